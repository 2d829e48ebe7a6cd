#include "gpu_generate.h"
#include "fail.h"
#include "gpu_halve.h"
#include "gpu_picture.h"
#include "gpu_surfaces.h"
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 16, LIGHT = 20, GROUP = 64 }; /* floats of a texel's moments and of a light; of a workgroup */

typedef struct {
    vec4 eye, center;
    int texel_count;
} moments_parameters;

typedef struct {
    vec4 center;
    int width, height, light_count, method, seed;
    float kernel_size;
} generate_parameters;

struct gpu_generate {
    int width, height, most;
    vec3 eye, center;
    gpu_halve *halve;
    gpu_program *find_moments, *generate;
    gpu_buffer *surfaces, *moments, *pdf, *lights, *moments_parameters, *generate_parameters;
    float *staged, *packed; /* a PDF's pyramid, whose level 0 is given; lights */
};

gpu_generate *gpu_generate_create(gpu *device, const char *folder, const vpl_map *map, vec3 eye, int most) {
    static const gpu_kind moments_kinds[4] = {GPU_STORAGE, GPU_STORAGE, GPU_STORAGE, GPU_UNIFORM};
    gpu_generate *g = (gpu_generate *)allocate("GPU", 1, sizeof *g);
    const size_t texels = fis_pyramid_size(map->width, map->height, 1);
    g->find_moments = gpu_compute_create(device, folder, "vsgl_moments", moments_kinds, 4, 0);
    g->generate = gpu_compute_create(device, folder, "vsgl_generate", moments_kinds, 4, 0);
    g->halve = gpu_halve_create(device, folder);
    g->width = map->width;
    g->height = map->height;
    g->most = most;
    g->eye = eye;
    g->center = map->center;
    g->surfaces = gpu_surfaces(device, map);
    g->moments = gpu_buffer_create(device, GPU_STORAGE, texels * CHANNELS * sizeof(float));
    g->pdf = gpu_buffer_create(device, GPU_STORAGE, texels * sizeof(float));
    g->lights = gpu_buffer_create(device, GPU_STORAGE, (size_t)most * LIGHT * sizeof(float));
    g->moments_parameters = gpu_buffer_create(device, GPU_UNIFORM, sizeof(moments_parameters));
    g->generate_parameters = gpu_buffer_create(device, GPU_UNIFORM, sizeof(generate_parameters));
    g->staged = (float *)allocate("PDF", texels, sizeof(float));
    g->packed = (float *)allocate("lights", (size_t)most, LIGHT * sizeof(float));
    return g;
}

void gpu_generate_free(gpu_generate *g) {
    gpu_halve_free(g->halve);
    gpu_program_free(g->find_moments);
    gpu_program_free(g->generate);
    gpu_buffer_free(g->surfaces);
    gpu_buffer_free(g->moments);
    gpu_buffer_free(g->pdf);
    gpu_buffer_free(g->lights);
    gpu_buffer_free(g->moments_parameters);
    gpu_buffer_free(g->generate_parameters);
    free(g->staged);
    free(g->packed);
    free(g);
}

/* Level 0 of both pyramids */
static double find_moments(gpu_generate *g) {
    gpu_buffer *buffers[4];
    moments_parameters p;
    memset(&p, 0, sizeof p);
    p.eye = vec4_of(g->eye, 0);
    p.center = vec4_of(g->center, 0);
    p.texel_count = g->width * g->height;
    gpu_buffer_write(g->moments_parameters, &p);
    buffers[0] = g->surfaces;
    buffers[1] = g->moments;
    buffers[2] = g->pdf;
    buffers[3] = g->moments_parameters;
    return gpu_run(g->find_moments, buffers, (p.texel_count + GROUP - 1) / GROUP, 1, 1);
}

static double generate_lights(gpu_generate *g, method how, float k, unsigned seed, int count) {
    gpu_buffer *buffers[4];
    generate_parameters p;
    memset(&p, 0, sizeof p);
    p.center = vec4_of(g->center, 0);
    p.width = g->width;
    p.height = g->height;
    p.light_count = count;
    p.method = (int)how;
    p.seed = (int)seed;
    p.kernel_size = k;
    gpu_buffer_write(g->generate_parameters, &p);
    buffers[0] = g->pdf;
    buffers[1] = g->moments;
    buffers[2] = g->lights;
    buffers[3] = g->generate_parameters;
    return gpu_run(g->generate, buffers, (count + GROUP - 1) / GROUP, 1, 1);
}

double gpu_generate_run(gpu_generate *g, const float *pdf, method how, float k, unsigned seed, int count) {
    double ms = find_moments(g);
    if (pdf) {
        memcpy(g->staged, pdf, (size_t)g->width * (size_t)g->height * sizeof *pdf);
        gpu_buffer_write(g->pdf, g->staged);
    }
    ms += gpu_halve_build(g->halve, g->moments, g->width, g->height, CHANNELS, 0);
    ms += gpu_halve_build(g->halve, g->pdf, g->width, g->height, 1, 1);
    return ms + generate_lights(g, how, k, seed, count);
}

gpu_buffer *gpu_generate_lights(const gpu_generate *g) {
    return g->lights;
}

void gpu_generate_read(gpu_generate *g, vsgl *lights, int count) {
    int i;
    gpu_buffer_read(g->lights, g->packed);
    for (i = 0; i < count; i++) {
        const float *from = g->packed + (size_t)i * LIGHT;
        vsgl *v = &lights[i];
        v->position = lobe_vector(from[0], from[1], from[2]);
        v->variance = from[3];
        v->emission[0].axis = lobe_vector(from[4], from[5], from[6]);
        v->emission[0].sharpness = from[7];
        v->emission[1].axis = lobe_vector(from[8], from[9], from[10]);
        v->emission[1].sharpness = from[11];
        v->intensity[0] = lobe_vector(from[12], from[13], from[14]);
        v->emission[0].log_amplitude = from[15];
        v->intensity[1] = lobe_vector(from[16], from[17], from[18]);
        v->emission[1].log_amplitude = from[19];
    }
}
