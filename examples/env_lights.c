/*
 env_lights.c - an environment map as a few spherical Gaussian lights

 What Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights, leaves for later in
 its conclusions: the directions of an environment map, weighted by its radiance, as pyramids; filtered importance
 sampling of clusters; an SG light for each, and closed-form shading. Three sizes of the kernel (density, the paper's
 bisection, a fast solver) and cells of equal flux are compared with sums over the map.

 The map is a latitude-longitude image: its top row is up (+y), its centre ahead (-z), and +x to the right of that. The
 camera looks ahead at a sphere of radius 1, from so far that it sees everything from +z.
*/
#include "../asg.h"
#include "../fis.h"
#include "common/brdf.h"
#include "common/csv.h"
#include "common/fail.h"
#include "common/image.h"
#include "common/options.h"
#include "common/output.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "common/raster.h"
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "env_lights";

enum { REPEATS = 5, LIMIT_MS = 1000, BISECTIONS = 12, SKY_WIDTH = 512, SKY_HEIGHT = 256, REFERENCE_WIDTH = 512 };

static const vec3 viewer = {0, 0, 1};

typedef enum { RULE_DENSITY, RULE_BISECTION, RULE_SOLVER, RULE_SPLIT, RULES } rule;
static const char *const rule_names[RULES] = {"density", "bisection", "solver", "split"};

typedef enum { SURFACE_MIRROR, SURFACE_GLOSSY, SURFACE_ROUGH, SURFACE_DIFFUSE, SURFACES } surface_kind;
static const char *const surface_names[SURFACES] = {"mirror", "alpha .1", "alpha .3", "diffuse"};
static const float alphas[SURFACES] = {0, 0.1f, 0.3f, 0};

/* ---- the map ---- */

typedef struct {
    int width, height, first; /* that column of the file, or of the sky, is the leftmost here */
    vec3 *radiance;           /* over its mean over the sphere */
} environment;

/* Integrals over a texel's polar angles: of sin, sin^2 and sin cos. Over its azimuths: of 1, and of the horizontal
   direction. Their products are the texel's solid angle and its integral of directions, which is what makes a light of
   even one texel as wide as that. */
typedef struct {
    double area, flat, height;
} band;

typedef struct {
    double angle, x, z;
} sector;

static const double pi = 3.14159265358979324;

static band band_of(int row, int rows) {
    const double from = pi * row / rows, to = pi * (row + 1) / rows, middle = 0.5 * (from + to),
                 half = 0.5 * (to - from);
    band b;
    b.area = 2 * sin(middle) * sin(half);
    b.flat = half - 0.5 * cos(2 * middle) * sin(2 * half);
    b.height = 0.5 * sin(2 * middle) * sin(2 * half);
    return b;
}

static sector sector_of(int column, int columns, double first) {
    const double middle = 2 * pi * ((column + 0.5) / columns + first - 0.5), half = pi / columns;
    sector s;
    s.angle = 2 * half;
    s.x = 2 * sin(middle) * sin(half);
    s.z = -2 * cos(middle) * sin(half);
    return s;
}

static band *bands_of(int rows) {
    band *bands = (band *)allocate("map", (size_t)rows, sizeof *bands);
    int y;
    for (y = 0; y < rows; y++) bands[y] = band_of(y, rows);
    return bands;
}

static sector *sectors_of(const environment *map, int columns) {
    sector *sectors = (sector *)allocate("map", (size_t)columns, sizeof *sectors);
    int x;
    for (x = 0; x < columns; x++) sectors[x] = sector_of(x, columns, (double)map->first / map->width);
    return sectors;
}

/* A clear sky: blue above, white at the horizon, with a sun that is half of all the light, over bare ground. */
static vec3 sky(vec3 dir) {
    static const vec3 zenith = {0.18f, 0.34f, 0.75f}, horizon = {0.9f, 0.95f, 1}, ground = {0.16f, 0.12f, 0.08f};
    static const vec3 sunlight = {1, 0.85f, 0.62f};
    static const vec3 sun = {0.616f, 0.557f, 0.557f};
    const float cos_sun = lobe_dot(dir, sun), high = lobe_at_least(dir.y, 0);
    const float haze = expf(-6 * high), glow = expf(40 * (cos_sun - 1)),
                disc = 1 / (1 + expf(3e4f * (0.99966f - cos_sun)));
    vec3 colour = lobe_add(lobe_scale(zenith, 1 - haze), lobe_scale(horizon, haze));
    if (dir.y < 0) colour = lobe_add(lobe_scale(ground, 1 - expf(40 * dir.y)), lobe_scale(horizon, expf(40 * dir.y)));
    return lobe_add(colour, lobe_scale(sunlight, dir.y < 0 ? 0 : 1.5f * glow + 1500 * disc));
}

