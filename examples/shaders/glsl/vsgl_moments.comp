#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"

// Four vec4 a texel: position and alpha, normal, diffuse and specular power
layout(std430, binding = 0) readonly buffer surfaces_buffer { vec4 surfaces[]; };

// Level 0 of both pyramids; the moments as vsgl_moments_unpack takes them
layout(std430, binding = 1) buffer moments_buffer { vec4 moments[]; };
layout(std430, binding = 2) buffer pdf_buffer { float pdf[]; };

layout(std140, binding = 3) uniform parameters {
    vec4 eye;    // that the texels are seen from: the light
    vec4 center; // positions are summed relative to it
    int texel_count;
};

layout(local_size_x = 64) in;
void main() {
    int texel = int(gl_GlobalInvocationID.x);
    if (texel >= texel_count) return;
    vec3 position = surfaces[4 * texel].xyz, normal = surfaces[4 * texel + 1].xyz;
    vec3 diffuse = surfaces[4 * texel + 2].xyz, specular = surfaces[4 * texel + 3].xyz;
    vec3 view = lobe_normalize_or(eye.xyz - position, normal);
    vsgl_moments m = vsgl_moments_from_vpl(position - center.xyz, normal, view, diffuse, specular, surfaces[4 * texel].w);
    moments[4 * texel] = vec4(m.power[0], m.position.x);
    moments[4 * texel + 1] = vec4(m.power[1], m.position.y);
    moments[4 * texel + 2] = vec4(m.direction[0], m.position.z);
    moments[4 * texel + 3] = vec4(m.direction[1], m.position_squared);
    pdf[texel] = lobe_mean(diffuse) + lobe_mean(specular);
}
