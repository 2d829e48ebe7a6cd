/*
 bilateral.h - weights of filters and upsamplers that know the surfaces' reflection lobes, version 0.1.0

   #include "bilateral.h"

   lobe_vec3 normal = {0, 0, 1}, viewer = {0, 0.8f, 0.6f};
   sg_lobe here = sg_ggx_lobe(normal, viewer, 0.1f), there = sg_ggx_lobe(normal, viewer, 0.2f);
   float similar = bilateral_sg_weight(here, there, 20);               // in [0, 1], 1 for equal lobes
   bilateral_sg i = bilateral_sg_prepare(here, 20), j = bilateral_sg_prepare(there, 20); // once for each pixel
   float tap = bilateral_sg_tap(-1.5f, i, j, 20);                      // the same times 2^-1.5, one exponential

 Configuration: as sg.h, which asg.h includes, which this includes.

 Conventions: a weight is in [0, 1], and 1 for equal pixels. beta, any positive number, sets how much difference is
 allowed: weights are q^beta of a similarity q; bounds hold for beta in [1e-3, 1e3]. A variance is that of a Gaussian
 exp(-|a - b|^2 / (2 variance)). The paper's smoothing kernel kappa is sg_convolve(lobe, kappa) or asg_convolve(lobe,
 kappa) before anything here; infinity smooths nothing. An exponent is one of base 2: the logarithm of all that a tap's
 weight has beside its lobes, so that a tap needs one exponential.

 A filter: prepare each pixel's lobe into planes, arrays of one number each; scale the plane of depths by
 bilateral_scale(variance); then for each tap and each pixel of a row

   exponent = log2(kernel) + bilateral_depth_exponent(depth_i, depth_j)
   weight = bilateral_sg_tap(exponent, lobe_i, lobe_j, beta)

 and sum weight and weight times colour; the quotient is the filtered colour. Such a loop becomes vector code, see sg.h.
 Where the total weight over that of the kernel is below a threshold (the paper's 0.25), recompute the pixel. All weights
 are symmetric: each may be used for both pixels, which bilateral_pairs_add does.

 Functions:

   bilateral_depth_weight           Eq. 3
   bilateral_normal_weight          Eq. 4, the usual filter, which knows no lobes
   bilateral_gaussian_weight        section 3: guides with a variance of their own
   bilateral_sg_weight              Eq. 12: a lobe each
   bilateral_sg_mixture_weight      Eq. 11: several lobes each
   bilateral_asg_weight             Eq. 13: an anisotropic lobe each
   bilateral_merge                  several lobes as one, for Eq. 12
   bilateral_scale                  what planes of depths, normals and other guides are multiplied by
   bilateral_depth_exponent         of scaled depths
   bilateral_normal_tap             of scaled normals
   bilateral_sg_prepare, _tap, _tap_power
   bilateral_asg_prepare, _tap
   bilateral_sg_mixture_prepare, _pair, _tap
   bilateral_pairs_add              both pixels of each pair of a row
   bilateral_footprint              2 x 2 taps around a position: upsampling, reprojection
   bilateral_footprint_weights      the same with the taps' similarities
   bilateral_history_share          of a reprojected sample beside a new one

 Papers named in the sources: 004 is Tokuyoshi 2015, Specular Lobe-Aware Filtering and Upsampling for Interactive
 Indirect Illumination.
*/
#ifndef LOBE_BILATERAL_H
#define LOBE_BILATERAL_H

#include "asg.h"

#ifdef __clang__ /* as in asg.h */
#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)
#endif

/* ---- types ---- */

/* A pixel's lobe for Eq. 12: four planes. */
typedef struct bilateral_sg {
    lobe_vec3 axis; /* times bilateral_scale(1 / beta) */
    float width;    /* 1 / sharpness */
} bilateral_sg;

/* One of a pixel's lobes for Eq. 11: six planes. */
typedef struct bilateral_sg_part {
    lobe_vec3 axis;
    float sharpness, amplitude; /* so that the mixture's product with itself integrates to 1 */
    float tail;                 /* exp(-2 sharpness) */
} bilateral_sg_part;

