/* gpu_picture.h - a picture that a compute shader writes or a fragment shader draws, of the same name. */
#ifndef GPU_PICTURE_H
#define GPU_PICTURE_H

#include "gpu.h"
#include "scene.h"

/* What a shader's buffers hold */
typedef struct {
    float x, y, z, w;
} vec4;

static inline vec4 vec4_of(vec3 v, float w) {
    vec4 joined;
    joined.x = v.x;
    joined.y = v.y;
    joined.z = v.z;
    joined.w = w;
    return joined;
}

typedef struct {
    int width, height, count; /* of buffers but the result */
    gpu_program *compute, *fragment;
    gpu_buffer *result; /* the compute shader's last buffer */
    vec4 *pixels;
} gpu_picture;

/* The shaders are in the folder. The kinds are those of the buffers but the result, at most GPU_MAX_BUFFERS - 1. */
gpu_picture gpu_picture_create(gpu *device, const char *folder, const char *name, const gpu_kind *kinds, int count,
                               int width, int height);

/* Returns the milliseconds that the device took. */
double gpu_picture_run(gpu_picture *p, gpu_stage stage, gpu_buffer *const *buffers, vec3 *pixels);
void gpu_picture_free(gpu_picture *p);

#endif
