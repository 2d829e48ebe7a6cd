#include "gpu_cull.h"
#include "fail.h"
#include "gpu_picture.h"
#include <stdlib.h>

/* One layout for all shaders, of which each takes what it needs */
enum { PARAMETERS, SURFACES, LIGHTS, FIRSTS, VOLUMES, TILES, ENTRIES, BUFFERS };

static const gpu_kind kinds[BUFFERS] = {GPU_UNIFORM, GPU_STORAGE, GPU_STORAGE, GPU_STORAGE,
                                        GPU_STORAGE, GPU_STORAGE, GPU_STORAGE};

/* As in light_tiles.glsl */
typedef struct {
    vec4 eye, right, up, forward;
    float delta, extent;
    int width, height, interleave, edge, columns, rows, light_count, most;
} parameters;

struct gpu_cull {
    parameters p;
    int subsets;
    gpu_buffer *buffers[BUFFERS];
    gpu_program *bound, *cull;
    gpu_picture picture;
};

static gpu_buffer *put_surfaces(gpu *device, const gpu_cull_settings *settings, const buffer *view) {
    const size_t count = (size_t)view->width * (size_t)view->height;
    vec4 *values = (vec4 *)allocate("surfaces", count, 2 * sizeof *values);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const texel *t = &view->texels[i];
        if (!t->valid) continue;
        values[2 * i] = vec4_of(t->hit.position, lobe_dot(settings->forward, lobe_sub(t->hit.position, settings->eye)));
        values[2 * i + 1] = vec4_of(t->hit.normal, 0);
    }
    b = gpu_buffer_of(device, GPU_STORAGE, values, count * 2 * sizeof *values);
    free(values);
    return b;
}

static gpu_buffer *put_lights(gpu *device, const gpu_cull_light *lights, size_t count, size_t room) {
    vec4 *values = (vec4 *)allocate("lights", room, 4 * sizeof *values);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const gpu_cull_light *l = &lights[i];
        values[4 * i] = vec4_of(l->position, l->flux);
        values[4 * i + 1] = vec4_of(l->normal, l->alpha);
        values[4 * i + 2] = vec4_of(l->wi, l->xi);
        values[4 * i + 3] = vec4_of(l->colour, l->glossy ? 1.0f : 0.0f);
    }
    b = gpu_buffer_of(device, GPU_STORAGE, values, room * 4 * sizeof *values);
    free(values);
    return b;
}

static int parts(int whole, int part) {
    return (whole + part - 1) / part;
}

static parameters parameters_of(const gpu_cull_settings *settings, const buffer *view, int light_count) {
    parameters p;
    p.eye = vec4_of(settings->eye, 0);
    p.right = vec4_of(settings->right, 0);
    p.up = vec4_of(settings->up, 0);
    p.forward = vec4_of(settings->forward, 0);
    p.delta = settings->delta;
    p.extent = settings->extent;
    p.width = view->width;
    p.height = view->height;
    p.interleave = settings->interleave;
    p.edge = settings->edge;
    p.columns = parts(view->width, settings->interleave * settings->edge);
    p.rows = parts(view->height, settings->interleave * settings->edge);
    p.light_count = light_count;
    p.most = settings->most;
    return p;
}

gpu_cull *gpu_cull_create(gpu *device, const char *folder, const gpu_cull_settings *settings, const buffer *view,
                          const gpu_cull_light *lights, const int *firsts) {
    const int subsets = settings->interleave * settings->interleave, light_count = firsts[subsets];
    const size_t room = light_count ? (size_t)light_count : 1; /* no buffer is empty */
    gpu_cull *c = (gpu_cull *)allocate("GPU", 1, sizeof *c);
    size_t tiles;
    c->p = parameters_of(settings, view, light_count);
    c->subsets = subsets;
    tiles = (size_t)gpu_cull_tiles(c);
    c->bound = gpu_compute_create(device, folder, "light_bound", kinds, BUFFERS, 0);
    c->cull = gpu_compute_create(device, folder, "light_cull", kinds, BUFFERS, 0);
    c->picture = gpu_picture_create(device, folder, "light_shade", kinds, BUFFERS, view->width, view->height);
    c->buffers[PARAMETERS] = gpu_buffer_of(device, GPU_UNIFORM, &c->p, sizeof c->p);
    c->buffers[SURFACES] = put_surfaces(device, settings, view);
    c->buffers[LIGHTS] = put_lights(device, lights, (size_t)light_count, room);
    c->buffers[FIRSTS] = gpu_buffer_of(device, GPU_STORAGE, firsts, ((size_t)subsets + 1) * sizeof *firsts);
    c->buffers[VOLUMES] = gpu_buffer_create(device, GPU_STORAGE, room * 12 * sizeof(float));
    c->buffers[TILES] = gpu_buffer_create(device, GPU_STORAGE, tiles * 2 * sizeof(unsigned));
    c->buffers[ENTRIES] = gpu_buffer_create(device, GPU_STORAGE, tiles * (size_t)settings->most * sizeof(unsigned));
    return c;
}

void gpu_cull_free(gpu_cull *c) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(c->buffers[i]);
    gpu_program_free(c->bound);
    gpu_program_free(c->cull);
    gpu_picture_free(&c->picture);
    free(c);
}

double gpu_cull_run(gpu_cull *c) {
    double ms = gpu_run(c->bound, c->buffers, parts(c->p.light_count, 64), 1, 1);
    return ms + gpu_run(c->cull, c->buffers, c->p.columns, c->p.rows, c->subsets);
}

double gpu_cull_shade(gpu_cull *c, gpu_stage stage, image *irradiance) {
    return gpu_picture_run(&c->picture, stage, c->buffers, irradiance->pixels);
}

int gpu_cull_tiles(const gpu_cull *c) {
    return c->p.columns * c->p.rows * c->subsets;
}

void gpu_cull_kept(gpu_cull *c, int *counts, unsigned *entries) {
    const int tiles = gpu_cull_tiles(c);
    unsigned *values = (unsigned *)allocate("tiles", (size_t)tiles, 2 * sizeof *values);
    int i;
    gpu_buffer_read(c->buffers[TILES], values);
    for (i = 0; i < tiles; i++) counts[i] = (int)values[2 * i];
    free(values);
    gpu_buffer_read(c->buffers[ENTRIES], entries);
}
