#include "glossy_frame.h"
#include "fail.h"
#include "hash.h"
#include "parallel.h"
#include "progress.h"
#include <stdlib.h>

/* ---- scenes: shapes, what they are made of, and the light that they are seen by ---- */

glossy one_lobe(glossy_model model, float along, float across) {
    glossy look;
    memset(&look, 0, sizeof look);
    look.count = 1;
    look.lobes[0].model = model;
    look.lobes[0].along = along;
    look.lobes[0].across = across;
    look.lobes[0].share = 1;
    return look;
}

int tile_of(const surface *hit) {
    return ((int)floorf(hit->position.x / 0.5f) + (int)floorf(hit->position.z / 0.5f)) & 1;
}

/* Bands around the vertical axis of a sphere */
static int band_of(const surface *hit, int bands) {
    return (int)lobe_min(floorf((0.5f + 0.5f * hit->normal.y) * (float)bands), (float)bands - 1);
}

glossy look_tiles(const surface *hit, int which) {
    static const float alphas[] = {0.05f, 0.12f, 0.35f};
    float alpha;
    (void)which;
    if (hit->shape == GALLERY_FLOOR) {
        const float x = hit->position.x / 0.5f, z = hit->position.z / 0.5f;
        const float dx = x - floorf(x) - 0.5f, dz = z - floorf(z) - 0.5f;
        alpha = !tile_of(hit) ? 0.04f : dx * dx + dz * dz < 0.09f ? 0.1f : 0.3f;
    } else {
        alpha = alphas[hit->shape - GALLERY_WALLS] * (band_of(hit, 8) & 1 ? 1 : 2);
    }
    return one_lobe(GLOSSY_GGX, alpha, alpha);
}

glossy look_models(const surface *hit, int which) {
    static const float exponents[] = {1000, 200, 60}, alphas[] = {0.25f, 0.2f, 0.06f};
    const int k = hit->shape - GALLERY_WALLS;
    (void)which;
    if (hit->shape == GALLERY_FLOOR)
        return tile_of(hit) ? one_lobe(GLOSSY_BECKMANN, 0.3f, 0.3f) : one_lobe(GLOSSY_PHONG, 1500, 1500);
    return hit->normal.x > 0.2f ? one_lobe(GLOSSY_BECKMANN, alphas[k], alphas[k])
                                : one_lobe(GLOSSY_PHONG, exponents[k], exponents[k]);
}

glossy look_brushed(const surface *hit, int which) {
    glossy look = one_lobe(GLOSSY_PHONG, 4000, 12);
    (void)which;
    if (hit->shape == GALLERY_FLOOR)
        look.tangent = tile_of(hit) ? lobe_vector(1, 0, 0) : lobe_vector(0, 0, 1);
    else
        look.tangent = lobe_cross(lobe_vector(0, 1, 0), hit->normal);
    return look;
}

static glossy three_lobes(float first, float second, float third, float a, float b) {
    glossy look = one_lobe(GLOSSY_PHONG, first, first);
    look.count = 3;
    look.lobes[1] = one_lobe(GLOSSY_PHONG, second, second).lobes[0];
    look.lobes[2] = one_lobe(GLOSSY_PHONG, third, third).lobes[0];
    look.lobes[0].share = a;
    look.lobes[1].share = b;
    look.lobes[2].share = 1 - a - b;
    return look;
}

glossy look_layers(const surface *hit, int which) {
    (void)which;
    if (hit->shape == GALLERY_FLOOR)
        return tile_of(hit) ? three_lobes(4000, 1000, 300, 0.4f, 0.4f) : three_lobes(100, 25, 8, 0.4f, 0.4f);
    return band_of(hit, 8) & 1 ? three_lobes(3000, 200, 12, 0.6f, 0.3f) : three_lobes(3000, 200, 12, 0.1f, 0.3f);
}

glossy look_phong(const surface *hit, int which) {
    static const float exponents[] = {10, 100, 1000};
    const float e = exponents[which < 3 ? which : (band_of(hit, 3) + hit->shape) % 3];
    return one_lobe(GLOSSY_PHONG, e, e);
}

glossy look_mixture(const surface *hit, int which) {
    static const float lobes[3][5] = {
        {40, 10, 3, 0.4f, 0.4f}, {400, 100, 30, 0.4f, 0.4f}, {4000, 1000, 300, 0.4f, 0.4f}};
    const float *l = lobes[which];
    (void)hit;
    return three_lobes(l[0], l[1], l[2], l[3], l[4]);
}

glossy look_stretched(const surface *hit, int which) {
    static const float exponents[3][2] = {{100, 5}, {1000, 10}, {5000, 100}};
    glossy look = one_lobe(GLOSSY_PHONG, exponents[which][0], exponents[which][1]);
    look.tangent = lobe_cross(lobe_vector(0, 1, 0), hit->normal);
    return look;
}

static int is_glossy(const texel *t) {
    return t->valid && (t->hit.shape == GALLERY_FLOOR || t->hit.shape >= GALLERY_WALLS);
}

static int is_checked(float u, float v, float edge) {
    return ((int)floorf(u / edge) + (int)floorf(v / edge)) & 1;
}

