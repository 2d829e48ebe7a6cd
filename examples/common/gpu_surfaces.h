/* gpu_surfaces.h - the texels of a map as shaders take them: four vec4 each. */
#ifndef GPU_SURFACES_H
#define GPU_SURFACES_H

#include "gpu.h"
#include "vpl.h"

gpu_buffer *gpu_surfaces(gpu *device, const vpl_map *map);

#endif