static void paint_sky(environment *map) {
    int x, y;
    map->width = SKY_WIDTH;
    map->height = SKY_HEIGHT;
    map->radiance = (vec3 *)allocate("map", (size_t)SKY_WIDTH * SKY_HEIGHT, sizeof *map->radiance);
    for (y = 0; y < SKY_HEIGHT; y++) {
        for (x = 0; x < SKY_WIDTH; x++) {
            const band b = band_of(y, SKY_HEIGHT);
            const sector s = sector_of(x, SKY_WIDTH, 0);
            map->radiance[y * SKY_WIDTH + x] = sky(
                vec3_normalize(lobe_vector((float)(b.flat * s.x), (float)(b.height * s.angle), (float)(b.flat * s.z))));
        }
    }
}

/* Values that fis.h takes for no light in a PDF are no light here at all: negative, infinite and NaN, or too large. */
static float clean(float value, int *bad) {
    unsigned bits;
    memcpy(&bits, &value, sizeof bits);
    *bad += bits > 0x80000000u || (bits & 0x7FFFFFFFu) >= 0x6F800000u; /* below 0, or 2^96 and more */
    return lobe_fis_clean_pdf(value);
}

static void read_map(const char *path, environment *map) {
    raster r;
    const char *wrong = raster_read(path, &r);
    int bad = 0, i;
    if (wrong) give_up(path, wrong);
    map->width = r.width;
    map->height = r.height;
    map->radiance = (vec3 *)allocate("map", (size_t)r.width * (size_t)r.height, sizeof *map->radiance);
    for (i = 0; i < r.width * r.height; i++) {
        const float *value = r.values + (size_t)i * (size_t)r.channels;
        const int grey = r.channels == 1;
        map->radiance[i].x = clean(value[0], &bad);
        map->radiance[i].y = grey ? map->radiance[i].x : clean(value[1], &bad);
        map->radiance[i].z = grey ? map->radiance[i].x : clean(value[2], &bad);
    }
    free(r.values);
    if (bad) printf("%d values of %s are negative, 2^96 and more, or no numbers: they count as 0\n", bad, path);
}

typedef enum { SEAM_DARKEST, SEAM_BRIGHTEST, SEAM_FILE } seam_kind;

/* Makes the mean over the sphere 1, and a column the leftmost: kernels do not reach around the map, so that the edge is
   best where there is the least light. Returns that column's light over the mean. */
static double prepare_map(environment *map, seam_kind seam, const char *path) {
    const int width = map->width, height = map->height;
    double *columns = (double *)allocate("map", (size_t)width, sizeof *columns), total = 0, light;
    vec3 *row = (vec3 *)allocate("map", (size_t)width, sizeof *row);
    int x, y;
    for (y = 0; y < height; y++) {
        const double area = band_of(y, height).area;
        for (x = 0; x < width; x++) {
            vec3 texel = map->radiance[(size_t)y * (size_t)width + (size_t)x];
            columns[x] += area * ((double)texel.x + (double)texel.y + (double)texel.z);
        }
    }
    map->first = 0;
    for (x = 0; x < width; x++) {
        total += columns[x];
        /* what differs by rounding only is the same */
        if (seam == SEAM_DARKEST ? columns[x] < 0.999999 * columns[map->first]
                                 : seam == SEAM_BRIGHTEST && columns[x] > columns[map->first])
            map->first = x;
    }
    if (!(total > 0)) give_up(path, "the map is black");
    for (y = 0; y < height; y++) {
        vec3 *texels = map->radiance + (size_t)y * (size_t)width;
        for (x = 0; x < width; x++) {
            const vec3 texel = texels[(x + map->first) % width];
            const double scale = 6.0 * width / total; /* total is 3 channels, times 2 of the bands, times width for 1 */
            row[x] = lobe_vector((float)((double)texel.x * scale), (float)((double)texel.y * scale),
                                 (float)((double)texel.z * scale));
        }
        memcpy(texels, row, (size_t)width * sizeof *row);
    }
    light = columns[map->first] * width / total;
    free(columns);
    free(row);
    return light;
}

/* ---- the stages, in the paper's order ---- */

/* Sums over a cluster of texels, linear: they may be added, scaled and mipmapped. */
typedef struct {
    vec3 flux;      /* radiance times solid angle */
    vec3 direction; /* weighted by the mean of the flux's channels */
} env_moments;

enum { CHANNELS = sizeof(env_moments) / sizeof(float) };

typedef struct {
    sg_lobe lobe; /* peak 1 */
    vec3 radiance;
} env_light;

