#include "gpu_picture.h"
#include "fail.h"
#include <stdlib.h>
#include <string.h>

gpu_picture gpu_picture_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count,
                               int width, int height) {
    gpu_kind all[GPU_MAX_BUFFERS];
    gpu_picture p;
    const size_t pixels = (size_t)width * (size_t)height;
    memcpy(all, kinds, (size_t)count * sizeof *kinds);
    all[count] = GPU_STORAGE;
    p.width = width;
    p.height = height;
    p.count = count;
    p.compute = gpu_compute_create(device, folder, name, all, count + 1, 0);
    p.fragment = gpu_fragment_create(device, folder, name, kinds, count);
    p.result = gpu_buffer_create(device, GPU_STORAGE, pixels * sizeof *p.pixels);
    p.pixels = (vec4 *)allocate("picture", pixels, sizeof *p.pixels);
    return p;
}

double gpu_picture_run(gpu_picture *p, gpu_stage stage, gpu_buffer *const *buffers, vec3 *pixels) {
    double ms;
    int i;
    if (stage == GPU_COMPUTE) {
        gpu_buffer *all[GPU_MAX_BUFFERS];
        memcpy(all, buffers, (size_t)p->count * sizeof(gpu_buffer *));
        all[p->count] = p->result;
        ms = gpu_run(p->compute, all, (p->width + 7) / 8, (p->height + 7) / 8, 1);
        gpu_buffer_read(p->result, p->pixels);
    } else {
        ms = gpu_draw(p->fragment, buffers, p->width, p->height, &p->pixels->x);
    }
    for (i = 0; i < p->width * p->height; i++) pixels[i] = lobe_vector(p->pixels[i].x, p->pixels[i].y, p->pixels[i].z);
    return ms;
}

void gpu_picture_free(gpu_picture *p) {
    gpu_program_free(p->compute);
    gpu_program_free(p->fragment);
    gpu_buffer_free(p->result);
    free(p->pixels);
}