/* A pixel's lobe for Eq. 13: thirteen planes. */
typedef struct bilateral_asg {
    lobe_vec3 x, y, z;
    float sharpness_x, sharpness_y;
    float own_exponent, own_scale; /* of the lobe's product with itself */
} bilateral_asg;

/* ---- private helpers ---- */

/* log2 x for x from 2^-126, which counts as at most 1: then 0.   [bound lobe_bilateral_log2 abs 4e-7] */
LOBE_API float lobe_bilateral_log2(float x) {
    int bits, power;
    float f, f2, slope;
    x = lobe_at_most(x, 1);
    memcpy(&bits, &x, sizeof bits);
    power = (bits - 0x3F3504F3) & ~0x007FFFFF; /* as lobe_log */
    bits -= power;
    memcpy(&f, &bits, sizeof f);
    f -= 1;
    f2 = f * f;
    slope = (1.44269973f - 0.721375871f * f) +
            f2 * ((0.480465014f - 0.358961895f * f) + f2 * ((0.297262908f - 0.272697535f * f) + f2 * 0.170632825f));
    return 1.1920929e-7f * (float)power + f * slope;
}

/* x^n for n in 0 .. 15 */
LOBE_API float lobe_bilateral_power(float x, int n) {
    float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return (n & 1 ? x : 1) * (n & 2 ? x2 : 1) * ((n & 4 ? x4 : 1) * (n & 8 ? x8 : 1));
}

/* The overlap 4 ti tj / (ti + tj)^2 of two widths, given 1 / (ti + tj), so much too large that it is at least 1 for equal
   ones. */
LOBE_API float lobe_bilateral_overlap(float ti, float tj, float inverse) {
    return 4.00000191f * (ti * inverse) * (tj * inverse);
}

LOBE_API float lobe_bilateral_width(float sharpness) {
    return 1 / lobe_at_most(lobe_at_least(sharpness, 1e-15f), 1e18f);
}

LOBE_API float lobe_bilateral_squared(lobe_vec3 a, lobe_vec3 b) {
    lobe_vec3 d = lobe_sub(a, b);
    return lobe_dot(d, d);
}

/* ---- weights of two pixels ---- */

LOBE_API float bilateral_depth_weight(float zi, float zj, float variance) {
    float d = (zi - zj) / sqrtf(lobe_at_least(variance, LOBE_TINY));
    LOBE_ASSERT(variance > 0);
    return lobe_exp(-0.5f * lobe_at_most(d * d, LOBE_HUGE));
}

LOBE_API float bilateral_normal_weight(lobe_vec3 ni, lobe_vec3 nj, float variance) {
    LOBE_ASSERT(variance > 0);
    return lobe_exp(-0.5f * lobe_chord_squared(ni, nj) / lobe_at_least(variance, LOBE_TINY));
}

LOBE_API float bilateral_gaussian_weight(float mi, float vi, float mj, float vj, float beta) {
    float ti = lobe_at_most(lobe_at_least(vi, 1e-18f), 1e15f), tj = lobe_at_most(lobe_at_least(vj, 1e-18f), 1e15f);
    float inverse = 1 / (ti + tj), d = mi - mj;
    LOBE_ASSERT(vi >= 0 && vj >= 0 && beta > 0);
    return lobe_exp2(beta * (0.25f * lobe_bilateral_log2(lobe_bilateral_overlap(ti, tj, inverse)) -
                             0.5f * LOBE_LOG2E * lobe_at_most(d * d, 1e15f) * inverse));
}

LOBE_API float bilateral_sg_weight(sg_lobe i, sg_lobe j, float beta) {
    float ti = lobe_bilateral_width(i.sharpness), tj = lobe_bilateral_width(j.sharpness), inverse = 1 / (ti + tj);
    LOBE_ASSERT(i.sharpness >= 0 && j.sharpness >= 0 && beta > 0);
    return lobe_exp2(0.5f * beta *
                     (lobe_bilateral_log2(lobe_bilateral_overlap(ti, tj, inverse)) -
                      LOBE_LOG2E * lobe_chord_squared(i.axis, j.axis) * inverse));
}

