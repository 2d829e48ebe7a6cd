/*
 fis_study.h - images, lookups in double, and what kernels are good for: shared by the unit tests and the bench of fis.h

   study s = study_begin(importance, power, 512, 512);
   study_kernels(&s, STUDY_BISECTION, 1024, kernels);
   study_quality quality = study_measure(&s, STUDY_BISECTION, kernels, 1024);
   study_end(&s);

 It includes fis.h so that texels read by lookups are counted, in study_reads.
*/
#ifndef FIS_STUDY_H
#define FIS_STUDY_H

#include "test.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static unsigned long study_reads; /* stays 0 where something else has included fis.h */
#ifndef LOBE_FIS_H
#define LOBE_FIS_READ(value) (study_reads++, (value))
#endif
#include "../fis.h"

/* ---- images ---- */

enum { CONSTANT, SMOOTH, CHECKERBOARD, POWER, BRSM, OCTAVES, SPARSE, SPIKE, ROW, LONE, KINDS };

static inline double wave(double x, double y) {
    return 1 + 0.6 * sin(6.2 * x + 1) * cos(5.1 * y) + 0.3 * sin(14 * x - 9 * y);
}

static inline float *make_image(int kind, int width, int height, unsigned long long seed) {
    float *image = (float *)malloc((size_t)width * (size_t)height * sizeof *image);
    test_rng rng = {seed};
    double phase[8][3];
    int x, y, i;
    for (i = 0; i < 24; i++) phase[i / 3][i % 3] = 6.283185307179586 * test_uniform(&rng);
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            double s = (x + 0.5) / width, t = (y + 0.5) / height, random = test_uniform(&rng), value = 1;
            if (kind == SMOOTH) value = wave(s, t);
            if (kind == CHECKERBOARD) value = (x + y) & 1 ? 0.01 + random : 1e-3;
            if (kind == POWER) value = pow(random, 8);
            if (kind == BRSM)
                value = -log(1 - random) * wave(s, t); /* a bidirectional RSM's: estimates from one path */
            if (kind == OCTAVES) {
                for (i = 0; i < 8; i++) /* 1/f */
                    value += sin((1 << i) * (6.3 * s * cos(phase[i][0]) + 6.3 * t * sin(phase[i][0])) + phase[i][1]) /
                             (1 << i);
                value = exp(2 * value);
            }
            if (kind == SPARSE) value = random < 0.02 ? 0.1 + test_uniform(&rng) : 0;
            if (kind == SPIKE) value = x == width / 3 && y == height / 2 ? 1e5 : 0.5 + random;
            if (kind == ROW) value = y == height / 2 ? 0.1 + random : 0;
            if (kind == LONE) value = x == width - 1 && y == height / 3 ? 7 : 0;
            image[(size_t)y * (size_t)width + (size_t)x] = (float)value;
        }
    }
    if (kind == SPARSE) image[0] = 1; /* never without mass */
    return image;
}

/* ---- reference ---- */

typedef struct {
    double *level[LOBE_FIS_LEVELS]; /* sum over the texels that a level's texel covers, over 4^level */
    double total;
    int width, height, levels;
} reference;

static inline int halved(int size, int level) {
    return (size + (1 << level) - 1) / (1 << level);
}

static inline reference make_reference(const float *image, int width, int height) {
    reference r;
    int level, x, y;
    memset(&r, 0, sizeof r);
    r.width = width;
    r.height = height;
    do {
        double *sums;
        int w = halved(width, r.levels);
        sums = r.level[r.levels] = (double *)calloc((size_t)w * (size_t)halved(height, r.levels), sizeof *sums);
        for (y = 0; y < height; y++)
            for (x = 0; x < width; x++)
                sums[(y >> r.levels) * w + (x >> r.levels)] += ldexp((double)image[y * width + x], -2 * r.levels);
        level = r.levels++;
    } while (halved(width, level) > 1 || halved(height, level) > 1);
    r.total = ldexp(r.level[level][0], 2 * level);
    return r;
}

static inline void free_reference(reference r) {
    int level;
    for (level = 0; level < r.levels; level++) free(r.level[level]);
}