/* The moments of each texel, and the PDF: flux. */
static void find_moments(const environment *map, env_moments *moments, float *density) {
    band *bands = bands_of(map->height);
    sector *sectors = sectors_of(map, map->width);
    int y;
    for (y = 0; y < map->height; y++) {
        const band b = bands[y];
        int x;
        for (x = 0; x < map->width; x++) {
            const size_t i = (size_t)y * (size_t)map->width + (size_t)x;
            const sector s = sectors[x];
            const float mean = lobe_mean(map->radiance[i]);
            moments[i].flux = lobe_scale(map->radiance[i], (float)(b.area * s.angle));
            moments[i].direction = lobe_scale(
                lobe_vector((float)(b.flat * s.x), (float)(b.height * s.angle), (float)(b.flat * s.z)), mean);
            density[i] = lobe_mean(moments[i].flux);
        }
    }
    free(bands);
    free(sectors);
}

/* The light that has a cluster's flux in each channel, its mean direction and, after Toksvig, its spread. */
static env_light light_of(env_moments m) {
    env_light light;
    light.lobe = lobe_vsgl_emission(m.flux, m.direction);
    light.radiance = lobe_scale(m.flux, 1 / sg_integral(light.lobe.sharpness));
    return light;
}

/* All that the map gives, once for any number of lights, and the milliseconds it took. */
typedef struct {
    env_moments *texels;
    float *density, *memory[2];
    double *sums;
    fis_pyramid moments, pdf;
    fis_split_table table;
    double flux;
    quartiles moments_ms, pyramid_ms, table_ms, with_pyramids, with_table; /* moments and either */
} env_source;

static env_light sample_light(const env_source *source, rule how, int i, int count, const float shift[2]) {
    fis_point point = fis_lattice(i, count);
    fis_sample where;
    env_moments cluster;
    float level, scale;
    point.u = point.u + shift[0] < 1 ? point.u + shift[0] : point.u + shift[0] - 1;
    point.v = point.v + shift[1] < 1 ? point.v + shift[1] : point.v + shift[1] - 1;
    where = fis_warp(&source->pdf, point);
    if (how == RULE_DENSITY) {
        level = fis_level_density(&source->pdf, &where, count, 1);
        scale = fis_scale_density(&source->pdf, &where, count);
    } else {
        level = how == RULE_SOLVER ? fis_level(&source->pdf, &where, count, 1)
                                   : fis_level_bisect(&source->pdf, &where, count, 1, BISECTIONS);
        scale = fis_scale(&source->pdf, &where, level, count);
    }
    fis_fetch(&source->moments, where.u, where.v, level, (float *)&cluster);
    cluster.flux = lobe_scale(cluster.flux, scale);
    cluster.direction = lobe_scale(cluster.direction, scale);
    return light_of(cluster);
}

/* One light for each filtered sample, or for each cell of equal flux. */
static void make_lights(const env_source *source, rule how, int count, unsigned seed, fis_cell *cells,
                        env_light *lights) {
    float shift[2];
    int i;
    shift[0] = (float)(seed * 0x9E3779B1u >> 8) / 16777216.0f;
    shift[1] = (float)(seed * 0x85EBCA77u >> 8) / 16777216.0f;
    if (how == RULE_SPLIT) fis_split(&source->table, count, cells);
    for (i = 0; i < count; i++) {
        env_moments cluster;
        if (how == RULE_SPLIT) {
            fis_cell_sum((const float *)source->texels, source->table.width, source->table.height, CHANNELS, cells[i],
                         (float *)&cluster);
            lights[i] = light_of(cluster);
        } else {
            lights[i] = sample_light(source, how, i, count, shift);
        }
    }
}

/* ---- shading: pixels as planes, whose loops become vector code ---- */

enum { BLOCK = 256 };

typedef struct {
    float normal[3][BLOCK];
    float x[3][BLOCK], y[3][BLOCK], z[3][BLOCK], sharpness_x[BLOCK], sharpness_y[BLOCK], log_amplitude[BLOCK];
    float sum[3][BLOCK];
} pixel_block;

/* The sphere's pixels in an image */
typedef struct {
    int count, *pixel;
    vec3 *normal;
} sphere_view;

static sphere_view see_sphere(int width, int height, int step) {
    const float radius = 0.5f * (float)(width < height ? width : height);
    sphere_view view;
    int i;
    view.count = 0;
    view.pixel = (int *)allocate("image", (size_t)width * (size_t)height, sizeof *view.pixel);
    view.normal = (vec3 *)allocate("image", (size_t)width * (size_t)height, sizeof *view.normal);
    for (i = 0; i < width * height; i++) {
        const float x = ((float)(i % width) + 0.5f - 0.5f * (float)width) / radius;
        const float y = (0.5f * (float)height - (float)(i / width) - 0.5f) / radius, rest = 1 - x * x - y * y;
        if (rest <= 0 || i % width % step != step / 2 || i / width % step != step / 2) continue;
        view.pixel[view.count] = i;
        view.normal[view.count++] = lobe_vector(x, y, sqrtf(rest));
    }
    return view;
}

static void free_view(sphere_view *view) {
    free(view->pixel);
    free(view->normal);
}

