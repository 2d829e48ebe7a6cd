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
#include "common/image.h"
#include "common/options.h"
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

/* Three lobes each: a clear coat in two thicknesses */
static glossy look_layers(const surface *hit, int which) {
    const int coated = hit->shape == GALLERY_FLOOR ? tile_of(hit) : band_of(hit, 8) & 1;
    (void)which;
    return coated ? three_lobes(3000, 200, 12, 0.6f, 0.3f) : three_lobes(3000, 200, 12, 0.1f, 0.3f);
}

/* One of three exponents, or all three in bands */
static glossy look_phong(const surface *hit, int which) {
    static const float exponents[] = {10, 100, 1000};
    const float e = exponents[which < 3 ? which : (band_of(hit, 9) + hit->shape) % 3];
    return one_lobe(GLOSSY_PHONG, e, e);
}

static glossy look_mixture(const surface *hit, int which) {
    static const float lobes[3][5] = {
        {60, 15, 4, 0.5f, 0.3f}, {600, 100, 12, 0.5f, 0.3f}, {6000, 700, 60, 0.5f, 0.3f}};
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

static unsigned mix(unsigned x) {
    x = (x ^ (x >> 16)) * 0x7FEB352Du;
    x = (x ^ (x >> 15)) * 0x846CA68Bu;
    return x ^ (x >> 16);
}

/* Four uniform numbers below 1: at random, or evenly spread over a pixel's draws (Roberts 2018) for the reference */
static void draw(unsigned pixel, unsigned number, unsigned seed, int even, float u[4]) {
    static const double steps[4] = {0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};
    unsigned k;
    for (k = 0; k < 4; k++) {
        double x = (double)mix(mix(pixel * 0x9E3779B1u + seed) + (even ? 0 : number * 0x85EBCA77u) + k * 0xC2B2AE3Du);
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

static image create(int width, int height) {
    image picture = image_create(width, height);
    if (!picture.pixels) give_up("images", "not enough memory");
    return picture;
}

static frame frame_of(const scene *world, const subject *what, int width, int height) {
    frame f;
    int i;
    f.world = *world;
    f.width = width;
    f.height = height;
    f.seen = buffer_camera(world, width, height);
    if (!f.seen.texels) give_up("images", "not enough memory");
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
    image result = create(f->width, f->height);
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
    int parameters;    /* 0 to 2; searched by powers of two: */
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

enum {
    RED, GREEN, BLUE, VALID, DEPTH,
    NORMAL_X, NORMAL_Y, NORMAL_Z, ALPHA, LIMIT,
    AXIS_X = NORMAL_X, AXIS_Y, AXIS_Z, WIDTH,
    PART = NORMAL_X, PART_PLANES = 6,
    STRETCHED = NORMAL_X, STRETCHED_PLANES = 13,
    PLANES = PART + GLOSSY_LOBES * PART_PLANES
};

typedef struct {
    int width, height, stride, parts;
    float *memory, *plane[PLANES]; /* at the first pixel: the border is before it */
} planes;

static planes planes_create(int width, int height) {
    planes p;
    size_t size;
    int k;
    p.width = width;
    p.height = height;
    p.stride = width + 2 * RADIUS;
    p.parts = 1;
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

static void fill_planes(planes *p, const guide *guides, method m, const float *parameter, float depth_variance) {
    const float depth_scale = bilateral_scale(depth_variance);
    int row, k;
    p->parts = 1;
    for (k = 0; k < p->width * p->height; k++) p->parts = guides[k].parts_count > p->parts ? guides[k].parts_count : p->parts;
    PARALLEL_FOR
    for (row = -RADIUS; row < p->height + RADIUS; row++) {
        guide outside;
        int column;
        memset(&outside, 0, sizeof outside);
        lobe_frame(lobe_vector(0, 0, 1), &outside.stretched.x, &outside.stretched.y);
        outside.stretched.z = lobe_vector(0, 0, 1);
        outside.stretched.sharpness_x = outside.stretched.sharpness_y = 1;
        for (column = -RADIUS; column < p->width + RADIUS; column++) {
            const ptrdiff_t at = (ptrdiff_t)row * p->stride + column;
            const int inside = row >= 0 && row < p->height && column >= 0 && column < p->width;
            const guide *g = inside && guides[row * p->width + column].valid ? &guides[row * p->width + column] : &outside;
            p->plane[VALID][at] = g->valid ? 1 : 0;
            p->plane[DEPTH][at] = g->depth * depth_scale;
            put_guide(p, at, g, m, parameter);
        }
    }
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

static inline bilateral_sg narrow_at(const planes *p, ptrdiff_t at) {
    bilateral_sg g;
    g.axis = vector_at(p, AXIS_X, at);
    g.width = p->plane[WIDTH][at];
    return g;
}

static void weigh_lobes(const planes *all, const tap_row *row, float beta, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    int x;
    for (x = 0; x < t.count; x++)
        weight[x] = bilateral_sg_tap(depth_exponent(&p, &t, x), narrow_at(&p, t.i + x), narrow_at(&p, t.j + x), beta);
}

/* Eq. 11 and Eq. 13, where the library runs along the row: log2 of the rest goes in, the weight comes out */
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
    if (m == EQ11)
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
        weigh_lobes(p, row, parameter[0], weight);
        break;
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

/* One noisy image, what it should be, and room for filtering it */
typedef struct {
    frame f;
    image noisy, wanted, result;
    planes room;
} study;

static void study_begin(study *s, const subject *what, int width, int height, int samples, int reference,
                        unsigned seed) {
    const scene world = what->build();
    s->f = frame_of(&world, what, width, height);
    s->noisy = shade_frame(&s->f, samples, seed, 0, what->name);
    s->wanted = shade_frame(&s->f, reference, seed + 1, 1, what->name);
    s->result = create(width, height);
    s->room = planes_create(width, height);
    fill_colours(&s->room, &s->noisy);
}

static void study_end(study *s) {
    frame_free(&s->f);
    image_free(&s->noisy);
    image_free(&s->wanted);
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
static double error_of(const frame *f, const image *got, const image *wanted) {
    double sum = 0;
    long count = 0;
    int i;
    for (i = 0; i < f->width * f->height; i++) {
        vec3 d;
        if (!f->guides[i].valid) continue;
        d = lobe_sub(got->pixels[i], wanted->pixels[i]);
        sum += (double)lobe_dot(d, d);
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
int main(int argc, char**argv){
  subject what[]={{"tiles",scene_gallery,look_tiles,0},{"models",scene_gallery,look_models,0},{"brushed",scene_gallery,look_brushed,0},{"layers",scene_gallery,look_layers,0},{"spheres",scene_spheres,look_phong,3}};
  int k,m;
  for(k=0;k<5;k++){
    study s; char path[100]; progress line=progress_begin("x",METHODS);
    double t=progress_clock();
    study_begin(&s,&what[k],256,192,8,256,0);
    printf("%s trace %g ms\n",what[k].name,progress_clock()-t);
    sprintf(path,"/tmp/lobe/%s-n.png",what[k].name); image_write_png(path,&s.noisy,1);
    sprintf(path,"/tmp/lobe/%s-w.png",what[k].name); image_write_png(path,&s.wanted,1);
    for(m=0;m<METHODS;m++){ float p[2]; double e; int row; t=progress_clock(); e=search(&s,(method)m,2,p,&line);
      printf("%-20s %g  %g %g  search %g ms",methods[m].name,e,(double)p[0],(double)p[1],progress_clock()-t);
      t=progress_clock(); for(row=0;row<192;row++) filter_row(&s.room,(method)m,p,row,&s.result);
      t=progress_clock()-t; printf("  %g ms %g ns/tap\n",t,t*1e6/(256*192*289.));
    sprintf(path,"/tmp/lobe/%s-%d.png",what[k].name,m); image_write_png(path,&s.result,1);
    }
    study_end(&s);
  }
  (void)argc;(void)argv; return 0;
}
