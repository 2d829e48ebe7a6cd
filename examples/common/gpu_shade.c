#include "gpu_shade.h"
#include "fail.h"
#include "output.h"
#include <stdlib.h>
#include <string.h>

enum { SURFACES, LIGHTS, DISTANCES, PARAMETERS, PICTURE, BUFFERS, TEXELS = SHADOW_MAP_SIZE * SHADOW_MAP_SIZE };

static const gpu_kind kinds[BUFFERS] = {GPU_STORAGE, GPU_STORAGE, GPU_STORAGE, GPU_UNIFORM, GPU_STORAGE};

typedef struct {
    float x, y, z, w;
} vec4;

struct gpu_shade {
    int width, height;
    gpu_buffer *buffers[BUFFERS];
    gpu_program *compute, *fragment;
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

static gpu_buffer *upload_surfaces(gpu *device, const vpl_map *map) {
    const size_t count = (size_t)map->width * (size_t)map->height;
    vec4 *surfaces = (vec4 *)allocate("surfaces", count, 4 * sizeof *surfaces);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const vpl *t = &map->texels[i];
        surfaces[4 * i] = join(t->position, t->alpha);
        surfaces[4 * i + 1] = join(t->normal, 0);
        surfaces[4 * i + 2] = join(t->diffuse, 0);
        surfaces[4 * i + 3] = join(t->specular, 0);
    }
    b = upload(device, GPU_STORAGE, surfaces, count * 4 * sizeof *surfaces);
    free(surfaces);
    return b;
}

/* As vsgl_unpack reads them; one at least, since no buffer is empty */
static gpu_buffer *upload_lights(gpu *device, const vsgl *lights, size_t count) {
    const size_t size = (count ? count : 1) * 5 * sizeof(vec4);
    vec4 *packed = (vec4 *)allocate("lights", size, 1);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const vsgl *v = &lights[i];
        packed[5 * i] = join(v->position, v->variance);
        packed[5 * i + 1] = join(v->emission[0].axis, v->emission[0].sharpness);
        packed[5 * i + 2] = join(v->emission[1].axis, v->emission[1].sharpness);
        packed[5 * i + 3] = join(v->intensity[0], v->emission[0].log_amplitude);
        packed[5 * i + 4] = join(v->intensity[1], v->emission[1].log_amplitude);
    }
    b = upload(device, GPU_STORAGE, packed, size);
    free(packed);
    return b;
}

static gpu_buffer *upload_distances(gpu *device, const shadow_map *maps, size_t count) {
    const size_t size = (maps && count ? count * TEXELS : 1) * sizeof(float);
    float *distances = (float *)allocate("shadow maps", size, 1);
    gpu_buffer *b;
    size_t i;
    for (i = 0; maps && i < count; i++) memcpy(distances + i * TEXELS, maps[i].distances, sizeof maps[i].distances);
    b = upload(device, GPU_STORAGE, distances, size);
    free(distances);
    return b;
}

gpu_shade *gpu_shade_create(gpu *device, const char *folder, const vpl_map *map, vec3 eye, const vsgl *lights,
                            const shadow_map *maps, int light_count) {
    struct {
        vec4 eye;
        int width, height, light_count, map_size;
    } parameters;
    gpu_shade *s = (gpu_shade *)allocate("GPU", 1, sizeof *s);
    const size_t texels = (size_t)map->width * (size_t)map->height;
    char path[OUTPUT_NAME], vertex_path[OUTPUT_NAME];
    output_name(path, folder, "/vsgl_shade.comp.spv");
    s->compute = gpu_compute_create(device, path, kinds, BUFFERS, 0);
    output_name(vertex_path, folder, "/fullscreen.vert.spv");
    output_name(path, folder, "/vsgl_shade.frag.spv");
    s->fragment = gpu_fragment_create(device, vertex_path, path, kinds, PICTURE); /* draws it instead */
    s->width = map->width;
    s->height = map->height;
    s->pixels = (vec4 *)allocate("picture", texels, sizeof *s->pixels);
    parameters.eye = join(eye, 0);
    parameters.width = map->width;
    parameters.height = map->height;
    parameters.light_count = light_count;
    parameters.map_size = maps ? SHADOW_MAP_SIZE : 0;
    s->buffers[SURFACES] = upload_surfaces(device, map);
    s->buffers[LIGHTS] = upload_lights(device, lights, (size_t)light_count);
    s->buffers[DISTANCES] = upload_distances(device, maps, (size_t)light_count);
    s->buffers[PARAMETERS] = upload(device, GPU_UNIFORM, &parameters, sizeof parameters);
    s->buffers[PICTURE] = gpu_buffer_create(device, GPU_STORAGE, texels * sizeof *s->pixels);
    return s;
}

double gpu_shade_run(gpu_shade *s, gpu_stage stage, vec3 *radiance) {
    double ms;
    int i;
    if (stage == GPU_COMPUTE) {
        ms = gpu_run(s->compute, s->buffers, (s->width + 7) / 8, (s->height + 7) / 8, 1);
        gpu_buffer_read(s->buffers[PICTURE], s->pixels);
    } else {
        ms = gpu_draw(s->fragment, s->buffers, s->width, s->height, &s->pixels->x);
    }
    for (i = 0; i < s->width * s->height; i++)
        radiance[i] = lobe_vector(s->pixels[i].x, s->pixels[i].y, s->pixels[i].z);
    return ms;
}

void gpu_shade_free(gpu_shade *s) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(s->buffers[i]);
    gpu_program_free(s->compute);
    gpu_program_free(s->fragment);
    free(s->pixels);
    free(s);
}
