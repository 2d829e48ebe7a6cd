#include "sg.hlsl"
#include "asg.hlsl"
#include "bilateral.hlsl"
#include "lobe_guides.hlsl"
#include "lobe_upsample.hlsl"


void main(float4 position : SV_Position, out float4 pixel : SV_Target) {
    pixel = lobe_upsample(int(position.x), int(position.y));
}
