/* gpu_cull.h - stochastic light culling on a Vulkan device: light_bound, light_cull and light_shade. */
#ifndef GPU_CULL_H
#define GPU_CULL_H

#include "buffers.h"
#include "gpu.h"
#include "image.h"

/* A diffuse or a glossy virtual point light; its colour's largest channel is 1. */
typedef struct {
    vec3 position, normal, wi, colour;
    float flux, alpha, xi;
    int glossy;
} gpu_cull_light;

typedef struct {
    vec3 eye, right, up, forward; /* of the camera */
    float delta;                  /* radiance below which lights are left out at random */
    float extent;                 /* length that is added to each distance, as the hypotenuse */
    int interleave;               /* edge of the squares of pixels each of which is of another subset */
    int edge;                     /* of a tile, in pixels of one subset */
    int most;                     /* lights that a tile's list has room for */
} gpu_cull_settings;

typedef struct gpu_cull gpu_cull;

/* The lights of subset s are firsts[s] to firsts[s + 1] - 1; there are interleave squared. Shaders are in the folder:
   light_bound.comp.spv and so on. */
gpu_cull *gpu_cull_create(gpu *device, const char *folder, const gpu_cull_settings *settings, const buffer *view,
                          const gpu_cull_light *lights, const int *firsts);
void gpu_cull_free(gpu_cull *c);

/* Bounds the lights and makes the tiles' lists, and shades each pixel with its tile's. Both return the milliseconds that
   the device took. */
double gpu_cull_run(gpu_cull *c);
double gpu_cull_shade(gpu_cull *c, gpu_stage stage, image *irradiance);

/* How many lights each tile keeps, and the lists, `most` entries a tile: index times 4, plus 1 for the nearer cluster, 2
   for the farther. A count above `most` tells of a list that lacks the rest. */
int gpu_cull_tiles(const gpu_cull *c);
void gpu_cull_kept(gpu_cull *c, int *counts, unsigned *entries);

#endif
