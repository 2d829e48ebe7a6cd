#include "gpu_halve.h"
#include "../../fis.h"
#include "fail.h"
#include <stdlib.h>

enum { TEXELS, PARAMETERS, BUFFERS, GROUP = 64 };
enum { CLEAN, CLEAN_PDF, HALVE, FILL }; /* as in the shader */

static const gpu_kind kinds[BUFFERS] = {GPU_STORAGE, GPU_UNIFORM};

typedef struct {
    int width, height, channels, level, mode, plane;
} halve_parameters;

struct gpu_halve {
    gpu_buffer *parameters;
    gpu_program *compute, *fragment;
};

gpu_halve *gpu_halve_create(gpu *device, const char *folder) {
    gpu_halve *h = (gpu_halve *)allocate("GPU", 1, sizeof *h);
    h->compute = gpu_compute_create(device, folder, "fis_halve", kinds, BUFFERS, 0);
    h->fragment = gpu_fragment_create(device, folder, "fis_halve", kinds, BUFFERS);
    h->parameters = gpu_buffer_create(device, GPU_UNIFORM, sizeof(halve_parameters));
    return h;
}

void gpu_halve_free(gpu_halve *h) {
    gpu_program_free(h->compute);
    gpu_program_free(h->fragment);
    gpu_buffer_free(h->parameters);
    free(h);
}

static int size_of(int size, int level) {
    return ((size - 1) >> level) + 1;
}

static double make_level(gpu_halve *h, gpu_buffer *texels, halve_parameters p) {
    gpu_buffer *buffers[BUFFERS];
    buffers[TEXELS] = texels;
    buffers[PARAMETERS] = h->parameters;
    gpu_buffer_write(h->parameters, &p);
    return gpu_run(h->compute, buffers, (size_of(p.width, p.level) * p.channels + GROUP - 1) / GROUP,
                   size_of(p.height, p.level), 1);
}

double gpu_halve_build(gpu_halve *h, gpu_buffer *texels, int width, int height, int channels, int is_pdf) {
    const int levels = fis_levels(width, height);
    halve_parameters p;
    double ms = 0;
    p.width = width;
    p.height = height;
    p.channels = channels;
    p.plane = 0;
    for (p.level = 0; p.level < levels; p.level++) {
        p.mode = p.level ? HALVE : is_pdf ? CLEAN_PDF : CLEAN;
        ms += make_level(h, texels, p);
    }
    p.mode = FILL;
    for (p.level = 0; is_pdf && p.level < levels; p.level++) ms += make_level(h, texels, p);
    return ms;
}

void gpu_halve_draw(gpu_halve *h, gpu_buffer *texels, int width, int height, int channels, int level, int plane,
                    float *pixels) {
    halve_parameters p;
    gpu_buffer *buffers[BUFFERS];
    p.width = width;
    p.height = height;
    p.channels = channels;
    p.level = level;
    p.mode = HALVE;
    p.plane = plane;
    buffers[TEXELS] = texels;
    buffers[PARAMETERS] = h->parameters;
    gpu_buffer_write(h->parameters, &p);
    gpu_draw(h->fragment, buffers, size_of(width, level), size_of(height, level), pixels);
}