/* ln of the integral of the product of two mixtures over 4 pi, amplitudes over e^top */
LOBE_API float lobe_bilateral_log_product(const sg_lobe *i, int ni, float top_i, const sg_lobe *j, int nj,
                                          float top_j) {
    float top = -LOBE_HUGE, sum = 0;
    int l, m;
    for (l = 0; l < ni; l++) {
        for (m = 0; m < nj; m++) {
            float log_loss, sharpness = lobe_product_sharpness(i[l], j[m], lobe_product_mean(i[l], j[m]), &log_loss);
            float term = ((i[l].log_amplitude - top_i) + (j[m].log_amplitude - top_j)) +
                         (log_loss + lobe_log(lobe_phi(2 * sharpness)));
            float last = top;
            top = lobe_max(top, term);
            sum = sum * lobe_exp(last - top) + lobe_exp(term - top);
        }
    }
    return top + lobe_log(sum);
}

LOBE_API float lobe_bilateral_top(const sg_lobe *lobes, int count) {
    float top = -LOBE_HUGE;
    int l;
    for (l = 0; l < count; l++) top = lobe_max(top, lobes[l].log_amplitude);
    return top;
}

LOBE_API float bilateral_sg_mixture_weight(const sg_lobe *i, int ni, const sg_lobe *j, int nj, float beta) {
    float log_product[3], top_i = lobe_bilateral_top(i, ni), top_j = lobe_bilateral_top(j, nj);
    int k;
    LOBE_ASSERT(ni > 0 && nj > 0 && beta > 0);
    for (k = 0; k < 3; k++) { /* one copy of the code, so that equal mixtures round alike */
        log_product[k] = lobe_bilateral_log_product(k == 2 ? j : i, k == 2 ? nj : ni, k == 2 ? top_j : top_i,
                                                    k == 1 ? i : j, k == 1 ? ni : nj, k == 1 ? top_i : top_j);
    }
    return lobe_exp(beta * lobe_min(log_product[0] - 0.5f * (log_product[1] + log_product[2]), 0));
}

/* ---- prepared forms ---- */

LOBE_API float bilateral_scale(float variance) {
    LOBE_ASSERT(variance > 0);
    return sqrtf(0.5f * LOBE_LOG2E / lobe_at_least(variance, LOBE_TINY));
}

LOBE_API float bilateral_depth_exponent(float zi, float zj) {
    float d = zi - zj;
    return -(d * d);
}

LOBE_INLINE float bilateral_normal_tap(float exponent, lobe_vec3 ni, lobe_vec3 nj) {
    return lobe_exp2(exponent - lobe_bilateral_squared(ni, nj));
}

LOBE_API bilateral_sg bilateral_sg_prepare(sg_lobe g, float beta) {
    bilateral_sg p;
    p.axis = lobe_scale(g.axis, bilateral_scale(1 / beta));
    p.width = lobe_bilateral_width(g.sharpness);
    LOBE_ASSERT(g.sharpness >= 0 && beta > 0);
    return p;
}

LOBE_INLINE float bilateral_sg_tap(float exponent, bilateral_sg i, bilateral_sg j, float beta) {
    float inverse = 1 / (i.width + j.width);
    return lobe_exp2(exponent + 0.5f * beta * lobe_bilateral_log2(lobe_bilateral_overlap(i.width, j.width, inverse)) -
                     lobe_bilateral_squared(i.axis, j.axis) * inverse);
}

LOBE_INLINE float bilateral_sg_tap_power(float exponent, bilateral_sg i, bilateral_sg j, int half_beta) {
    float inverse = 1 / (i.width + j.width), s = (i.width - j.width) * inverse;
    return lobe_bilateral_power(lobe_at_least(1 - s * s, 0), half_beta) *
           lobe_exp2(exponent - lobe_bilateral_squared(i.axis, j.axis) * inverse);
}

/* What a product of two parts is made of: exponent and factor, and the product of tails. */
typedef struct lobe_bilateral_pair {
    float exponent, factor, tail;
} lobe_bilateral_pair;

LOBE_INLINE lobe_bilateral_pair lobe_bilateral_pair_of(bilateral_sg_part a, bilateral_sg_part b) {
    lobe_bilateral_pair p;
    float sum = a.sharpness + b.sharpness, squared = sum * sum;
    float lost = lobe_at_most(a.sharpness * b.sharpness * lobe_bilateral_squared(a.axis, b.axis), 0.99999f * squared);
    float size = sqrtf(squared - lost), both = size + sum, inverse = 1 / (size * both);
    p.exponent = lost * (inverse * size);
    p.factor = a.amplitude * b.amplitude * (both * inverse);
    p.tail = a.tail * b.tail;
    return p;
}