static void store(float plane[3][BLOCK], int i, vec3 v) {
    plane[0][i] = v.x;
    plane[1][i] = v.y;
    plane[2][i] = v.z;
}

static inline vec3 load(float plane[3][BLOCK], int i) {
    return lobe_vector(plane[0][i], plane[1][i], plane[2][i]);
}

/* BRDF times cosine as a lobe. The papers take what the distribution is multiplied by at each light's centre; these
   lights may be wider than the lobe, even below the horizon, so it is taken at the mirror direction, where it is
   .25 / sqrt(alpha^2 + (1 - alpha^2) cos^2). */
static asg_lobe reflection_of(vec3 normal, float alpha) {
    const float cosine = lobe_dot(normal, viewer), a2 = alpha * alpha;
    asg_lobe reflection = asg_ggx_lobe(normal, viewer, alpha);
    if (a2 > 0) reflection.log_amplitude = -logf(4 * LOBE_PI * a2 * sqrtf(a2 + (1 - a2) * cosine * cosine));
    return reflection;
}

static void fill_block(pixel_block *b, const vec3 *normals, int count, float alpha) {
    int i;
    memset(b, 0, sizeof *b);
    for (i = 0; i < BLOCK; i++) {
        const vec3 normal = i < count ? normals[i] : viewer;
        const asg_lobe reflection = reflection_of(normal, alpha);
        store(b->normal, i, normal);
        store(b->x, i, reflection.x);
        store(b->y, i, reflection.y);
        store(b->z, i, reflection.z);
        b->sharpness_x[i] = reflection.sharpness_x;
        b->sharpness_y[i] = reflection.sharpness_y;
        b->log_amplitude[i] = reflection.log_amplitude;
    }
}

static inline void add(pixel_block *b, int i, float value, vec3 radiance) {
    b->sum[0][i] += value * radiance.x;
    b->sum[1][i] += value * radiance.y;
    b->sum[2][i] += value * radiance.z;
}

static void add_mirror(pixel_block *b, const env_light *light) {
    const env_light l = *light;
    int i;
    for (i = 0; i < BLOCK; i++) add(b, i, sg_eval(l.lobe, load(b->z, i)), l.radiance);
}

static void add_diffuse(pixel_block *b, const env_light *light) {
    const env_light l = *light;
    int i;
    for (i = 0; i < BLOCK; i++) add(b, i, sg_cosine_integral(l.lobe, load(b->normal, i)) * (1 / LOBE_PI), l.radiance);
}

static void add_glossy(pixel_block *b, const env_light *light) {
    const env_light l = *light;
    int i;
    for (i = 0; i < BLOCK; i++) {
        asg_lobe reflection;
        reflection.x = load(b->x, i);
        reflection.y = load(b->y, i);
        reflection.z = load(b->z, i);
        reflection.sharpness_x = b->sharpness_x[i];
        reflection.sharpness_y = b->sharpness_y[i];
        reflection.log_amplitude = b->log_amplitude[i];
        add(b, i, asg_sg_integral(reflection, l.lobe), l.radiance);
    }
}

static void shade(const sphere_view *view, surface_kind kind, const env_light *lights, int count, vec3 *radiance) {
    const int blocks = (view->count + BLOCK - 1) / BLOCK;
    progress line = progress_begin("lights", blocks);
    int n;
    PARALLEL_FOR
    for (n = 0; n < blocks; n++) {
        pixel_block b;
        const int first = n * BLOCK, pixels = view->count - first < BLOCK ? view->count - first : BLOCK;
        int i, light;
        fill_block(&b, view->normal + first, pixels, alphas[kind]);
        for (light = 0; light < count; light++) {
            if (kind == SURFACE_MIRROR)
                add_mirror(&b, &lights[light]);
            else if (kind == SURFACE_DIFFUSE)
                add_diffuse(&b, &lights[light]);
            else
                add_glossy(&b, &lights[light]);
        }
        for (i = 0; i < pixels; i++) radiance[first + i] = load(b.sum, i);
        progress_step(&line);
    }
    progress_end(&line);
}

/* ---- the reference ---- */

/* What one cell of the map sends: exact for cosines while all of it is above the horizon */
typedef struct {
    vec3 moment[3]; /* integral of direction times radiance, red, green and blue */
    vec3 flux, dir, half;
} env_cell;

