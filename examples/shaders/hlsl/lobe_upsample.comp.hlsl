#include "sg.hlsl"
#include "asg.hlsl"
#include "bilateral.hlsl"
#include "lobe_guides.hlsl"
#include "lobe_upsample.hlsl"

RWStructuredBuffer<float4> picture : register(u3);

[numthreads(8, 8, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int x = int(thread.x), y = int(thread.y);
    if (x < width && y < height) picture[y * width + x] = lobe_upsample(x, y);
}
