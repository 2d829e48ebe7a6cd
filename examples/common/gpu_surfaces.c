#include "gpu_surfaces.h"
#include "fail.h"
#include "gpu_picture.h"
#include <stdlib.h>

gpu_buffer *gpu_surfaces(gpu *device, const vpl_map *map) {
    const size_t count = (size_t)map->width * (size_t)map->height;
    vec4 *surfaces = (vec4 *)allocate("surfaces", count, 4 * sizeof *surfaces);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const vpl *t = &map->texels[i];
        surfaces[4 * i] = vec4_of(t->position, t->alpha);
        surfaces[4 * i + 1] = vec4_of(t->normal, 0);
        surfaces[4 * i + 2] = vec4_of(t->diffuse, 0);
        surfaces[4 * i + 3] = vec4_of(t->specular, 0);
    }
    b = gpu_buffer_of(device, GPU_STORAGE, surfaces, count * 4 * sizeof *surfaces);
    free(surfaces);
    return b;
}
