#include "sg.hlsl"

// Four float4 a texel: position and alpha, normal, diffuse and specular power
StructuredBuffer<float4> surfaces : register(t0);

// Level 0 of both pyramids; the moments as vsgl_moments_unpack takes them
RWStructuredBuffer<float4> moments : register(u1);
RWStructuredBuffer<float> pdf : register(u2);

cbuffer parameters : register(b3) {
    float4 eye;    // that the texels are seen from: the light
    float4 center; // positions are summed relative to it
    int texel_count;
};

[numthreads(64, 1, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int texel = int(thread.x);
    if (texel >= texel_count) return;
    float3 position = surfaces[4 * texel].xyz, normal = surfaces[4 * texel + 1].xyz;
    float3 diffuse = surfaces[4 * texel + 2].xyz, specular = surfaces[4 * texel + 3].xyz;
    float3 view = lobe_normalize_or(eye.xyz - position, normal);
    vsgl_moments m = vsgl_moments_from_vpl(position - center.xyz, normal, view, diffuse, specular, surfaces[4 * texel].w);
    moments[4 * texel] = float4(m.power[0], m.position.x);
    moments[4 * texel + 1] = float4(m.power[1], m.position.y);
    moments[4 * texel + 2] = float4(m.direction[0], m.position.z);
    moments[4 * texel + 3] = float4(m.direction[1], m.position_squared);
    pdf[texel] = lobe_mean(diffuse) + lobe_mean(specular);
}
