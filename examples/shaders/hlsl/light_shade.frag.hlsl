#include "sg.hlsl"
#include "ggx_bound.hlsl"
#include "light_tiles.hlsl"
#include "light_shade.hlsl"


void main(float4 position : SV_Position, out float4 pixel : SV_Target) {
    pixel = float4(light_shade(int(position.x), int(position.y)), 1.0);
}
