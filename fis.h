/*
 fis.h - filtered importance sampling of 2D images, and their division into cells of equal mass, version 1.0.0

   #include "fis.h"

   float *memory = malloc(fis_pyramid_size(512, 512, 1) * sizeof(float)); // the caller's; light likewise
   fis_pyramid pdf = fis_build_pdf(memory, importance, 512, 512);         // light = fis_build(..., 16 channels)
   for (int i = 0; i < 1024; i++) {
       fis_sample s = fis_warp(&pdf, fis_lattice(i, 1024));               // a kernel's centre,
       float level = fis_level(&pdf, &s, 1024, 1), mean[16];              // its size,
       float scale = fis_scale(&pdf, &s, level, 1024);                    // and what makes totals of means:
       fis_fetch(&light, s.u, s.v, level, mean);                          // scale * mean[c] is channel c's total
   }

 Configuration, before inclusion:

   macro         | default       | effect
   LOBE_API      | static inline | linkage of every function, with inline
   LOBE_ASSERT   | nothing       | called with each domain condition, e.g. assert
   LOBE_FIS_READ | its argument  | every texel that a lookup reads, and entry of a table that fis_split does, e.g. to count

 Conventions: u and v in [0, 1] run over the width and height of the image; texel (x, y) is
 image[(y * width + x) * channels + channel] and its centre u = (x + 0.5) / width. A texel of level l covers
 2^l by 2^l texels of the image. Its value is their sum over 4^l, where texels beyond the image's border count as 0:
 a mean inside the image, and everywhere 4^l times it is a total. A total is a sum over texels. M is the number of
 texels of the image, N or n the number of samples. The top level is one texel. Errors of what is computed from a
 pyramid are stated for the texels that it has, which fis_build has rounded.

 Images are 1 to 32768 texels wide and high. Texels that are infinite, NaN or 2^96 (7.9e28) and more in magnitude
 count as 0. In a PDF so do negative ones and those below 2^-96 (1.3e-29), and a PDF without any mass is uniform.
 Other arguments must be finite: what is not leads to any number, but to no texel outside of the image, save with
 -ffast-math, which knows no NaN. Out of any image comes no NaN and no infinity.

 Functions:

   fis_levels, fis_pyramid_size     what a pyramid takes
   fis_build, fis_build_pdf         mean pyramid of an image; of a PDF
   fis_fetch                        trilinear lookup
   fis_lattice                      Fibonacci lattice
   fis_warp                         a point to a texel, with the PDF's probability
   fis_level                        kernel size that holds k / n of the PDF: fast
   fis_level_bisect                 the same by bisection, as published
   fis_level_density, _nearest      kernel size from the PDF at the centre
   fis_scale                        from a fetched mean to the kernel's total, for the first two
   fis_scale_density, _nearest      for the last two
   fis_split_size, fis_split_build  summed-area table of a PDF
   fis_split                        division of the image into cells of equal mass
   fis_cell_sum                     total of every channel in a cell

 Papers named in the sources: 000 and 002 are Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual
 Spherical Gaussian Lights (000 the supplement).
*/
#ifndef LOBE_FIS_H
#define LOBE_FIS_H

#ifndef LOBE_VERSION
#define LOBE_VERSION 10000 /* 10000 major + 100 minor + patch */
#elif LOBE_VERSION != 10000
#error "headers of different versions of Lobe"
#endif

#include <math.h>
#include <string.h>

#ifndef LOBE_API
#define LOBE_API static inline
#endif
#ifndef LOBE_ASSERT
#define LOBE_ASSERT(condition) ((void)0)
#endif
#ifndef LOBE_FIS_READ
#define LOBE_FIS_READ(value) (value)
#endif

/* What C++ has under another name or not at all. It spares lobe_fis_halve checks that cost more than a short row. */
#if defined(__GNUC__) || defined(_MSC_VER)
#define LOBE_FIS_RESTRICT __restrict
#elif defined(__cplusplus)
#define LOBE_FIS_RESTRICT
#else
#define LOBE_FIS_RESTRICT restrict
#endif

/* ---- types ---- */

enum { LOBE_FIS_LEVELS = 16, LOBE_FIS_SIDE = 32768 }; /* at most */

typedef struct fis_pyramid {
    const float *texels; /* level 0 first; the caller's memory */
    int width, height, channels, levels;
    int offset[LOBE_FIS_LEVELS]; /* where each level starts, in texels */
} fis_pyramid;

typedef struct fis_point {
    float u, v;
} fis_point;

typedef struct fis_sample {
    float u, v;                   /* kernel centre */
    float density;                /* PDF of its texel over the PDF's mean */
    float share[LOBE_FIS_LEVELS]; /* of the PDF's total, in the texel of each level that it lies in */
} fis_sample;

typedef struct fis_split_table {
    const double *sums; /* (width + 1) by (height + 1); the caller's memory */
    int width, height;
} fis_split_table;