/* Radiance of what reflections show: panels, a window, patterned walls. It does not depend on the direction. */
static vec3 light_of(const surface *hit) {
    const vec3 p = hit->position;
    float shade;
    switch (hit->shape) {
    case GALLERY_FLOOR:
        shade = tile_of(hit) ? 0.14f : 0.07f;
        return lobe_vector(shade, 0.95f * shade, 0.9f * shade);
    case GALLERY_CEILING:
        return fabsf(fabsf(p.x) - 0.8f) < 0.3f && fabsf(p.z) < 1.5f ? lobe_vector(5, 4.7f, 4.2f)
                                                                    : lobe_vector(0.15f, 0.15f, 0.15f);
    case GALLERY_BACK:
        return is_checked(p.x, p.y, 0.25f) ? lobe_vector(0.95f, 0.75f, 0.4f) : lobe_vector(0.06f, 0.07f, 0.1f);
    case GALLERY_FRONT:
        return is_checked(p.x, 0, 0.4f) ? lobe_vector(0.9f, 0.9f, 0.95f) : lobe_vector(0.12f, 0.1f, 0.1f);
    case GALLERY_LEFT:
        return is_checked(0, p.y, 0.3f) ? lobe_vector(1.3f, 0.25f, 0.15f) : lobe_vector(0.1f, 0.05f, 0.05f);
    case GALLERY_RIGHT:
        return fabsf(p.y - 1.3f) < 0.7f && fabsf(p.z) < 1.4f && is_checked(p.z + 0.1f, p.y, 0.7f)
                   ? lobe_vector(1.5f, 2.2f, 3.5f)
                   : lobe_vector(0.1f, 0.25f, 0.12f);
    default:
        shade = 0.15f + 0.12f * hit->normal.y;
        return lobe_vector(shade, hit->shape & 1 ? shade : 0.6f * shade, hit->shape & 2 ? shade : 0.7f * shade);
    }
}

/* ---- path tracing ---- */

/* Four uniform numbers below 1: at random, or evenly spread over a pixel's draws (Roberts 2018) for the reference */
static void draw(unsigned pixel, unsigned number, unsigned seed, int even, float u[4]) {
    static const double steps[4] = {0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
    unsigned k;
    for (k = 0; k < 4; k++) {
        double x = (double)hash_mix(hash_mix(pixel * 0x9E3779B1u + seed) + (even ? 0 : number * 0x85EBCA77u) +
                                    k * 0xC2B2AE3Du);
        x = x / 4294967296.0 + (even ? number * steps[k] : 0);
        u[k] = (float)((int)((x - floor(x)) * 16777216)) / 16777216;
    }
}

/* L_r / R: the mean radiance over the reflection lobe */
static vec3 trace_pixel(const scene *world, const texel *t, const glossy *look, unsigned pixel, int samples,
                        unsigned seed, int even) {
    const vec3 from = lobe_add(t->hit.position, lobe_scale(t->hit.normal, 1e-4f));
    vec3 sum = {0, 0, 0}, wi;
    int taken = 0;
    unsigned number;
    for (number = 0; taken < samples && number < 64u * (unsigned)samples; number++) {
        float u[4];
        surface hit;
        draw(pixel, number, seed, even, u);
        if (!glossy_draw(look, t->hit.normal, t->view, u, &wi)) continue;
        taken++;
        if (scene_trace(world, from, wi, &hit)) sum = lobe_add(sum, light_of(&hit));
    }
    return lobe_scale(sum, 1 / (float)(taken ? taken : 1));
}

/* ---- a frame of a scene ---- */

frame frame_of(const scene *world, const subject *what, int width, int height) {
    frame f;
    int i;
    f.world = *world;
    f.width = width;
    f.height = height;
    f.seen = buffer_camera(world, width, height);
    f.looks = (glossy *)allocate("images", (size_t)width * (size_t)height, sizeof *f.looks);
    f.guides = (guide *)allocate("images", (size_t)width * (size_t)height, sizeof *f.guides);
    for (i = 0; i < width * height; i++) {
        const texel *t = &f.seen.texels[i];
        vec3 unused;
        if (!is_glossy(t)) continue;
        f.looks[i] = what->look(&t->hit, what->which);
        if (lobe_dot(f.looks[i].tangent, f.looks[i].tangent) > 0)
            f.looks[i].tangent = vec3_normalize(f.looks[i].tangent);
        else
            lobe_frame(t->hit.normal, &f.looks[i].tangent, &unused);
        f.guides[i] = filter_guide_of(&f.looks[i], t->hit.normal, t->view, t->hit.distance);
    }
    return f;
}

void frame_free(frame *f) {
    buffer_free(&f->seen);
    free(f->looks);
    free(f->guides);
}

vec3 shade_pixel(const frame *f, int i, int samples, unsigned seed, int even) {
    const vec3 none = {0, 0, 0};
    if (f->guides[i].valid)
        return trace_pixel(&f->world, &f->seen.texels[i], &f->looks[i], (unsigned)i, samples, seed, even);
    return f->seen.texels[i].valid ? light_of(&f->seen.texels[i].hit) : none;
}

image shade_frame(const frame *f, int samples, unsigned seed, int even, const char *label) {
    image result = image_create(f->width, f->height);
    progress line = progress_begin(label, f->height);
    int row;
    PARALLEL_FOR
    for (row = 0; row < f->height; row++) {
        int i;
        for (i = row * f->width; i < (row + 1) * f->width; i++)
            result.pixels[i] = shade_pixel(f, i, samples, seed, even);
        progress_step(&line);
    }
    progress_end(&line);
    return result;
}
