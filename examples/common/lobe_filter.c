#include "lobe_filter.h"
#include "fail.h"
#include "parallel.h"
#include <stdlib.h>

/* ---- what filters know of a pixel ---- */

static sg_lobe with_share(sg_lobe g, float share) {
    g = sg_normalize(g);
    g.log_amplitude += lobe_log(lobe_max(share, 1e-6f));
    return g;
}

guide filter_guide_of(const glossy *look, vec3 normal, vec3 view, float depth) {
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

/* ---- filters: guides as planes with a border, so that the loops over them become vector code ---- */

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

struct filter_planes {
    int width, height, stride, radius;
    int parts;                     /* most lobes of a pixel */
    float *memory, *plane[PLANES]; /* at the first pixel: the border is before it */
};

typedef filter_planes planes;

filter_planes *filter_planes_create(int width, int height, int radius, int parts) {
    planes *p = (planes *)allocate("images", 1, sizeof *p);
    size_t size;
    int k;
    p->width = width;
    p->height = height;
    p->radius = radius;
    p->stride = width + 2 * radius;
    p->parts = parts;
    size = (size_t)p->stride * (size_t)(height + 2 * radius);
    p->memory = (float *)allocate("images", size, PLANES * sizeof *p->memory);
    for (k = 0; k < PLANES; k++) p->plane[k] = p->memory + (size_t)k * size + (size_t)radius * (size_t)(p->stride + 1);
    return p;
}

void filter_planes_free(filter_planes *p) {
    free(p->memory);
    free(p);
}

int filter_most_parts(const guide *guides, int count) {
    int i, most = 1;
    for (i = 0; i < count; i++) most = guides[i].parts_count > most ? guides[i].parts_count : most;
    return most;
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

/* Every plane gets numbers that the loops can take, outside of what is valid too */
static void put_guide(const planes *p, ptrdiff_t at, const guide *g, filter_method m, const float *parameter) {
    bilateral_sg_part parts[GLOSSY_LOBES];
    bilateral_sg narrow;
    bilateral_asg stretched;
    int k;
    switch (m) {
    case FILTER_NORMAL:
    case FILTER_BANDLIMIT:
    case FILTER_ALPHA_GUIDE:
        put_vector(p, NORMAL_X, at, lobe_scale(g->normal, bilateral_scale(parameter[0])));
        p->plane[ALPHA][at] = m == FILTER_ALPHA_GUIDE ? g->alpha * bilateral_scale(parameter[1]) : 0;
        /* log2 of a Gaussian in squared pixels, whose deviation is parameter / sqrt(sharpness) */
        p->plane[LIMIT][at] =
            m == FILTER_BANDLIMIT ? 0.5f * LOBE_LOG2E * g->half_sharpness / (parameter[1] * parameter[1]) : 0;
        break;
    case FILTER_EQ12:
        narrow = bilateral_sg_prepare(g->valid ? g->lobe : blank_lobe(), parameter[0]);
        put_vector(p, AXIS_X, at, narrow.axis);
        p->plane[WIDTH][at] = narrow.width;
        break;
    case FILTER_EQ11:
        for (k = 0; k < GLOSSY_LOBES; k++) { /* missing ones are empty */
            sg_lobe blank = blank_lobe();
            bilateral_sg_mixture_prepare(&blank, 1, &parts[k]);
            parts[k].amplitude = 0;
        }
        if (g->valid) bilateral_sg_mixture_prepare(g->parts, g->parts_count, parts);
        for (k = 0; k < GLOSSY_LOBES; k++) put_part(p, k, at, &parts[k]);
        break;
    case FILTER_EQ13:
        stretched = bilateral_asg_prepare(g->stretched);
        put_stretched(p, at, &stretched);
        break;
    case FILTER_UNFILTERED:
    case FILTER_METHODS:
        break;
    }
}

void filter_fill_row(const planes *p, const guide *guides, filter_method m, const float *parameter, float depth_scale,
                     int row) {
    guide outside;
    int column;
    memset(&outside, 0, sizeof outside);
    lobe_frame(lobe_vector(0, 0, 1), &outside.stretched.x, &outside.stretched.y);
    outside.stretched.z = lobe_vector(0, 0, 1);
    outside.stretched.sharpness_x = outside.stretched.sharpness_y = 1;
    for (column = -p->radius; column < p->width + p->radius; column++) {
        const ptrdiff_t at = (ptrdiff_t)row * p->stride + column;
        const int inside = row >= 0 && row < p->height && column >= 0 && column < p->width;
        const guide *g = inside ? &guides[(ptrdiff_t)row * p->width + column] : &outside;
        g = g->valid ? g : &outside;
        p->plane[VALID][at] = g->valid ? 1 : 0;
        p->plane[DEPTH][at] = g->depth * depth_scale;
        put_guide(p, at, g, m, parameter);
    }
}

void filter_fill_planes(const planes *p, const guide *guides, filter_method m, const float *parameter,
                        float depth_variance) {
    const float depth_scale = bilateral_scale(depth_variance);
    int row;
    PARALLEL_FOR
    for (row = -p->radius; row < p->height + p->radius; row++)
        filter_fill_row(p, guides, m, parameter, depth_scale, row);
}

void filter_fill_colours(planes *p, const image *noisy) {
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
static void weigh_planes(const planes *all, const tap_row *row, filter_method m, float beta, float *restrict weight) {
    const planes p = *all;
    const tap_row t = *row;
    const float *i[PLANES], *j[PLANES];
    int x, k;
    for (x = 0; x < t.count; x++) weight[x] = depth_exponent(&p, &t, x);
    for (k = 0; k < PLANES; k++) {
        i[k] = p.plane[k] + t.i;
        j[k] = p.plane[k] + t.j;
    }
    if (m == FILTER_EQ12)
        bilateral_sg_taps(t.count, i + AXIS_X, j + AXIS_X, beta, weight);
    else if (m == FILTER_EQ11)
        bilateral_sg_mixture_taps(t.count, p.parts, i + PART, j + PART, beta, weight);
    else
        bilateral_asg_taps(t.count, i + STRETCHED, j + STRETCHED, beta, weight);
}

static void weigh(const planes *p, const tap_row *row, filter_method m, const float *parameter, float *weight) {
    switch (m) {
    case FILTER_NORMAL:
        weigh_normals(p, row, weight);
        break;
    case FILTER_BANDLIMIT:
        weigh_normals_near(p, row, weight);
        break;
    case FILTER_ALPHA_GUIDE:
        weigh_normals_and_alpha(p, row, weight);
        break;
    case FILTER_EQ12:
    case FILTER_EQ11:
    case FILTER_EQ13:
        weigh_planes(p, row, m, parameter[0], weight);
        break;
    case FILTER_UNFILTERED:
    case FILTER_METHODS:
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

void filter_row(const planes *p, filter_method m, const float *parameter, int row, image *result) {
    int first, x, y, k;
    for (first = 0; first < p->width; first += BLOCK) {
        float weight[BLOCK], sum[4][BLOCK];
        tap_row t;
        t.i = (ptrdiff_t)row * p->stride + first;
        t.count = p->width - first < BLOCK ? p->width - first : BLOCK;
        memset(sum, 0, sizeof sum);
        for (y = -p->radius; y <= p->radius && m != FILTER_UNFILTERED; y++) {
            for (x = -p->radius; x <= p->radius; x++) {
                t.j = t.i + (ptrdiff_t)y * p->stride + x;
                t.squared = (float)(x * x + y * y);
                t.exponent = -0.5f * LOBE_LOG2E / filter_kernel_variance(p->radius) * t.squared;
                weigh(p, &t, m, parameter, weight);
                gather(p, &t, weight, sum[0], sum[1], sum[2], sum[3]);
            }
        }
        for (k = 0; k < t.count; k++) {
            vec3 *to = &result->pixels[row * p->width + first + k];
            if (m != FILTER_UNFILTERED && p->plane[VALID][t.i + k] > 0)
                *to = lobe_scale(lobe_vector(sum[0][k], sum[1][k], sum[2][k]), 1 / sum[3][k]);
            else
                *to = vector_at(p, RED, t.i + k);
        }
    }
}

void filter_frame(const planes *p, const guide *guides, filter_method m, const float *parameter, float depth_variance,
                  image *result) {
    int row;
    filter_fill_planes(p, guides, m, parameter, depth_variance);
    PARALLEL_FOR
    for (row = 0; row < p->height; row++) filter_row(p, m, parameter, row, result);
}

/* ---- upsampling ---- */

float upsample_likeness(filter_method m, float parameter, const guide *i, float depth, const guide *j) {
    float alike;
    if (!j->valid) return 0;
    alike = bilateral_depth_weight(depth, j->depth, filter_depth_variance);
    if (m == FILTER_EQ12) return alike * bilateral_sg_weight(i->lobe, j->lobe, parameter);
    if (m == FILTER_EQ13) return alike * bilateral_asg_weight(i->stretched, j->stretched, parameter);
    return alike * bilateral_normal_weight(i->normal, j->normal, parameter);
}

float upsample_pixel(filter_method m, float parameter, const guide *guides, int width, const coarse *low, int x, int y,
                     vec3 *colour) {
    const float column = (float)(x - low->column) / UPSAMPLE_CELL, row = (float)(y - low->row) / UPSAMPLE_CELL;
    const guide *g = &guides[y * width + x];
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
                upsample_likeness(m, parameter, g, g->depth,
                                  &guides[(j * UPSAMPLE_CELL + low->row) * width + i * UPSAMPLE_CELL + low->column]);
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
