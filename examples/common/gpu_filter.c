#include "gpu_filter.h"
#include "fail.h"
#include "output.h"
#include <stdio.h>
#include <stdlib.h>

enum { LIGHT, GUIDES, PARAMETERS, PICTURE, BUFFERS }; /* GUIDES: prepared ones, for the filter */
enum { GUIDE_SIZE = 8, PREPARED_SIZE = 5 };           /* vec4s, as in lobe_guides.glsl */

static const gpu_kind kinds[BUFFERS] = {GPU_STORAGE, GPU_STORAGE, GPU_UNIFORM, GPU_STORAGE};

typedef struct {
    float x, y, z, w;
} vec4;

struct gpu_filter {
    int width, height;
    gpu_buffer *buffers[BUFFERS], *raw; /* raw: what lobe_prepare.comp reads; null for upsampling */
    gpu_program *prepare, *compute, *fragment;
    vec4 *pixels;
};

static vec4 join(vec3 v, float w) {
    vec4 joined;
    joined.x = v.x;
    joined.y = v.y;
    joined.z = v.z;
    joined.w = w;
    return joined;
}

static gpu_buffer *upload(gpu *device, gpu_kind kind, const void *values, size_t size) {
    gpu_buffer *b = gpu_buffer_create(device, kind, size);
    gpu_buffer_write(b, values);
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
        to[0] = join(g->normal, g->depth);
        to[1] = join(g->lobe.axis, g->lobe.sharpness);
        for (k = 0; k < g->parts_count; k++) {
            to[2 + k] = join(g->parts[k].axis, g->parts[k].sharpness);
            amplitudes[k] = g->parts[k].log_amplitude;
        }
        to[5] = join(lobe_vector(amplitudes[0], amplitudes[1], amplitudes[2]), (float)g->parts_count);
        to[6] = join(g->stretched.x, g->stretched.sharpness_x);
        to[7] = join(g->stretched.z, g->stretched.sharpness_y);
    }
    b = upload(device, GPU_STORAGE, packed, count * GUIDE_SIZE * sizeof *packed);
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

static gpu_filter *begin(gpu *device, const char *folder, const char *name, int width, int height) {
    gpu_filter *f = (gpu_filter *)allocate("GPU", 1, sizeof *f);
    char rest[64], path[OUTPUT_NAME], vertex_path[OUTPUT_NAME];
    snprintf(rest, sizeof rest, "/%s.comp.spv", name);
    output_name(path, folder, rest);
    f->compute = gpu_compute_create(device, path, kinds, BUFFERS, 0);
    output_name(vertex_path, folder, "/fullscreen.vert.spv");
    snprintf(rest, sizeof rest, "/%s.frag.spv", name);
    output_name(path, folder, rest);
    f->fragment = gpu_fragment_create(device, vertex_path, path, kinds, PICTURE); /* draws it instead */
    f->width = width;
    f->height = height;
    f->pixels = (vec4 *)allocate("picture", (size_t)width * (size_t)height, sizeof *f->pixels);
    f->buffers[PICTURE] = gpu_buffer_create(device, GPU_STORAGE, (size_t)width * (size_t)height * sizeof *f->pixels);
    return f;
}

gpu_filter *gpu_filter_create(gpu *device, const char *folder, const image *noisy, const guide *guides, filter_method m,
                              float parameter, float depth_variance) {
    struct {
        int width, height, method;
        float parameter, depth_variance;
        int radius;
        float kernel_variance;
    } parameters;
    gpu_filter *f = begin(device, folder, "lobe_filter", noisy->width, noisy->height);
    const size_t count = (size_t)noisy->width * (size_t)noisy->height;
    char path[OUTPUT_NAME];
    size_t i;
    output_name(path, folder, "/lobe_prepare.comp.spv");
    f->prepare = gpu_compute_create(device, path, kinds, PICTURE, 0);
    parameters.width = noisy->width;
    parameters.height = noisy->height;
    parameters.method = weight_of(m);
    parameters.parameter = parameter;
    parameters.depth_variance = depth_variance;
    parameters.radius = FILTER_RADIUS;
    parameters.kernel_variance = filter_kernel_variance;
    for (i = 0; i < count; i++) f->pixels[i] = join(noisy->pixels[i], guides[i].valid ? 1 : 0);
    f->raw = upload_guides(device, guides, count);
    f->buffers[LIGHT] = upload(device, GPU_STORAGE, f->pixels, count * sizeof *f->pixels);
    f->buffers[GUIDES] = gpu_buffer_create(device, GPU_STORAGE, count * PREPARED_SIZE * sizeof *f->pixels);
    f->buffers[PARAMETERS] = upload(device, GPU_UNIFORM, &parameters, sizeof parameters);
    return f;
}

gpu_filter *gpu_upsample_create(gpu *device, const char *folder, const coarse *low, int width, int height,
                                const guide *guides, filter_method m, float parameter) {
    struct {
        int width, height, coarse_width, coarse_height, cell, column, row, method;
        float parameter, depth_variance;
    } parameters;
    gpu_filter *f = begin(device, folder, "lobe_upsample", width, height);
    const size_t count = (size_t)low->width * (size_t)low->height;
    size_t i;
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
    for (i = 0; i < count; i++) f->pixels[i] = join(low->colours[i], 0);
    f->buffers[LIGHT] = upload(device, GPU_STORAGE, f->pixels, count * sizeof *f->pixels);
    f->buffers[GUIDES] = upload_guides(device, guides, (size_t)width * (size_t)height);
    f->buffers[PARAMETERS] = upload(device, GPU_UNIFORM, &parameters, sizeof parameters);
    return f;
}

double gpu_filter_run(gpu_filter *f, gpu_stage stage, vec3 *pixels) {
    const int groups_x = (f->width + 7) / 8, groups_y = (f->height + 7) / 8;
    double ms = 0;
    int i;
    if (f->prepare) {
        gpu_buffer *buffers[PICTURE];
        buffers[LIGHT] = f->raw;
        buffers[GUIDES] = f->buffers[GUIDES];
        buffers[PARAMETERS] = f->buffers[PARAMETERS];
        ms = gpu_run(f->prepare, buffers, groups_x, groups_y, 1);
    }
    if (stage == GPU_COMPUTE) {
        ms += gpu_run(f->compute, f->buffers, groups_x, groups_y, 1);
        gpu_buffer_read(f->buffers[PICTURE], f->pixels);
    } else {
        ms += gpu_draw(f->fragment, f->buffers, f->width, f->height, &f->pixels->x);
    }
    for (i = 0; i < f->width * f->height; i++) pixels[i] = lobe_vector(f->pixels[i].x, f->pixels[i].y, f->pixels[i].z);
    return ms;
}

void gpu_filter_free(gpu_filter *f) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(f->buffers[i]);
    if (f->raw) gpu_buffer_free(f->raw);
    if (f->prepare) gpu_program_free(f->prepare);
    gpu_program_free(f->compute);
    gpu_program_free(f->fragment);
    free(f->pixels);
    free(f);
}
