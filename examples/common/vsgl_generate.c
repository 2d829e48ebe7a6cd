#include "vsgl_generate.h"
#include "fail.h"
#include "progress.h"
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = sizeof(vsgl_moments) / sizeof(float), BISECTIONS = 12, BLOCK = 32 };

/* clang would make gathers and scatters of them, which take twice as long. */
#ifdef __clang__
#define LOOP_BETWEEN_PLANES _Pragma("clang loop vectorize(disable)")
#else
#define LOOP_BETWEEN_PLANES
#endif

const char *const method_names[METHODS + 1] = {"nearest",  "density",  "bisection", "fast", "split",
                                               "kmeans2d", "kmeans3d", "transform", NULL};

generator generator_create(int width, int height, int most) {
    const size_t texels = (size_t)width * (size_t)height, lights = (size_t)most;
    generator g;
    g.moments = (float *)allocate("generation", fis_pyramid_size(width, height, CHANNELS), sizeof *g.moments);
    g.pdf = (float *)allocate("generation", fis_pyramid_size(width, height, 1), sizeof *g.pdf);
    g.table = (double *)allocate("generation", fis_split_size(width, height), sizeof *g.table);
    g.scratch = (double *)allocate("generation", 3 * (size_t)width, sizeof *g.scratch);
    g.labels = (int *)allocate("generation", texels, sizeof *g.labels);
    g.order = (int *)allocate("generation", texels, sizeof *g.order);
    g.begins = (int *)allocate("generation", lights + 1, sizeof *g.begins);
    g.columns = (int *)allocate("generation", lights, sizeof *g.columns);
    g.rows = (int *)allocate("generation", lights, sizeof *g.rows);
    g.centers = (kmeans_center *)allocate("generation", lights, sizeof *g.centers);
    g.nodes = (kmeans_node *)allocate("generation", 2 * lights, sizeof *g.nodes);
    g.sums = (vsgl_moments *)allocate("generation", lights, sizeof *g.sums);
    g.levels = (float *)allocate("generation", lights, sizeof *g.levels);
    return g;
}

void generator_free(generator *g) {
    free(g->moments);
    free(g->pdf);
    free(g->table);
    free(g->scratch);
    free(g->labels);
    free(g->order);
    free(g->begins);
    free(g->columns);
    free(g->rows);
    free(g->centers);
    free(g->nodes);
    free(g->sums);
    free(g->levels);
}

light_set light_set_create(int most) {
    light_set set;
    memset(&set, 0, sizeof set);
    set.lights = (vsgl *)allocate("lights", (size_t)most, sizeof *set.lights);
    set.centers = (fis_point *)allocate("lights", (size_t)most, sizeof *set.centers);
    set.cells = (fis_cell *)allocate("lights", (size_t)most, sizeof *set.cells);
    set.count = most;
    return set;
}

void light_set_free(light_set *set) {
    free(set->lights);
    free(set->centers);
    free(set->cells);
}

/* ---- what the methods share ---- */

/* Milliseconds since the last call, whose time is kept */
static double lap(double *clock) {
    const double now = progress_clock(), since = now - *clock;
    *clock = now;
    return since;
}

static inline void store(float (*planes)[BLOCK], int k, int i, vec3 v) {
    planes[k][i] = v.x;
    planes[k + 1][i] = v.y;
    planes[k + 2][i] = v.z;
}

static inline vec3 load(float (*planes)[BLOCK], int k, int i) {
    return lobe_vector(planes[k][i], planes[k + 1][i], planes[k + 2][i]);
}

static vsgl_moments texel_moments(const vpl_map *map, const vpl *t) {
    return vsgl_moments_from_vpl(lobe_sub(t->position, map->center), t->normal, t->view, t->diffuse, t->specular,
                                 t->alpha);
}

/* A run of texels' moments as planes: loops over them become vector code. */
static void find_block(const vpl_map *map, int first, int count, float (*sums)[BLOCK]) {
    const vec3 center = map->center;
    float t[sizeof(vpl) / sizeof(float)][BLOCK];
    int i;

    LOOP_BETWEEN_PLANES
    for (i = 0; i < count; i++) {
        const vpl *v = &map->texels[first + i];
        store(t, 0, i, v->position);
        store(t, 3, i, v->normal);
        store(t, 6, i, v->view);
        store(t, 9, i, v->diffuse);
        store(t, 12, i, v->specular);
        t[15][i] = v->alpha;
    }
    for (i = 0; i < count; i++) {
        const vsgl_moments m = vsgl_moments_from_vpl(lobe_sub(load(t, 0, i), center), load(t, 3, i), load(t, 6, i),
                                                     load(t, 9, i), load(t, 12, i), t[15][i]);
        store(sums, 0, i, m.power[0]);
        store(sums, 3, i, m.power[1]);
        store(sums, 6, i, m.direction[0]);
        store(sums, 9, i, m.direction[1]);
        store(sums, 12, i, m.position);
        sums[15][i] = m.position_squared;
    }
}

