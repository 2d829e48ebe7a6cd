#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "asg.glsl"
#include "bilateral.glsl"
#include "lobe_guides.glsl"
#include "lobe_upsample.glsl"

layout(std430, binding = 3) buffer picture_buffer { vec4 picture[]; };

layout(local_size_x = 8, local_size_y = 8) in;
void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y);
    if (x < width && y < height) picture[y * width + x] = lobe_upsample(x, y);
}
