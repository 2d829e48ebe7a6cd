#include "sg.hlsl"
#include "ggx_bound.hlsl"
#include "light_tiles.hlsl"

// The first light of each subset, and their number
StructuredBuffer<int> firsts : register(t3);
StructuredBuffer<float4> volumes : register(t4);

// Two uint a tile: how many lights it keeps, which may be more than its list has room for; the depth that parts its
// clusters, as bits
RWStructuredBuffer<uint> tiles : register(u5);

// The lists: index times 4, plus 1 for the nearer cluster, 2 for the farther
RWStructuredBuffer<uint> entries : register(u6);

groupshared float3 least[64];
groupshared float3 greatest[64];
groupshared uint kept;

// Leaves the least and the greatest of all threads in the first place
void reduce(int local) {
    GroupMemoryBarrierWithGroupSync();
    for (int reach = 32; reach > 0; reach /= 2) {
        if (local < reach) {
            least[local] = min(least[local], least[local + reach]);
            greatest[local] = max(greatest[local], greatest[local + reach]);
        }
        GroupMemoryBarrierWithGroupSync();
    }
}

// Index of a tile's pixel, -1 beyond the picture
int pixel_of(int column, int row, int subset, int i) {
    int x = (column * edge + i % edge) * interleave + subset % interleave;
    int y = (row * edge + i / edge) * interleave + subset / interleave;
    return x < width && y < height ? y * width + x : -1;
}

ggx_stretched volume_at(int k) {
    ggx_stretched s;
    float4 first = volumes[3 * k], second = volumes[3 * k + 1];
    s.xx = first.x;
    s.xy = first.y;
    s.xz = first.z;
    s.yy = first.w;
    s.yz = second.x;
    s.zz = second.y;
    s.size = second.z;
    s.swapped = second.w > 0.0;
    s.center = volumes[3 * k + 2].xyz;
    return s;
}

// A workgroup a tile: its sides and depths from its pixels, then the lights of its subset
[numthreads(64, 1, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int column = int(workgroup.x), row = int(workgroup.y), subset = int(workgroup.z);
    int local = int(local_index), index = (subset * rows + row) * columns + column;
    // limits of x/z, y/z and z
    float3 low = float3(1e30, 1e30, 1e30), high = float3(-1e30, -1e30, -1e30);
    for (int i = local; i < edge * edge; i += 64) {
        int at = pixel_of(column, row, subset, i);
        if (at < 0) continue;
        float depth = surfaces[2 * at].w;
        if (depth <= 0.0) continue;
        float3 offset = surfaces[2 * at].xyz - eye.xyz;
        float3 seen = float3(dot(right.xyz, offset) / depth, dot(up.xyz, offset) / depth, depth);
        low = min(low, seen);
        high = max(high, seen);
    }
    least[local] = low;
    greatest[local] = high;
    if (local == 0) kept = 0u;
    reduce(local);
    low = least[0];
    high = greatest[0];
    ggx_tile tile;
    tile.left = low.x - 1e-6;
    tile.right = high.x + 1e-6;
    tile.bottom = low.y - 1e-6;
    tile.top = high.y + 1e-6;
    GroupMemoryBarrierWithGroupSync();
    // two clusters of depths, parted in the middle
    float middle = 0.5 * (low.z + high.z), nearer = 0.0, farther = 1e30;
    for (int j = local; j < edge * edge; j += 64) {
        int at = pixel_of(column, row, subset, j);
        if (at < 0) continue;
        float depth = surfaces[2 * at].w;
        if (depth <= 0.0) continue;
        if (depth > middle)
            farther = min(farther, depth);
        else
            nearer = max(nearer, depth);
    }
    least[local].z = farther;
    greatest[local].z = nearer;
    reduce(local);
    float2 near_depth = float2(low.z * 0.999999, greatest[0].z * 1.000001);
    float2 far_depth = float2(least[0].z * 0.999999, high.z * 1.000001);
    int end = low.z <= high.z ? firsts[subset + 1] : 0;
    for (int k = firsts[subset] + local; k < end; k += 64) {
        int hits = ggx_stretched_hits_clusters(volume_at(k), tile, near_depth, far_depth);
        if (hits == 0) continue;
        uint place;
        InterlockedAdd(kept, 1u, place);
        if (place < uint(most)) entries[index * most + int(place)] = uint(4 * k + hits);
    }
    GroupMemoryBarrierWithGroupSync();
    if (local == 0) {
        tiles[2 * index] = kept;
        tiles[2 * index + 1] = asuint(middle);
    }
}