/* Additional RSM: the sums of each texel's one virtual point light */
static void find_moments(const vpl_map *map, float *moments) {
    const int texels = map->width * map->height;
    float sums[CHANNELS][BLOCK];
    int first, i, k;
    for (first = 0; first < texels; first += BLOCK) {
        const int count = texels - first < BLOCK ? texels - first : BLOCK;
        find_block(map, first, count, sums);

        LOOP_BETWEEN_PLANES
        for (i = 0; i < count; i++) {
            for (k = 0; k < CHANNELS; k++) moments[k] = sums[k][i];
            moments += CHANNELS;
        }
    }
}

/* Level 1 of their pyramid: few kernels are so small that they need level 0, which has thrice the size of all others
   together and is not stored. */
static void find_halved_moments(const vpl_map *map, float *moments) {
    float sums[CHANNELS][BLOCK], below[CHANNELS][BLOCK];
    int row, column, i, k;
    for (row = 0; row < map->height; row += 2) {
        for (column = 0; column < map->width; column += BLOCK) {
            const int left = map->width - column, count = left < BLOCK ? left : BLOCK;
            const int first = row * map->width + column;
            memset(below, 0, sizeof below);
            find_block(map, first, count, sums);
            if (row + 1 < map->height) find_block(map, first + map->width, count, below);
            for (k = 0; k < CHANNELS; k++) {
                for (i = 0; i < count; i++) sums[k][i] = 0.25f * (sums[k][i] + below[k][i]);
                if (count < BLOCK) sums[k][count] = 0; /* beyond an odd border */
            }

            LOOP_BETWEEN_PLANES
            for (i = 0; i < count; i += 2) {
                for (k = 0; k < CHANNELS; k++) moments[k] = sums[k][i] + sums[k][i + 1];
                moments += CHANNELS;
            }
        }
    }
}

/* What fis_fetch gives for the pyramid with level 0; `above` are the others. */
static vsgl_moments fetch_moments(const vpl_map *map, const fis_pyramid *above, float u, float v, float level) {
    const float x = lobe_min(lobe_max(u * (float)map->width - 0.5f, 0), (float)(map->width - 1));
    const float y = lobe_min(lobe_max(v * (float)map->height - 0.5f, 0), (float)(map->height - 1));
    const float half_u = u * (float)map->width / (float)(2 * above->width);
    const float half_v = v * (float)map->height / (float)(2 * above->height);
    const int column = (int)x, row = (int)y;
    vsgl_moments sum;
    int k;
    fis_fetch(above, half_u, half_v, level - 1, (float *)&sum);
    if (level >= 1) return sum;
    sum = vsgl_moments_scale(sum, level);
    for (k = 0; k < 4; k++) {
        const int across = column + (k & 1), down = row + (k >> 1);
        const float part = (k & 1 ? x - (float)column : 1 - (x - (float)column)) *
                           (k >> 1 ? y - (float)row : 1 - (y - (float)row)) * (1 - level);
        if (part > 0)
            sum = vsgl_moments_add(
                sum, vsgl_moments_scale(texel_moments(map, &map->texels[down * map->width + across]), part));
    }
    return sum;
}

/* A kernel's centre: a point of the lattice, shifted by the seed, to a position by the PDF */
static fis_sample sample_center(const fis_pyramid *pdf, int i, int count, unsigned seed) {
    const float shift_u = (float)(seed * 0x9E3779B1u >> 8) / 16777216.0f;
    const float shift_v = (float)(seed * 0x85EBCA77u >> 8) / 16777216.0f;
    fis_point point = fis_lattice(i, count);
    point.u = point.u + shift_u < 1 ? point.u + shift_u : point.u + shift_u - 1;
    point.v = point.v + shift_v < 1 ? point.v + shift_v : point.v + shift_v - 1;
    return fis_warp(pdf, point);
}

/* ---- filtered importance sampling ---- */

typedef struct {
    float level, scale; /* of the kernel; what makes its total of its mean */
} kernel;

static kernel kernel_nearest(const fis_pyramid *pdf, const fis_sample *center, int count, float k) {
    kernel size;
    size.level = fis_level_density_nearest(pdf, center, count, k);
    size.scale = fis_scale_density_nearest(pdf, center, count);
    return size;
}

static kernel kernel_density(const fis_pyramid *pdf, const fis_sample *center, int count, float k) {
    kernel size;
    size.level = fis_level_density(pdf, center, count, k);
    size.scale = fis_scale_density(pdf, center, count);
    return size;
}

