#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "ggx_bound.glsl"
#include "light_tiles.glsl"

// Each light's volume in the camera's frame, as light_cull takes it: three vec4
layout(std430, binding = 4) buffer volumes_buffer { vec4 volumes[]; };

layout(local_size_x = 64) in;
void main() {
    int k = int(gl_GlobalInvocationID.x);
    if (k >= light_count) return;
    vpl l = vpl_at(k);
    ggx_ellipsoid e;
    if (l.glossy)
        e = ggx_bound_ellipsoid(l.position, l.normal, l.wi, l.alpha, l.flux, 1.0, delta, l.xi);
    else
        e = ggx_ellipsoid_of_sphere(ggx_bound_diffuse(l.position, l.normal, l.flux, 1.0, delta, l.xi));
    vec3 view[3];
    view[0] = right.xyz;
    view[1] = up.xyz;
    view[2] = forward.xyz;
    ggx_stretched s = ggx_stretch_ellipsoid(ggx_ellipsoid_transform(e, view, eye.xyz));
    volumes[3 * k] = vec4(s.xx, s.xy, s.xz, s.yy);
    volumes[3 * k + 1] = vec4(s.yz, s.zz, s.size, s.swapped ? 1.0 : 0.0);
    volumes[3 * k + 2] = vec4(s.center, 0.0);
}