static inline double clamped(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static inline double bilinear(const reference *r, double u, double v, int level) {
    int w = halved(r->width, level), h = halved(r->height, level), x0, y0, x1, y1;
    double x = clamped(ldexp(u * r->width, -level) - 0.5, 0, w - 1);
    double y = clamped(ldexp(v * r->height, -level) - 0.5, 0, h - 1);
    const double *texels = r->level[level];
    x0 = (int)x;
    y0 = (int)y;
    x1 = x0 + 1 < w ? x0 + 1 : x0;
    y1 = y0 + 1 < h ? y0 + 1 : y0;
    x -= x0;
    y -= y0;
    return (1 - y) * ((1 - x) * texels[y0 * w + x0] + x * texels[y0 * w + x1]) +
           y * ((1 - x) * texels[y1 * w + x0] + x * texels[y1 * w + x1]);
}

static inline double trilinear(const reference *r, double u, double v, double level) {
    int fine = (int)clamped(level, 0, r->levels - 1), coarse = fine + 1 < r->levels ? fine + 1 : fine;
    double t = clamped(level, 0, r->levels - 1) - fine;
    return (1 - t) * bilinear(r, u, v, fine) + t * bilinear(r, u, v, coarse);
}

/* 4^l p(x, l) / M of 002, Eq. 3 */
static inline double share(const reference *r, double u, double v, double level) {
    return exp2(2 * level) * trilinear(r, u, v, level) / r->total;
}

/* The solution of share = k / n nearest to a level, to 2^-30; the ends where even a texel holds more or all holds less */
static inline double nearest_root(const reference *r, double u, double v, double wanted, double level) {
    enum { STEPS = 64 };
    double mean[LOBE_FIS_LEVELS], root = -1;
    int i, step, above = 0, top = r->levels - 1;
    for (i = 0; i <= top; i++) mean[i] = bilinear(r, u, v, i) / r->total;
    for (i = 0; i <= top * STEPS; i++) {
        int fine = i / STEPS, coarse = fine < top ? fine + 1 : fine;
        double t = (double)i / STEPS - fine, low = (i - 1.0) / STEPS, high = (double)i / STEPS, found;
        int now = exp2(2 * high) * ((1 - t) * mean[fine] + t * mean[coarse]) >= wanted, was = above;
        above = now;
        if (now == was) continue;
        for (step = 0; step < 24 && i > 0; step++) {
            double middle = 0.5 * (low + high);
            fine = (int)middle;
            t = middle - fine;
            if ((exp2(2 * middle) * ((1 - t) * mean[fine] + t * mean[fine + 1]) >= wanted) == was)
                low = middle;
            else
                high = middle;
        }
        found = i > 0 ? high : 0;
        if (root < 0 || fabs(found - level) < fabs(root - level)) root = found;
    }
    if (!above && (root < 0 || fabs(top - level) < fabs(root - level))) root = top;
    return root;
}

/* ---- kernels ---- */

enum { STUDY_NEAREST, STUDY_DENSITY, STUDY_BISECTION, STUDY_FAST, STUDY_SPLIT, STUDY_METHODS };
static const char *const study_method[] = {"density, nearest", "density, bilinear", "12 bisections", "fis_level",
                                           "split"};
enum { STUDY_CHANNELS = 3 }; /* of lights: power, and power times u and v */

typedef struct {
    fis_sample at;
    float level, scale;
    fis_cell cell; /* a square of 2^level texels around the sample; or of the split */
} study_kernel;

typedef struct {
    int width, height;
    const float *importance;
    float *light; /* interleaved channels */
    fis_pyramid pdf, lights;
    fis_split_table table;
    unsigned long reads; /* by the last study_kernels, of PDF texels for levels; of the table's entries for the split */
} study;

/* A light's power that is unlike its importance */
static inline float *make_power(const float *importance, int width, int height) {
    float *power = (float *)malloc((size_t)width * (size_t)height * sizeof *power);
    int i;
    for (i = 0; i < width * height; i++)
        power[i] = (float)(sqrt((double)importance[i]) * wave((i % width + 0.5) / width, (i / width + 0.5) / height));
    return power;
}

/* The images stay the caller's. */
static inline study study_begin(const float *importance, const float *power, int width, int height) {
    size_t count = (size_t)width * (size_t)height, i;
    study s;
    memset(&s, 0, sizeof s);
    s.width = width;
    s.height = height;
    s.importance = importance;
    s.light = (float *)malloc(count * STUDY_CHANNELS * sizeof(float));
    for (i = 0; i < count; i++) {
        s.light[i * STUDY_CHANNELS] = power[i];
        s.light[i * STUDY_CHANNELS + 1] = power[i] * ((float)(i % (size_t)width) + 0.5f) / (float)width;
        s.light[i * STUDY_CHANNELS + 2] = power[i] * ((float)(i / (size_t)width) + 0.5f) / (float)height;
    }
    s.pdf =
        fis_build_pdf((float *)malloc(fis_pyramid_size(width, height, 1) * sizeof(float)), importance, width, height);
    s.lights = fis_build((float *)malloc(fis_pyramid_size(width, height, STUDY_CHANNELS) * sizeof(float)), s.light,
                         width, height, STUDY_CHANNELS);
    s.table =
        fis_split_build((double *)malloc(fis_split_size(width, height) * sizeof(double)), importance, width, height);
    return s;
}

/* A new PDF for the same lights */
static inline void study_renew(study *s, const float *importance) {
    s->importance = importance;
    fis_build_pdf((float *)s->pdf.texels, importance, s->width, s->height);
    fis_split_build((double *)s->table.sums, importance, s->width, s->height);
}

static inline void study_end(study *s) {
    free((float *)s->pdf.texels);
    free((float *)s->lights.texels);
    free((double *)s->table.sums);
    free(s->light);
}

static inline void study_kernels(study *s, int method, int n, study_kernel *kernels) {
    fis_cell *cells = (fis_cell *)malloc((size_t)n * sizeof *cells);
    int i;
    s->reads = study_reads;
    if (method == STUDY_SPLIT) fis_split(&s->table, n, cells);
    s->reads = study_reads - s->reads;
    for (i = 0; i < n; i++) {
        study_kernel *k = kernels + i;
        double half_width, half_height;
        unsigned long before;
        memset(k, 0, sizeof *k);
        if (method == STUDY_SPLIT) {
            k->cell = cells[i];
            continue;
        }
        k->at = fis_warp(&s->pdf, fis_lattice(i, n));
        before = study_reads;
        if (method == STUDY_NEAREST) k->level = fis_level_density_nearest(&s->pdf, &k->at, n, 1);
        if (method == STUDY_DENSITY) k->level = fis_level_density(&s->pdf, &k->at, n, 1);
        if (method == STUDY_BISECTION) k->level = fis_level_bisect(&s->pdf, &k->at, n, 1, 12);
        if (method == STUDY_FAST) k->level = fis_level(&s->pdf, &k->at, n, 1);
        s->reads += study_reads - before;
        k->scale = method == STUDY_NEAREST   ? fis_scale_density_nearest(&s->pdf, &k->at, n)
                   : method == STUDY_DENSITY ? fis_scale_density(&s->pdf, &k->at, n)
                                             : fis_scale(&s->pdf, &k->at, k->level, n);
        half_width = 0.5 * exp2((double)k->level) / s->width;
        half_height = 0.5 * exp2((double)k->level) / s->height;
        k->cell.u0 = (double)k->at.u - half_width;
        k->cell.u1 = (double)k->at.u + half_width;
        k->cell.v0 = (double)k->at.v - half_height;
        k->cell.v1 = (double)k->at.v + half_height;
    }
    free(cells);
}

/* The lights' sums in a kernel */
static inline void study_total(const study *s, int method, const study_kernel *k, float total[STUDY_CHANNELS]) {
    int c;
    if (method == STUDY_SPLIT) {
        fis_cell_sum(s->light, s->width, s->height, STUDY_CHANNELS, k->cell, total);
    } else {
        fis_fetch(&s->lights, k->at.u, k->at.v, k->level, total);
        for (c = 0; c < STUDY_CHANNELS; c++) total[c] *= k->scale;
    }
}

typedef struct {
    double reads;        /* a kernel */
    double rms, largest; /* error of the levels to the nearest solution of 002, Eq. 3; 0 for the split */
    double gap, overlap; /* part of the PDF's mass in no kernel, in several */
    double firefly;      /* the brightest kernel's power over the mean that it should have */
    double total;        /* the kernels' power over the image's */
} study_quality;

/* Point of a grid of 2 SIZE intervals: the first at or after a coordinate */
static inline int study_grid(double coordinate, int size) {
    double x = ceil(clamped(coordinate, 0, 1) * 2 * size - 0.5);
    return x < 0 ? 0 : x > 2 * size ? 2 * size : (int)x;
}

/* How much of the PDF is in no kernel, and in several: of four points a texel */
static inline void study_coverage(const study *s, const study_kernel *kernels, int n, double *gap, double *overlap) {
    int width = 2 * s->width, height = 2 * s->height, row = width + 1, i, x, y;
    int *change = (int *)calloc((size_t)row * (size_t)(height + 1), sizeof *change); /* of the number of kernels */
    double total = 0;
    for (i = 0; i < n; i++) {
        int x0 = study_grid(kernels[i].cell.u0, s->width), x1 = study_grid(kernels[i].cell.u1, s->width);
        int y0 = study_grid(kernels[i].cell.v0, s->height), y1 = study_grid(kernels[i].cell.v1, s->height);
        change[y0 * row + x0]++;
        change[y0 * row + x1]--;
        change[y1 * row + x0]--;
        change[y1 * row + x1]++;
    }
    *gap = *overlap = 0;
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            double mass = (double)s->importance[y / 2 * s->width + x / 2];
            int *kernels_here = change + y * row + x;
            if (x) kernels_here[0] += kernels_here[-1];
            if (y) kernels_here[0] += kernels_here[-row];
            if (x && y) kernels_here[0] -= kernels_here[-row - 1];
            total += mass;
            if (*kernels_here == 0) *gap += mass;
            if (*kernels_here > 1) *overlap += mass;
        }
    }
    *gap /= total;
    *overlap /= total;
    free(change);
}