/* The map in cells of `group` texels each way, or texels in `parts` cells each way; black ones left out */
static env_cell *make_cells(const environment *map, int group, int parts, int *count) {
    const int rows = map->height * parts, columns = map->width * parts;
    const int across = (columns + group - 1) / group, down = (rows + group - 1) / group;
    double(*sums)[12] = (double(*)[12])allocate("reference", (size_t)across, sizeof *sums);
    env_cell *cells = (env_cell *)allocate("reference", (size_t)across * (size_t)down, sizeof *cells);
    sector *sectors = sectors_of(map, columns);
    int x, y, k, c, row;
    *count = 0;
    for (row = 0; row < down; row++) {
        memset(sums, 0, (size_t)across * sizeof *sums);
        for (y = row * group; y < rows && y < (row + 1) * group; y++) {
            const band b = band_of(y, rows);
            for (x = 0; x < columns; x++) {
                const vec3 texel = map->radiance[(size_t)(y / parts) * (size_t)map->width + (size_t)(x / parts)];
                const sector s = sectors[x];
                const double colour[3] = {(double)texel.x, (double)texel.y, (double)texel.z};
                double *sum = sums[x / group];
                for (c = 0; c < 3; c++) {
                    sum[4 * c] += colour[c] * b.area * s.angle;
                    sum[4 * c + 1] += colour[c] * b.flat * s.x;
                    sum[4 * c + 2] += colour[c] * b.height * s.angle;
                    sum[4 * c + 3] += colour[c] * b.flat * s.z;
                }
            }
        }
        for (x = 0; x < across; x++) {
            env_cell *cell = &cells[*count];
            vec3 mean = {0, 0, 0};
            if (!(sums[x][0] + sums[x][4] + sums[x][8] > 0)) continue;
            for (k = 0; k < 3; k++) {
                cell->moment[k] =
                    lobe_vector((float)sums[x][4 * k + 1], (float)sums[x][4 * k + 2], (float)sums[x][4 * k + 3]);
                mean = lobe_add(mean, cell->moment[k]);
            }
            cell->flux = lobe_vector((float)sums[x][0], (float)sums[x][4], (float)sums[x][8]);
            cell->dir = lobe_normalize_or(mean, viewer);
            cell->half = lobe_normalize_or(lobe_add(cell->dir, viewer), viewer);
            ++*count;
        }
    }
    free(sums);
    free(sectors);
    return cells;
}

/* GGX's visibility, Smith's height-correlated, times the cosine of what comes in */
static inline float visibility(float a2, float cos_i, float cos_o) {
    const float smith = cos_o * sqrtf(a2 + (1 - a2) * cos_i * cos_i) + cos_i * sqrtf(a2 + (1 - a2) * cos_o * cos_o);
    return 0.5f * cos_i / lobe_at_least(smith, 1e-20f);
}

static void add_cell_diffuse(pixel_block *b, const env_cell *cell) {
    const env_cell l = *cell;
    int i;
    for (i = 0; i < BLOCK; i++) {
        const vec3 normal = load(b->normal, i);
        b->sum[0][i] += lobe_at_least(lobe_dot(normal, l.moment[0]), 0) * (1 / LOBE_PI);
        b->sum[1][i] += lobe_at_least(lobe_dot(normal, l.moment[1]), 0) * (1 / LOBE_PI);
        b->sum[2][i] += lobe_at_least(lobe_dot(normal, l.moment[2]), 0) * (1 / LOBE_PI);
    }
}

static void add_cell_glossy(pixel_block *b, const env_cell *cell, float alpha) {
    const env_cell l = *cell;
    int i;
    for (i = 0; i < BLOCK; i++) {
        const vec3 normal = load(b->normal, i);
        const float cos_i = lobe_at_least(lobe_dot(normal, l.dir), 0);
        const float value = brdf_distribution(alpha, lobe_dot(normal, l.half)) *
                            visibility(alpha * alpha, cos_i, lobe_dot(normal, viewer));
        add(b, i, value, l.flux);
    }
}

/* Single precision for a few cells, then double */
static void drain(pixel_block *b, double totals[3][BLOCK]) {
    int c, i;
    for (c = 0; c < 3; c++) {
        for (i = 0; i < BLOCK; i++) totals[c][i] += (double)b->sum[c][i];
    }
    memset(b->sum, 0, sizeof b->sum);
}

static void sum_cells(const sphere_view *view, surface_kind kind, const env_cell *cells, int count, const char *label,
                      vec3 *radiance) {
    const int blocks = (view->count + BLOCK - 1) / BLOCK;
    progress line = progress_begin(label, blocks);
    int n;
    PARALLEL_FOR
    for (n = 0; n < blocks; n++) {
        pixel_block b;
        double totals[3][BLOCK];
        const int first = n * BLOCK, pixels = view->count - first < BLOCK ? view->count - first : BLOCK;
        int i;
        fill_block(&b, view->normal + first, pixels, alphas[kind]);
        memset(totals, 0, sizeof totals);
        for (i = 0; i < count; i++) {
            if (kind == SURFACE_DIFFUSE)
                add_cell_diffuse(&b, &cells[i]);
            else
                add_cell_glossy(&b, &cells[i], alphas[kind]);
            if (i % 512 == 511) drain(&b, totals);
        }
        drain(&b, totals);
        for (i = 0; i < pixels; i++)
            radiance[first + i] = lobe_vector((float)totals[0][i], (float)totals[1][i], (float)totals[2][i]);
        progress_step(&line);
    }
    progress_end(&line);
}

