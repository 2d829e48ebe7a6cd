/*
 lobe_filter.c - noisy glossy light, filtered and upsampled by weights that know the reflection lobes

 The pipeline of Tokuyoshi 2015, Specular Lobe-Aware Filtering and Upsampling for Interactive Indirect Illumination: one
 bounce of specular light by path tracing, reflectance divided out; a cross bilateral filter whose weights come from
 normals (Eq. 4) or from lobes (Eq. 11, 12, 13), each at its best parameter; the error against that parameter (Figs. 10
 to 13); upsampling of 4 x 4 pixels in space and time with recomputation of what has no like neighbours (Figs. 14 to
 16). With --color and its like it filters buffers of a renderer of yours.
*/
#include "../bilateral.h"
#include "common/buffers.h"
#include "common/fail.h"
#include "common/file.h"
#include "common/glossy.h"
#include "common/hash.h"
#include "common/image.h"
#include "common/options.h"
#include "common/output.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "common/raster.h"
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "lobe_filter";

/* Of all filters: weights of distance in the image and in depth are the same. */
enum { RADIUS = 8, TAPS = (2 * RADIUS + 1) * (2 * RADIUS + 1), SIDE_LIMIT = 16384 };
static const float kernel_variance = 16, scene_depth_variance = 0.1f;

/* ---- scenes: shapes, what they are made of, and the light that they are seen by ---- */

typedef struct {
    const char *name;
    scene (*build)(void);
    glossy (*look)(const surface *hit, int which);
    int which;
} subject;

static glossy one_lobe(glossy_model model, float along, float across) {
    glossy look;
    memset(&look, 0, sizeof look);
    look.count = 1;
    look.lobes[0].model = model;
    look.lobes[0].along = along;
    look.lobes[0].across = across;
    look.lobes[0].share = 1;
    return look;
}

static int tile_of(const surface *hit) {
    return ((int)floorf(hit->position.x / 0.5f) + (int)floorf(hit->position.z / 0.5f)) & 1;
}

/* Bands around the vertical axis of a sphere */
static int band_of(const surface *hit, int bands) {
    return (int)lobe_min(floorf((0.5f + 0.5f * hit->normal.y) * (float)bands), (float)bands - 1);
}