static inline study_quality study_measure(const study *s, int method, const study_kernel *kernels, int n) {
    study_quality q;
    reference r = make_reference(s->importance, s->width, s->height);
    double truth = ldexp((double)s->lights.texels[s->lights.offset[s->lights.levels - 1] * STUDY_CHANNELS],
                         2 * (s->lights.levels - 1));
    int i;
    memset(&q, 0, sizeof q);
    q.reads = (double)s->reads / n;
    study_coverage(s, kernels, n, &q.gap, &q.overlap);
    for (i = 0; i < n; i++) {
        double level = (double)kernels[i].level, error;
        float total[STUDY_CHANNELS];
        study_total(s, method, kernels + i, total);
        q.total += (double)total[0] / truth;
        q.firefly = fmax(q.firefly, n * (double)total[0] / truth);
        if (method == STUDY_SPLIT) continue;
        error = fabs(level - nearest_root(&r, (double)kernels[i].at.u, (double)kernels[i].at.v, 1.0 / n, level));
        q.rms += error * error / n;
        q.largest = fmax(q.largest, error);
    }
    q.rms = sqrt(q.rms);
    free_reference(r);
    return q;
}

/* ---- flicker ---- */

/* How much the light that receivers get from a plane of lights varies over frames: standard deviation over mean, root
   mean square of the receivers, for each method. The plane's power stays; its importance gets fresh noise each frame,
   like a bidirectional RSM's. Every kernel is a light at its centre of power. */
