#include "fis.hlsl"

StructuredBuffer<float> texels : register(t0);

#include "fis_halve.hlsl"


void main(float4 position : SV_Position, out float4 pixel : SV_Target) {
    int x = int(position.x), y = int(position.y);
    pixel = float4(0.0, 0.0, 0.0, 0.0);
    for (int k = 0; k < 4; k++)
        if (4 * plane + k < channels) pixel[k] = fis_made(x, y, 4 * plane + k);
}