LOBE_INLINE float lobe_bilateral_pair_value(lobe_bilateral_pair p) {
    float x = lobe_at_most(p.exponent, 125), power, inverse, r, r2, even, odd;
    int k = (int)(127.5f - x);
    unsigned u = (unsigned)k << 23;
    r = (127 - (float)k) - x;
    memcpy(&power, &u, sizeof power);
    u = 0x7F000000u - u;
    memcpy(&inverse, &u, sizeof inverse);
    r2 = r * r;
    even = 1 + r2 * (0.240222346f + r2 * 0.0096718776f);
    odd = r * (0.693147215f + r2 * (0.0555030847f + r2 * 0.00134072204f));
    return p.factor * (power * (even + odd) - p.tail * (inverse * (even - odd)));
}

LOBE_INLINE float bilateral_sg_pair(bilateral_sg_part a, bilateral_sg_part b) {
    return lobe_bilateral_pair_value(lobe_bilateral_pair_of(a, b));
}

LOBE_API void bilateral_sg_mixture_prepare(const sg_lobe *lobes, int count, bilateral_sg_part *parts) {
    float top = lobe_bilateral_top(lobes, count), own = 0, scale;
    int l, m;
    LOBE_ASSERT(count > 0);
    for (l = 0; l < count; l++) {
        parts[l].axis = lobes[l].axis;
        parts[l].sharpness = LOBE_LOG2E * lobe_at_most(lobe_at_least(lobes[l].sharpness, 0.015625f), 1e18f);
        parts[l].amplitude = lobe_exp(lobes[l].log_amplitude - top);
        parts[l].tail = lobe_select(lobes[l].sharpness < 16, lobe_exp(-2 * lobes[l].sharpness), 0);
    }
    for (l = 0; l < count; l++) {
        for (m = 0; m < count; m++) own += bilateral_sg_pair(parts[l], parts[m]);
    }
    scale = sqrtf(1.000001f / own);
    for (l = 0; l < count; l++) parts[l].amplitude *= scale;
}

LOBE_INLINE float bilateral_sg_mixture_tap(float exponent, float product, float beta) {
    return lobe_exp2(exponent + beta * lobe_bilateral_log2(product));
}

enum { LOBE_BILATERAL_BLOCK = 64 };

LOBE_INLINE bilateral_sg_part lobe_bilateral_part(const float *const *planes, int x) {
    bilateral_sg_part p;
    p.axis = lobe_vector(planes[0][x], planes[1][x], planes[2][x]);
    p.sharpness = planes[3][x];
    p.amplitude = planes[4][x];
    p.tail = planes[5][x];
    return p;
}

LOBE_API void bilateral_sg_mixture_taps(int count, int lobes, const float *const *i, const float *const *j, float beta,
                                        float *weight) {
    float product[LOBE_BILATERAL_BLOCK], exponent[LOBE_BILATERAL_BLOCK], factor[LOBE_BILATERAL_BLOCK],
        tail[LOBE_BILATERAL_BLOCK];
    int from, x, l, m;
    for (from = 0; from < count; from += LOBE_BILATERAL_BLOCK) {
        int n = count - from < LOBE_BILATERAL_BLOCK ? count - from : LOBE_BILATERAL_BLOCK;
        for (x = 0; x < n; x++) product[x] = 0;
        for (l = 0; l < lobes; l++) {
            for (m = 0; m < lobes; m++) {
                for (x = 0; x < n; x++) {
                    lobe_bilateral_pair p = lobe_bilateral_pair_of(lobe_bilateral_part(i + 6 * l, from + x),
                                                                   lobe_bilateral_part(j + 6 * m, from + x));
                    exponent[x] = p.exponent;
                    factor[x] = p.factor;
                    tail[x] = p.tail;
                }
                for (x = 0; x < n; x++) {
                    lobe_bilateral_pair p;
                    p.exponent = exponent[x];
                    p.factor = factor[x];
                    p.tail = tail[x];
                    product[x] += lobe_bilateral_pair_value(p);
                }
            }
        }
        for (x = 0; x < n; x++) weight[from + x] = bilateral_sg_mixture_tap(weight[from + x], product[x], beta);
    }
}

