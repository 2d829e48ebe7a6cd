/* shadow_map.h - distances seen from a light in all directions, on an octahedral map. */
#ifndef SHADOW_MAP_H
#define SHADOW_MAP_H

#include "scene.h"

enum { SHADOW_MAP_SIZE = 48 };

typedef struct {
    vec3 position;
    float distances[SHADOW_MAP_SIZE * SHADOW_MAP_SIZE];
} shadow_map;

/* Looks for surfaces farther than `start` from the light. */
void shadow_map_render(shadow_map *map, const scene *world, vec3 position, float start);

/* Index of the map's texel in a direction of any length. */
static inline int shadow_map_texel(vec3 dir) {
    float scale = 1 / lobe_max(fabsf(dir.x) + fabsf(dir.y) + fabsf(dir.z), LOBE_TINY), x = dir.x * scale,
          y = dir.y * scale, u, v;
    float folded_x = (1 - fabsf(y)) * (x < 0 ? -1.0f : 1.0f), folded_y = (1 - fabsf(x)) * (y < 0 ? -1.0f : 1.0f);
    u = dir.z < 0 ? folded_x : x;
    v = dir.z < 0 ? folded_y : y;
    u = (u * 0.5f + 0.5f) * (float)SHADOW_MAP_SIZE;
    v = (v * 0.5f + 0.5f) * (float)SHADOW_MAP_SIZE;
    return (int)lobe_min(v, (float)SHADOW_MAP_SIZE - 1) * SHADOW_MAP_SIZE +
           (int)lobe_min(u, (float)SHADOW_MAP_SIZE - 1);
}

/* Where to look for a point with the given normal: its texel, and the depth that must not exceed the distance there.
   The bias grows with the slope: a texel is seen under an angle of about 1.7 / size. */
static inline int shadow_map_probe(vec3 light, vec3 point, vec3 normal, float *depth) {
    vec3 offset = lobe_sub(point, light);
    float distance2 = lobe_max(lobe_dot(offset, offset), LOBE_TINY), distance = sqrtf(distance2);
    float cosine = lobe_max(-lobe_dot(offset, normal), 0.1f * distance); /* times distance */
    *depth = distance - 0.5f * (1.7f / (float)SHADOW_MAP_SIZE) * distance2 * (distance / cosine) - 0.01f;
    return shadow_map_texel(offset);
}

#endif
