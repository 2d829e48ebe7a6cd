/* gpu_filter.h - filter_frame and upsample_pixel on a Vulkan device. */
#ifndef GPU_FILTER_H
#define GPU_FILTER_H

#include "gpu.h"
#include "lobe_filter.h"

typedef struct gpu_filter gpu_filter;

/* Puts on the device what filter_frame takes, and its shaders from a folder: lobe_filter.comp.spv and so on. The method is
   FILTER_NORMAL, FILTER_EQ11, FILTER_EQ12 or FILTER_EQ13. */
gpu_filter *gpu_filter_create(gpu *device, const char *folder, const image *noisy, const guide *guides, filter_method m,
                              float parameter, float depth_variance);

/* The same for upsample_pixel over a picture of this size; FILTER_EQ11 is not for this. */
gpu_filter *gpu_upsample_create(gpu *device, const char *folder, const coarse *low, int width, int height,
                                const guide *guides, filter_method m, float parameter);

/* Returns the milliseconds that the device took, preparation of the guides included. An upsampled pixel is black where
   nothing glossy is seen. */
double gpu_filter_run(gpu_filter *f, gpu_stage stage, vec3 *pixels);
void gpu_filter_free(gpu_filter *f);

#endif