typedef struct fis_cell {
    double u0, v0, u1, v1;
} fis_cell;

/* ---- small numerics ---- */

LOBE_API float lobe_fis_clamp(float x, float low, float high) {
    return x > low ? (x < high ? x : high) : low; /* low for NaN: an index stays one */
}

/* x, or 0 where it is not below 2^96 in magnitude. On bits, since -ffast-math knows no infinities, and as signed
   numbers, which vectors compare in one instruction. */
LOBE_API float lobe_fis_clean(float x) {
    int bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits & 0x7FFFFFFF) < 0x6F800000 ? x : 0;
}

/* x, or 0 where it is not in [2^-96, 2^96), whose bits are the sums from -2^31 to -2^29 */
LOBE_API float lobe_fis_clean_pdf(float x) {
    unsigned bits;
    memcpy(&bits, &x, sizeof bits);
    return (int)(bits + 0x70800000u) < -0x20000000 ? x : 0;
}

/* 4^level */
LOBE_API float lobe_fis_area(int level) {
    return (float)(1u << 2 * level);
}

/* 2^-level; on bits, since -ffast-math may make an inexact reciprocal of a division */
LOBE_API float lobe_fis_shrink(int level) {
    unsigned bits = (unsigned)(127 - level) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

/* ceil(size / 2^level) */
LOBE_API int lobe_fis_size(int size, int level) {
    return ((size - 1) >> level) + 1;
}

/* ---- pyramids ---- */

/*
 fis_levels - number of levels of a pyramid

   width, height   [1, 32768]
   returns         1 + ceil(log2 of the larger), at most 16

   Rounding: exact
   Model:    exact
   Source:   each level has half of the last one's size, rounded up
*/
LOBE_API int fis_levels(int width, int height) {
    int levels = 1;
    LOBE_ASSERT(width >= 1 && width <= LOBE_FIS_SIDE && height >= 1 && height <= LOBE_FIS_SIDE);
    while (levels < LOBE_FIS_LEVELS && (lobe_fis_size(width, levels - 1) > 1 || lobe_fis_size(height, levels - 1) > 1))
        levels++;
    return levels;
}

/* A pyramid without its texels */
LOBE_API fis_pyramid lobe_fis_layout(int width, int height, int channels) {
    fis_pyramid p;
    int level;
    memset(&p, 0, sizeof p);
    p.width = width;
    p.height = height;
    p.channels = channels;
    p.levels = fis_levels(width, height);
    for (level = 1; level < p.levels; level++)
        p.offset[level] = p.offset[level - 1] + lobe_fis_size(width, level - 1) * lobe_fis_size(height, level - 1);
    return p;
}

/* count * channels numbers of a size; more than any allocation gives where their bytes exceed a size_t */
LOBE_API size_t lobe_fis_numbers(size_t count, size_t channels, size_t size) {
    return count <= (size_t)-1 / size / channels ? count * channels : (size_t)-1;
}

/*
 fis_pyramid_size - memory that a pyramid takes

   width, height   [1, 32768]
   channels        1 or more
   returns         number of floats, all levels together; the largest size_t where memory cannot hold them

   Rounding: exact
   Model:    exact
   Source:   fis_levels
*/
LOBE_API size_t fis_pyramid_size(int width, int height, int channels) {
    fis_pyramid p = lobe_fis_layout(width, height, channels);
    size_t texels = (size_t)p.offset[p.levels - 1] + 1; /* the top level is one texel */
    return lobe_fis_numbers(texels, (size_t)channels, sizeof(float));
}

/* One row of a level from two of the level below, or from one: there is no second one where bottom == top. */
LOBE_API void lobe_fis_halve(float *LOBE_FIS_RESTRICT halved, const float *top, const float *bottom, int width,
                             int channels) {
    float scale = bottom != top ? 0.25f : 0.125f;
    int pairs = width / 2, x, c;
    if (channels == 1) { /* vector code along the row, otherwise along the channels */
        for (x = 0; x < pairs; x++)
            halved[x] = scale * ((top[2 * x] + bottom[2 * x]) + (top[2 * x + 1] + bottom[2 * x + 1]));
        halved += pairs;
        top += 2 * pairs;
        bottom += 2 * pairs;
    } else {
        for (x = 0; x < pairs; x++) {
            for (c = 0; c < channels; c++)
                halved[c] = scale * ((top[c] + bottom[c]) + (top[channels + c] + bottom[channels + c]));
            halved += channels;
            top += 2 * channels;
            bottom += 2 * channels;
        }
    }
    if (width % 2)
        for (c = 0; c < channels; c++) halved[c] = scale * (top[c] + bottom[c]);
}

/* Every level from the image, which may be the memory's. Two rows of a level are halved as soon as they are there, while
   they are in the cache. */
LOBE_API void lobe_fis_fill(const fis_pyramid *p, float *memory, const float *image, int is_pdf) {
    size_t channels = (size_t)p->channels, count = (size_t)p->width * channels, i;
    int y;
    for (y = 0; y < p->height; y++) {
        const float *from = image + (size_t)y * count;
        float *to = memory + (size_t)y * count;
        int level, row = y; /* the level's last one so far */
        if (is_pdf)
            for (i = 0; i < count; i++) to[i] = lobe_fis_clean_pdf(from[i]);
        else if (from != to)
            for (i = 0; i < count; i++) to[i] = lobe_fis_clean(from[i]);
        else /* vector code, which that would not be here: its rows must not be the same */
            for (i = 0; i < count; i++) to[i] = lobe_fis_clean(to[i]);
        for (level = 0; level + 1 < p->levels; level++) {
            int width = lobe_fis_size(p->width, level), height = lobe_fis_size(p->height, level);
            size_t size = (size_t)width * channels, half = (size_t)lobe_fis_size(width, 1) * channels;
            const float *bottom = memory + (size_t)p->offset[level] * channels + (size_t)row * size;
            const float *top = row % 2 ? bottom - size : bottom;
            if (top == bottom && row + 1 < height) break;
            row /= 2;
            lobe_fis_halve(memory + (size_t)p->offset[level + 1] * channels + (size_t)row * half, top, bottom, width,
                           p->channels);
        }
    }
}

/*
 fis_build - mean pyramid of an image

   memory     fis_pyramid_size floats, that stay as long as the pyramid is used; fastest at a multiple of 64 bytes
   image      interleaved, any sign; may be the same as memory
   channels   1 or more
   returns    the pyramid in memory. Bad texels: see the head of this file

   Rounding: 4^l times the top texel is the image's sum to 2 (levels - 1) 2^-24 of the sum of magnitudes at the worst
             [bound fis_build levels 2]; of noise, up to 32768 by 1 and 1920 by 1088 texels, to 2e-7
             [bound fis_build rel 2e-7]. Half as much more with -ffast-math, which may add in another order
   Model:    exact
   Source:   box filter, sizes rounded up and missing texels 0, so that no texel of an odd size is lost
*/
LOBE_API fis_pyramid fis_build(float *memory, const float *image, int width, int height, int channels) {
    fis_pyramid p = lobe_fis_layout(width, height, channels);
    lobe_fis_fill(&p, memory, image, 0);
    p.texels = memory;
    return p;
}

/* The PDF's total, [2^-96, 2^126] */
LOBE_API float lobe_fis_total(const fis_pyramid *pdf) {
    return pdf->texels[pdf->offset[pdf->levels - 1]] * lobe_fis_area(pdf->levels - 1);
}

/*
 fis_build_pdf - pyramid of a PDF, which need not be normalised

   memory     fis_pyramid_size(width, height, 1) floats, that stay as long as the pyramid is used
   image      one channel; may be the same as memory
   returns    the pyramid in memory. Bad texels: see the head of this file. No mass at all: every texel is 1

   Rounding: as fis_build, of noise to 2.5e-7   [bound fis_build_pdf rel 2.5e-7]
   Model:    exact
   Source:   002, section 3
*/
LOBE_API fis_pyramid fis_build_pdf(float *memory, const float *image, int width, int height) {
    fis_pyramid p = lobe_fis_layout(width, height, 1);
    size_t i, count = (size_t)width * (size_t)height;
    p.texels = memory;
    lobe_fis_fill(&p, memory, image, 1);
    if (!(lobe_fis_total(&p) > 0)) {
        for (i = 0; i < count; i++) memory[i] = 1;
        lobe_fis_fill(&p, memory, memory, 1);
    }
    return p;
}

/* The four texels around a position and where it lies between their centres */
typedef struct lobe_fis_taps {
    const float *texel[4]; /* left and right above, left and right below */
    float x, y;
} lobe_fis_taps;

LOBE_API lobe_fis_taps lobe_fis_locate(const fis_pyramid *p, float u, float v, int level) {
    lobe_fis_taps taps;
    int width = lobe_fis_size(p->width, level), height = lobe_fis_size(p->height, level);
    float scale = lobe_fis_shrink(level);
    float x = lobe_fis_clamp(u * (float)p->width * scale - 0.5f, 0, (float)(width - 1));
    float y = lobe_fis_clamp(v * (float)p->height * scale - 0.5f, 0, (float)(height - 1));
    int column = (int)x, row = (int)y;
    size_t channels = (size_t)p->channels;
    size_t right = column + 1 < width ? channels : 0, below = row + 1 < height ? (size_t)width * channels : 0;
    taps.texel[0] = p->texels + ((size_t)p->offset[level] + (size_t)row * (size_t)width + (size_t)column) * channels;
    taps.texel[1] = taps.texel[0] + right;
    taps.texel[2] = taps.texel[0] + below;
    taps.texel[3] = taps.texel[2] + right;
    taps.x = x - (float)column;
    taps.y = y - (float)row;
    return taps;
}

LOBE_API float lobe_fis_mix(float a, float b, float t) {
    return a + (b - a) * t;
}

LOBE_API float lobe_fis_bilinear(const lobe_fis_taps *taps, int channel) {
    float a = LOBE_FIS_READ(taps->texel[0][channel]), b = LOBE_FIS_READ(taps->texel[1][channel]);
    float c = LOBE_FIS_READ(taps->texel[2][channel]), d = LOBE_FIS_READ(taps->texel[3][channel]);
    return lobe_fis_mix(lobe_fis_mix(a, b, taps->x), lobe_fis_mix(c, d, taps->x), taps->y);
}

/*
 fis_fetch - trilinear lookup: every channel's mean around a position

   u, v       clamped to the centres of the border's texels
   level      clamped to [0, levels - 1]; between two levels, linear in their values
   result     as many floats as the pyramid has channels

   Rounding: <= 2 (width + height + 4) 2^-24 of the largest magnitude near: position is good to 2^-23 of the image
             [bound fis_fetch position 2]
   Model:    a tent instead of a box; the values of levels above 0 near an odd border are diluted, see the conventions
   Source:   002, section 3
*/
LOBE_API void fis_fetch(const fis_pyramid *p, float u, float v, float level, float *result) {
    float clamped = lobe_fis_clamp(level, 0, (float)(p->levels - 1));
    int fine = (int)clamped, coarse = fine + 1 < p->levels ? fine + 1 : fine, c;
    lobe_fis_taps a = lobe_fis_locate(p, u, v, fine), b = lobe_fis_locate(p, u, v, coarse);
    for (c = 0; c < p->channels; c++)
        result[c] = lobe_fis_mix(lobe_fis_bilinear(&a, c), lobe_fis_bilinear(&b, c), clamped - (float)fine);
}

/* ---- samples ---- */

/*
 fis_lattice - point of the Fibonacci lattice: stratified in both coordinates

   i, n       0 <= i < n
   returns    ((i + 0.5) / n, the fraction of i times the golden ratio), both in [0, 1)

   Rounding: u to 2^-24; v rounded down to a multiple of 2^-24, for every i   [bound fis_lattice abs 6e-8]
   Model:    exact
   Source:   Sloan and Joe 1994; 002, section 5
*/
LOBE_API fis_point fis_lattice(int i, int n) {
    fis_point point;
    unsigned whole = (unsigned)i, high = whole >> 16, low = whole & 0xFFFFu;
    /* The golden ratio's fraction is 0x9E3779B97F4A7C15 / 2^64; these are bits 32 to 63 of i times the numerator. */
    unsigned carry = low * 0x7F4Au + high * 0x7C15u + (low * 0x7C15u >> 16);
    unsigned fraction = whole * 0x9E3779B9u + high * 0x7F4Au + (carry >> 16);
    LOBE_ASSERT(i >= 0 && i < n);
    point.u = lobe_fis_clamp((float)(((double)i + 0.5) / (double)n), 0, 0.99999994f);
    point.v = (float)(fraction >> 8) * (1.0f / 16777216.0f);
    return point;
}

/* Which of two masses a number in [0, 1) falls into; the number becomes its position in there, in [0, 1) again. It
   cannot be one of 0: number * first rounds to less than first for every number below 1. */
LOBE_API int lobe_fis_choose(float *number, float first, float second) {
    float mass = *number * (first + second);
    int chosen = mass >= first;
    float skipped = chosen ? first : 0, kept = chosen ? second : first;
    *number = lobe_fis_clamp((mass - skipped) / kept, 0, 0.99999994f);
    return chosen;
}

/*
 fis_warp - turns a uniform point into a position with the PDF's probability

   pdf        of fis_build_pdf
   place      clamped to [0, 1)
   returns    position in (0, 1), in a texel whose mass is not 0, and what fis_level needs to know about it. It is
              kept (width 2^-21, height 2^-21) of a texel off the texel's border, so that u * width stays in the texel

   Rounding: density and shares to 1e-6 relative   [bound fis_warp rel 1e-6]. The probability of a texel to 2^-23 of
             each ancestor's, as if the point had been moved by that much
   Model:    exact; stratified points stay stratified
   Source:   Clarberg et al. 2005, hierarchical sample warping; 002, section 3
*/
LOBE_API fis_sample fis_warp(const fis_pyramid *pdf, fis_point place) {
    fis_sample s;
    float u = lobe_fis_clamp(place.u, 0, 0.99999994f), v = lobe_fis_clamp(place.v, 0, 0.99999994f);
    float total = lobe_fis_total(pdf), margin;
    int x = 0, y = 0, level;
    memset(&s, 0, sizeof s);
    s.share[pdf->levels - 1] = 1;
    for (level = pdf->levels - 2; level >= 0; level--) {
        int width = lobe_fis_size(pdf->width, level), height = lobe_fis_size(pdf->height, level);
        int right = 2 * x + 1 < width, below = 2 * y + 1 < height;
        const float *top = pdf->texels + pdf->offset[level] + (size_t)(2 * y) * (size_t)width + 2 * x;
        float a = top[0], b = right ? top[1] : 0, c = below ? top[width] : 0, d = right && below ? top[width + 1] : 0;
        below = lobe_fis_choose(&v, a + b, c + d);
        a = below ? c : a;
        b = below ? d : b;
        right = lobe_fis_choose(&u, a, b);
        x = 2 * x + right;
        y = 2 * y + below;
        s.share[level] = (right ? b : a) / total * lobe_fis_area(level);
    }
    margin = (float)pdf->width * (1.0f / 2097152.0f);
    s.u = ((float)x + lobe_fis_clamp(u, margin, 1 - margin)) / (float)pdf->width;
    margin = (float)pdf->height * (1.0f / 2097152.0f);
    s.v = ((float)y + lobe_fis_clamp(v, margin, 1 - margin)) / (float)pdf->height;
    s.density = s.share[0] * ((float)pdf->width * (float)pdf->height);
    return s;
}

/* ---- kernel sizes ---- */

/* Share of the PDF's total in the kernel of an integer level: 4^l p / M, p normalised */
LOBE_API float lobe_fis_share(const fis_pyramid *pdf, const fis_sample *s, int level) {
    lobe_fis_taps taps = lobe_fis_locate(pdf, s->u, s->v, level);
    return lobe_fis_bilinear(&taps, 0) / lobe_fis_total(pdf) * lobe_fis_area(level);
}

/* The root t in [0, 1] of 4^t (a + t (b - a)) = 1, where a < 1 <= 4 b. Written a + t (b - a) - 4^-t = 0, the left side
   is concave, negative at 0 and not at 1, so there is one. 4^-t is close to the parabola through its values at 0, 1/2
   and 1, which gives the start; then each step solves the parabola that touches the curve. That converges at a double
   root too, where Newton's method would crawl. Error after 0, 1, 2, 3 steps: .2, .04, 5e-4, 5e-8 at most. */
LOBE_API float lobe_fis_root(float a, float b) {
    float slope = b - a + 1.25f, squared, t;
    int step;
    squared = slope * slope - 2 * (1 - a);
    t = 2 * (1 - a) / (slope + sqrtf(squared > 0 ? squared : 0));
    for (step = 0; step < 3; step++) {
        float power = exp2f(-2 * t), value = a + t * (b - a) - power;
        slope = b - a + 1.38629436f * power;
        squared = slope * slope + 3.84362411f * value * power;                /* 2 ln(4)^2 */
        t -= 2 * value / (slope + sqrtf(squared > 0 ? squared : 0) + 1e-20f); /* both 0: double root */
    }
    return lobe_fis_clamp(t, 0, 1);
}

/*
 fis_level - size of the kernel that holds k / n of the PDF's total: fast

   pdf, s     a sample of this PDF by fis_warp
   n          number of samples, 1 or more
   k          kernel size in shares of a sample, [1e-6, 1e6]; above 1 blurs more
   returns    level in [0, levels - 1]; the lower end where even one texel holds more, the upper where all holds less

   Rounding: share of the kernel to 5e-7 relative, besides moving the kernel by 2^-23 of the image and the level by its
             last bit   [bound fis_level residual 5e-7]
             Where there is one solution, levels to 2e-6 (root mean square)   [bound fis_level rms 2e-6]; over hard
             equations, with jumps of up to 1e8 or 1e-5 from a double root, to 1e-5   [bound fis_level stress 1e-5]; at a
             double root, where rounding moves the solution most, to 1e-3   [bound fis_level worst 1e-3]
   Model:    a solution of 002, Eq. 3, with the trilinear lookup as the mean in the kernel. Its left side is not always
             monotone (the integral that it stands for is): where it has more than one solution this one is close to the
             size of the ancestor that holds k / n, and bisection may find another
   Source:   002, Eq. 3. The ancestors that fis_warp came through tell the level to within about one, so two or three
             bilinear lookups, 9 texels on average   [bound fis_level reads 9], do instead of the 24 of 12 bisections
*/
LOBE_API float fis_level(const fis_pyramid *pdf, const fis_sample *s, int n, float k) {
    float wanted = k / (float)n, below, above;
    int top = pdf->levels - 1, low = 0, high;
    LOBE_ASSERT(n >= 1 && k > 0);
    while (low < top && s->share[low + 1] < wanted) low++;
    high = low;
    below = above = lobe_fis_share(pdf, s, low);
    while (below >= wanted) {
        if (low == 0) return 0;
        high = low;
        above = below;
        below = lobe_fis_share(pdf, s, --low);
    }
    while (above < wanted) {
        if (high == top) return (float)top;
        low = high;
        below = above;
        above = lobe_fis_share(pdf, s, ++high);
    }
    return (float)low + lobe_fis_root(below / wanted, 0.25f * above / wanted);
}

/* Trilinear lookup of the PDF over its total */
LOBE_API float lobe_fis_relative(const fis_pyramid *pdf, const fis_sample *s, float level) {
    float value = 0;
    LOBE_ASSERT(pdf->channels == 1);
    fis_fetch(pdf, s->u, s->v, level, &value);
    return value / lobe_fis_total(pdf);
}

/*
 fis_level_bisect - size of the kernel that holds k / n of the PDF's total: as published

   pdf, s     a sample of this PDF
   n, k       as fis_level
   iterations the paper has 12; each halves the error and takes a trilinear lookup. 0 or more
   returns    level in (0, levels - 1): the middle of the last interval, so the ends are approached and not reached

   Rounding: after 60 iterations, where there is one solution, as fis_level   [bound fis_level_bisect residual 5e-7]
   Model:    (levels - 1) / 2^(iterations + 1) at most; as fis_level where there is more than one solution
   Source:   000, Algorithm 1; 002, Eq. 3
*/
LOBE_API float fis_level_bisect(const fis_pyramid *pdf, const fis_sample *s, int n, float k, int iterations) {
    float low = 0, high = (float)(pdf->levels - 1), wanted = k / (float)n;
    LOBE_ASSERT(n >= 1 && k > 0);
    for (; iterations > 0; iterations--) {
        float level = 0.5f * (low + high);
        if (exp2f(2 * level) * lobe_fis_relative(pdf, s, level) < wanted)
            low = level;
        else
            high = level;
    }
    return 0.5f * (low + high);
}

LOBE_API float lobe_fis_texels(const fis_pyramid *p) {
    return (float)p->width * (float)p->height;
}

/* 002, Eq. 1 with the PDF p, whose mean is 1 */
LOBE_API float lobe_fis_density_level(const fis_pyramid *pdf, float p, int n, float k) {
    float expected = (float)n * p, area = lobe_fis_texels(pdf) * (k / (expected > k ? expected : k));
    LOBE_ASSERT(n >= 1 && k > 0);
    return area > 1 ? 0.5f * log2f(area) : 0;
}

/*
 fis_level_density - kernel size from the PDF at the centre, read bilinearly

   pdf, s     a sample of this PDF
   n, k       as fis_level; Krivanek and Colbert have k = 4, the papers 1
   returns    level in [0, log4 M]; M, not the top level, bounds a kernel here: they differ in images that are not
              square with a power of two for a side

   Rounding: levels to 1e-6 and that of the lookup's position   [bound fis_level_density abs 1e-6]
   Model:    as if the PDF were constant in the kernel: gaps and overlaps where it is not
   Source:   Krivanek and Colbert 2008; 002, Eq. 1
*/
LOBE_API float fis_level_density(const fis_pyramid *pdf, const fis_sample *s, int n, float k) {
    return lobe_fis_density_level(pdf, lobe_fis_share(pdf, s, 0) * lobe_fis_texels(pdf), n, k);
}

/*
 fis_level_density_nearest - the same from the PDF of the sample's texel: worse on noise

   Rounding: levels to 1e-6   [bound fis_level_density_nearest abs 1e-6]
   Model:    as fis_level_density; one dark texel makes a kernel that is too large
   Source:   002, Eq. 1
*/
LOBE_API float fis_level_density_nearest(const fis_pyramid *pdf, const fis_sample *s, int n, float k) {
    return lobe_fis_density_level(pdf, s->density, n, k);
}

/* ---- from means to totals ---- */

/*
 fis_scale - the factor that makes a kernel's total of a fetched mean

   pdf, s     a sample of this PDF
   level      at which the mean is fetched: of fis_level or fis_level_bisect
   n          number of samples
   returns    the PDF's total / (n times the PDF's mean in the kernel); the PDF's scale does not matter. 0 where that
              mean is below 1e-36 of the total: so improbable that a sample is not there

   Rounding: with the PDF as the image, the sum over n samples of factor times mean is the PDF's total to 1e-6 relative
             [bound fis_scale rel 1e-6]. A kernel's total is at most the largest ratio of an image's texel to the PDF's,
             times the PDF's total / n, to 1e-6   [bound fis_scale firefly 1e-6]: no fireflies
   Model:    the factor is 4^level where fis_level solved its equation with k = 1. Kernels may overlap or leave gaps, so
             the sum over samples of an image unlike the PDF is only near its total. Image 1 + .5 cos of a smooth PDF,
             1024 samples: to .01   [bound fis_scale model 0.01]
   Source:   002, Eq. 5
*/
LOBE_API float fis_scale(const fis_pyramid *pdf, const fis_sample *s, float level, int n) {
    float mean = lobe_fis_relative(pdf, s, level);
    LOBE_ASSERT(n >= 1);
    return mean > 1e-36f ? 1 / ((float)n * mean) : 0;
}

/* 002, Eq. 4 with the PDF p, whose mean is 1 */
LOBE_API float lobe_fis_density_scale(const fis_pyramid *pdf, float p, int n) {
    float expected = (float)n * p;
    LOBE_ASSERT(n >= 1);
    return lobe_fis_texels(pdf) / (expected > 1 ? expected : 1);
}

/*
 fis_scale_density - the same factor from the PDF at the centre, read bilinearly

   pdf, s     a sample of this PDF
   n          number of samples
   returns    M / max(n p, 1), p the PDF over its mean; (0, M]

   Rounding: <= 1e-6 relative and that of the lookup's position   [bound fis_scale_density rel 1e-6]
   Model:    the mean is filtered and the PDF is not: fireflies where it is rough
   Source:   002, Eq. 4
*/
LOBE_API float fis_scale_density(const fis_pyramid *pdf, const fis_sample *s, int n) {
    return lobe_fis_density_scale(pdf, lobe_fis_share(pdf, s, 0) * lobe_fis_texels(pdf), n);
}

/*
 fis_scale_density_nearest - the same from the PDF of the sample's texel

   Rounding: <= 1e-6 relative   [bound fis_scale_density_nearest rel 1e-6]
   Model:    as fis_scale_density
   Source:   002, Eq. 4
*/
LOBE_API float fis_scale_density_nearest(const fis_pyramid *pdf, const fis_sample *s, int n) {
    return lobe_fis_density_scale(pdf, s->density, n);
}

/* ---- cells of equal mass ---- */

/*
 fis_split_size - memory that a summed-area table takes

   width, height   [1, 32768]
   returns         number of doubles; the largest size_t where memory cannot hold them

   Rounding: exact
   Model:    exact
   Source:   fis_split_build
*/
LOBE_API size_t fis_split_size(int width, int height) {
    LOBE_ASSERT(width >= 1 && width <= LOBE_FIS_SIDE && height >= 1 && height <= LOBE_FIS_SIDE);
    return lobe_fis_numbers((size_t)width + 1, (size_t)height + 1, sizeof(double));
}

/*
 fis_split_build - summed-area table of a PDF, which need not be normalised

   memory     fis_split_size doubles, that stay as long as the table is used
   image      one channel. Bad texels and no mass at all: as fis_build_pdf
   returns    the table in memory

   Rounding: entries to (width + height) 2^-53 of the total   [bound fis_split_build sides 1]
   Model:    exact
   Source:   Crow 1984
*/
LOBE_API fis_split_table fis_split_build(double *memory, const float *image, int width, int height) {
    fis_split_table table;
    size_t row = (size_t)width + 1;
    int x, y, uniform;
    table.sums = memory;
    table.width = width;
    table.height = height;
    for (uniform = 0; uniform < 2; uniform++) {
        memset(memory, 0, row * sizeof *memory);
        for (y = 0; y < height; y++) {
            const float *texels = image + (size_t)y * (size_t)width;
            const double *above = memory + (size_t)y * row;
            double *sums = memory + ((size_t)y + 1) * row, sum = 0;
            sums[0] = 0;
            for (x = 0; x < width; x++) {
                sum += uniform ? 1.0 : (double)lobe_fis_clean_pdf(texels[x]);
                sums[x + 1] = above[x + 1] + sum;
            }
        }
        if (memory[fis_split_size(width, height) - 1] > 0) break;
    }
    return table;
}

/* Mass of the image left of x and above y, in texels; linear in each of them within a texel, as the PDF is constant */
LOBE_API double lobe_fis_mass(const fis_split_table *table, double x, double y) {
    int column = x < table->width ? (int)x : table->width - 1, row = y < table->height ? (int)y : table->height - 1;
    const double *above = table->sums + (size_t)row * ((size_t)table->width + 1) + column;
    const double *below = above + table->width + 1;
    double a = LOBE_FIS_READ(above[0]), b = LOBE_FIS_READ(above[1]);
    double c = LOBE_FIS_READ(below[0]), d = LOBE_FIS_READ(below[1]);
    a += (b - a) * (x - column);
    c += (d - c) * (x - column);
    return a + (c - a) * (y - row);
}

/* Mass between two rows and left of x; or between two columns and above it, where vertical */
LOBE_API double lobe_fis_strip(const fis_split_table *table, int vertical, double from, double to, double x) {
    return vertical ? lobe_fis_mass(table, to, x) - lobe_fis_mass(table, from, x)
                    : lobe_fis_mass(table, x, to) - lobe_fis_mass(table, x, from);
}

/* Splits a cell, given in texels, into n; the depth is log2 n. */
LOBE_API void lobe_fis_split(const fis_split_table *table, fis_cell cell, int n, fis_cell *cells) {
    int vertical = cell.v1 - cell.v0 > cell.u1 - cell.u0, low, high;
    double from = vertical ? cell.u0 : cell.v0, to = vertical ? cell.u1 : cell.v1;   /* the cell across the cut */
    double start = vertical ? cell.v0 : cell.u0, end = vertical ? cell.v1 : cell.u1; /* and along */
    double before, after, wanted, cut;
    fis_cell first = cell, second = cell;
    if (n == 1) {
        cells->u0 = cell.u0 / table->width;
        cells->v0 = cell.v0 / table->height;
        cells->u1 = cell.u1 / table->width;
        cells->v1 = cell.v1 / table->height;
        return;
    }
    before = lobe_fis_strip(table, vertical, from, to, start);
    after = lobe_fis_strip(table, vertical, from, to, end);
    wanted = before + (after - before) * (n / 2) / n;
    low = (int)start;
    high = (int)ceil(end);
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (lobe_fis_strip(table, vertical, from, to, middle) <= wanted)
            low = middle;
        else
            high = middle;
    }
    before = lobe_fis_strip(table, vertical, from, to, low);
    after = lobe_fis_strip(table, vertical, from, to, low + 1);
    cut = low + (after > before ? (wanted - before) / (after - before) : 0);
    cut = cut < start ? start : cut > end ? end : cut;
    if (vertical)
        first.v1 = second.v0 = cut;
    else
        first.u1 = second.u0 = cut;
    lobe_fis_split(table, first, n / 2, cells);
    lobe_fis_split(table, second, n - n / 2, cells + n / 2);
}

