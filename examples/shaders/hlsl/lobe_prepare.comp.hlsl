#include "sg.hlsl"
#include "asg.hlsl"
#include "bilateral.hlsl"
#include "lobe_guides.hlsl"
#include "lobe_parameters.hlsl"

StructuredBuffer<float4> guides : register(t0);
RWStructuredBuffer<float4> prepared : register(u1);

void prepare_normal(int from, int to) {
    prepared[to] = float4(guides[from].xyz * bilateral_scale(parameter), 0.0);
}

void prepare_sg(int from, int to) {
    bilateral_sg p = bilateral_sg_prepare(guide_lobe(guides[from + 1], 0.0), parameter);
    prepared[to] = float4(p.axis, p.width);
}

void prepare_sg_mixture(int from, int to) {
    sg_lobe lobes[4];
    bilateral_sg_part parts[4];
    float4 rest = guides[from + 5];
    lobes[0] = guide_lobe(guides[from + 2], rest.x);
    lobes[1] = guide_lobe(guides[from + 3], rest.y);
    lobes[2] = guide_lobe(guides[from + 4], rest.z);
    lobes[3] = lobes[0];
    bilateral_sg_mixture_prepare(lobes, int(rest.w), parts);
    prepared[to] = float4(parts[0].axis, parts[0].sharpness);
    prepared[to + 1] = float4(parts[1].axis, parts[1].sharpness);
    prepared[to + 2] = float4(parts[2].axis, parts[2].sharpness);
    prepared[to + 3] = float4(parts[0].amplitude, parts[1].amplitude, parts[2].amplitude, 0.0);
    prepared[to + 4] = float4(parts[0].tail, parts[1].tail, parts[2].tail, 0.0);
}

void prepare_asg(int from, int to) {
    bilateral_asg p = bilateral_asg_prepare(guide_asg(guides[from + 6], guides[from + 7]));
    prepared[to] = float4(p.x, p.sharpness_x);
    prepared[to + 1] = float4(p.y, p.sharpness_y);
    prepared[to + 2] = float4(p.z, p.own_exponent);
    prepared[to + 3] = float4(p.own_scale, 0.0, 0.0, 0.0);
}

[numthreads(8, 8, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int x = int(thread.x), y = int(thread.y);
    if (x >= width || y >= height) return;
    int from = (y * width + x) * GUIDE_SIZE, to = (y * width + x) * PREPARED_SIZE;
    float depth = guides[from].w;
    if (depth > 0.0) {
        if (method == WEIGHT_NORMALS) prepare_normal(from, to);
        if (method == WEIGHT_SG) prepare_sg(from, to);
        if (method == WEIGHT_SG_MIXTURE) prepare_sg_mixture(from, to);
        if (method == WEIGHT_ASG) prepare_asg(from, to);
    }
    prepared[to + 4].w = depth * bilateral_scale(depth_variance);
}
