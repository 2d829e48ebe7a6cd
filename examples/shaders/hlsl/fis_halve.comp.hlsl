#include "fis.hlsl"

RWStructuredBuffer<float> texels : register(u0);

#include "fis_halve.hlsl"

// One invocation a channel, since neighbours then write side by side
[numthreads(64, 1, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int x = int(thread.x) / channels, y = int(thread.y);
    int channel = int(thread.x) - x * channels;
    if (x < lobe_fis_size(width, level)) texels[fis_number(x, y, level, channel)] = fis_made(x, y, channel);
}