LOBE_API asg_lobe lobe_bilateral_asg(bilateral_asg p) {
    asg_lobe a;
    a.x = p.x;
    a.y = p.y;
    a.z = p.z;
    a.sharpness_x = p.sharpness_x;
    a.sharpness_y = p.sharpness_y;
    a.log_amplitude = 0;
    return a;
}

LOBE_INLINE bilateral_asg lobe_bilateral_asg_at(const float *const *planes, int x) {
    bilateral_asg a;
    a.x = lobe_vector(planes[0][x], planes[1][x], planes[2][x]);
    a.y = lobe_vector(planes[3][x], planes[4][x], planes[5][x]);
    a.z = lobe_vector(planes[6][x], planes[7][x], planes[8][x]);
    a.sharpness_x = planes[9][x];
    a.sharpness_y = planes[10][x];
    a.own_exponent = planes[11][x];
    a.own_scale = planes[12][x];
    return a;
}

LOBE_API bilateral_asg bilateral_asg_prepare(asg_lobe a) {
    bilateral_asg p;
    float square, mean = lobe_asg_pair_integral(lobe_asg_pair_of(a, a), &square, &p.own_exponent);
    p.x = a.x;
    p.y = a.y;
    p.z = a.z;
    p.sharpness_x = a.sharpness_x;
    p.sharpness_y = a.sharpness_y;
    p.own_scale = 1.0000005f / (mean * sqrtf(square));
    p.own_exponent *= 0.5f;
    return p;
}

LOBE_INLINE float bilateral_asg_tap(float exponent, bilateral_asg i, bilateral_asg j, float beta) {
    float square, tau,
        mean = lobe_asg_pair_integral(lobe_asg_pair_of(lobe_bilateral_asg(i), lobe_bilateral_asg(j)), &square, &tau);
    float ratio = mean * mean * square * (i.own_scale * j.own_scale);
    float similar = 0.34657359f * lobe_bilateral_log2(ratio) + (tau - (i.own_exponent + j.own_exponent));
    return lobe_exp2(exponent - LOBE_LOG2E * beta * lobe_at_least(-similar, 0));
}

LOBE_API void bilateral_asg_taps(int count, const float *const *i, const float *const *j, float beta, float *weight) {
    float stage[11][LOBE_BILATERAL_BLOCK], mean[LOBE_BILATERAL_BLOCK];
    int from, x;
    for (from = 0; from < count; from += LOBE_BILATERAL_BLOCK) {
        int n = count - from < LOBE_BILATERAL_BLOCK ? count - from : LOBE_BILATERAL_BLOCK;
        for (x = 0; x < n; x++) {
            bilateral_asg a = lobe_bilateral_asg_at(i, from + x), b = lobe_bilateral_asg_at(j, from + x);
            lobe_asg_pair k = lobe_asg_pair_of(lobe_bilateral_asg(a), lobe_bilateral_asg(b));
            stage[0][x] = k.trace;
            stage[1][x] = k.m2;
            stage[2][x] = k.det;
            stage[3][x] = k.quad_a;
            stage[4][x] = k.quad_b;
            stage[5][x] = k.adj_aa;
            stage[6][x] = k.adj_bb;
            stage[7][x] = k.adj_ab;
            stage[8][x] = k.cosine;
            stage[9][x] = a.own_scale * b.own_scale;
            stage[10][x] = a.own_exponent + b.own_exponent;
        }
        for (x = 0; x < n; x++) {
            lobe_asg_pair k;
            float square, tau, m;
            k.trace = stage[0][x];
            k.m2 = stage[1][x];
            k.det = stage[2][x];
            k.quad_a = stage[3][x];
            k.quad_b = stage[4][x];
            k.adj_aa = stage[5][x];
            k.adj_bb = stage[6][x];
            k.adj_ab = stage[7][x];
            k.cosine = stage[8][x];
            m = lobe_asg_pair_integral(k, &square, &tau);
            mean[x] = m * m * square * stage[9][x];
            stage[10][x] = tau - stage[10][x];
        }
        for (x = 0; x < n; x++) {
            float similar = 0.34657359f * lobe_bilateral_log2(mean[x]) + stage[10][x];
            weight[from + x] = lobe_exp2(weight[from + x] - LOBE_LOG2E * beta * lobe_at_least(-similar, 0));
        }
    }
}

