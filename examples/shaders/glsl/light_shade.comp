#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "ggx_bound.glsl"
#include "light_tiles.glsl"
#include "light_shade.glsl"

layout(std430, binding = 7) buffer picture_buffer { vec4 picture[]; };

layout(local_size_x = 8, local_size_y = 8) in;
void main() {
    int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y);
    if (x < width && y < height) picture[y * width + x] = vec4(light_shade(x, y), 1.0);
}
