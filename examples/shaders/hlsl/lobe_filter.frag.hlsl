#include "sg.hlsl"
#include "asg.hlsl"
#include "bilateral.hlsl"
#include "lobe_guides.hlsl"
#include "lobe_parameters.hlsl"
#include "lobe_filter.hlsl"


void main(float4 position : SV_Position, out float4 pixel : SV_Target) {
    pixel = float4(lobe_filter(int(position.x), int(position.y)), 1.0);
}
