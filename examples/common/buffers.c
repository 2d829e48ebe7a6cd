#include "buffers.h"
#include "fail.h"
#include "parallel.h"
#include "progress.h"
#include <stdlib.h>

static buffer make_buffer(int width, int height) {
    buffer b;
    b.width = width;
    b.height = height;
    b.texels = (texel *)allocate("images", (size_t)width * (size_t)height, sizeof *b.texels);
    return b;
}

void buffer_free(buffer *b) {
    free(b->texels);
    b->texels = NULL;
}

buffer buffer_camera(const scene *world, int width, int height) {
    buffer b = make_buffer(width, height);
    vec3 forward = vec3_normalize(lobe_sub(world->eye.target, world->eye.position)), right, up;
    float tangent = tanf(0.5f * world->eye.field_of_view), aspect = (float)width / (float)height;
    progress line = progress_begin("camera", height);
    int row;
    scene_frame(forward, &right, &up);
    PARALLEL_FOR
    for (row = 0; row < height; row++) {
        int column;
        for (column = 0; column < width; column++) {
            texel *t = &b.texels[row * width + column];
            float x = (2 * ((float)column + 0.5f) / (float)width - 1) * tangent * aspect;
            float y = (1 - 2 * ((float)row + 0.5f) / (float)height) * tangent;
            vec3 dir = vec3_normalize(lobe_add(forward, lobe_add(lobe_scale(right, x), lobe_scale(up, y))));
            t->valid = scene_trace(world, world->eye.position, dir, &t->hit);
            t->view = lobe_scale(dir, -1);
            t->flux = lobe_vector(1, 1, 1);
        }
        progress_step(&line);
    }
    progress_end(&line);
    return b;
}

vec3 spot_direction(const spot_light *spot, float u, float v, float *solid_angle) {
    float tangent = spot->tangent, x = (2 * u - 1) * tangent, y = (2 * v - 1) * tangent;
    float length2 = 1 + x * x + y * y;
    *solid_angle = 4 * tangent * tangent / (length2 * sqrtf(length2));
    return vec3_normalize(lobe_add(spot->forward, lobe_add(lobe_scale(spot->right, x), lobe_scale(spot->up, y))));
}

int spot_project(const spot_light *spot, vec3 dir, float *u, float *v) {
    float tangent = spot->tangent, depth = lobe_dot(dir, spot->forward);
    if (depth <= 0) return 0;
    *u = 0.5f + 0.5f * lobe_dot(dir, spot->right) / (depth * tangent);
    *v = 0.5f + 0.5f * lobe_dot(dir, spot->up) / (depth * tangent);
    return *u >= 0 && *u < 1 && *v >= 0 && *v < 1;
}

buffer buffer_rsm(const scene *world, int size) {
    buffer b = make_buffer(size, size);
    int row;
    PARALLEL_FOR
    for (row = 0; row < size; row++) {
        int column;
        for (column = 0; column < size; column++) {
            texel *t = &b.texels[row * size + column];
            float solid_angle;
            vec3 dir = spot_direction(&world->spot, ((float)column + 0.5f) / (float)size,
                                      ((float)row + 0.5f) / (float)size, &solid_angle);
            t->valid = scene_trace(world, world->spot.position, dir, &t->hit);
            t->view = lobe_scale(dir, -1);
            if (t->valid) t->flux = lobe_scale(spot_intensity(&world->spot, dir), solid_angle / (float)(size * size));
        }
    }
    return b;
}
