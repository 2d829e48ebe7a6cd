#include "gpu_cull.h"
#include "fail.h"
#include "output.h"
#include <stdlib.h>

/* One layout for all shaders, of which each takes what it needs */
enum { PARAMETERS, SURFACES, LIGHTS, FIRSTS, VOLUMES, TILES, ENTRIES, PICTURE, BUFFERS };

static const gpu_kind kinds[BUFFERS] = {GPU_UNIFORM, GPU_STORAGE, GPU_STORAGE, GPU_STORAGE,
                                        GPU_STORAGE, GPU_STORAGE, GPU_STORAGE, GPU_STORAGE};

/* As in light_tiles.glsl */
typedef struct {
    float eye[4], right[4], up[4], forward[4], delta, extent;
    int width, height, interleave, edge, columns, rows, light_count, most;
} parameters;

struct gpu_cull {
    parameters p;
    int subsets;
    gpu_buffer *buffers[BUFFERS];
    gpu_program *bound, *cull, *shade, *draw;
};

static void put(float to[4], vec3 v, float w) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
    to[3] = w;
}

static gpu_buffer *buffer_with(gpu *device, gpu_kind kind, const void *values, size_t size) {
    gpu_buffer *b = gpu_buffer_create(device, kind, size);
    gpu_buffer_write(b, values);
    return b;
}

static gpu_buffer *put_surfaces(gpu *device, const gpu_cull_settings *settings, const buffer *view) {
    const size_t count = (size_t)view->width * (size_t)view->height;
    float *values = (float *)allocate("surfaces", count, 8 * sizeof *values);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const texel *t = &view->texels[i];
        if (!t->valid) continue;
        put(values + 8 * i, t->hit.position, lobe_dot(settings->forward, lobe_sub(t->hit.position, settings->eye)));
        put(values + 8 * i + 4, t->hit.normal, 0);
    }
    b = buffer_with(device, GPU_STORAGE, values, count * 8 * sizeof *values);
    free(values);
    return b;
}

static gpu_buffer *put_lights(gpu *device, const gpu_cull_light *lights, size_t count, size_t room) {
    float *values = (float *)allocate("lights", room, 16 * sizeof *values);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const gpu_cull_light *l = &lights[i];
        put(values + 16 * i, l->position, l->flux);
        put(values + 16 * i + 4, l->normal, l->alpha);
        put(values + 16 * i + 8, l->wi, l->xi);
        put(values + 16 * i + 12, l->colour, l->glossy ? 1.0f : 0.0f);
    }
    b = buffer_with(device, GPU_STORAGE, values, room * 16 * sizeof *values);
    free(values);
    return b;
}

static int parts(int whole, int part) {
    return (whole + part - 1) / part;
}

static parameters parameters_of(const gpu_cull_settings *settings, const buffer *view, int light_count) {
    parameters p;
    put(p.eye, settings->eye, 0);
    put(p.right, settings->right, 0);
    put(p.up, settings->up, 0);
    put(p.forward, settings->forward, 0);
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

static gpu_program *compute_of(gpu *device, const char *folder, const char *name) {
    char path[OUTPUT_NAME];
    output_name(path, folder, name);
    return gpu_compute_create(device, path, kinds, BUFFERS, 0);
}

gpu_cull *gpu_cull_create(gpu *device, const char *folder, const gpu_cull_settings *settings, const buffer *view,
                          const gpu_cull_light *lights, const int *firsts) {
    const int subsets = settings->interleave * settings->interleave, light_count = firsts[subsets];
    const size_t pixels = (size_t)view->width * (size_t)view->height;
    const size_t room = light_count ? (size_t)light_count : 1; /* no buffer is empty */
    gpu_cull *c = (gpu_cull *)allocate("GPU", 1, sizeof *c);
    char path[OUTPUT_NAME], vertex_path[OUTPUT_NAME];
    size_t tiles;
    c->p = parameters_of(settings, view, light_count);
    c->subsets = subsets;
    tiles = (size_t)gpu_cull_tiles(c);
    c->bound = compute_of(device, folder, "/light_bound.comp.spv");
    c->cull = compute_of(device, folder, "/light_cull.comp.spv");
    c->shade = compute_of(device, folder, "/light_shade.comp.spv");
    output_name(vertex_path, folder, "/fullscreen.vert.spv");
    output_name(path, folder, "/light_shade.frag.spv");
    c->draw = gpu_fragment_create(device, vertex_path, path, kinds, BUFFERS);
    c->buffers[PARAMETERS] = buffer_with(device, GPU_UNIFORM, &c->p, sizeof c->p);
    c->buffers[SURFACES] = put_surfaces(device, settings, view);
    c->buffers[LIGHTS] = put_lights(device, lights, (size_t)light_count, room);
    c->buffers[FIRSTS] = buffer_with(device, GPU_STORAGE, firsts, ((size_t)subsets + 1) * sizeof *firsts);
    c->buffers[VOLUMES] = gpu_buffer_create(device, GPU_STORAGE, room * 12 * sizeof(float));
    c->buffers[TILES] = gpu_buffer_create(device, GPU_STORAGE, tiles * 2 * sizeof(unsigned));
    c->buffers[ENTRIES] = gpu_buffer_create(device, GPU_STORAGE, tiles * (size_t)settings->most * sizeof(unsigned));
    c->buffers[PICTURE] = gpu_buffer_create(device, GPU_STORAGE, pixels * 4 * sizeof(float));
    return c;
}

void gpu_cull_free(gpu_cull *c) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(c->buffers[i]);
    gpu_program_free(c->bound);
    gpu_program_free(c->cull);
    gpu_program_free(c->shade);
    gpu_program_free(c->draw);
    free(c);
}

double gpu_cull_run(gpu_cull *c) {
    double ms = gpu_run(c->bound, c->buffers, parts(c->p.light_count, 64), 1, 1);
    return ms + gpu_run(c->cull, c->buffers, c->p.columns, c->p.rows, c->subsets);
}

double gpu_cull_shade(gpu_cull *c, gpu_stage stage, image *irradiance) {
    const int pixels = c->p.width * c->p.height;
    float *values = (float *)allocate("picture", (size_t)pixels, 4 * sizeof *values);
    double ms;
    int i;
    if (stage == GPU_COMPUTE) {
        ms = gpu_run(c->shade, c->buffers, parts(c->p.width, 8), parts(c->p.height, 8), 1);
        gpu_buffer_read(c->buffers[PICTURE], values);
    } else {
        ms = gpu_draw(c->draw, c->buffers, c->p.width, c->p.height, values);
    }
    for (i = 0; i < pixels; i++)
        irradiance->pixels[i] = lobe_vector(values[4 * i], values[4 * i + 1], values[4 * i + 2]);
    free(values);
    return ms;
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
