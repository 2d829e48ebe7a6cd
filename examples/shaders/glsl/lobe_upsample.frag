#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "asg.glsl"
#include "bilateral.glsl"
#include "lobe_guides.glsl"
#include "lobe_upsample.glsl"

layout(location = 0) out vec4 pixel;

void main() {
    pixel = lobe_upsample(int(gl_FragCoord.x), int(gl_FragCoord.y));
}