/* The map as a mirror shows it */
static void reflect_map(const sphere_view *view, const environment *map, vec3 *radiance) {
    int i;
    for (i = 0; i < view->count; i++) {
        const vec3 n = view->normal[i], dir = lobe_sub(lobe_scale(n, 2 * lobe_dot(n, viewer)), viewer);
        const double turn = atan2((double)dir.x, (double)-dir.z) / (2 * pi) + 1.5 - (double)map->first / map->width;
        const int x = (int)((turn - floor(turn)) * map->width), y = (int)(acos((double)dir.y) / pi * map->height);
        radiance[i] = map->radiance[(size_t)(y < map->height ? y : map->height - 1) * (size_t)map->width +
                                    (size_t)(x < map->width ? x : map->width - 1)];
    }
}

/* ---- what is said and shown of them ---- */

static double rmse(const vec3 *values, const vec3 *wanted, int count) {
    double sum = 0;
    int i;
    for (i = 0; i < count; i++) {
        const vec3 d = wanted ? lobe_sub(values[i], wanted[i]) : values[i];
        sum += (double)d.x * (double)d.x + (double)d.y * (double)d.y + (double)d.z * (double)d.z;
    }
    return count ? sqrt(sum / (3.0 * count)) : 0;
}

static env_source prepare(const environment *map) {
    const size_t texels = (size_t)map->width * (size_t)map->height;
    timing taken[5];
    env_source source;
    size_t i;
    int k;
    source.texels = (env_moments *)allocate("map", texels, sizeof *source.texels);
    source.density = (float *)allocate("map", texels, sizeof *source.density);
    source.memory[0] = (float *)allocate("map", fis_pyramid_size(map->width, map->height, CHANNELS), sizeof(float));
    source.memory[1] = (float *)allocate("map", fis_pyramid_size(map->width, map->height, 1), sizeof(float));
    source.sums = (double *)allocate("map", fis_split_size(map->width, map->height), sizeof(double));
    memset(taken, 0, sizeof taken);
    for (k = 0; k < REPEATS; k++) {
        double ms[3], started = progress_clock();
        find_moments(map, source.texels, source.density);
        ms[0] = progress_clock() - started;
        started = progress_clock();
        source.moments = fis_build(source.memory[0], (const float *)source.texels, map->width, map->height, CHANNELS);
        source.pdf = fis_build_pdf(source.memory[1], source.density, map->width, map->height);
        ms[1] = progress_clock() - started;
        started = progress_clock();
        source.table = fis_split_build(source.sums, source.density, map->width, map->height);
        ms[2] = progress_clock() - started;
        timing_add(&taken[0], ms[0]);
        timing_add(&taken[1], ms[1]);
        timing_add(&taken[2], ms[2]);
        timing_add(&taken[3], ms[0] + ms[1]);
        timing_add(&taken[4], ms[0] + ms[2]);
    }
    source.moments_ms = timing_quartiles(&taken[0]);
    source.pyramid_ms = timing_quartiles(&taken[1]);
    source.table_ms = timing_quartiles(&taken[2]);
    source.with_pyramids = timing_quartiles(&taken[3]);
    source.with_table = timing_quartiles(&taken[4]);
    source.flux = 0;
    for (i = 0; i < texels; i++) source.flux += (double)source.density[i];
    return source;
}

static void free_source(env_source *source) {
    free(source->texels);
    free(source->density);
    free(source->memory[0]);
    free(source->memory[1]);
    free(source->sums);
}

static double total_flux(const env_light *lights, int count) {
    double sum = 0;
    int i;
    for (i = 0; i < count; i++)
        sum += (double)lobe_mean(lights[i].radiance) * (double)sg_integral(lights[i].lobe.sharpness);
    return sum;
}