static inline void study_flicker(int side, int n, int frames, double flicker[STUDY_METHODS]) {
    enum { RECEIVERS = 8 };
    static double sums[STUDY_METHODS][RECEIVERS * RECEIVERS][2];
    study_kernel *kernels = (study_kernel *)malloc((size_t)n * sizeof *kernels);
    float *power = make_image(OCTAVES, side, side, 1), *noise = 0;
    study s = study_begin(power, power, side, side);
    int frame, method, i, x, y;
    memset(sums, 0, sizeof sums);
    for (frame = 0; frame < frames; frame++) {
        free(noise);
        noise = make_image(BRSM, side, side, 100 + (unsigned long long)frame);
        for (i = 0; i < side * side; i++) noise[i] *= power[i];
        study_renew(&s, noise);
        for (method = 0; method < STUDY_METHODS; method++) {
            double light[RECEIVERS * RECEIVERS] = {0};
            study_kernels(&s, method, n, kernels);
            for (i = 0; i < n; i++) {
                float total[STUDY_CHANNELS];
                double u, v;
                study_total(&s, method, kernels + i, total);
                u = (double)total[1] / (double)total[0];
                v = (double)total[2] / (double)total[0];
                for (y = 0; y < RECEIVERS; y++) {
                    for (x = 0; x < RECEIVERS; x++) { /* a quarter of the plane's width above it */
                        double dx = (x + 0.5) / RECEIVERS - u, dy = (y + 0.5) / RECEIVERS - v, z = 0.25;
                        double squared = dx * dx + dy * dy + z * z;
                        light[y * RECEIVERS + x] += (double)total[0] * z * z / (squared * squared);
                    }
                }
            }
            for (i = 0; i < RECEIVERS * RECEIVERS; i++) {
                sums[method][i][0] += light[i];
                sums[method][i][1] += light[i] * light[i];
            }
        }
    }
    for (method = 0; method < STUDY_METHODS; method++) {
        flicker[method] = 0;
        for (i = 0; i < RECEIVERS * RECEIVERS; i++) {
            double mean = sums[method][i][0] / frames, variance = sums[method][i][1] / frames - mean * mean;
            flicker[method] += variance * frames / (frames - 1) / (mean * mean) / (RECEIVERS * RECEIVERS);
        }
        flicker[method] = sqrt(flicker[method]);
    }
    study_end(&s);
    free(noise);
    free(power);
    free(kernels);
}

#endif
