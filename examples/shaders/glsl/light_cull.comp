#version 450
#extension GL_GOOGLE_include_directive : require
#include "sg.glsl"
#include "ggx_bound.glsl"
#include "light_tiles.glsl"

// The first light of each subset, and their number
layout(std430, binding = 3) readonly buffer firsts_buffer { int firsts[]; };
layout(std430, binding = 4) readonly buffer volumes_buffer { vec4 volumes[]; };

// Two uint a tile: how many lights it keeps, which may be more than its list has room for; the depth that parts its
// clusters, as bits
layout(std430, binding = 5) buffer tiles_buffer { uint tiles[]; };

// The lists: index times 4, plus 1 for the nearer cluster, 2 for the farther
layout(std430, binding = 6) buffer entries_buffer { uint entries[]; };

shared vec3 least[64];
shared vec3 greatest[64];
shared uint kept;

// Leaves the least and the greatest of all threads in the first place
void reduce(int local) {
    memoryBarrierShared();
    barrier();
    for (int reach = 32; reach > 0; reach /= 2) {
        if (local < reach) {
            least[local] = min(least[local], least[local + reach]);
            greatest[local] = max(greatest[local], greatest[local + reach]);
        }
        memoryBarrierShared();
        barrier();
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
    vec4 first = volumes[3 * k], second = volumes[3 * k + 1];
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
layout(local_size_x = 64) in;
void main() {
    int column = int(gl_WorkGroupID.x), row = int(gl_WorkGroupID.y), subset = int(gl_WorkGroupID.z);
    int local = int(gl_LocalInvocationIndex), index = (subset * rows + row) * columns + column;
    // limits of x/z, y/z and z
    vec3 low = vec3(1e30, 1e30, 1e30), high = vec3(-1e30, -1e30, -1e30);
    for (int i = local; i < edge * edge; i += 64) {
        int at = pixel_of(column, row, subset, i);
        if (at < 0) continue;
        float depth = surfaces[2 * at].w;
        if (depth <= 0.0) continue;
        vec3 offset = surfaces[2 * at].xyz - eye.xyz;
        vec3 seen = vec3(dot(right.xyz, offset) / depth, dot(up.xyz, offset) / depth, depth);
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
    memoryBarrierShared();
    barrier();
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
    vec2 near_depth = vec2(low.z * 0.999999, greatest[0].z * 1.000001);
    vec2 far_depth = vec2(least[0].z * 0.999999, high.z * 1.000001);
    int end = low.z <= high.z ? firsts[subset + 1] : 0;
    for (int k = firsts[subset] + local; k < end; k += 64) {
        int hits = ggx_stretched_hits_clusters(volume_at(k), tile, near_depth, far_depth);
        if (hits == 0) continue;
        uint place;
        place = atomicAdd(kept, 1u);
        if (place < uint(most)) entries[index * most + int(place)] = uint(4 * k + hits);
    }
    memoryBarrierShared();
    barrier();
    if (local == 0) {
        tiles[2 * index] = kept;
        tiles[2 * index + 1] = floatBitsToUint(middle);
    }
}