LOBE_API float bilateral_asg_weight(asg_lobe i, asg_lobe j, float beta) {
    LOBE_ASSERT(i.sharpness_x >= 0 && i.sharpness_y >= 0 && j.sharpness_x >= 0 && j.sharpness_y >= 0 && beta > 0);
    return bilateral_asg_tap(0, bilateral_asg_prepare(i), bilateral_asg_prepare(j), beta);
}

/* ---- several lobes as one ---- */

LOBE_API sg_lobe bilateral_merge(const sg_lobe *lobes, int count) {
    sg_lobe sum, merged;
    float top = -LOBE_HUGE, total = 0;
    int l;
    LOBE_ASSERT(count > 0);
    for (l = 0; l < count; l++) top = lobe_max(top, lobes[l].log_amplitude + lobe_log(sg_integral(lobes[l].sharpness)));
    sum.axis = lobes[0].axis;
    sum.sharpness = 0;
    sum.log_amplitude = 0;
    for (l = 0; l < count; l++) {
        float energy = lobe_exp(lobes[l].log_amplitude + lobe_log(sg_integral(lobes[l].sharpness)) - top);
        sg_lobe part;
        part.axis = lobes[l].axis;
        part.log_amplitude = -energy / (lobes[l].sharpness + 1);
        part.sharpness = -lobes[l].sharpness * part.log_amplitude;
        sum = sg_product(sum, part);
        total += energy;
    }
    merged.axis = sum.axis;
    merged.sharpness = lobe_cluster_sharpness(sum);
    merged.log_amplitude = top + lobe_log(total) - lobe_log(sg_integral(merged.sharpness));
    return merged;
}

/* ---- both pixels of a pair ---- */

LOBE_API void bilateral_pairs_add(int count, const float *weight, int channels, const float *const *first,
                                  const float *const *second, float *const *first_sum, float *const *second_sum) {
    int c, x;
    for (c = 0; c < channels; c++) {
        const float *from = second[c];
        float *to = first_sum[c];
        for (x = 0; x < count; x++) to[x] += weight[x] * from[x];
        from = first[c];
        to = second_sum[c];
        for (x = 0; x < count; x++) to[x] += weight[x] * from[x];
    }
    for (x = 0; x < count; x++) first_sum[channels][x] += weight[x];
    for (x = 0; x < count; x++) second_sum[channels][x] += weight[x];
}

/* ---- upsampling and reprojection ---- */

LOBE_API void bilateral_footprint(float x, float y, int width, int height, int *left, int *top, float weight[4]) {
    float cx = lobe_min(lobe_max(x, -1), (float)width), cy = lobe_min(lobe_max(y, -1), (float)height);
    int ix = (int)(cx + 1) - 1, iy = (int)(cy + 1) - 1;
    float fx = cx - (float)ix, fy = cy - (float)iy;
    float wl = ix >= 0 && ix < width ? 1 - fx : 0, wr = ix + 1 < width ? fx : 0;
    float wt = iy >= 0 && iy < height ? 1 - fy : 0, wb = iy + 1 < height ? fy : 0;
    *left = ix;
    *top = iy;
    weight[0] = wl * wt;
    weight[1] = wr * wt;
    weight[2] = wl * wb;
    weight[3] = wr * wb;
}

LOBE_API float bilateral_footprint_weights(const float footprint[4], const float similarity[4], float weight[4]) {
    float w0 = footprint[0] * similarity[0], w1 = footprint[1] * similarity[1];
    float w2 = footprint[2] * similarity[2], w3 = footprint[3] * similarity[3];
    float total = (w0 + w1) + (w2 + w3), inverse = 1 / lobe_at_least(total, LOBE_TINY);
    weight[0] = w0 * inverse;
    weight[1] = w1 * inverse;
    weight[2] = w2 * inverse;
    weight[3] = w3 * inverse;
    return total;
}

LOBE_API float bilateral_history_share(float total, float count, float most) {
    float old = total * lobe_min(count, most);
    return old / (old + 1);
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