/* The sums over the map, and how much those for some pixels change with cells of half the size */
static void find_reference(const environment *map, const sphere_view *view, option_size size,
                           vec3 *reference[SURFACES]) {
    const int across = map->width > 2 * map->height ? map->width : 2 * map->height;
    const int group = (across + REFERENCE_WIDTH - 1) / REFERENCE_WIDTH, parts = (REFERENCE_WIDTH + across - 1) / across;
    const double started = progress_clock();
    sphere_view few = see_sphere(size.width, size.height, 8);
    vec3 *coarse = (vec3 *)allocate("reference", (size_t)few.count, sizeof *coarse);
    vec3 *fine = (vec3 *)allocate("reference", (size_t)few.count, sizeof *fine);
    env_cell *cells[2];
    int counts[2], k;
    double seconds;
    cells[0] = make_cells(map, group, parts, &counts[0]);
    reflect_map(view, map, reference[SURFACE_MIRROR]);
    for (k = SURFACE_GLOSSY; k < SURFACES; k++)
        sum_cells(view, (surface_kind)k, cells[0], counts[0], "reference", reference[k]);
    seconds = (progress_clock() - started) * 1e-3;
    cells[1] = make_cells(map, (group + 1) / 2, group > 1 ? 1 : 2 * parts, &counts[1]);
    printf("reference: sums over %d cells of the map, %.1f s\n", counts[0], seconds);
    for (k = SURFACE_DIFFUSE; k >= SURFACE_GLOSSY; k--) {
        sum_cells(&few, (surface_kind)k, cells[0], counts[0], "reference's error", coarse);
        sum_cells(&few, (surface_kind)k, cells[1], counts[1], "reference's error", fine);
        printf("    %-9s root mean square %.3f; cells of half the size change it by %.2g\n", surface_names[k],
               rmse(reference[k], NULL, view->count), rmse(coarse, fine, few.count));
    }
    free(cells[0]);
    free(cells[1]);
    free(coarse);
    free(fine);
    free_view(&few);
}

static void paint(image *sheet, const sphere_view *view, option_size size, int column, int row, const vec3 *radiance) {
    int i;
    for (i = 0; i < view->count; i++) {
        const int x = view->pixel[i] % size.width + column * (size.width + 2);
        const int y = view->pixel[i] / size.width + row * (size.height + 2);
        sheet->pixels[y * sheet->width + x] = radiance[i];
    }
}

typedef struct {
    option_size size;
    option_list lights;
    int seed, shifts, seam;
    const char *map, *out;
} settings;

/* What one rule's lights do. Errors are root mean squares over shifts of the samples, since that of a few lights is a
   matter of luck, and the flux is that of the worst of them; cells have nothing to shift. */
typedef struct {
    rule how;
    int count, shifts;
    timing sampling, shading;
    double squares[SURFACES], flux;
} row;

/* Places the lights and shades with them, the glossy and the diffuse sphere. The first so many turns are the shifts. */
static void take_turn(const settings *o, const env_source *source, const sphere_view *view, int turn, row *r,
                      fis_cell *cells, env_light *lights, vec3 *const reference[SURFACES], vec3 *radiance,
                      image *sheet) {
    double started = progress_clock(), sampling, shading = 0;
    int k;
    make_lights(source, r->how, r->count, (unsigned)o->seed + (unsigned)turn, cells, lights);
    sampling = progress_clock() - started;
    for (k = SURFACE_GLOSSY; k < SURFACES; k++) {
        started = progress_clock();
        shade(view, (surface_kind)k, lights, r->count, radiance);
        shading += progress_clock() - started;
        if (turn < r->shifts) r->squares[k] += pow(rmse(radiance, reference[k], view->count), 2) / r->shifts;
        if (turn == 0 && sheet) paint(sheet, view, o->size, 1 + (int)r->how, k, radiance);
    }
    if (turn < REPEATS) {
        timing_add(&r->sampling, sampling);
        timing_add(&r->shading, shading);
    }
    if (turn < r->shifts) {
        const double ratio = total_flux(lights, r->count) / source->flux;
        if (fabs(ratio - 1) >= fabs(r->flux - 1)) r->flux = ratio;
    }
    if (turn == 0 && sheet) {
        shade(view, SURFACE_MIRROR, lights, r->count, radiance);
        paint(sheet, view, o->size, 1 + (int)r->how, SURFACE_MIRROR, radiance);
    }
}

static const char row_columns[] =
    "lights,rule,build_ms,build_ms_low,build_ms_high,sampling_ms,sampling_ms_low,sampling_ms_high,shading_ms,"
    "shading_ms_low,shading_ms_high,diffuse,alpha_3,alpha_1,power";

static void show_row(const row *r, const env_source *source, csv *table) {
    const quartiles build = r->how == RULE_SPLIT ? source->with_table : source->with_pyramids;
    const quartiles sampling = timing_quartiles(&r->sampling), shading = timing_quartiles(&r->shading);
    const double diffuse = sqrt(r->squares[SURFACE_DIFFUSE]), rough = sqrt(r->squares[SURFACE_ROUGH]),
                 glossy = sqrt(r->squares[SURFACE_GLOSSY]);
    printf("%6d %-9s %8.2f %8.3f %9.1f %9.5f %9.5f %9.5f   %.6f\n", r->count, rule_names[r->how], build.median,
           sampling.median, shading.median, diffuse, rough, glossy, r->flux);
    fflush(stdout);
    csv_count(table, r->count);
    csv_text(table, rule_names[r->how]);
    csv_quartiles(table, build);
    csv_quartiles(table, sampling);
    csv_quartiles(table, shading);
    csv_error(table, diffuse);
    csv_error(table, rough);
    csv_error(table, glossy);
    csv_error(table, r->flux);
    csv_row(table);
}

