#include "shadow_map.h"

void shadow_map_render(shadow_map *map, const scene *world, vec3 position, float start) {
    int row, column;
    map->position = position;
    for (row = 0; row < SHADOW_MAP_SIZE; row++) {
        for (column = 0; column < SHADOW_MAP_SIZE; column++) {
            float u = 2 * ((float)column + 0.5f) / (float)SHADOW_MAP_SIZE - 1;
            float v = 2 * ((float)row + 0.5f) / (float)SHADOW_MAP_SIZE - 1;
            vec3 dir = {0, 0, 0};
            dir.z = 1 - fabsf(u) - fabsf(v);
            dir.x = dir.z < 0 ? (1 - fabsf(v)) * (u < 0 ? -1.0f : 1.0f) : u;
            dir.y = dir.z < 0 ? (1 - fabsf(u)) * (v < 0 ? -1.0f : 1.0f) : v;
            map->distances[row * SHADOW_MAP_SIZE + column] =
                scene_distance(world, position, vec3_normalize(dir), start);
        }
    }
}