/*
 fis_split - division of the image into n rectangles of equal mass, without gaps or overlaps

   table      of fis_split_build
   n          cells may be smaller than texels; below 1 nothing is written
   cells      n of them are written. Neighbours share their edge's coordinate exactly

   Rounding: mass of each cell to 4 (width + height) 2^-53 of the total   [bound fis_split total 4]: to 1e-6 of total / n
             for a million cells of 1920 by 1088 texels
   Model:    exact, the PDF constant in each texel
   Source:   this project's: each cut halves the number of cells and goes across the longer side, where the mass is
             halved too; replaces kernels, which cannot tile, by cells that do
*/
LOBE_API void fis_split(const fis_split_table *table, int n, fis_cell *cells) {
    fis_cell image;
    image.u0 = image.v0 = 0;
    image.u1 = table->width;
    image.v1 = table->height;
    if (n >= 1) lobe_fis_split(table, image, n, cells);
}

/* A coordinate in texels, inside the image */
LOBE_API double lobe_fis_inside(double u, int size) {
    return u > 0 ? (u < 1 ? u * size : size) : 0;
}

/* How much of [texel, texel + 1] lies in [from, to] */
LOBE_API float lobe_fis_overlap(int texel, double from, double to) {
    double low = from > texel ? from : texel, high = to < texel + 1 ? to : texel + 1;
    return high > low ? (float)(high - low) : 0;
}

