/* gpu_generate.h - vsgl_generate's filtered importance sampling on a Vulkan device. */
#ifndef GPU_GENERATE_H
#define GPU_GENERATE_H

#include "gpu.h"
#include "vsgl_generate.h"

typedef struct gpu_generate gpu_generate;

/* Puts a map on the device, whose texels are seen from the eye, and its shaders from a folder: vsgl_moments.comp.spv and
   so on. `most` is the largest number of lights. */
gpu_generate *gpu_generate_create(gpu *device, const char *folder, const vpl_map *map, vec3 eye, int most);
void gpu_generate_free(gpu_generate *g);

/* As vsgl_generate, by a method that is filtered; without a PDF it is what each texel reflects. Returns the milliseconds
   that the device took. */
double gpu_generate_run(gpu_generate *g, const float *pdf, method how, float k, unsigned seed, int count);

/* The lights: on the device, as vsgl_unpack takes them; and read from there. */
gpu_buffer *gpu_generate_lights(const gpu_generate *g);
void gpu_generate_read(gpu_generate *g, vsgl *lights, int count);

#endif
