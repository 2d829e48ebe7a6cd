/* gpu_shade.h - vsgl_shade on a Vulkan device. */
#ifndef GPU_SHADE_H
#define GPU_SHADE_H

#include "gpu.h"
#include "shadow_map.h"
#include "vpl.h"

typedef struct gpu_shade gpu_shade;

/* Puts on the device what vsgl_shade takes, and its shaders from a folder: vsgl_shade.comp.spv and so on. All texels are
   seen from the eye, and each map is rendered at its light's position. */
gpu_shade *gpu_shade_create(gpu *device, const char *folder, const vpl_map *map, vec3 eye, const vsgl *lights,
                            const shadow_map *maps, int light_count);

/* Returns the milliseconds that the device took. */
double gpu_shade_run(gpu_shade *s, gpu_stage stage, vec3 *radiance);
void gpu_shade_free(gpu_shade *s);

#endif
