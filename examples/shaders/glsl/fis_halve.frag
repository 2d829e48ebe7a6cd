#version 450
#extension GL_GOOGLE_include_directive : require
#include "fis.glsl"

layout(std430, binding = 0) readonly buffer texels_buffer { float texels[]; };

#include "fis_halve.glsl"

layout(location = 0) out vec4 pixel;

void main() {
    int x = int(gl_FragCoord.x), y = int(gl_FragCoord.y);
    pixel = vec4(0.0, 0.0, 0.0, 0.0);
    for (int k = 0; k < 4; k++)
        if (4 * plane + k < channels) pixel[k] = fis_made(x, y, 4 * plane + k);
}
