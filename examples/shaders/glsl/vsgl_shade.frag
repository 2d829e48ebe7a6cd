#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "asg.glsl"
#include "vsgl_buffer.glsl"
#include "vsgl_shade.glsl"

layout(location = 0) out vec4 pixel;

void main() {
    pixel = vec4(vsgl_shade(int(gl_FragCoord.y) * width + int(gl_FragCoord.x)), 1.0);
}
