#version 450
#extension GL_GOOGLE_include_directive : require
#include "fis.glsl"

layout(std430, binding = 0) buffer texels_buffer { float texels[]; };

#include "fis_halve.glsl"

// One invocation a channel, since neighbours then write side by side
layout(local_size_x = 64, local_size_y = 1) in;
void main() {
    int x = int(gl_GlobalInvocationID.x) / channels, y = int(gl_GlobalInvocationID.y);
    int channel = int(gl_GlobalInvocationID.x) - x * channels;
    if (x < lobe_fis_size(width, level)) texels[fis_number(x, y, level, channel)] = fis_made(x, y, channel);
}