static kernel kernel_bisection(const fis_pyramid *pdf, const fis_sample *center, int count, float k) {
    kernel size;
    size.level = fis_level_bisect(pdf, center, count, k, BISECTIONS);
    size.scale = fis_scale(pdf, center, size.level, count);
    return size;
}

static kernel kernel_fast(const fis_pyramid *pdf, const fis_sample *center, int count, float k) {
    kernel size;
    size.level = fis_level(pdf, center, count, k);
    if (size.level > 0 && size.level < (float)(pdf->levels - 1))
        size.scale = exp2f(2 * size.level) / k; /* the kernel holds k / count of the PDF: no need to look */
    else
        size.scale = fis_scale(pdf, center, size.level, count);
    return size;
}

static void sample_filtered(generator *g, const vpl_map *map, const fis_pyramid *moments, const fis_pyramid *pdf,
                            kernel (*kernel_of)(const fis_pyramid *, const fis_sample *, int, float), float k,
                            unsigned seed, light_set *set) {
    int i;
    for (i = 0; i < set->count; i++) {
        const fis_sample center = sample_center(pdf, i, set->count, seed);
        const kernel size = kernel_of(pdf, &center, set->count, k);
        const vsgl_moments cluster = fetch_moments(map, moments, center.u, center.v, size.level);
        set->lights[i] = vsgl_from_moments(vsgl_moments_scale(cluster, size.scale), map->center);
        set->centers[i].u = center.u;
        set->centers[i].v = center.v;
        g->levels[i] = size.level;
    }
}

static void generate_filtered(generator *g, const vpl_map *map, const float *density,
                              kernel (*kernel_of)(const fis_pyramid *, const fis_sample *, int, float), float k,
                              unsigned seed, light_set *set) {
    const int width = (map->width + 1) / 2, height = (map->height + 1) / 2;
    double clock = progress_clock();
    fis_pyramid moments, pdf;
    find_halved_moments(map, g->moments);
    set->ms[STAGE_TEXELS] = lap(&clock);
    moments = fis_build(g->moments, g->moments, width, height, CHANNELS);
    pdf = fis_build_pdf(g->pdf, density, map->width, map->height);
    set->ms[STAGE_PYRAMID] = lap(&clock);
    sample_filtered(g, map, &moments, &pdf, kernel_of, k, seed, set);
    set->ms[STAGE_LIGHTS] = lap(&clock);
}

/* The squares that kernels stand for, which is only looked at */
static void find_kernels(const generator *g, const vpl_map *map, light_set *set) {
    int i;
    for (i = 0; i < set->count; i++) {
        const double half = 0.5 * exp2((double)g->levels[i]), u = half / map->width, v = half / map->height;
        set->cells[i].u0 = (double)set->centers[i].u - u;
        set->cells[i].v0 = (double)set->centers[i].v - v;
        set->cells[i].u1 = (double)set->centers[i].u + u;
        set->cells[i].v1 = (double)set->centers[i].v + v;
    }
}

/* ---- cells of equal mass ---- */

static void generate_split(generator *g, const vpl_map *map, const float *density, light_set *set) {
    double clock = progress_clock();
    fis_split_table table;
    int i;
    find_moments(map, g->moments);
    set->ms[STAGE_TEXELS] = lap(&clock);
    table = fis_split_build(g->table, density, map->width, map->height);
    set->ms[STAGE_PYRAMID] = lap(&clock);
    fis_split(&table, set->count, set->cells);
    for (i = 0; i < set->count; i++) {
        const fis_cell *cell = &set->cells[i];
        vsgl_moments cluster;
        fis_cell_sum(g->moments, map->width, map->height, CHANNELS, *cell, (float *)&cluster);
        set->lights[i] = vsgl_from_moments(cluster, map->center);
        set->centers[i].u = (float)(0.5 * (cell->u0 + cell->u1));
        set->centers[i].v = (float)(0.5 * (cell->v0 + cell->v1));
    }
    set->ms[STAGE_LIGHTS] = lap(&clock);
}

/* ---- labelling: each texel goes to the cluster of its nearest centre ---- */

/* Centres are texels, drawn by the PDF. */
static void sample_texels(generator *g, const vpl_map *map, const float *density, unsigned seed, light_set *set) {
    const fis_pyramid pdf = fis_build_pdf(g->pdf, density, map->width, map->height);
    int i;
    for (i = 0; i < set->count; i++) {
        const fis_sample center = sample_center(&pdf, i, set->count, seed);
        g->columns[i] = (int)(center.u * (float)map->width);
        g->rows[i] = (int)(center.v * (float)map->height);
        set->centers[i].u = center.u;
        set->centers[i].v = center.v;
    }
}

static void lights_of_sums(const generator *g, const vpl_map *map, light_set *set) {
    int i;
    for (i = 0; i < set->count; i++) set->lights[i] = vsgl_from_moments(g->sums[i], map->center);
}

