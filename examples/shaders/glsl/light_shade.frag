#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "ggx_bound.glsl"
#include "light_tiles.glsl"
#include "light_shade.glsl"

layout(location = 0) out vec4 pixel;

void main() {
    pixel = vec4(light_shade(int(gl_FragCoord.x), int(gl_FragCoord.y)), 1.0);
}
