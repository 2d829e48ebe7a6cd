/* buffers.h - what the camera and the light see: G-buffer and reflective shadow map. */
#ifndef BUFFERS_H
#define BUFFERS_H

#include "scene.h"

typedef struct {
    surface hit;
    vec3 view; /* towards the viewer: the camera, or the light for an RSM */
    vec3 flux; /* RSM: power that the light sends through the texel, watts; camera: importance, 1 in every pixel */
    int valid; /* 0: nothing hit */
} texel;

typedef struct {
    texel *texels;
    int width, height;
} buffer;

/* Both allocate, and give up when memory is short; buffer_free gives the memory back. */
buffer buffer_camera(const scene *world, int width, int height);
buffer buffer_rsm(const scene *world, int size);
void buffer_free(buffer *b);

/* Direction from the spot light through a point of its image, u and v in [0, 1], and solid angle per unit area there */
vec3 spot_direction(const spot_light *spot, float u, float v, float *solid_angle);

/* The inverse: 0 for a direction outside of the image. */
int spot_project(const spot_light *spot, vec3 dir, float *u, float *v);

#endif