/* One number of lights by all rules, turn by turn; with a sheet, a column of it for each */
static void compare_rules(const settings *o, const env_source *source, const sphere_view *view, int count,
                          vec3 *const reference[SURFACES], vec3 *radiance, image *sheet, csv *table) {
    const int turns = o->shifts > REPEATS ? o->shifts : REPEATS;
    env_light *lights = (env_light *)allocate("lights", (size_t)count, sizeof *lights);
    fis_cell *cells = (fis_cell *)allocate("lights", (size_t)count, sizeof *cells);
    row rows[RULES];
    int turn, k;
    memset(rows, 0, sizeof rows);
    for (k = 0; k < RULES; k++) {
        rows[k].how = (rule)k;
        rows[k].count = count;
        rows[k].shifts = k == RULE_SPLIT ? 1 : o->shifts;
        rows[k].flux = 1;
    }
    for (turn = 0; turn < turns; turn++) {
        for (k = 0; k < RULES; k++) {
            if (turn < rows[k].shifts || timing_goes_on(&rows[k].shading, 1, REPEATS, LIMIT_MS))
                take_turn(o, source, view, turn, &rows[k], cells, lights, reference, radiance, sheet);
        }
    }
    for (k = 0; k < RULES; k++) show_row(&rows[k], source, table);
    free(lights);
    free(cells);
}

int main(int argc, char **argv) {
    static const char *const seams[] = {"darkest", "brightest", "file", NULL};
    settings o = {{128, 128}, {4, {16, 64, 256, 1024}}, 0, 4, SEAM_DARKEST, NULL, "build/env_lights"};
    const option options[] = {
        {"--map FILE", OPTION_TEXT, &o.map, 0, 0, "PFM or Radiance file (without it a clear sky)", 0},
        {"--lights N,...", OPTION_LIST, &o.lights, 1, 65536, "numbers of lights to try", 0},
        {"--seam COLUMN", OPTION_CHOICE, &o.seam, 0, 0, "where the map is cut", seams},
        {"--shifts N", OPTION_WHOLE, &o.shifts, 1, 1000, "shifts of the samples that errors are a mean over", 0},
        OPTION_OF_SIZE(&o.size),
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    environment map;
    env_source source;
    sphere_view view;
    vec3 *reference[SURFACES], *radiance;
    image sheet;
    csv table = csv_begin(row_columns);
    double edge;
    int i, k;

    options_read(options, argc, argv,
                 "Lights spheres with an environment map as SG lights, by filtered sampling and by\n"
                 "cells of equal flux, and prints the speed and the error of each against the map.\n"
                 "A map is latitude by longitude: its top row up (+y), its centre ahead (-z), +x to the\n"
                 "right of that. One channel is grey. What is negative or no number counts as 0.");
    output_check(o.out, ".png");
    output_check(o.out, ".csv");
    if (o.map)
        read_map(o.map, &map);
    else
        paint_sky(&map);
    edge = prepare_map(&map, (seam_kind)o.seam, o.map ? o.map : "sky");
    view = see_sphere(o.size.width, o.size.height, 1);
    sheet = image_create((1 + RULES) * (o.size.width + 2) - 2, SURFACES * (o.size.height + 2) - 2);
    radiance = (vec3 *)allocate("image", (size_t)view.count, sizeof *radiance);
    for (k = 0; k < SURFACES; k++) reference[k] = (vec3 *)allocate("image", (size_t)view.count, sizeof **reference);

    printf("map %dx%d of mean radiance 1, cut at column %d, which has %.3f of a column's mean light\n", map.width,
           map.height, map.first, edge);
    find_reference(&map, &view, o.size, reference);
    for (k = 0; k < SURFACES; k++) paint(&sheet, &view, o.size, 0, k, reference[k]);
    source = prepare(&map);
    printf("%d pixels, times in ms: moments %.2f, pyramids %.2f, table %.2f\n\n", view.count, source.moments_ms.median,
           source.pyramid_ms.median, source.table_ms.median);
    printf("lights rule         build sampling   shading   diffuse  alpha .3  alpha .1   light/map\n");
    for (i = 0; i < o.lights.count; i++)
        compare_rules(&o, &source, &view, o.lights.value[i], reference, radiance, i ? NULL : &sheet, &table);
    output_picture(o.out, ".png", &sheet, 0.8f);
    printf("\nwrote %s.png: mirror, alpha .1, alpha .3 and diffuse; the map itself, then %d lights by each rule\n",
           o.out, o.lights.value[0]);
    csv_end(&table, o.out, ".csv", "the numbers above");
    for (k = 0; k < SURFACES; k++) free(reference[k]);
    free(radiance);
    free_source(&source);
    free_view(&view);
    image_free(&sheet);
    free(map.radiance);
    return 0;
}
