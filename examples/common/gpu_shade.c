#include "gpu_shade.h"
#include "fail.h"
#include "gpu_picture.h"
#include "gpu_surfaces.h"
#include <stdlib.h>
#include <string.h>

enum { SURFACES, LIGHTS, DISTANCES, PARAMETERS, BUFFERS, TEXELS = SHADOW_MAP_SIZE * SHADOW_MAP_SIZE };

static const gpu_kind kinds[BUFFERS] = {GPU_STORAGE, GPU_STORAGE, GPU_STORAGE, GPU_UNIFORM};

struct gpu_shade {
    gpu_buffer *buffers[BUFFERS];
    gpu_picture picture;
};

/* As vsgl_unpack reads them; one at least, since no buffer is empty */
static gpu_buffer *upload_lights(gpu *device, const vsgl *lights, size_t count) {
    const size_t size = (count ? count : 1) * 5 * sizeof(vec4);
    vec4 *packed = (vec4 *)allocate("lights", size, 1);
    gpu_buffer *b;
    size_t i;
    for (i = 0; i < count; i++) {
        const vsgl *v = &lights[i];
        packed[5 * i] = vec4_of(v->position, v->variance);
        packed[5 * i + 1] = vec4_of(v->emission[0].axis, v->emission[0].sharpness);
        packed[5 * i + 2] = vec4_of(v->emission[1].axis, v->emission[1].sharpness);
        packed[5 * i + 3] = vec4_of(v->intensity[0], v->emission[0].log_amplitude);
        packed[5 * i + 4] = vec4_of(v->intensity[1], v->emission[1].log_amplitude);
    }
    b = gpu_buffer_of(device, GPU_STORAGE, packed, size);
    free(packed);
    return b;
}

static gpu_buffer *upload_distances(gpu *device, const shadow_map *maps, size_t count) {
    const size_t size = (maps && count ? count * TEXELS : 1) * sizeof(float);
    float *distances = (float *)allocate("shadow maps", size, 1);
    gpu_buffer *b;
    size_t i;
    for (i = 0; maps && i < count; i++) memcpy(distances + i * TEXELS, maps[i].distances, sizeof maps[i].distances);
    b = gpu_buffer_of(device, GPU_STORAGE, distances, size);
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
    s->picture = gpu_picture_create(device, folder, "vsgl_shade", kinds, BUFFERS, map->width, map->height);
    parameters.eye = vec4_of(eye, 0);
    parameters.width = map->width;
    parameters.height = map->height;
    parameters.light_count = light_count;
    parameters.map_size = maps ? SHADOW_MAP_SIZE : 0;
    s->buffers[SURFACES] = gpu_surfaces(device, map);
    s->buffers[LIGHTS] = upload_lights(device, lights, (size_t)light_count);
    s->buffers[DISTANCES] = upload_distances(device, maps, (size_t)light_count);
    s->buffers[PARAMETERS] = gpu_buffer_of(device, GPU_UNIFORM, &parameters, sizeof parameters);
    return s;
}

double gpu_shade_run(gpu_shade *s, gpu_stage stage, vec3 *radiance) {
    return gpu_picture_run(&s->picture, stage, s->buffers, radiance);
}

void gpu_shade_free(gpu_shade *s) {
    int i;
    for (i = 0; i < BUFFERS; i++) gpu_buffer_free(s->buffers[i]);
    gpu_picture_free(&s->picture);
    free(s);
}