/*
 fis_cell_sum - total of every channel in a cell; texels on its edge count by the part inside

   image      interleaved, any sign. Bad texels: see the head of this file
   channels   1 or more
   cell       what lies outside the image counts as 0; 0 where u0 > u1 or v0 > v1
   totals     as many floats as channels

   Rounding: <= 1e-6 of the sum of magnitudes   [bound fis_cell_sum rel 1e-6]
   Model:    exact, the image constant in each texel
   Source:   002, section 4: the total texel value in a cluster
*/
LOBE_API void fis_cell_sum(const float *image, int width, int height, int channels, fis_cell cell, float *totals) {
    double u0 = lobe_fis_inside(cell.u0, width), u1 = lobe_fis_inside(cell.u1, width);
    double v0 = lobe_fis_inside(cell.v0, height), v1 = lobe_fis_inside(cell.v1, height);
    int x0 = (int)u0, x1 = (int)ceil(u1), y0 = (int)v0, y1 = (int)ceil(v1), first, x, y, c;
    for (first = 0; first < channels; first += 16) {
        int count = channels - first < 16 ? channels - first : 16;
        double sums[16] = {0};
        for (y = y0; y < y1; y++) {
            const float *texels = image + ((size_t)y * (size_t)width + (size_t)x0) * (size_t)channels + first;
            float height_inside = lobe_fis_overlap(y, v0, v1);
            for (x = x0; x < x1; x++) {
                float inside = height_inside * lobe_fis_overlap(x, u0, u1);
                for (c = 0; c < count; c++) sums[c] += (double)(inside * lobe_fis_clean(texels[c]));
                texels += channels;
            }
        }
        for (c = 0; c < count; c++) totals[first + c] = (float)sums[c];
    }
}

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
