/* gpu_halve.h - pyramids of fis.h on a Vulkan device. */
#ifndef GPU_HALVE_H
#define GPU_HALVE_H

#include "gpu.h"

typedef struct gpu_halve gpu_halve;

/* Its shaders are in the folder: fis_halve.comp.spv and so on. */
gpu_halve *gpu_halve_create(gpu *device, const char *folder);
void gpu_halve_free(gpu_halve *h);

/* fis_build, or fis_build_pdf for one channel, in a buffer of fis_pyramid_size floats that begins with the image.
   Returns the milliseconds that the device took. */
double gpu_halve_build(gpu_halve *h, gpu_buffer *texels, int width, int height, int channels, int is_pdf);

/* Draws four channels of a level above 0 from the level below, by the fragment shader, into four floats a texel. */
void gpu_halve_draw(gpu_halve *h, gpu_buffer *texels, int width, int height, int channels, int level, int plane,
                    float *pixels);

#endif
