#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "asg.glsl"
#include "bilateral.glsl"
#include "lobe_guides.glsl"
#include "lobe_parameters.glsl"

layout(std430, binding = 0) readonly buffer guides_buffer { vec4 guides[]; };
layout(std430, binding = 1) buffer prepared_buffer { vec4 prepared[]; };

void prepare_normal(int from, int to) {
    prepared[to] = vec4(guides[from].xyz * bilateral_scale(parameter), 0.0);
}

void prepare_sg(int from, int to) {
    bilateral_sg p = bilateral_sg_prepare(guide_lobe(guides[from + 1], 0.0), parameter);
    prepared[to] = vec4(p.axis, p.width);
}

void prepare_sg_mixture(int from, int to) {
    sg_lobe lobes[4];
    bilateral_sg_part parts[4];
    vec4 rest = guides[from + 5];
    lobes[0] = guide_lobe(guides[from + 2], rest.x);
    lobes[1] = guide_lobe(guides[from + 3], rest.y);
    lobes[2] = guide_lobe(guides[from + 4], rest.z);
    lobes[3] = lobes[0];
    bilateral_sg_mixture_prepare(lobes, int(rest.w), parts);
    prepared[to] = vec4(parts[0].axis, parts[0].sharpness);
    prepared[to + 1] = vec4(parts[1].axis, parts[1].sharpness);
    prepared[to + 2] = vec4(parts[2].axis, parts[2].sharpness);
    prepared[to + 3] = vec4(parts[0].amplitude, parts[1].amplitude, parts[2].amplitude, 0.0);
    prepared[to + 4] = vec4(parts[0].tail, parts[1].tail, parts[2].tail, 0.0);
}

void prepare_asg(int from, int to) {
    bilateral_asg p = bilateral_asg_prepare(guide_asg(guides[from + 6], guides[from + 7]));
    prepared[to] = vec4(p.x, p.sharpness_x);
    prepared[to + 1] = vec4(p.y, p.sharpness_y);
    prepared[to + 2] = vec4(p.z, p.own_exponent);
    prepared[to + 3] = vec4(p.own_scale, 0.0, 0.0, 0.0);
}

layout(local_size_x = 8, local_size_y = 8) in;
void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y);
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
