#include "gpu_filter.h"
#include "fail.h"
#include "gpu_picture.h"
#include <stdlib.h>

enum { LIGHT, GUIDES, PARAMETERS, BUFFERS }; /* GUIDES: prepared ones, for the filter */
enum { GUIDE_SIZE = 8, PREPARED_SIZE = 5 };  /* vec4s, as in lobe_guides.glsl */

static const gpu_kind kinds[BUFFERS] = {GPU_STORAGE, GPU_STORAGE, GPU_UNIFORM};

struct gpu_filter {
    gpu_buffer *buffers[BUFFERS], *raw; /* raw: what lobe_prepare.comp reads; null for upsampling */
    gpu_program *prepare;
    gpu_picture picture;
};

/* Colours, and a fourth number that is 0 for guides without */
static gpu_buffer *upload_colours(gpu *device, const vec3 *colours, const guide *guides, size_t count) {
    vec4 *packed = (vec4 *)allocate("picture", count, sizeof *packed);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) packed[i] = vec4_of(colours[i], guides && guides[i].valid ? 1 : 0);
    b = gpu_buffer_of(device, GPU_STORAGE, packed, count * sizeof *packed);
    free(packed);
    return b;
}

static gpu_buffer *upload_guides(gpu *device, const guide *guides, size_t count) {
    vec4 *packed = (vec4 *)allocate("guides", count, GUIDE_SIZE * sizeof *packed);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const guide *g = &guides[i];
        vec4 *to = packed + i * GUIDE_SIZE;
        float amplitudes[GLOSSY_LOBES] = {0, 0, 0};
        int k;
        if (!g->valid) continue;
        to[0] = vec4_of(g->normal, g->depth);
        to[1] = vec4_of(g->lobe.axis, g->lobe.sharpness);
        for (k = 0; k < g->parts_count; k++) {
            to[2 + k] = vec4_of(g->parts[k].axis, g->parts[k].sharpness);
            amplitudes[k] = g->parts[k].log_amplitude;
        }
        to[5] = vec4_of(lobe_vector(amplitudes[0], amplitudes[1], amplitudes[2]), (float)g->parts_count);
        to[6] = vec4_of(g->stretched.x, g->stretched.sharpness_x);
        to[7] = vec4_of(g->stretched.z, g->stretched.sharpness_y);
    }
    b = gpu_buffer_of(device, GPU_STORAGE, packed, count * GUIDE_SIZE * sizeof *packed);
    free(packed);
    return b;
}

/* Numbers in the order of lobe_guides.glsl */
static int weight_of(filter_method m) {
    switch (m) {
    case FILTER_NORMAL:
        return 0;
    case FILTER_EQ12:
        return 1;
    case FILTER_EQ11:
        return 2;
    case FILTER_EQ13:
        return 3;
    case FILTER_UNFILTERED:
    case FILTER_BANDLIMIT:
    case FILTER_ALPHA_GUIDE:
    case FILTER_METHODS:
        break;
    }
    give_up("filter", "no shader has this method");
    return 0;
}

gpu_filter *gpu_filter_create(gpu *device, const char *folder, const image *noisy, const guide *guides, filter_method m,
                              float parameter, float depth_variance) {
    struct {
        int width, height, method;
        float parameter, depth_variance;
        int radius;
        float kernel_variance;
    } parameters;
    gpu_filter *f = (gpu_filter *)allocate("GPU", 1, sizeof *f);
    const size_t count = (size_t)noisy->width * (size_t)noisy->height;
    f->prepare = gpu_compute_create(device, folder, "lobe_prepare", kinds, BUFFERS, 0);
    f->picture = gpu_picture_create(device, folder, "lobe_filter", kinds, BUFFERS, noisy->width, noisy->height);
    parameters.width = noisy->width;
    parameters.height = noisy->height;
    parameters.method = weight_of(m);
    parameters.parameter = parameter;
    parameters.depth_variance = depth_variance;
    parameters.radius = FILTER_RADIUS;
    parameters.kernel_variance = filter_kernel_variance(FILTER_RADIUS);
    f->raw = upload_guides(device, guides, count);
    f->buffers[LIGHT] = upload_colours(device, noisy->pixels, guides, count);
    f->buffers[GUIDES] = gpu_buffer_create(device, GPU_STORAGE, count * PREPARED_SIZE * sizeof(vec4));
    f->buffers[PARAMETERS] = gpu_buffer_of(device, GPU_UNIFORM, &parameters, sizeof parameters);
    return f;
}

gpu_filter *gpu_upsample_create(gpu *device, const char *folder, const coarse *low, int width, int height,
                                const guide *guides, filter_method m, float parameter) {
    struct {
        int width, height, coarse_width, coarse_height, cell, column, row, method;
        float parameter, depth_variance;
    } parameters;
    gpu_filter *f = (gpu_filter *)allocate("GPU", 1, sizeof *f);
    const size_t count = (size_t)low->width * (size_t)low->height;
    if (m == FILTER_EQ11) give_up("upsampling", "no shader has this method");
    parameters.width = width;
    parameters.height = height;
    parameters.coarse_width = low->width;
    parameters.coarse_height = low->height;
    parameters.cell = UPSAMPLE_CELL;
    parameters.column = low->column;
    parameters.row = low->row;
    parameters.method = weight_of(m);
    parameters.parameter = parameter;
    parameters.depth_variance = filter_depth_variance;
    f->picture = gpu_picture_create(device, folder, "lobe_upsample", kinds, BUFFERS, width, height);
    f->buffers[LIGHT] = upload_colours(device, low->colours, NULL, count);
    f->buffers[GUIDES] = upload_guides(device, guides, (size_t)width * (size_t)height);
    f->buffers[PARAMETERS] = gpu_buffer_of(device, GPU_UNIFORM, &parameters, sizeof parameters);
    return f;
}

double gpu_filter_run(gpu_filter *f, gpu_stage stage, vec3 *pixels) {
    double ms = 0;
    if (f->prepare) {
        gpu_buffer *buffers[BUFFERS];
        buffers[LIGHT] = f->raw;
        buffers[GUIDES] = f->buffers[GUIDES];
        buffers[PARAMETERS] = f->buffers[PARAMETERS];
        ms = gpu_run(f->prepare, buffers, (f->picture.width + 7) / 8, (f->picture.height + 7) / 8, 1);
    }
    return ms + gpu_picture_run(&f->picture, stage, f->buffers, pixels);
}

void gpu_filter_free(gpu_filter *f) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(f->buffers[i]);
    if (f->raw) gpu_buffer_free(f->raw);
    if (f->prepare) gpu_program_free(f->prepare);
    gpu_picture_free(&f->picture);
    free(f);
}