/* One model, a map of glossiness */
static glossy look_tiles(const surface *hit, int which) {
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

/* Two models side by side */
static glossy look_models(const surface *hit, int which) {
    static const float exponents[] = {1000, 200, 60}, alphas[] = {0.25f, 0.2f, 0.06f};
    const int k = hit->shape - GALLERY_WALLS;
    (void)which;
    if (hit->shape == GALLERY_FLOOR)
        return tile_of(hit) ? one_lobe(GLOSSY_BECKMANN, 0.3f, 0.3f) : one_lobe(GLOSSY_PHONG, 1500, 1500);
    return hit->normal.x > 0.2f ? one_lobe(GLOSSY_BECKMANN, alphas[k], alphas[k])
                                : one_lobe(GLOSSY_PHONG, exponents[k], exponents[k]);
}

/* Brushed metal: grooves along x and z by turns on the floor, around the axis on the balls */
static glossy look_brushed(const surface *hit, int which) {
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

/* Three lobes each: other lobes on the floor's tiles, other shares of the same ones on the balls */
static glossy look_layers(const surface *hit, int which) {
    (void)which;
    if (hit->shape == GALLERY_FLOOR)
        return tile_of(hit) ? three_lobes(4000, 1000, 300, 0.4f, 0.4f) : three_lobes(100, 25, 8, 0.4f, 0.4f);
    return band_of(hit, 8) & 1 ? three_lobes(3000, 200, 12, 0.6f, 0.3f) : three_lobes(3000, 200, 12, 0.1f, 0.3f);
}

/* One of three exponents, or all three in bands */
static glossy look_phong(const surface *hit, int which) {
    static const float exponents[] = {10, 100, 1000};
    const float e = exponents[which < 3 ? which : (band_of(hit, 3) + hit->shape) % 3];
    return one_lobe(GLOSSY_PHONG, e, e);
}

static glossy look_mixture(const surface *hit, int which) {
    static const float lobes[3][5] = {
        {40, 10, 3, 0.4f, 0.4f}, {400, 100, 30, 0.4f, 0.4f}, {4000, 1000, 300, 0.4f, 0.4f}};
    const float *l = lobes[which];
    (void)hit;
    return three_lobes(l[0], l[1], l[2], l[3], l[4]);
}

static glossy look_stretched(const surface *hit, int which) {
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

/* ---- what filters know of a pixel ---- */

typedef struct {
    int valid, parts_count;
    float depth, alpha, half_sharpness; /* of a distribution of half vectors like it */
    vec3 normal;
    sg_lobe parts[GLOSSY_LOBES], lobe; /* Eq. 11, Eq. 12 */
    asg_lobe stretched;                /* Eq. 13 */
} guide;

static sg_lobe with_share(sg_lobe g, float share) {
    g = sg_normalize(g);
    g.log_amplitude += lobe_log(lobe_max(share, 1e-6f));
    return g;
}

static guide guide_of(const glossy *look, vec3 normal, vec3 view, float depth) {
    guide g;
    sg_lobe halves[GLOSSY_LOBES];
    float along = 0, across = 0;
    int k;
    g.valid = 1;
    g.parts_count = look->count;
    g.depth = depth;
    g.normal = normal;
    for (k = 0; k < look->count; k++) {
        const glossy_lobe *l = &look->lobes[k];
        along = glossy_sharpness(l->model, l->along);
        across = glossy_sharpness(l->model, l->across);
        halves[k].axis = normal;
        halves[k].sharpness = sqrtf(along * across);
        halves[k].log_amplitude = 0;
        g.parts[k] = with_share(sg_reflection_lobe(normal, view, halves[k].sharpness), l->share);
        halves[k] = with_share(halves[k], l->share);
    }
    if (look->count > 1) {
        along = across = bilateral_merge(halves, look->count).sharpness;
        g.lobe = bilateral_merge(g.parts, look->count);
    } else {
        g.lobe = g.parts[0];
    }
    g.half_sharpness = sqrtf(along * across);
    g.alpha = sqrtf(2 / g.half_sharpness);
    if (along < across || along > across) {
        g.stretched = asg_reflection_lobe_aniso(normal, look->tangent, view, 0.5f * along, 0.5f * across);
        g.lobe = g.parts[0] = sg_normalize(asg_isotropic(g.stretched));
    } else {
        g.stretched = asg_reflection_lobe(normal, view, 0.5f * along);
    }
    return g;
}

/* ---- a frame of a scene ---- */

typedef struct {
    scene world;
    buffer seen;
    glossy *looks;
    guide *guides;
    int width, height;
} frame;

static frame frame_of(const scene *world, const subject *what, int width, int height) {
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
        f.guides[i] = guide_of(&f.looks[i], t->hit.normal, t->view, t->hit.distance);
    }
    return f;
}

static void frame_free(frame *f) {
    buffer_free(&f->seen);
    free(f->looks);
    free(f->guides);
}

static vec3 shade_pixel(const frame *f, int i, int samples, unsigned seed, int even) {
    const vec3 none = {0, 0, 0};
    if (f->guides[i].valid)
        return trace_pixel(&f->world, &f->seen.texels[i], &f->looks[i], (unsigned)i, samples, seed, even);
    return f->seen.texels[i].valid ? light_of(&f->seen.texels[i].hit) : none;
}

static image shade_frame(const frame *f, int samples, unsigned seed, int even, const char *label) {
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

/* ---- filters: guides as planes with a border, so that the loops over them become vector code ---- */

typedef enum { UNFILTERED, NORMAL, BANDLIMIT, ALPHA_GUIDE, EQ12, EQ11, EQ13, METHODS } method;

typedef struct {
    const char *name, *parameter;
    int parameters; /* 0 to 2; searched by powers of two: */
    float low[2], high[2];
} method_data;

static const method_data methods[METHODS] = {
    {"unfiltered", "", 0, {0, 0}, {0, 0}},
    {"normals, Eq. 4", "variance", 1, {-20, 0}, {2, 0}},
    {"normals, bandlimit", "variance, width", 2, {-20, 0}, {2, 12}},
    {"normals and alpha", "variances", 2, {-20, -20}, {2, 2}},
    {"lobes, Eq. 12", "beta", 1, {-6, 0}, {10, 0}},
    {"lobes, Eq. 11", "beta", 1, {-6, 0}, {10, 0}},
    {"lobes, Eq. 13", "beta", 1, {-6, 0}, {10, 0}},
};

/* Planes. Guides of one method at a time. */
enum {
    RED,
    GREEN,
    BLUE,
    VALID,
    DEPTH,
    NORMAL_X,
    NORMAL_Y,
    NORMAL_Z,
    ALPHA,
    LIMIT,
    AXIS_X = NORMAL_X,
    AXIS_Y,
    AXIS_Z,
    WIDTH,
    PART = NORMAL_X,
    PART_PLANES = 6,
    STRETCHED = NORMAL_X,
    PLANES = PART + GLOSSY_LOBES * PART_PLANES
};

typedef struct {
    int width, height, stride;
    int parts;                     /* most lobes of a pixel */
    float *memory, *plane[PLANES]; /* at the first pixel: the border is before it */
} planes;

static planes planes_create(int width, int height, int parts) {
    planes p;
    size_t size;
    int k;
    p.width = width;
    p.height = height;
    p.stride = width + 2 * RADIUS;
    p.parts = parts;
    size = (size_t)p.stride * (size_t)(height + 2 * RADIUS);
    p.memory = (float *)allocate("images", size, PLANES * sizeof *p.memory);
    for (k = 0; k < PLANES; k++) p.plane[k] = p.memory + (size_t)k * size + (size_t)RADIUS * (size_t)(p.stride + 1);
    return p;
}

static void put_vector(const planes *p, int first, ptrdiff_t at, vec3 v) {
    p->plane[first][at] = v.x;
    p->plane[first + 1][at] = v.y;
    p->plane[first + 2][at] = v.z;
}

static inline vec3 vector_at(const planes *p, int first, ptrdiff_t at) {
    return lobe_vector(p->plane[first][at], p->plane[first + 1][at], p->plane[first + 2][at]);
}

static void put_part(const planes *p, int k, ptrdiff_t at, const bilateral_sg_part *part) {
    put_vector(p, PART + k * PART_PLANES, at, part->axis);
    p->plane[PART + k * PART_PLANES + 3][at] = part->sharpness;
    p->plane[PART + k * PART_PLANES + 4][at] = part->amplitude;
    p->plane[PART + k * PART_PLANES + 5][at] = part->tail;
}

static void put_stretched(const planes *p, ptrdiff_t at, const bilateral_asg *a) {
    put_vector(p, STRETCHED, at, a->x);
    put_vector(p, STRETCHED + 3, at, a->y);
    put_vector(p, STRETCHED + 6, at, a->z);
    p->plane[STRETCHED + 9][at] = a->sharpness_x;
    p->plane[STRETCHED + 10][at] = a->sharpness_y;
    p->plane[STRETCHED + 11][at] = a->own_exponent;
    p->plane[STRETCHED + 12][at] = a->own_scale;
}

static inline sg_lobe blank_lobe(void) {
    sg_lobe g;
    g.axis = lobe_vector(0, 0, 1);
    g.sharpness = 1;
    g.log_amplitude = 0;
    return g;
}

/* Every plane gets numbers that the loops can take, outside of what is valid too */
static void put_guide(const planes *p, ptrdiff_t at, const guide *g, method m, const float *parameter) {
    bilateral_sg_part parts[GLOSSY_LOBES];
    bilateral_sg narrow;
    bilateral_asg stretched;
    int k;
    switch (m) {
    case NORMAL:
    case BANDLIMIT:
    case ALPHA_GUIDE:
        put_vector(p, NORMAL_X, at, lobe_scale(g->normal, bilateral_scale(parameter[0])));
        p->plane[ALPHA][at] = m == ALPHA_GUIDE ? g->alpha * bilateral_scale(parameter[1]) : 0;
        /* log2 of a Gaussian in squared pixels, whose deviation is parameter / sqrt(sharpness) */
        p->plane[LIMIT][at] =
            m == BANDLIMIT ? 0.5f * LOBE_LOG2E * g->half_sharpness / (parameter[1] * parameter[1]) : 0;
        break;
    case EQ12:
        narrow = bilateral_sg_prepare(g->valid ? g->lobe : blank_lobe(), parameter[0]);
        put_vector(p, AXIS_X, at, narrow.axis);
        p->plane[WIDTH][at] = narrow.width;
        break;
    case EQ11:
        for (k = 0; k < GLOSSY_LOBES; k++) { /* missing ones are empty */
            sg_lobe blank = blank_lobe();
            bilateral_sg_mixture_prepare(&blank, 1, &parts[k]);
            parts[k].amplitude = 0;
        }
        if (g->valid) bilateral_sg_mixture_prepare(g->parts, g->parts_count, parts);
        for (k = 0; k < GLOSSY_LOBES; k++) put_part(p, k, at, &parts[k]);
        break;
    case EQ13:
        stretched = bilateral_asg_prepare(g->stretched);
        put_stretched(p, at, &stretched);
        break;
    case UNFILTERED:
    case METHODS:
        break;
    }
}

static void fill_row(const planes *p, const guide *guides, method m, const float *parameter, float depth_scale,
                     int row) {
    guide outside;
    int column;
    memset(&outside, 0, sizeof outside);
    lobe_frame(lobe_vector(0, 0, 1), &outside.stretched.x, &outside.stretched.y);
    outside.stretched.z = lobe_vector(0, 0, 1);
    outside.stretched.sharpness_x = outside.stretched.sharpness_y = 1;
    for (column = -RADIUS; column < p->width + RADIUS; column++) {
        const ptrdiff_t at = (ptrdiff_t)row * p->stride + column;
        const int inside = row >= 0 && row < p->height && column >= 0 && column < p->width;
        const guide *g = inside ? &guides[(ptrdiff_t)row * p->width + column] : &outside;
        g = g->valid ? g : &outside;
        p->plane[VALID][at] = g->valid ? 1 : 0;
        p->plane[DEPTH][at] = g->depth * depth_scale;
        put_guide(p, at, g, m, parameter);
    }
}

static void fill_planes(const planes *p, const guide *guides, method m, const float *parameter, float depth_variance) {
    const float depth_scale = bilateral_scale(depth_variance);
    int row;
    PARALLEL_FOR
    for (row = -RADIUS; row < p->height + RADIUS; row++) fill_row(p, guides, m, parameter, depth_scale, row);
}

static void fill_colours(planes *p, const image *noisy) {
    int row, column;
    for (row = 0; row < p->height; row++) {
        for (column = 0; column < p->width; column++)
            put_vector(p, RED, (ptrdiff_t)row * p->stride + column, noisy->pixels[row * p->width + column]);
    }
}

/* Weights of the pixels from i on with those from j on; exponent: log2 of the kernel at their distance, whose square is
   given too */
typedef struct {
    ptrdiff_t i, j;
    int count;
    float exponent, squared;
} tap_row;

static inline float depth_exponent(const planes *p, const tap_row *t, int x) {
    return t->exponent + bilateral_depth_exponent(p->plane[DEPTH][t->i + x], p->plane[DEPTH][t->j + x]);
}

enum { BLOCK = 256 };

static void weigh_normals(const planes *all, const tap_row *row, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    int x;
    for (x = 0; x < t.count; x++)
        weight[x] = bilateral_normal_tap(depth_exponent(&p, &t, x), vector_at(&p, NORMAL_X, t.i + x),
                                         vector_at(&p, NORMAL_X, t.j + x));
}

static void weigh_normals_near(const planes *all, const tap_row *row, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    int x;
    for (x = 0; x < t.count; x++)
        weight[x] = bilateral_normal_tap(depth_exponent(&p, &t, x) - t.squared * p.plane[LIMIT][t.i + x],
                                         vector_at(&p, NORMAL_X, t.i + x), vector_at(&p, NORMAL_X, t.j + x));
}

static void weigh_normals_and_alpha(const planes *all, const tap_row *row, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    int x;
    for (x = 0; x < t.count; x++) {
        const float alike = bilateral_depth_exponent(p.plane[ALPHA][t.i + x], p.plane[ALPHA][t.j + x]);
        weight[x] = bilateral_normal_tap(depth_exponent(&p, &t, x) + alike, vector_at(&p, NORMAL_X, t.i + x),
                                         vector_at(&p, NORMAL_X, t.j + x));
    }
}

/* By lobes the library runs along the row: log2 of the rest goes in, the weight comes out */
static void weigh_planes(const planes *all, const tap_row *row, method m, float beta, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    const float *i[PLANES], *j[PLANES];
    int x, k;
    for (x = 0; x < t.count; x++) weight[x] = depth_exponent(&p, &t, x);
    for (k = 0; k < PLANES; k++) {
        i[k] = p.plane[k] + t.i;
        j[k] = p.plane[k] + t.j;
    }
    if (m == EQ12)
        bilateral_sg_taps(t.count, i + AXIS_X, j + AXIS_X, beta, weight);
    else if (m == EQ11)
        bilateral_sg_mixture_taps(t.count, p.parts, i + PART, j + PART, beta, weight);
    else
        bilateral_asg_taps(t.count, i + STRETCHED, j + STRETCHED, beta, weight);
}

static void weigh(const planes *p, const tap_row *row, method m, const float *parameter, float *weight) {
    switch (m) {
    case NORMAL:
        weigh_normals(p, row, weight);
        break;
    case BANDLIMIT:
        weigh_normals_near(p, row, weight);
        break;
    case ALPHA_GUIDE:
        weigh_normals_and_alpha(p, row, weight);
        break;
    case EQ12:
    case EQ11:
    case EQ13:
        weigh_planes(p, row, m, parameter[0], weight);
        break;
    case UNFILTERED:
    case METHODS:
        break;
    }
}

/* Adds what a row of taps weighs */
static void gather(const planes *all, const tap_row *row, const float *restrict weight, float *restrict red,
                   float *restrict green, float *restrict blue, float *restrict total) {
    const planes p = *all;
    const tap_row t = *row;
    int x;
    for (x = 0; x < t.count; x++) {
        const float w = weight[x] * p.plane[VALID][t.j + x];
        red[x] += w * p.plane[RED][t.j + x];
        green[x] += w * p.plane[GREEN][t.j + x];
        blue[x] += w * p.plane[BLUE][t.j + x];
        total[x] += w;
    }
}

static void filter_row(const planes *p, method m, const float *parameter, int row, image *result) {
    int first, x, y, k;
    for (first = 0; first < p->width; first += BLOCK) {
        float weight[BLOCK], sum[4][BLOCK];
        tap_row t;
        t.i = (ptrdiff_t)row * p->stride + first;
        t.count = p->width - first < BLOCK ? p->width - first : BLOCK;
        memset(sum, 0, sizeof sum);
        for (y = -RADIUS; y <= RADIUS && m != UNFILTERED; y++) {
            for (x = -RADIUS; x <= RADIUS; x++) {
                t.j = t.i + (ptrdiff_t)y * p->stride + x;
                t.squared = (float)(x * x + y * y);
                t.exponent = -0.5f * LOBE_LOG2E / kernel_variance * t.squared;
                weigh(p, &t, m, parameter, weight);
                gather(p, &t, weight, sum[0], sum[1], sum[2], sum[3]);
            }
        }
        for (k = 0; k < t.count; k++) {
            vec3 *to = &result->pixels[row * p->width + first + k];
            if (m != UNFILTERED && p->plane[VALID][t.i + k] > 0)
                *to = lobe_scale(lobe_vector(sum[0][k], sum[1][k], sum[2][k]), 1 / sum[3][k]);
            else
                *to = vector_at(p, RED, t.i + k);
        }
    }
}

/* ---- measuring ---- */

/* What an image should be, twice: their noise is independent, so that it does not count as an error. And the mean. */
typedef struct {
    image half[2], mean;
} truth;

static truth truth_of(const frame *f, int samples, unsigned seed, const char *label) {
    truth t;
    int i, k;
    for (k = 0; k < 2; k++) t.half[k] = shade_frame(f, samples > 1 ? samples / 2 : 1, seed + 1 + (unsigned)k, 1, label);
    t.mean = image_create(f->width, f->height);
    for (i = 0; i < f->width * f->height; i++)
        t.mean.pixels[i] = lobe_scale(lobe_add(t.half[0].pixels[i], t.half[1].pixels[i]), 0.5f);
    return t;
}

static void truth_free(truth *t) {
    image_free(&t->half[0]);
    image_free(&t->half[1]);
    image_free(&t->mean);
}

/* One noisy image, what it should be, and room for filtering it */
typedef struct {
    frame f;
    image noisy, result;
    truth wanted;
    planes room;
} study;

static int most_parts(const frame *f) {
    int i, most = 1;
    for (i = 0; i < f->width * f->height; i++) most = f->guides[i].parts_count > most ? f->guides[i].parts_count : most;
    return most;
}

static void study_begin(study *s, const subject *what, int width, int height, int samples, int reference,
                        unsigned seed) {
    const scene world = what->build();
    s->f = frame_of(&world, what, width, height);
    s->noisy = shade_frame(&s->f, samples, seed, 0, what->name);
    s->wanted = truth_of(&s->f, reference, seed, what->name);
    s->result = image_create(width, height);
    s->room = planes_create(width, height, most_parts(&s->f));
    fill_colours(&s->room, &s->noisy);
}

static void study_end(study *s) {
    frame_free(&s->f);
    image_free(&s->noisy);
    truth_free(&s->wanted);
    image_free(&s->result);
    free(s->room.memory);
}

static void run_filter(study *s, method m, const float *parameter) {
    int row;
    fill_planes(&s->room, s->f.guides, m, parameter, scene_depth_variance);
    PARALLEL_FOR
    for (row = 0; row < s->room.height; row++) filter_row(&s->room, m, parameter, row, &s->result);
}

/* Mean square error over the channels of what is glossy */
static double error_of(const frame *f, const image *got, const truth *wanted) {
    double sum = 0;
    long count = 0;
    int i;
    for (i = 0; i < f->width * f->height; i++) {
        if (!f->guides[i].valid) continue;
        sum += (double)lobe_dot(lobe_sub(got->pixels[i], wanted->half[0].pixels[i]),
                                lobe_sub(got->pixels[i], wanted->half[1].pixels[i]));
        count += 3;
    }
    return count ? sum / (double)count : 0;
}

static double try_filter(study *s, method m, const float *parameter) {
    run_filter(s, m, parameter);
    return error_of(&s->f, &s->result, &s->wanted);
}

/* The error at powers of two */
static double try_powers(study *s, method m, float first, float second) {
    float parameter[2];
    parameter[0] = exp2f(first);
    parameter[1] = exp2f(second);
    return try_filter(s, m, parameter);
}

/* Golden section of one exponent about a value that is lower than those a step away */
static void refine(study *s, method m, float at[2], int which, float step) {
    const float golden = 0.618033989f;
    float low = at[which] - step, high = at[which] + step, x[2];
    double y[2];
    int i, k;
    x[0] = high - golden * (high - low);
    x[1] = low + golden * (high - low);
    for (k = 0; k < 2; k++) {
        at[which] = x[k];
        y[k] = try_powers(s, m, at[0], at[1]);
    }
    for (i = 0; i < 6; i++) {
        k = y[0] < y[1]; /* the one that moves */
        if (k)
            high = x[1];
        else
            low = x[0];
        x[k] = x[!k];
        y[k] = y[!k];
        at[which] = x[!k] = k ? high - golden * (high - low) : low + golden * (high - low);
        y[!k] = try_powers(s, m, at[0], at[1]);
    }
    at[which] = y[0] < y[1] ? x[0] : x[1];
}

/* The parameters of least error: a sweep in steps, then golden sections */
static double search(study *s, method m, float step, float parameter[2], progress *line) {
    const method_data *d = &methods[m];
    float at[2], best[2] = {0, 0};
    double least = 1e300;
    int k;
    for (at[0] = d->low[0]; at[0] <= d->high[0]; at[0] += d->parameters > 0 ? step : 100) {
        for (at[1] = d->low[1]; at[1] <= d->high[1]; at[1] += d->parameters > 1 ? step : 100) {
            double found = try_powers(s, m, at[0], at[1]);
            if (!(found < least)) continue;
            least = found;
            best[0] = at[0];
            best[1] = at[1];
        }
    }
    for (k = 0; k < (d->parameters > 1 ? 4 : d->parameters); k++) refine(s, m, best, k & 1, k < 2 ? step : 0.5f * step);
    parameter[0] = exp2f(best[0]);
    parameter[1] = exp2f(best[1]);
    progress_step(line);
    return try_filter(s, m, parameter);
}

/* ---- time ---- */

enum { ROUNDS = 5 };

/* Milliseconds of each method on one core, turn by turn */
static void time_methods(study *s, float parameters[METHODS][2], double ms[METHODS]) {
    double times[METHODS][ROUNDS];
    int round, m, row;
    for (round = 0; round < ROUNDS; round++) {
        for (m = 0; m < METHODS; m++) {
            const double started = progress_clock();
            for (row = -RADIUS; row < s->room.height + RADIUS; row++)
                fill_row(&s->room, s->f.guides, (method)m, parameters[m], bilateral_scale(scene_depth_variance), row);
            for (row = 0; row < s->room.height; row++) filter_row(&s->room, (method)m, parameters[m], row, &s->result);
            times[m][round] = progress_clock() - started;
        }
    }
    for (m = 0; m < METHODS; m++) ms[m] = progress_median(times[m], ROUNDS);
}

/* ---- files ---- */

typedef struct {
    option_size size;
    int samples, reference, seed;
    const char *out;
    const char *color, *depth, *normal, *alpha; /* a user's buffers */
    float field_of_view, beta, depth_variance;
} settings;

static void write_picture(const char *prefix, const char *rest, const image *picture, const char *what) {
    output_picture(prefix, rest, picture, 1);
    printf("wrote %s%s: %s\n", prefix, rest, what);
}

static void begin_csv(file *f, char path[OUTPUT_NAME], const char *prefix, const char *rest) {
    const char *wrong;
    output_name(path, prefix, rest);
    wrong = file_begin(f, path);
    if (wrong) give_up(path, wrong);
}

static void end_csv(file *f, const char *what) {
    const char *path = f->path, *wrong = file_end(f);
    if (wrong) give_up(path, wrong);
    printf("wrote %s: %s\n", path, what);
}

/* Twice the difference where something is glossy */
static image difference(const frame *f, const image *got, const image *wanted) {
    image result = image_create(f->width, f->height);
    int i;
    for (i = 0; i < f->width * f->height; i++) {
        vec3 d = lobe_sub(got->pixels[i], wanted->pixels[i]);
        if (f->guides[i].valid) result.pixels[i] = lobe_vector(2 * fabsf(d.x), 2 * fabsf(d.y), 2 * fabsf(d.z));
    }
    return result;
}

static void paste_with_difference(const frame *f, image *sheet, const image *got, const image *wanted, int column) {
    image d = difference(f, got, wanted);
    image_paste(sheet, got, column * got->width, 0);
    image_paste(sheet, &d, column * got->width, got->height);
    image_free(&d);
}

/* ---- Fig. 4: what Eq. 12 loses against Eq. 11 of one lobe each ---- */

static void compare_similarities(const settings *o) {
    static const float sharpnesses[] = {1, 3, 10, 30, 100, 1000};
    enum { COLUMNS = sizeof sharpnesses / sizeof *sharpnesses, STEPS = 180 };
    float worst[COLUMNS], where[COLUMNS];
    char path[OUTPUT_NAME];
    file f;
    int i, k;
    begin_csv(&f, path, o->out, "-similarity.csv");
    fprintf(f.stream, "degrees");
    for (k = 0; k < COLUMNS; k++) {
        fprintf(f.stream, ",Eq. 11 of sharpness %g,Eq. 12", (double)sharpnesses[k]);
        worst[k] = where[k] = 0;
    }
    for (i = 0; i <= STEPS; i++) {
        const float angle = (float)i * LOBE_PI / STEPS;
        fprintf(f.stream, "\n%d", i);
        for (k = 0; k < COLUMNS; k++) {
            sg_lobe a = blank_lobe(), b = blank_lobe();
            float exact, approximate;
            a.sharpness = b.sharpness = sharpnesses[k];
            b.axis = lobe_vector(sinf(angle), 0, cosf(angle));
            exact = bilateral_sg_mixture_weight(&a, 1, &b, 1, 20);
            approximate = bilateral_sg_weight(a, b, 20);
            fprintf(f.stream, ",%g,%g", (double)exact, (double)approximate);
            if (fabsf(exact - approximate) <= worst[k]) continue;
            worst[k] = fabsf(exact - approximate);
            where[k] = angle * 180 / LOBE_PI;
        }
    }
    fprintf(f.stream, "\n");
    printf("\nEq. 12 against Eq. 11, lobes of one sharpness, beta 20 (Fig. 4): the largest difference\n\nsharpness ");
    for (k = 0; k < COLUMNS; k++) printf("%10g", (double)sharpnesses[k]);
    printf("\ndifference");
    for (k = 0; k < COLUMNS; k++) printf("%10.5f", (double)worst[k]);
    printf("\nat degrees");
    for (k = 0; k < COLUMNS; k++) printf("%10.0f", (double)where[k]);
    printf("\n\n");
    end_csv(&f, "both weights over the angle (Fig. 4)");
}

/* ---- Figs. 10 to 13: the error over the parameter, one material a picture, and three in one ---- */

enum { SINGLES = 3, GROUPS = 3, MATERIALS = GROUPS * SINGLES + 1, ALL_THREE = MATERIALS - 1, GRID = 45 };
static const subject materials[MATERIALS] = {{"Phong 10", scene_spheres, look_phong, 0},
                                             {"Phong 100", scene_spheres, look_phong, 1},
                                             {"Phong 1000", scene_spheres, look_phong, 2},
                                             {"three wide lobes", scene_spheres, look_mixture, 0},
                                             {"three lobes", scene_spheres, look_mixture, 1},
                                             {"three narrow lobes", scene_spheres, look_mixture, 2},
                                             {"brushed 100, 5", scene_spheres, look_stretched, 0},
                                             {"brushed 1000, 10", scene_spheres, look_stretched, 1},
                                             {"brushed 5000, 100", scene_spheres, look_stretched, 2},
                                             {"10, 100 and 1000", scene_spheres, look_phong, 3}};
static const method group_methods[GROUPS] = {EQ12, EQ11, EQ13};

/* Errors of one method at the powers of two that its search covers, in half steps */
typedef struct {
    int count;
    double error[MATERIALS][GRID];
} curve;

static float grid_parameter(const method_data *d, int i) {
    return exp2f(d->low[0] + 0.5f * (float)i);
}

static void find_curve(study *s, method m, int which, curve *c) {
    int i;
    c->count = (int)(2 * (methods[m].high[0] - methods[m].low[0])) + 1;
    for (i = 0; i < c->count; i++) {
        const float parameter = grid_parameter(&methods[m], i);
        c->error[which][i] = try_filter(s, m, &parameter);
    }
}

static double mean_of_group(const curve *c, int group, int i) {
    const int k = group * SINGLES;
    return (c->error[k][i] + c->error[k + 1][i] + c->error[k + 2][i]) / SINGLES;
}

static int best_of(const curve *c, int which) {
    int i, best = 0;
    for (i = 1; i < c->count; i++) best = c->error[which][i] < c->error[which][best] ? i : best;
    return best;
}

static int best_of_group(const curve *c, int group) {
    int i, best = 0;
    for (i = 1; i < c->count; i++) best = mean_of_group(c, group, i) < mean_of_group(c, group, best) ? i : best;
    return best;
}

static void write_curve(const settings *o, const char *rest, const char *parameter, method m, const curve *c,
                        const char *what) {
    char path[OUTPUT_NAME];
    file f;
    int i, k, group;
    begin_csv(&f, path, o->out, rest);
    fprintf(f.stream, "%s", parameter);
    for (group = 0; group < GROUPS; group++) {
        for (k = 0; k < SINGLES; k++) fprintf(f.stream, ",\"%s\"", materials[group * SINGLES + k].name);
        fprintf(f.stream, ",mean");
    }
    fprintf(f.stream, ",\"%s\"\n", materials[ALL_THREE].name);
    for (i = 0; i < c->count; i++) {
        fprintf(f.stream, "%g", (double)grid_parameter(&methods[m], i));
        for (group = 0; group < GROUPS; group++) {
            for (k = 0; k < SINGLES; k++) fprintf(f.stream, ",%g", c->error[group * SINGLES + k][i]);
            fprintf(f.stream, ",%g", mean_of_group(c, group, i));
        }
        fprintf(f.stream, ",%g\n", c->error[ALL_THREE][i]);
    }
    end_csv(&f, what);
}

/* One method's four columns: errors of a material at its own best parameter and at the group's, and the parameters */
static void print_errors(method m, const curve *c, int group, int which) {
    const int own = best_of(c, which), shared = best_of_group(c, group);
    printf("%11.5f%9.3g%11.5f%9.3g", c->error[which][own], (double)grid_parameter(&methods[m], own),
           c->error[which][shared], (double)grid_parameter(&methods[m], shared));
}

/* Prints what each method loses by a shared parameter; returns those of the three exponents. */
static void compare_materials(const settings *o, float shared[2]) {
    curve *normals = (curve *)allocate("curves", 2, sizeof *normals), *lobes = normals + 1;
    progress line = progress_begin("materials", MATERIALS);
    int i, k, group;
    for (i = 0; i < MATERIALS; i++) {
        const method m = i == ALL_THREE ? EQ12 : group_methods[i / SINGLES];
        study s;
        study_begin(&s, &materials[i], o->size.width, o->size.height, o->samples, o->reference, (unsigned)o->seed);
        find_curve(&s, NORMAL, i, normals);
        find_curve(&s, m, i, lobes);
        study_end(&s);
        progress_step(&line);
    }
    progress_end(&line);
    printf(
        "\nMean square error of one material a picture, at its own best parameter and at that of the least mean\n\n");
    printf("%-22s%-40s%s\n", "", "normals, Eq. 4", "lobes");
    printf("%-22s%11s%9s%11s%9s%11s%9s%11s%9s\n", "", "own best", "variance", "shared", "variance", "own best", "beta",
           "shared", "beta");
    for (group = 0; group < GROUPS; group++) {
        const int best[2] = {best_of_group(normals, group), best_of_group(lobes, group)};
        double own[2] = {0, 0};
        for (k = group * SINGLES; k < (group + 1) * SINGLES; k++) {
            printf("%-22s", materials[k].name);
            print_errors(NORMAL, normals, group, k);
            print_errors(group_methods[group], lobes, group, k);
            printf("\n");
            own[0] += normals->error[k][best_of(normals, k)] / SINGLES;
            own[1] += lobes->error[k][best_of(lobes, k)] / SINGLES;
        }
        printf("%-22s%11.5f%9s%11.5f%9s%11.5f%9s%11.5f%9s\n",
               group == 0   ? "mean, Eq. 12"
               : group == 1 ? "mean, Eq. 11"
                            : "mean, Eq. 13",
               own[0], "", mean_of_group(normals, group, best[0]), "", own[1], "", mean_of_group(lobes, group, best[1]),
               "");
        if (group == 0) {
            shared[0] = grid_parameter(&methods[NORMAL], best[0]);
            shared[1] = grid_parameter(&methods[EQ12], best[1]);
            printf("%-22s", "all three in one");
            print_errors(NORMAL, normals, 0, ALL_THREE);
            print_errors(EQ12, lobes, 0, ALL_THREE);
            printf("\n");
        }
    }
    printf("\n");
    write_curve(o, "-normals.csv", "variance", NORMAL, normals,
                "error of Eq. 4 over its variance (Figs. 10 to 13, left)");
    write_curve(o, "-lobes.csv", "beta", EQ12, lobes, "error of Eq. 12, 11 and 13 over beta (Figs. 10 to 13, right)");
    free(normals);
}

/* ---- the scenes: each filter at its best, and at what was best for three exponents ---- */

enum { SCENES = 5, SHEET_COLUMNS = 5 };

typedef struct {
    subject what;
    method shown; /* in the picture, beside those of normals */
    const char *about;
} shown_scene;

static const shown_scene scenes[SCENES] = {
    {{"tiles", scene_gallery, look_tiles, 0}, EQ12, "GGX of alpha .04, .1 and .3; bands on the balls"},
    {{"models", scene_gallery, look_models, 0}, EQ12, "Phong beside Beckmann"},
    {{"brushed", scene_gallery, look_brushed, 0}, EQ13, "brushed along x and z by turns, exponents 4000 and 12"},
    {{"layers", scene_gallery, look_layers, 0}, EQ11, "three lobes each"},
    {{"spheres", scene_spheres, look_phong, 3}, EQ12, "Phong of exponent 10, 100 and 1000 in bands"}};

static void show_scene(const settings *o, const shown_scene *which, const float shared[2]) {
    static const method columns[SHEET_COLUMNS - 1] = {UNFILTERED, NORMAL, BANDLIMIT, METHODS};
    float best[METHODS][2];
    double error[METHODS], ms[METHODS];
    progress line = progress_begin(which->what.name, METHODS);
    char rest[64];
    image sheet = image_create(SHEET_COLUMNS * o->size.width, 2 * o->size.height);
    study s;
    int m, k;
    study_begin(&s, &which->what, o->size.width, o->size.height, o->samples, o->reference, (unsigned)o->seed);
    for (m = 0; m < METHODS; m++) {
        error[m] = search(&s, (method)m, 2, best[m], &line);
        for (k = 0; k < SHEET_COLUMNS - 1; k++) {
            if (m == (int)(columns[k] == METHODS ? which->shown : columns[k]))
                paste_with_difference(&s.f, &sheet, &s.result, &s.wanted.mean, k);
        }
    }
    image_paste(&sheet, &s.wanted.mean, (SHEET_COLUMNS - 1) * o->size.width, 0);
    progress_end(&line);
    time_methods(&s, best, ms);
    printf("\n%s: %s\n\n%-20s%10s%10s  %-18s%10s%14s%9s\n", which->what.name, which->about, "", "MSE", "best at", "",
           "at shared", "ms/megapixel", "ns/tap");
    for (m = 0; m < METHODS; m++) {
        const method_data *d = &methods[m];
        const double megapixels = 1e-6 * o->size.width * o->size.height;
        char second[32] = "", at_shared[32] = "";
        if (d->parameters > 1) snprintf(second, sizeof second, ", %.3g", (double)best[m][1]);
        if (d->parameters == 1)
            snprintf(at_shared, sizeof at_shared, "%.5f", try_filter(&s, (method)m, &shared[m == NORMAL ? 0 : 1]));
        if (d->parameters > 0)
            printf("%-20s%10.5f%10.3g%-20s%10s%14.0f%9.2f\n", d->name, error[m], (double)best[m][0], second, at_shared,
                   ms[m] / megapixels, ms[m] / megapixels / TAPS);
        else
            printf("%-20s%10.5f\n", d->name, error[m]);
    }
    snprintf(rest, sizeof rest, "-%s.png", which->what.name);
    write_picture(o->out, rest, &sheet, "noisy, Eq. 4, the same with a bandlimit, with lobes, reference; errors below");
    image_free(&sheet);
    study_end(&s);
}

/* ---- Fig. 19: the weights of Eq. 13 around a pixel, and by Cardano's formula ---- */

/* The papers' product integral of two ASGs in float: the lowest eigenvalue of the summed quadratic form by Cardano's
   formula, its vector as the longest cross product of two rows */
static float product_by_cardano(const asg_lobe *a, const asg_lobe *b) {
    const vec3 v[4] = {a->x, a->y, b->x, b->y};
    const float l[4] = {a->sharpness_x, a->sharpness_y, b->sharpness_x, b->sharpness_y};
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, mean, p, q, angle, high, middle, low, length = 0;
    vec3 rows[3], axis = a->z;
    int k;
    for (k = 0; k < 4; k++) {
        xx += l[k] * v[k].x * v[k].x;
        yy += l[k] * v[k].y * v[k].y;
        zz += l[k] * v[k].z * v[k].z;
        xy += l[k] * v[k].x * v[k].y;
        xz += l[k] * v[k].x * v[k].z;
        yz += l[k] * v[k].y * v[k].z;
    }
    mean = (xx + yy + zz) / 3;
    rows[0] = lobe_vector(xx - mean, xy, xz);
    rows[1] = lobe_vector(xy, yy - mean, yz);
    rows[2] = lobe_vector(xz, yz, zz - mean);
    p = sqrtf((lobe_dot(rows[0], rows[0]) + lobe_dot(rows[1], rows[1]) + lobe_dot(rows[2], rows[2])) / 6);
    q = 0.5f * lobe_dot(rows[0], lobe_cross(rows[1], rows[2])) / lobe_max(p * p * p, LOBE_TINY);
    angle = acosf(lobe_max(-1, lobe_min(1, q))) / 3;
    high = mean + 2 * p * cosf(angle);
    low = mean + 2 * p * cosf(angle + 2 * LOBE_PI / 3);
    middle = 3 * mean - high - low;
    rows[0].x = xx - low;
    rows[1].y = yy - low;
    rows[2].z = zz - low;
    for (k = 0; k < 3; k++) {
        const vec3 cross = lobe_cross(rows[k], rows[(k + 1) % 3]);
        if (lobe_dot(cross, cross) <= length) continue;
        length = lobe_dot(cross, cross);
        axis = lobe_scale(cross, 1 / sqrtf(length));
    }
    return LOBE_PI * expf(-low) * lobe_max(lobe_dot(axis, a->z) * lobe_dot(axis, b->z), 0) /
           sqrtf(lobe_max((high - low) * (middle - low), LOBE_TINY));
}

static float weight_by_cardano(const asg_lobe *a, const asg_lobe *b, float beta) {
    const float own = product_by_cardano(a, a) * product_by_cardano(b, b);
    return powf(lobe_min(product_by_cardano(a, b) / sqrtf(lobe_max(own, LOBE_TINY)), 1), beta);
}

/* White is 1; the PNG's tone curve undone */
static vec3 as_grey(float weight) {
    const float c = -logf(1 - 0.999f * lobe_max(lobe_min(weight, 1), 0));
    return lobe_vector(c, c, c);
}

static int same_tile(const frame *f, int i, int k) {
    const surface *a = &f->seen.texels[i].hit, *b = &f->seen.texels[k].hit;
    return f->guides[i].valid && f->guides[k].valid && a->shape == b->shape &&
           (a->shape != GALLERY_FLOOR || tile_of(a) == tile_of(b));
}

static void show_weights(const settings *o) {
    static const subject what = {"brushed", scene_gallery, look_brushed, 0};
    const int width = o->size.width, height = o->size.height, target = height * 11 / 20 * width + width / 2;
    scene world = what.build();
    image sheet = image_create(2 * width, height);
    frame f;
    float *weights[2], jump[2] = {0, 0};
    int i, k;
    world.eye.target = lobe_vector(0, 0, 0.7f); /* closer to the floor */
    world.eye.field_of_view *= 0.6f;
    f = frame_of(&world, &what, width, height);
    for (k = 0; k < 2; k++) weights[k] = (float *)allocate("images", (size_t)(width * height), sizeof(float));
    for (i = 0; i < width * height; i++) {
        const asg_lobe a = f.guides[target].stretched, b = f.guides[i].stretched;
        if (!f.guides[target].valid || !f.guides[i].valid) continue;
        weights[0][i] = bilateral_asg_weight(a, b, 1);
        weights[1][i] = weight_by_cardano(&a, &b, 1);
        for (k = 0; k < 2; k++) {
            sheet.pixels[i / width * 2 * width + k * width + i % width] = as_grey(weights[k][i]);
            if (i % width > 0 && same_tile(&f, i, i - 1))
                jump[k] = lobe_max(jump[k], fabsf(weights[k][i] - weights[k][i - 1]));
            if (i >= width && same_tile(&f, i, i - width))
                jump[k] = lobe_max(jump[k], fabsf(weights[k][i] - weights[k][i - width]));
        }
    }
    printf(
        "\nWeights of a brushed pixel's neighbours, beta 1 (Fig. 19): the largest step between pixels side by side of\n"
        "one tile or ball is %.3f by Eq. 13, and %.3f with Cardano's formula in float\n\n",
        (double)jump[0], (double)jump[1]);
    write_picture(o->out, "-weights.png", &sheet,
                  "weights around a brushed pixel by Eq. 13, and with Cardano's formula");
    for (k = 0; k < 2; k++) free(weights[k]);
    image_free(&sheet);
    frame_free(&f);
}

/* ---- upsampling: one pixel of 4 x 4 is shaded a frame ---- */

enum { CELL = 4, FRAMES = CELL * CELL, MOST_SAMPLES = 16, MOVING_BALL = GALLERY_WALLS + 1 };
static const float upsampling_kappa = 100, normal_variance = 0.01f, lobe_beta = 20, least_weight = 0.25f;

/* Which pixel of a cell is shaded in each frame: every one once */
static const int shaded_column[FRAMES] = {1, 3, 0, 2, 3, 1, 2, 0, 0, 2, 1, 3, 2, 0, 3, 1};
static const int shaded_row[FRAMES] = {1, 3, 3, 1, 0, 2, 2, 0, 2, 0, 0, 2, 3, 1, 1, 3};

typedef struct {
    int lobes, temporal, adaptive; /* similarity of lobes, not of normals; with a history; recomputing */
    float parameter;
    image result, history;        /* of this frame and of the last */
    float *samples, *old_samples; /* total weight that a pixel's value is the mean of */
    int recomputed;
    double filter_ms, shade_ms;
} upsampler;

typedef struct {
    int width, height, column, row; /* and where in its cell each is */
    vec3 *colours;
} coarse;

static float likeness(const upsampler *u, const guide *i, float depth, const guide *j) {
    if (!j->valid) return 0;
    return bilateral_depth_weight(depth, j->depth, scene_depth_variance) *
           (u->lobes ? bilateral_sg_weight(i->lobe, j->lobe, u->parameter)
                     : bilateral_normal_weight(i->normal, j->normal, u->parameter));
}

/* The value by this frame's samples around, and their total weight */
static float upsample_pixel(const upsampler *u, const frame *f, const coarse *low, int x, int y, vec3 *colour) {
    const float column = (float)(x - low->column) / CELL, row = (float)(y - low->row) / CELL;
    const guide *g = &f->guides[y * f->width + x];
    float footprint[4], similarity[4], weight[4], total;
    int left, top, k;
    bilateral_footprint(lobe_max(0, lobe_min(column, (float)(low->width - 1))),
                        lobe_max(0, lobe_min(row, (float)(low->height - 1))), low->width, low->height, &left, &top,
                        footprint);
    for (k = 0; k < 4; k++) {
        const int i = left + (k & 1), j = top + (k >> 1);
        similarity[k] = 0;
        if (footprint[k] > 0)
            similarity[k] =
                likeness(u, g, g->depth, &f->guides[(j * CELL + low->row) * f->width + i * CELL + low->column]);
    }
    total = bilateral_footprint_weights(footprint, similarity, weight);
    *colour = lobe_vector(0, 0, 0);
    for (k = 0; k < 4; k++) {
        if (weight[k] > 0)
            *colour =
                lobe_add(*colour, lobe_scale(low->colours[(top + (k >> 1)) * low->width + left + (k & 1)], weight[k]));
    }
    return total;
}

/* Where a point of the scene is in the image */
static void project(const frame *f, vec3 point, float *x, float *y, float *distance) {
    const camera *eye = &f->world.eye;
    const vec3 forward = vec3_normalize(lobe_sub(eye->target, eye->position)), d = lobe_sub(point, eye->position);
    const float scale = 0.5f * (float)f->height / (tanf(0.5f * eye->field_of_view) * lobe_dot(d, forward));
    vec3 right, up;
    scene_frame(forward, &right, &up);
    *x = 0.5f * (float)f->width - 0.5f + scale * lobe_dot(d, right);
    *y = 0.5f * (float)f->height - 0.5f - scale * lobe_dot(d, up);
    *distance = vec3_length(d);
}

/* The value that the last frame has for what is seen here, and the samples that it is the mean of */
static float recall_pixel(const upsampler *u, const frame *f, const frame *last, vec3 motion, int index, vec3 *colour) {
    const surface *hit = &f->seen.texels[index].hit;
    const vec3 before = hit->shape == MOVING_BALL ? lobe_sub(hit->position, motion) : hit->position;
    float x, y, distance, footprint[4], similarity[4], weight[4], total, samples = 0;
    int left, top, k;
    project(last, before, &x, &y, &distance);
    bilateral_footprint(x, y, f->width, f->height, &left, &top, footprint);
    for (k = 0; k < 4; k++) {
        similarity[k] = 0;
        if (footprint[k] > 0.001f) /* not by rounding of the place */
            similarity[k] =
                likeness(u, &f->guides[index], distance, &last->guides[(top + (k >> 1)) * f->width + left + (k & 1)]);
    }
    total = bilateral_footprint_weights(footprint, similarity, weight);
    *colour = lobe_vector(0, 0, 0);
    for (k = 0; k < 4; k++) {
        const int at = (top + (k >> 1)) * f->width + left + (k & 1);
        if (!(weight[k] > 0)) continue;
        *colour = lobe_add(*colour, lobe_scale(u->history.pixels[at], weight[k]));
        samples += weight[k] * u->old_samples[at];
    }
    return total * lobe_min(samples, MOST_SAMPLES);
}

/* How much a frame's value counts at a pixel: that of pixels near a shaded one is better. */
static float nearness(const coarse *low, int x, int y) {
    int dx = (x - low->column + CELL) % CELL, dy = (y - low->row + CELL) % CELL;
    dx = dx > CELL / 2 ? CELL - dx : dx;
    dy = dy > CELL / 2 ? CELL - dy : dy;
    return lobe_exp(-(float)(dx * dx + dy * dy));
}

/* One frame of one upsampler: Eq. 1 over samples near in space and, by the history, in time */
static void upsample(upsampler *u, const frame *f, const frame *last, vec3 motion, const coarse *low, int reference,
                     unsigned seed) {
    const image swapped = u->history;
    float *const samples = u->old_samples;
    char *poor = (char *)allocate("images", (size_t)(f->width * f->height), 1);
    double started = progress_clock();
    int row, i;
    u->history = u->result;
    u->result = swapped;
    u->old_samples = u->samples;
    u->samples = samples;
    PARALLEL_FOR
    for (row = 0; row < f->height; row++) {
        int x;
        for (x = 0; x < f->width; x++) {
            const int at = row * f->width + x;
            vec3 now, old = {0, 0, 0};
            float total, share, recalled = 0;
            if (!f->guides[at].valid) {
                u->result.pixels[at] = shade_pixel(f, at, 1, seed, 1); /* a wall, as it is */
                continue;
            }
            total = upsample_pixel(u, f, low, x, row, &now);
            if (u->temporal && last) recalled = recall_pixel(u, f, last, motion, at, &old);
            poor[at] = total + recalled < least_weight;
            total *= u->temporal ? nearness(low, x, row) : 1;
            share = recalled / lobe_max(recalled + total, 1e-20f);
            u->result.pixels[at] = lobe_add(lobe_scale(old, share), lobe_scale(now, 1 - share));
            u->samples[at] = recalled + total;
        }
    }
    u->filter_ms = progress_clock() - started;
    u->recomputed = 0;
    started = progress_clock();
    if (u->adaptive) {
        PARALLEL_FOR
        for (row = 0; row < f->height; row++) {
            int at;
            for (at = row * f->width; at < (row + 1) * f->width; at++) {
                if (!poor[at]) continue;
                u->result.pixels[at] = shade_pixel(f, at, reference, seed, 1);
                u->samples[at] = 1;
            }
        }
    }
    u->shade_ms = progress_clock() - started;
    for (i = 0; i < f->width * f->height; i++) u->recomputed += poor[i];
    free(poor);
}

static void shade_coarse(const frame *f, coarse *low, int number, int reference, unsigned seed) {
    int row;
    low->column = shaded_column[number];
    low->row = shaded_row[number];
    PARALLEL_FOR
    for (row = 0; row < low->height; row++) {
        int x;
        for (x = 0; x < low->width; x++)
            low->colours[row * low->width + x] =
                shade_pixel(f, (row * CELL + low->row) * f->width + x * CELL + low->column, reference, seed, 1);
    }
}

/* What parameters would have been best in space alone: the first two upsamplers' */
static void find_upsampling_best(const upsampler *first, const frame *f, const coarse *low, const truth *wanted,
                                 unsigned seed) {
    const vec3 still = {0, 0, 0};
    int k;
    printf("\nIn space alone, at the best parameter:");
    for (k = 0; k < 2; k++) {
        const method_data *d = &methods[k ? EQ12 : NORMAL];
        upsampler u = first[k];
        double least = 1e300;
        float power, best = 0;
        u.result = image_create(f->width, f->height);
        u.history = image_create(f->width, f->height);
        for (power = d->low[0]; power <= d->high[0]; power += 1) {
            double error;
            u.parameter = exp2f(power);
            upsample(&u, f, NULL, still, low, 1, seed);
            error = error_of(f, &u.result, wanted);
            if (error < least) {
                least = error;
                best = u.parameter;
            }
        }
        printf(" %s %.5f at %s %.3g%s", k ? "lobes" : "normals", least, d->parameter, (double)best, k ? "\n" : ",");
        image_free(&u.result);
        image_free(&u.history);
    }
}

enum { UPSAMPLERS = 8 };

static void show_upsampling(const settings *o) {
    static const subject what = {"upsampling", scene_gallery, look_tiles, 0};
    const int width = o->size.width, height = o->size.height;
    const vec3 motion = {0.025f, 0, 0.01f}; /* of the ball in the middle, a frame */
    const unsigned seed = (unsigned)o->seed + 7;
    upsampler u[UPSAMPLERS];
    image sheet = image_create(SHEET_COLUMNS * width, 2 * height);
    progress line = progress_begin("upsampling", FRAMES);
    double coarse_ms = 0, full_ms, count = 0;
    frame f, last;
    coarse low;
    truth wanted;
    int number, k, i;
    low.width = width / CELL;
    low.height = height / CELL;
    low.colours = (vec3 *)allocate("images", (size_t)(low.width * low.height), sizeof *low.colours);
    memset(u, 0, sizeof u);
    for (k = 0; k < UPSAMPLERS; k++) {
        u[k].lobes = k & 1;
        u[k].temporal = k >> 1 & 1;
        u[k].adaptive = k >> 2;
        u[k].parameter = u[k].lobes ? lobe_beta : normal_variance;
        u[k].result = image_create(width, height);
        u[k].history = image_create(width, height);
        u[k].samples = (float *)allocate("images", (size_t)(width * height), sizeof(float));
        u[k].old_samples = (float *)allocate("images", (size_t)(width * height), sizeof(float));
    }
    for (number = 0; number < FRAMES; number++) {
        scene world = what.build();
        double started;
        shape *ball = &world.shapes[MOVING_BALL];
        ball->center = lobe_add(ball->center, lobe_scale(motion, (float)(number - FRAMES / 2)));
        if (number > 0) last = f;
        f = frame_of(&world, &what, width, height);
        for (i = 0; i < width * height; i++) {
            if (f.guides[i].valid) f.guides[i].lobe = sg_convolve(f.guides[i].lobe, upsampling_kappa);
        }
        started = progress_clock();
        shade_coarse(&f, &low, number, o->reference, seed);
        coarse_ms = progress_clock() - started;
        for (k = 0; k < UPSAMPLERS; k++) {
            if (u[k].temporal || number == FRAMES - 1)
                upsample(&u[k], &f, number > 0 ? &last : NULL, motion, &low, o->reference, seed);
        }
        if (number > 0) frame_free(&last);
        progress_step(&line);
    }
    full_ms = progress_clock();
    wanted = truth_of(&f, 2 * o->reference, seed, "upsampling");
    full_ms = 0.5 * (progress_clock() - full_ms);
    progress_end(&line);
    for (i = 0; i < width * height; i++) count += f.guides[i].valid;
    printf(
        "\nUpsampling of one shaded pixel in 4 x 4, frame %d of a scene with a moving ball; normals: variance %g, "
        "lobes:\n"
        "beta %g, kappa %g; recomputed where the total weight is below %g. Milliseconds by all threads; shading all\n"
        "pixels takes %.0f ms.\n\n%-34s%10s%12s%10s%12s%10s\n",
        FRAMES, (double)normal_variance, (double)lobe_beta, (double)upsampling_kappa, (double)least_weight, full_ms, "",
        "MSE", "poor or", "weights", "shading", "total");
    printf("%-34s%10s%12s%10s%12s%10s\n", "", "", "recomputed", "ms", "ms", "ms");
    for (k = 0; k < UPSAMPLERS; k++) {
        printf("%-9s%-16s%-9s%10.5f%10.2f %%%10.2f%12.1f%10.1f\n", u[k].lobes ? "lobes," : "normals,",
               u[k].temporal ? "space and time" : "space", u[k].adaptive ? " anew" : "",
               error_of(&f, &u[k].result, &wanted), 100 * u[k].recomputed / count, u[k].filter_ms,
               coarse_ms + u[k].shade_ms, u[k].filter_ms + coarse_ms + u[k].shade_ms);
    }
    find_upsampling_best(u, &f, &low, &wanted, seed);
    for (k = 0; k < SHEET_COLUMNS - 1; k++) {
        static const int columns[SHEET_COLUMNS - 1] = {0, 1, 3, 7};
        paste_with_difference(&f, &sheet, &u[columns[k]].result, &wanted.mean, k);
    }
    image_paste(&sheet, &wanted.mean, (SHEET_COLUMNS - 1) * width, 0);
    printf("\n");
    write_picture(o->out, "-upsampling.png", &sheet,
                  "by normals; by lobes; in time too; and anew where poor; reference; errors below");
    for (k = 0; k < UPSAMPLERS; k++) {
        image_free(&u[k].result);
        image_free(&u[k].history);
        free(u[k].samples);
        free(u[k].old_samples);
    }
    frame_free(&f);
    truth_free(&wanted);
    image_free(&sheet);
    free(low.colours);
}

/* ---- buffers of a user's ---- */

static void refuse_texel(const char *path, int x, int y, const char *why) {
    char text[128];
    snprintf(text, sizeof text, "at column %d of row %d from the top %s", x, y, why);
    give_up(path, text);
}

/* Values of a file that must have so many channels and be of the first one's size */
static raster read_buffer(const char *path, int channels, const raster *like) {
    raster r;
    const char *wrong = raster_read(path, &r);
    if (wrong) give_up(path, wrong);
    if (r.channels != channels)
        give_up(path, channels == 1 ? "it has three channels, not one" : "it has one channel, not three");
    if (r.width > SIDE_LIMIT || r.height > SIDE_LIMIT) give_up(path, "it is wider or higher than 16384");
    if (like && (r.width != like->width || r.height != like->height)) give_up(path, "its size is not that of --color");
    return r;
}

static vec3 texel_of(const raster *r, int i) {
    const float *v = r->values + 3 * (size_t)i;
    return lobe_vector(v[0], v[1], v[2]);
}

static int is_within(vec3 v, float limit) {
    return raster_in_range(v.x, -limit, limit) && raster_in_range(v.y, -limit, limit) &&
           raster_in_range(v.z, -limit, limit);
}

/* In the camera's frame: x to the right, y up, z towards the viewer. A depth of 0: nothing there. */
static void read_guides(const settings *o, const raster *depth, const raster *normals, const raster *alphas,
                        guide *guides) {
    const float tangent = tanf(0.5f * o->field_of_view * LOBE_PI / 180), width = (float)depth->width,
                height = (float)depth->height;
    int x, y;
    for (y = 0; y < depth->height; y++) {
        for (x = 0; x < depth->width; x++) {
            const int i = y * depth->width + x;
            const float z = depth->values[i], alpha = alphas->values[i];
            vec3 n = texel_of(normals, i), view, unused;
            glossy look;
            if (!raster_in_range(z, 0, 1e9f)) refuse_texel(o->depth, x, y, "it is not from 0 to 1e9");
            if (!raster_in_range(alpha, 0, 1)) refuse_texel(o->alpha, x, y, "it is not from 0 to 1");
            if (!is_within(n, 1e6f)) refuse_texel(o->normal, x, y, "it is not a normal");
            if (!(z > 0)) continue;
            if (!(lobe_dot(n, n) > 1e-6f)) refuse_texel(o->normal, x, y, "its length is 0");
            n = vec3_normalize(n);
            view = vec3_normalize(lobe_vector((1 - (2 * (float)x + 1) / width) * tangent * width / height,
                                              ((2 * (float)y + 1) / height - 1) * tangent, 1));
            look = one_lobe(GLOSSY_GGX, lobe_max(alpha, 1e-3f), lobe_max(alpha, 1e-3f));
            lobe_frame(n, &look.tangent, &unused);
            guides[i] = guide_of(&look, n, view, z);
        }
    }
}

static void write_raster(const char *prefix, const image *picture) {
    char path[OUTPUT_NAME];
    const char *wrong;
    raster r;
    int i;
    output_name(path, prefix, ".pfm");
    r.width = picture->width;
    r.height = picture->height;
    r.channels = 3;
    r.values = (float *)allocate("images", (size_t)r.width * (size_t)r.height, 3 * sizeof *r.values);
    for (i = 0; i < r.width * r.height; i++) {
        r.values[3 * (size_t)i] = picture->pixels[i].x;
        r.values[3 * (size_t)i + 1] = picture->pixels[i].y;
        r.values[3 * (size_t)i + 2] = picture->pixels[i].z;
    }
    wrong = raster_write(path, &r);
    free(r.values);
    if (wrong) give_up(path, wrong);
    printf("wrote %s\n", path);
}

/* Eq. 12, of GGX lobes */
static void filter_buffers(const settings *o) {
    raster color, depth, normals, alphas;
    image noisy, result;
    guide *guides;
    planes room;
    progress line;
    int i, row;
    if (!o->color || !o->depth || !o->normal || !o->alpha)
        give_up("buffers", "--color, --depth, --normal and --alpha are needed together");
    output_check(o->out, ".pfm");
    output_check(o->out, ".png");
    color = read_buffer(o->color, 3, NULL);
    depth = read_buffer(o->depth, 1, &color);
    normals = read_buffer(o->normal, 3, &color);
    alphas = read_buffer(o->alpha, 1, &color);
    noisy = image_create(color.width, color.height);
    for (i = 0; i < color.width * color.height; i++) {
        noisy.pixels[i] = texel_of(&color, i);
        if (!is_within(noisy.pixels[i], 1e30f))
            refuse_texel(o->color, i % color.width, i / color.width, "it is not a number up to 1e30");
    }
    guides = (guide *)allocate("images", (size_t)color.width * (size_t)color.height, sizeof *guides);
    read_guides(o, &depth, &normals, &alphas, guides);
    free(color.values);
    free(depth.values);
    free(normals.values);
    free(alphas.values);
    room = planes_create(noisy.width, noisy.height, 1);
    result = image_create(noisy.width, noisy.height);
    fill_colours(&room, &noisy);
    fill_planes(&room, guides, EQ12, &o->beta, o->depth_variance);
    line = progress_begin("filter", noisy.height);
    PARALLEL_FOR
    for (row = 0; row < noisy.height; row++) {
        filter_row(&room, EQ12, &o->beta, row, &result);
        progress_step(&line);
    }
    progress_end(&line);
    write_raster(o->out, &result);
    write_picture(o->out, ".png", &result, "the same, as it looks");
    free(guides);
    free(room.memory);
    image_free(&noisy);
    image_free(&result);
}

static void check_study_files(const char *prefix) {
    static const char *const rests[] = {"-similarity.csv", "-normals.csv", "-lobes.csv", "-weights.png",
                                        "-upsampling.png"};
    char rest[64];
    int i;
    for (i = 0; i < (int)(sizeof rests / sizeof *rests); i++) output_check(prefix, rests[i]);
    for (i = 0; i < SCENES; i++) {
        snprintf(rest, sizeof rest, "-%s.png", scenes[i].what.name);
        output_check(prefix, rest);
    }
}

int main(int argc, char **argv) {
    settings o = {{256, 192}, 8, 256, 0, "build/lobe_filter", NULL, NULL, NULL, NULL, 45, 8, 0.1f};
    const option options[] = {
        OPTION_OF_SIZE(&o.size),
        {"--samples N", OPTION_WHOLE, &o.samples, 1, 4096, "paths a pixel of what is filtered", 0},
        {"--reference N", OPTION_WHOLE, &o.reference, 2, 65536, "paths a pixel of what that should be", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {"--color FILE", OPTION_TEXT, &o.color, 0, 0,
         "PFM of yours to filter instead of all that, by Eq. 12: noisy light, reflectance divided out", 0},
        {"--depth FILE", OPTION_TEXT, &o.depth, 0, 0, "its depths, one channel; 0: nothing there", 0},
        {"--normal FILE", OPTION_TEXT, &o.normal, 0, 0, "its normals: x to the right, y up, z to the viewer", 0},
        {"--alpha FILE", OPTION_TEXT, &o.alpha, 0, 0, "its GGX roughness, one channel", 0},
        {"--fov DEGREES", OPTION_REAL, &o.field_of_view, 1, 170, "vertical field of view of yours", 0},
        {"--beta X", OPTION_REAL, &o.beta, 1e-3, 1e3, "how like lobes must be in yours", 0},
        {"--depth-variance X", OPTION_REAL, &o.depth_variance, 1e-9, 1e9, "how like depths must be in yours", 0},
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    float shared[2];
    int i;
    options_read(options, argc, argv,
                 "Filters and upsamples noisy glossy light by weights that know the reflection lobes and by others,\n"
                 "and prints how far each is from what it should be, and how long it takes.");
    if (o.color || o.depth || o.normal || o.alpha) {
        filter_buffers(&o);
        return 0;
    }
    check_study_files(o.out);
    printf("%dx%d pixels, %d paths each, %d for the reference; filters of %dx%d pixels. Errors are mean squares over\n"
           "what is glossy; times are the medians of %d turns on one core, preparation included.\n",
           o.size.width, o.size.height, o.samples, o.reference, 2 * RADIUS + 1, 2 * RADIUS + 1, ROUNDS);
    compare_similarities(&o);
    compare_materials(&o, shared);
    for (i = 0; i < SCENES; i++) show_scene(&o, &scenes[i], shared);
    show_weights(&o);
    show_upsampling(&o);
    return 0;
}