/* Distances are in texels, or in the world. */
static void place_in_image(const vpl_map *map, int column, int row, float at[3]) {
    (void)map;
    at[0] = (float)column;
    at[1] = (float)row;
    at[2] = 0;
}

static void place_in_world(const vpl_map *map, int column, int row, float at[3]) {
    const vec3 position = map->texels[row * map->width + column].position;
    at[0] = position.x;
    at[1] = position.y;
    at[2] = position.z;
}

static inline void label_by_tree(generator *g, const vpl_map *map, int count,
                                 void (*place)(const vpl_map *, int, int, float[3])) {
    kmeans_tree tree;
    int i, column, row, guess = 0;
    for (i = 0; i < count; i++) {
        place(map, g->columns[i], g->rows[i], g->centers[i].at);
        g->centers[i].label = i;
    }
    tree = kmeans_build(g->centers, count, g->nodes);
    for (row = 0; row < map->height; row++) {
        for (column = 0; column < map->width; column++) {
            float at[3];
            i = row * map->width + column;
            g->labels[i] = -1;
            if (!(vpl_weight(&map->texels[i]) > 0)) continue;
            place(map, column, row, at);
            guess = kmeans_nearest(&tree, at, guess); /* the neighbour's is near */
            g->labels[i] = g->centers[guess].label;
        }
    }
}

/* The sum of each cluster from its texels, which lie together in the order */
static void sum_sorted(generator *g, const vpl_map *map, int count) {
    int i, k;
    for (i = 0; i < count; i++) {
        vsgl_moments sum;
        memset(&sum, 0, sizeof sum);
        for (k = g->begins[i]; k < g->begins[i + 1]; k++)
            sum = vsgl_moments_add(sum, texel_moments(map, &map->texels[g->order[k]]));
        g->sums[i] = sum;
    }
}

static void generate_kmeans(generator *g, const vpl_map *map, const float *density, int in_world, unsigned seed,
                            light_set *set) {
    double clock = progress_clock();
    sample_texels(g, map, density, seed, set);
    if (in_world)
        label_by_tree(g, map, set->count, place_in_world);
    else
        label_by_tree(g, map, set->count, place_in_image);
    set->ms[STAGE_TEXELS] = lap(&clock);
    kmeans_sort(g->labels, map->width * map->height, set->count, g->order, g->begins);
    set->ms[STAGE_PYRAMID] = lap(&clock);
    sum_sorted(g, map, set->count);
    lights_of_sums(g, map, set);
    set->ms[STAGE_LIGHTS] = lap(&clock);
}

/* Every cluster's sum in one pass over the texels, without a sort */
static void sum_in_place(generator *g, const vpl_map *map, int count) {
    const int texels = map->width * map->height;
    float sums[CHANNELS][BLOCK];
    int first, i, k;
    memset(g->sums, 0, (size_t)count * sizeof *g->sums);
    for (first = 0; first < texels; first += BLOCK) {
        const int run = texels - first < BLOCK ? texels - first : BLOCK;
        find_block(map, first, run, sums);
        for (i = 0; i < run; i++) {
            float *sum = (float *)&g->sums[g->labels[first + i]];
            for (k = 0; k < CHANNELS; k++) sum[k] += sums[k][i];
        }
    }
}

static void generate_transform(generator *g, const vpl_map *map, const float *density, unsigned seed, light_set *set) {
    double clock = progress_clock();
    sample_texels(g, map, density, seed, set);
    kmeans_label_image(g->labels, map->width, map->height, g->columns, g->rows, set->count, g->scratch);
    set->ms[STAGE_TEXELS] = lap(&clock);
    set->ms[STAGE_PYRAMID] = 0;
    sum_in_place(g, map, set->count);
    lights_of_sums(g, map, set);
    set->ms[STAGE_LIGHTS] = lap(&clock);
}

/* ---- */

void vsgl_generate(generator *g, const vpl_map *map, const float *pdf, method how, float k, unsigned seed,
                   light_set *set) {
    static kernel (*const kernels[METHODS])(const fis_pyramid *, const fis_sample *, int,
                                            float) = {kernel_nearest, kernel_density, kernel_bisection, kernel_fast};
    set->labels = method_is_labelling(how) ? g->labels : NULL;
    if (method_is_filtered(how)) {
        generate_filtered(g, map, pdf, kernels[how], k, seed, set);
        find_kernels(g, map, set);
    } else if (how == METHOD_SPLIT) {
        generate_split(g, map, pdf, set);
    } else if (how == METHOD_TRANSFORM) {
        generate_transform(g, map, pdf, seed, set);
    } else {
        generate_kmeans(g, map, pdf, how == METHOD_KMEANS_3D, seed, set);
    }
}
