#include "sg.hlsl"
#include "ggx_bound.hlsl"
#include "light_tiles.hlsl"

// Each light's volume in the camera's frame, as light_cull takes it: three float4
RWStructuredBuffer<float4> volumes : register(u4);

[numthreads(64, 1, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int k = int(thread.x);
    if (k >= light_count) return;
    vpl l = vpl_at(k);
    ggx_ellipsoid e;
    if (l.glossy)
        e = ggx_bound_ellipsoid(l.position, l.normal, l.wi, l.alpha, l.flux, 1.0, delta, l.xi);
    else
        e = ggx_ellipsoid_of_sphere(ggx_bound_diffuse(l.position, l.normal, l.flux, 1.0, delta, l.xi));
    float3 view[3];
    view[0] = right.xyz;
    view[1] = up.xyz;
    view[2] = forward.xyz;
    ggx_stretched s = ggx_stretch_ellipsoid(ggx_ellipsoid_transform(e, view, eye.xyz));
    volumes[3 * k] = float4(s.xx, s.xy, s.xz, s.yy);
    volumes[3 * k + 1] = float4(s.yz, s.zz, s.size, s.swapped ? 1.0 : 0.0);
    volumes[3 * k + 2] = float4(s.center, 0.0);
}
