#include "sg.hlsl"
#include "asg.hlsl"
#include "vsgl_buffer.hlsl"
#include "vsgl_shade.hlsl"


void main(float4 position : SV_Position, out float4 pixel : SV_Target) {
    pixel = float4(vsgl_shade(int(position.y) * width + int(position.x)), 1.0);
}
