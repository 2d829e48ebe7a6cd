/* pipelines.h - whole pipelines on the GPU against the same on the CPU. */
#ifndef PIPELINES_H
#define PIPELINES_H

#include "../../../examples/common/gpu.h"
#include "../../../examples/common/image.h"

/* Fails unless the picture's PSNR at an exposure is at least 60 dB, and its brightest pixels are as bright. */
void pipeline_picture(const char *what, const image *got, const image *wanted, float exposure);

/* Fails unless it holds. */
void pipeline_check(const char *what, int holds);

/* One a pipeline. They run in each language, whose shaders are in the folder: vsgl_shade.comp.spv and so on. */
void pipeline_shade(gpu *device, const char *folder);
void pipeline_generate(gpu *device, const char *folder);
void pipeline_cull(gpu *device, const char *folder);
void pipeline_filter(gpu *device, const char *folder);

#endif
