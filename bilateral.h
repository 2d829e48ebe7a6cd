/*
 bilateral.h - weights of filters and upsamplers that know the surfaces' reflection lobes, version 1.0.0

   #include "bilateral.h"

   lobe_vec3 normal = {0, 0, 1}, viewer = {0, 0.8f, 0.6f};
   sg_lobe here = sg_ggx_lobe(normal, viewer, 0.1f), there = sg_ggx_lobe(normal, viewer, 0.2f);
   float similar = bilateral_sg_weight(here, there, 20);            // in [0, 1], 1 for equal lobes
   bilateral_sg i = bilateral_sg_prepare(here, 20), j = bilateral_sg_prepare(there, 20); // once for each pixel
   float tap = bilateral_sg_tap(-1.5f, i, j, 20);                   // similar times 2^-1.5, by one exponential

 Configuration: as sg.h, which asg.h includes, which this includes.

 Conventions: a weight is in [0, 1], and exactly 1 for equal pixels, the same either way round. Weights of lobes are
 q^beta of a similarity q, the product of two normalised distributions, for any beta above 0; bounds hold for beta in
 [1e-3, 1e3]. A variance is that of exp(-|a - b|^2 / (2 variance)). An "exponent" is one of base 2, at most 0: the
 logarithm of all that a tap's weight has beside its lobes. The paper's smoothing kernel kappa is sg_convolve(lobe,
 kappa) or asg_convolve(lobe, kappa) before anything here; a kappa of 1e30 or infinity smooths nothing.

 A filter: prepare each pixel's lobe into planes, arrays of one number each, one for each field in the order of the
 struct's. Scale the plane of depths by bilateral_scale(variance). Then for each tap and each pixel of a row

   exponent = log2(kernel) + bilateral_depth_exponent(depth_i, depth_j)
   weight = bilateral_sg_tap(exponent, lobe_i, lobe_j, beta)

 and sum weight and weight times colour; their quotient is the filtered colour. Such a loop becomes vector code, see
 sg.h. The functions called _taps do a row in stages, which is faster where a weight is long. As weights are
 symmetric, half of the taps will do: bilateral_pairs_add uses each weight for both pixels.
 Recompute a pixel where its total weight, over that of the kernel alone, is small: below 0.25 in the paper.
 Upsampling and reprojection: bilateral_footprint, the taps' similarities (times 0 for a sample that is not valid),
 bilateral_footprint_weights, whose total tells the same.

 Errors: as in sg.h. "similarity" is in (1 + e + beta + sqrt(l e) + 2^-24 l) 2^-24 of the weight for e = -ln of it and
 l = beta times the smaller sharpness: what rounding of the logarithm and of unit vectors costs.
 Out of finite input (unit vectors, sharpness of any size, depths and guides up to 1e18) comes no NaN and no infinity.

 Functions:

   bilateral_depth_weight           Eq. 3
   bilateral_normal_weight          Eq. 4: what a filter does that knows no lobes
   bilateral_gaussian_weight        section 3: guides that have a variance each
   bilateral_sg_weight              Eq. 12: a lobe each
   bilateral_sg_mixture_weight      Eq. 11: several lobes each
   bilateral_asg_weight             Eq. 13: an anisotropic lobe each
   bilateral_merge                  several lobes as one, for Eq. 12
   bilateral_scale                  what planes of depths and normals are multiplied by
   bilateral_depth_exponent         of scaled depths
   bilateral_normal_tap             of scaled normals
   bilateral_sg_prepare, _tap       Eq. 12; _tap_power for an even beta; _taps
   bilateral_sg_mixture_prepare     Eq. 11; _pair of lobes, _tap, _taps
   bilateral_asg_prepare, _tap      Eq. 13; _taps
   bilateral_pairs_add              a row of weights, each for both pixels
   bilateral_footprint              2 x 2 taps around a position
   bilateral_footprint_weights      the same times similarities, normalised; their total
   bilateral_history_share          of a reprojected sample beside a new one

 Papers named in the sources: 004 is Tokuyoshi 2015, Specular Lobe-Aware Filtering and Upsampling for Interactive
 Indirect Illumination.
*/
#ifndef LOBE_BILATERAL_H
#define LOBE_BILATERAL_H

#ifndef LOBE_VERSION
#define LOBE_VERSION 10000 /* 10000 major + 100 minor + patch */
#elif LOBE_VERSION != 10000
#error "headers of different versions of Lobe"
#endif

#include "asg.h"

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

/* log2 x for x from 2^-126; exactly 0 at 1. Error in max(1, |log2 x| / 4).   [bound lobe_bilateral_log2 abs 6e-7] */
LOBE_INLINE float lobe_bilateral_log2(float x) {
    unsigned bits, power;
    float f, f2, slope;
    memcpy(&bits, &x, sizeof bits);
    power = (bits - 0x3F3504F3u) & ~0x007FFFFFu; /* as lobe_log */
    bits -= power;
    memcpy(&f, &bits, sizeof f);
    f -= 1;
    f2 = f * f;
    slope = (1.44269973f - 0.721375871f * f) +
            f2 * ((0.480465014f - 0.358961895f * f) + f2 * ((0.297262908f - 0.272697535f * f) + f2 * 0.170632825f));
    return 1.1920929e-7f * (float)(int)power + f * slope;
}

/* x^n for n in 0 .. 15 */
LOBE_INLINE float lobe_bilateral_power(float x, int n) {
    float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return (n & 1 ? x : 1) * (n & 2 ? x2 : 1) * ((n & 4 ? x4 : 1) * (n & 8 ? x8 : 1));
}

/* The overlap 4 ti tj / (ti + tj)^2 of two widths, given 1 / (ti + tj). A little too large, but at most 1, so that
   it is 1 for equal ones. */
LOBE_INLINE float lobe_bilateral_overlap(float ti, float tj, float inverse) {
    return lobe_at_most(4.00000191f * ((ti * inverse) * (tj * inverse)), 1);
}

LOBE_API float lobe_bilateral_width(float sharpness) {
    return 1 / lobe_at_most(lobe_at_least(sharpness, 1e-15f), 1e18f);
}

LOBE_INLINE float lobe_bilateral_squared(lobe_vec3 a, lobe_vec3 b) {
    lobe_vec3 d = lobe_sub(a, b);
    return lobe_dot(d, d);
}

/* ---- weights of two pixels ---- */

/*
 bilateral_depth_weight - similarity of two depths

   variance   (0, 1e30], counts as at least 1e-30
   returns    exp(-(zi - zj)^2 / (2 variance))

   Rounding: <= 10 (1 + |ln w|) 2^-24 relative   [bound bilateral_depth_weight conditioned 10 over 1e-6 1e6]
   Model:    exact
   Source:   004, Eq. 3
*/
LOBE_API float bilateral_depth_weight(float zi, float zj, float variance) {
    float d = (zi - zj) / sqrtf(lobe_at_least(variance, LOBE_TINY));
    LOBE_ASSERT(variance > 0);
    return lobe_exp(-0.5f * lobe_at_most(d * d, LOBE_HUGE));
}

/*
 bilateral_normal_weight - similarity of two normals: an SG of sharpness 1 / variance

   variance   (0, 1e30], counts as at least 1e-30
   returns    exp(-|ni - nj|^2 / (2 variance))

   Rounding: <= 8 (1 + |ln w|) 2^-24 relative   [bound bilateral_normal_weight conditioned 8 over 1e-10 1e6]
   Model:    exact
   Source:   004, Eq. 4
*/
LOBE_API float bilateral_normal_weight(lobe_vec3 ni, lobe_vec3 nj, float variance) {
    LOBE_ASSERT(variance > 0);
    return lobe_exp(-0.5f * lobe_chord_squared(ni, nj) / lobe_at_least(variance, LOBE_TINY));
}

/*
 bilateral_gaussian_weight - similarity of two guides that have a mean and a variance each

   mi, mj     up to 1e18
   vi, vj     [0, 1e30], count as within [1e-18, 1e15]
   returns    q^beta, q the integral of the product of both Gaussians over the root of those of their squares

   Rounding: <= 12 similarity, with no l   [bound bilateral_gaussian_weight similarity 12 over 1e-6 1e6]
   Model:    exact
   Source:   004, Eqs. 7 and 8 for plane Gaussians: (4 vi vj / (vi + vj)^2)^(beta / 4) exp(-beta (mi - mj)^2 / (2 (vi +
             vj)))
*/
LOBE_API float bilateral_gaussian_weight(float mi, float vi, float mj, float vj, float beta) {
    float ti = lobe_at_most(lobe_at_least(vi, 1e-18f), 1e15f), tj = lobe_at_most(lobe_at_least(vj, 1e-18f), 1e15f);
    float inverse = 1 / (ti + tj), d = mi - mj;
    LOBE_ASSERT(vi >= 0 && vj >= 0 && beta > 0);
    return lobe_exp2(beta * (0.25f * lobe_bilateral_log2(lobe_bilateral_overlap(ti, tj, inverse)) -
                             0.5f * LOBE_LOG2E * lobe_at_most(d * d, 1e15f) * inverse));
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

/*
 bilateral_sg_mixture_weight - similarity of two sums of SGs

   i, j       ni and nj lobes, 1 or more; sharpness [0, 1e30]; amplitudes matter among the lobes of one pixel
   returns    q^beta

   Rounding: <= 55 similarity, with no l   [bound bilateral_sg_mixture_weight similarity 55 over 1e-3 1e5]
   Model:    exact
   Source:   004, Eq. 11, of logarithms, the sums over their largest term
*/
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

/*
 bilateral_scale - what guides are multiplied by, so that minus the squared distance is the exponent of their weight

   variance   (0, 1e30], counts as at least 1e-30

   Rounding: <= 4 ulp   [bound bilateral_scale ulp 4 over 1e-20 1e20]
   Model:    exact
   Source:   sqrt(log2(e) / (2 variance))
*/
LOBE_API float bilateral_scale(float variance) {
    LOBE_ASSERT(variance > 0);
    return sqrtf(0.5f * LOBE_LOG2E / lobe_at_least(variance, LOBE_TINY));
}

/*
 bilateral_depth_exponent - logarithm of Eq. 3

   zi, zj     depths times bilateral_scale(variance), up to 1e18

   Rounding: <= 3 ulp of the difference's square   [bound bilateral_depth_exponent ulp 3]
   Model:    exact
   Source:   004, Eq. 3
*/
LOBE_INLINE float bilateral_depth_exponent(float zi, float zj) {
    float d = zi - zj;
    return -(d * d);
}

/*
 bilateral_normal_tap - a tap's weight with Eq. 4

   exponent   at most 0
   ni, nj     normals times bilateral_scale(variance)
   returns    bilateral_normal_weight times 2^exponent

   Rounding: <= 9 similarity, with beta 1 and l = 1 / variance   [bound bilateral_normal_tap similarity 9 over 1e-8 1e6]
   Model:    exact
   Source:   004, Eq. 4
*/
LOBE_INLINE float bilateral_normal_tap(float exponent, lobe_vec3 ni, lobe_vec3 nj) {
    return lobe_exp2(exponent - lobe_bilateral_squared(ni, nj));
}

/*
 bilateral_sg_prepare - a lobe for bilateral_sg_tap and bilateral_sg_tap_power with this beta

   Rounding: with that of the taps
   Model:    exact
   Source:   004, Eq. 12
*/
LOBE_API bilateral_sg bilateral_sg_prepare(sg_lobe g, float beta) {
    bilateral_sg p;
    p.axis = lobe_scale(g.axis, bilateral_scale(1 / beta));
    p.width = lobe_bilateral_width(g.sharpness);
    LOBE_ASSERT(g.sharpness >= 0 && beta > 0);
    return p;
}

/* Exponent of Eq. 12. */
LOBE_INLINE float lobe_bilateral_sg_exponent(bilateral_sg i, bilateral_sg j, float beta) {
    float inverse = 1 / (i.width + j.width);
    return 0.5f * beta * lobe_bilateral_log2(lobe_bilateral_overlap(i.width, j.width, inverse)) -
           lobe_bilateral_squared(i.axis, j.axis) * inverse;
}

/*
 bilateral_sg_tap, bilateral_sg_tap_power, bilateral_sg_taps - a tap's weight with Eq. 12

   exponent   at most 0
   i, j       prepared with the same beta; for _taps four planes each, from the row's first pixel on
   half_beta  1 to 15, beta / 2: without a logarithm; a constant is best
   weight     count exponents, which become weights
   returns    bilateral_sg_weight times 2^exponent

   Rounding: <= 12 similarity, of _tap_power 14 and 3 beta 2^-24 of the largest weight besides
             [bound bilateral_sg_tap similarity 12 over 1e-8 1e10]
             [bound bilateral_sg_taps similarity 12 over 1e-8 1e10]
             [bound bilateral_sg_tap_power similarity 14 over 1e-8 1e10]
   Model:    as bilateral_sg_weight
   Source:   004, Eq. 12, with widths 1 / li, so that only their sum is divided by
*/
LOBE_INLINE float bilateral_sg_tap(float exponent, bilateral_sg i, bilateral_sg j, float beta) {
    return lobe_exp2(exponent + lobe_bilateral_sg_exponent(i, j, beta));
}

LOBE_INLINE float bilateral_sg_tap_power(float exponent, bilateral_sg i, bilateral_sg j, int half_beta) {
    float inverse = 1 / (i.width + j.width), s = (i.width - j.width) * inverse;
    return lobe_bilateral_power(lobe_at_least(1 - s * s, 0), half_beta) *
           lobe_exp2(exponent - lobe_bilateral_squared(i.axis, j.axis) * inverse);
}

/*
 bilateral_sg_weight - similarity of two SGs

   i, j       sharpness [0, 1e30], counts as within [1e-15, 1e18]; amplitudes do not matter
   returns    q^beta

   Rounding: <= 12 similarity   [bound bilateral_sg_weight similarity 12 over 1e-8 1e10]
   Model:    against bilateral_sg_mixture_weight of one lobe each and for beta 20: within .02 for a sharpness of 10 or
             more of both, .002 from 100 on
             [bound bilateral_sg_weight model .02 over 10 1e5] [bound bilateral_sg_weight sharp .002 over 100 1e6]
   Source:   004, Eq. 12: (4 li lj / (li + lj)^2)^(beta / 2) times an SG of sharpness beta li lj / (li + lj)
*/
LOBE_INLINE float bilateral_sg_weight(sg_lobe i, sg_lobe j, float beta) {
    LOBE_ASSERT(i.sharpness >= 0 && j.sharpness >= 0 && beta > 0);
    return bilateral_sg_tap(0, bilateral_sg_prepare(i, beta), bilateral_sg_prepare(j, beta), beta);
}

/* How many pixels go through the stages of a row at once: what the stages leave stays in the first cache. */
enum { LOBE_BILATERAL_BLOCK = 128 };

LOBE_INLINE bilateral_sg lobe_bilateral_sg_at(const float *const *planes, int x) {
    bilateral_sg p;
    p.axis = lobe_vector(planes[0][x], planes[1][x], planes[2][x]);
    p.width = planes[3][x];
    return p;
}

LOBE_API void bilateral_sg_taps(int count, const float *const *i, const float *const *j, float beta, float *weight) {
    float stage[LOBE_BILATERAL_BLOCK];
    int from, x;
    for (from = 0; from < count; from += LOBE_BILATERAL_BLOCK) {
        int n = count - from < LOBE_BILATERAL_BLOCK ? count - from : LOBE_BILATERAL_BLOCK;
        for (x = 0; x < n; x++) {
            stage[x] =
                lobe_bilateral_sg_exponent(lobe_bilateral_sg_at(i, from + x), lobe_bilateral_sg_at(j, from + x), beta);
        }
        for (x = 0; x < n; x++) weight[from + x] = lobe_exp2(weight[from + x] + stage[x]);
    }
}

/* What the product of two lobes integrates to, with L = |la a + lb b| and all lengths times log2(e): 2^-exponent times
   factor, a constant over L, less e^-2L of that, where 2^exponent times tail is that again. */
typedef struct lobe_bilateral_pair {
    float exponent, factor, tail;
} lobe_bilateral_pair;

LOBE_INLINE lobe_bilateral_pair lobe_bilateral_pair_of(bilateral_sg_part a, bilateral_sg_part b) {
    lobe_bilateral_pair p;
    float sum = a.sharpness + b.sharpness;
    float lost = a.sharpness * b.sharpness * lobe_bilateral_squared(a.axis, b.axis);
    float size = sqrtf(sum * sum - lost), both = size + sum, inverse = 1 / (size * both);
    p.exponent = lost * (inverse * size);
    p.factor = a.amplitude * b.amplitude * (both * inverse);
    p.tail = a.tail * b.tail;
    return p;
}

/* 2^-x = 2^(whole - 127) 2^r for x in [0, 125]; returns whole, from 2 to 127. */
LOBE_INLINE int lobe_bilateral_split(float x, float *r) {
    int whole;
    x = lobe_at_most(lobe_at_least(x, 0), 125);
    whole = (int)(127.5f - x);
    *r = (float)(127 - whole) - x; /* of integers: in floats it could be added in another order */
    return whole;
}

LOBE_INLINE float lobe_bilateral_power_of_2(unsigned whole) {
    float power;
    whole <<= 23;
    memcpy(&power, &whole, sizeof power);
    return power;
}

/* Without a tail; 2^r to 1e-7 */
LOBE_INLINE float lobe_bilateral_sharp_value(float exponent, float factor) {
    float r;
    int whole = lobe_bilateral_split(exponent, &r);
    r = 1 + r * (0.693147215f + r * (0.240222346f + r * (0.0555030847f + r * (0.0096718776f + r * 0.00134072204f))));
    return factor * (lobe_bilateral_power_of_2((unsigned)whole) * r);
}

/* The same polynomial, even and odd, gives 2^-r too. */
LOBE_INLINE float lobe_bilateral_pair_value(lobe_bilateral_pair p) {
    float r, r2, even, odd, value;
    int whole = lobe_bilateral_split(p.exponent, &r);
    r2 = r * r;
    even = 1 + r2 * (0.240222346f + r2 * 0.0096718776f);
    odd = r * (0.693147215f + r2 * (0.0555030847f + r2 * 0.00134072204f));
    value = lobe_bilateral_power_of_2((unsigned)whole) * (even + odd);
    return p.factor * (value - p.tail * (lobe_bilateral_power_of_2((unsigned)(254 - whole)) * (even - odd)));
}

/*
 bilateral_sg_pair - integral of the product of one lobe of a pixel and one of another, in the unit of their mixtures

   returns    what the sum over all pairs of lobes is q, but for 2e-6

   Rounding: as bilateral_sg_mixture_tap
   Model:    as bilateral_sg_mixture_tap
   Source:   004, Eq. 11
*/
LOBE_INLINE float bilateral_sg_pair(bilateral_sg_part a, bilateral_sg_part b) {
    return lobe_bilateral_pair_value(lobe_bilateral_pair_of(a, b));
}

/*
 bilateral_sg_mixture_prepare - the lobes of a pixel for bilateral_sg_pair and bilateral_sg_mixture_taps

   lobes      1 or more; sharpness [0, 1e30], counts as within [1/64, 1e15]
   parts      as many

   Rounding: with that of the taps
   Model:    as bilateral_sg_mixture_tap
   Source:   004, Eq. 11: amplitudes are divided by the root of the mixture's product with itself, by the same code as
             the taps'
*/
LOBE_API void bilateral_sg_mixture_prepare(const sg_lobe *lobes, int count, bilateral_sg_part *parts) {
    float top = lobe_bilateral_top(lobes, count), own = 0, scale;
    int l, m;
    LOBE_ASSERT(count > 0);
    for (l = 0; l < count; l++) {
        parts[l].axis =
            lobe_scale(lobe_normalize_or(lobes[l].axis, lobe_vector(0, 0, 1)), 0.9999995f); /* so that L is not 0 */
        parts[l].sharpness = LOBE_LOG2E * lobe_at_most(lobe_at_least(lobes[l].sharpness, 0.015625f), 1e15f);
        parts[l].amplitude = lobe_exp(lobes[l].log_amplitude - top);
        parts[l].tail =
            lobe_select(lobes[l].sharpness < 16, lobe_exp(-2 * lobe_at_least(lobes[l].sharpness, 0.015625f)), 0);
    }
    for (l = 0; l < count; l++) {
        for (m = 0; m < count; m++) own += bilateral_sg_pair(parts[l], parts[m]);
    }
    scale = sqrtf(1.000002f / own); /* a little more: q of equal mixtures is to reach 1 */
    for (l = 0; l < count; l++) parts[l].amplitude *= scale;
}

/*
 bilateral_sg_mixture_tap, bilateral_sg_mixture_taps - a tap's weight with Eq. 11

   exponent   at most 0
   product    sum of bilateral_sg_pair over all pairs of lobes, counts as within [1e-30, 1]
   lobes      as many for each pixel, 1 to 32; six planes each, from the row's first pixel on, lobe by lobe
   weight     count exponents, which become weights
   returns    bilateral_sg_mixture_weight times 2^exponent

   Rounding: of q, with l the largest sharpness, where no two axes are more than 150 degrees apart: <= 36 similarity
             for sharpness of 1 or more, <= 120 below
             [bound bilateral_sg_mixture_tap similarity 36 over 1 1e6]
             [bound bilateral_sg_mixture_tap below 120 over .015625 1]
             [bound bilateral_sg_mixture_taps similarity 32 over 1 1e6]
             Of equal mixtures it is 1, but with -ffast-math within 3e-5 of that
             Of axes further apart, whose L may be nearly 0: within 4e-4 of q besides; below sharpness 1 within .02
             [bound bilateral_sg_mixture_tap apart 4e-4] [bound bilateral_sg_mixture_tap opposed .02 over .015625 1]
   Model:    exact, but for lobes of sharpness below 1/64: q within .015   [bound bilateral_sg_mixture_tap wide .015]
             and for axes so far apart with a sharpness of 16 or more: q within 2e-11
             [bound bilateral_sg_mixture_tap dropped 2e-11]
   Source:   004, Eq. 11, with exp(-L) sinh L as a difference of exponentials, the second by the first's polynomial; 0
             where one of two lobes is of sharpness 16 or more
*/
LOBE_INLINE float bilateral_sg_mixture_tap(float exponent, float product, float beta) {
    return lobe_exp2(exponent + beta * lobe_bilateral_log2(lobe_at_most(lobe_at_least(product, LOBE_TINY), 1)));
}

LOBE_INLINE bilateral_sg_part lobe_bilateral_part(const float *const *planes, int x) {
    bilateral_sg_part p;
    p.axis = lobe_vector(planes[0][x], planes[1][x], planes[2][x]);
    p.sharpness = planes[3][x];
    p.amplitude = planes[4][x];
    p.tail = planes[5][x];
    return p;
}

/* Which of the lobes have a tail anywhere in a row, as bits. */
LOBE_API unsigned lobe_bilateral_tails(int count, int lobes, const float *const *planes, int from) {
    unsigned tails = 0;
    int l, x;
    for (l = 0; l < lobes; l++) {
        const float *plane = planes[6 * l + 5] + from;
        unsigned any = 0;
        for (x = 0; x < count; x++) {
            unsigned bits;
            memcpy(&bits, plane + x, sizeof bits);
            any |= bits;
        }
        tails |= (unsigned)(any != 0) << l;
    }
    return tails;
}

LOBE_API void bilateral_sg_mixture_taps(int count, int lobes, const float *const *i, const float *const *j, float beta,
                                        float *weight) {
    float product[LOBE_BILATERAL_BLOCK], exponent[LOBE_BILATERAL_BLOCK], factor[LOBE_BILATERAL_BLOCK];
    int from, x, l, m;
    for (from = 0; from < count; from += LOBE_BILATERAL_BLOCK) {
        int n = count - from < LOBE_BILATERAL_BLOCK ? count - from : LOBE_BILATERAL_BLOCK;
        unsigned tails_i = lobe_bilateral_tails(n, lobes, i, from), tails_j = lobe_bilateral_tails(n, lobes, j, from);
        for (x = 0; x < n; x++) product[x] = 0;
        for (l = 0; l < lobes; l++) {
            for (m = 0; m < lobes; m++) {
                for (x = 0; x < n; x++) {
                    lobe_bilateral_pair p = lobe_bilateral_pair_of(lobe_bilateral_part(i + 6 * l, from + x),
                                                                   lobe_bilateral_part(j + 6 * m, from + x));
                    exponent[x] = p.exponent;
                    factor[x] = p.factor;
                }
                if (tails_i >> l & tails_j >> m & 1) {
                    const float *tail_i = i[6 * l + 5] + from, *tail_j = j[6 * m + 5] + from;
                    for (x = 0; x < n; x++) {
                        lobe_bilateral_pair p;
                        p.exponent = exponent[x];
                        p.factor = factor[x];
                        p.tail = tail_i[x] * tail_j[x];
                        product[x] += lobe_bilateral_pair_value(p);
                    }
                } else {
                    for (x = 0; x < n; x++) {
                        product[x] += lobe_bilateral_sharp_value(exponent[x], factor[x]);
                    }
                }
            }
        }
        for (x = 0; x < n; x++)
            product[x] = beta * lobe_bilateral_log2(lobe_at_most(lobe_at_least(product[x], LOBE_TINY), 1));
        for (x = 0; x < n; x++) weight[from + x] = lobe_exp2(weight[from + x] + product[x]);
    }
}

/* log2 of q from the square of its factor and its exponent, at most 0 */
LOBE_INLINE float lobe_bilateral_asg_exponent(float square, float exponent) {
    return -lobe_at_least(-0.5f * lobe_bilateral_log2(square) - LOBE_LOG2E * exponent, 0);
}

LOBE_INLINE asg_lobe lobe_bilateral_asg(bilateral_asg p) {
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

/*
 bilateral_asg_prepare - a lobe for bilateral_asg_tap, any beta

   a          sharpness [0, 1e30], counts as at most 1e9; its amplitude does not matter

   Rounding: with that of the taps
   Model:    as bilateral_asg_weight
   Source:   004, Eq. 13: the product with itself, by the same code as the taps'
*/
LOBE_INLINE bilateral_asg bilateral_asg_prepare(asg_lobe a) {
    bilateral_asg p;
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(a, a));
    float square, mean = lobe_asg_clamped_mean(m, &square);
    p.x = a.x;
    p.y = a.y;
    p.z = a.z;
    p.sharpness_x = a.sharpness_x;
    p.sharpness_y = a.sharpness_y;
    p.own_scale = 1.00001f / (mean * sqrtf(square)); /* a little more: q of equal lobes is to reach 1 */
    p.own_exponent = 0.5f * m.tau;
    return p;
}

/*
 bilateral_asg_tap, bilateral_asg_taps - a tap's weight with Eq. 13

   exponent   at most 0
   i, j       for _taps thirteen planes each, from the row's first pixel on
   weight     count exponents, which become weights
   returns    bilateral_asg_weight times 2^exponent

   Rounding: of q, 2e-5 from that and between them   [bound bilateral_asg_taps rel 2e-5 over 1e-3 1e6]
   Model:    as bilateral_asg_weight
   Source:   004, Eq. 13
*/
LOBE_INLINE float bilateral_asg_tap(float exponent, bilateral_asg i, bilateral_asg j, float beta) {
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(lobe_bilateral_asg(i), lobe_bilateral_asg(j)));
    float square, mean = lobe_asg_clamped_mean(m, &square);
    float ratio = mean * mean * square * (i.own_scale * j.own_scale);
    return lobe_exp2(exponent + beta * lobe_bilateral_asg_exponent(ratio, m.tau - (i.own_exponent + j.own_exponent)));
}

LOBE_API void bilateral_asg_taps(int count, const float *const *i, const float *const *j, float beta, float *weight) {
    /* an array each, not one of arrays: clang does not see that something used so often is not the planes */
    float trace[LOBE_BILATERAL_BLOCK], m2[LOBE_BILATERAL_BLOCK], det[LOBE_BILATERAL_BLOCK];
    float quad_a[LOBE_BILATERAL_BLOCK], quad_b[LOBE_BILATERAL_BLOCK], cosine[LOBE_BILATERAL_BLOCK];
    float adj_aa[LOBE_BILATERAL_BLOCK], adj_bb[LOBE_BILATERAL_BLOCK], adj_ab[LOBE_BILATERAL_BLOCK];
    float square[LOBE_BILATERAL_BLOCK], exponent[LOBE_BILATERAL_BLOCK];
    int from, x;
    for (from = 0; from < count; from += LOBE_BILATERAL_BLOCK) {
        int n = count - from < LOBE_BILATERAL_BLOCK ? count - from : LOBE_BILATERAL_BLOCK;
        for (x = 0; x < n; x++) {
            bilateral_asg a = lobe_bilateral_asg_at(i, from + x), b = lobe_bilateral_asg_at(j, from + x);
            lobe_asg_pair k = lobe_asg_pair_of(lobe_bilateral_asg(a), lobe_bilateral_asg(b));
            trace[x] = k.trace;
            m2[x] = k.m2;
            det[x] = k.det;
            quad_a[x] = k.quad_a;
            quad_b[x] = k.quad_b;
            adj_aa[x] = k.adj_aa;
            adj_bb[x] = k.adj_bb;
            adj_ab[x] = k.adj_ab;
            cosine[x] = k.cosine;
            square[x] = a.own_scale * b.own_scale;
            exponent[x] = a.own_exponent + b.own_exponent;
        }
        for (x = 0; x < n; x++) {
            lobe_asg_pair k;
            lobe_asg_means m;
            k.trace = trace[x];
            k.m2 = m2[x];
            k.det = det[x];
            k.quad_a = quad_a[x];
            k.quad_b = quad_b[x];
            k.adj_aa = adj_aa[x];
            k.adj_bb = adj_bb[x];
            k.adj_ab = adj_ab[x];
            k.cosine = cosine[x];
            m = lobe_asg_means_of(k);
            adj_ab[x] = m.ab;
            adj_aa[x] = m.aa;
            adj_bb[x] = m.bb;
            det[x] = m.scale;
            exponent[x] = m.tau - exponent[x];
        }
        for (x = 0; x < n; x++) {
            lobe_asg_means m;
            float scale, mean;
            m.tau = 0;
            m.ab = adj_ab[x];
            m.aa = adj_aa[x];
            m.bb = adj_bb[x];
            m.scale = det[x];
            mean = lobe_asg_clamped_mean(m, &scale);
            square[x] *= mean * mean * scale;
        }
        for (x = 0; x < n; x++) {
            float similar = lobe_bilateral_asg_exponent(square[x], exponent[x]);
            weight[from + x] = lobe_exp2(weight[from + x] + beta * similar);
        }
    }
}

/*
 bilateral_asg_weight - similarity of two ASGs

   i, j       sharpness [0, 1e30], counts as at most 1e9; amplitudes do not matter
   returns    q^beta; q counts as at least 2^-63 times its exponential

   Rounding: q the same either way round within 4e-6, and falls without steps above 2e-6 as lobes turn
             [bound bilateral_asg_weight symmetric 4e-6] [bound bilateral_asg_weight monotone 2e-6]
   Model:    that of asg_product_integral: q within .0125, RMS .001
             [bound bilateral_asg_weight model .0125 over .1 1e5] [bound bilateral_asg_weight rms .001 over .1 1e5]
   Source:   004, Eq. 13
*/
LOBE_INLINE float bilateral_asg_weight(asg_lobe i, asg_lobe j, float beta) {
    LOBE_ASSERT(i.sharpness_x >= 0 && i.sharpness_y >= 0 && j.sharpness_x >= 0 && j.sharpness_y >= 0 && beta > 0);
    return bilateral_asg_tap(0, bilateral_asg_prepare(i), bilateral_asg_prepare(j), beta);
}

/* ---- several lobes as one ---- */

/* ln of a lobe's integral */
LOBE_API float lobe_bilateral_log_energy(sg_lobe g) {
    return g.log_amplitude + lobe_log(sg_integral(lobe_sharpness(g)));
}

/*
 bilateral_merge - several lobes as one, of the same integral and mean direction

   lobes      1 or more; sharpness [0, 1e30]
   returns    the axis is the mean direction, the sharpness from its length; at most 1e18

   Rounding: sharpness of three lobes within (32 + sqrt(l)) 2^-24 relative for the sharpest l, as directions are floats;
             axis within 8e-7, integral within 3e-6
             [bound bilateral_merge sharpness 1 over 1e-3 1e8] [bound bilateral_merge axis 8e-7]
             [bound bilateral_merge integral 3e-6]
   Model:    lengths are Toksvig's l / (l + 1) both ways, see sg_mean_length: of lobes of sharpness 10 or more within an
             angle of 1 the mean's length is within .19 of the sum's, as sg_mean_length is of the exact one
             [bound bilateral_merge model .19 over 10 1e6]
   Source:   Toksvig 2005, which 004 names; as vsgl_cluster_merge, which stays exact at high sharpness
*/
LOBE_API sg_lobe bilateral_merge(const sg_lobe *lobes, int count) {
    sg_lobe sum, merged, brightest = lobes[0];
    float top = lobe_bilateral_log_energy(brightest), whole, total = 0;
    int l;
    LOBE_ASSERT(count > 0);
    for (l = 1; l < count; l++) {
        float energy = lobe_bilateral_log_energy(lobes[l]);
        if (energy > top) {
            top = energy;
            brightest = lobes[l];
        }
    }
    whole = sg_integral(lobe_sharpness(brightest));
    sum.axis = lobes[0].axis;
    sum.sharpness = 0;
    sum.log_amplitude = 0;
    for (l = 0; l < count; l++) {
        float sharpness = lobe_sharpness(lobes[l]);
        float energy = lobe_exp(lobes[l].log_amplitude - brightest.log_amplitude) * (sg_integral(sharpness) / whole);
        sg_lobe part;
        part.axis = lobes[l].axis;
        part.log_amplitude = -energy / (sharpness + 1);
        part.sharpness = sharpness * -part.log_amplitude;
        sum = sg_product(sum, part);
        total += energy;
    }
    merged.axis = sum.axis;
    merged.sharpness = lobe_cluster_sharpness(sum);
    merged.log_amplitude = brightest.log_amplitude + lobe_log(total * (whole / sg_integral(merged.sharpness)));
    return merged;
}

/* ---- both pixels of a pair ---- */

/*
 bilateral_pairs_add - adds a row of weights, each to the sums of both pixels of its pair

   weight              count of them
   first, second       channels planes of colour each, from the row's first pixel and from its partner on
   first_sum, second_sum
                       channels planes each of sums of weight times the partner's colour, and one of weights; those of
                       first and second may overlap

   Rounding: 2^-23 of each sum and addend   [bound bilateral_pairs_add rel 0x1p-23]
   Model:    exact
   Source:   004, Eq. 1
*/
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

/*
 bilateral_footprint - the 2 x 2 taps of bilinear interpolation

   x, y           in pixels of the image sampled, whose centres are at whole numbers
   width, height  of it, up to 2^20
   left, top      the first tap's pixel, from -1 on; the others are right of it, below, and both
   weight         of (left, top), (left + 1, top), (left, top + 1), (left + 1, top + 1); 0 of those outside the image

   Rounding: 2^-22   [bound bilateral_footprint abs 0x1p-22]
   Model:    exact
   Source:   Kopf et al. 2007; 004, section 5
*/
LOBE_API void bilateral_footprint(float x, float y, int width, int height, int *left, int *top, float weight[4]) {
    float cx = lobe_min(lobe_max(x, -1), (float)width), cy = lobe_min(lobe_max(y, -1), (float)height);
    int ix = (int)(cx + 1) - 1, iy = (int)(cy + 1) - 1;
    float fx = lobe_at_least(cx - (float)ix, 0), fy = lobe_at_least(cy - (float)iy, 0);
    float wl = ix >= 0 && ix < width ? 1 - fx : 0, wr = ix + 1 < width ? fx : 0;
    float wt = iy >= 0 && iy < height ? 1 - fy : 0, wb = iy + 1 < height ? fy : 0;
    *left = ix;
    *top = iy;
    weight[0] = wl * wt;
    weight[1] = wr * wt;
    weight[2] = wl * wb;
    weight[3] = wr * wb;
}

/*
 bilateral_footprint_weights - joint bilateral weights of four taps

   footprint   of bilateral_footprint
   similarity  weights of the taps' depths and lobes, and whether they are valid
   weight      their products over the sum; all 0 where the sum is below 1e-30
   returns     the sum, [0, 1]: small where the pixel should be recomputed

   Rounding: weights sum to 1 within 4e-7   [bound bilateral_footprint_weights sum 4e-7]
   Model:    exact
   Source:   004, Eq. 1; Kopf et al. 2007
*/
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

/*
 bilateral_history_share - how much of a pixel the reprojected image should make up

   total      of bilateral_footprint_weights at the place the pixel was seen before
   count      samples in that image, 0 or more
   most       [0, 1e6], at most so many count, so that old light fades
   returns    s in [0, 1): the pixel is history times s plus new times 1 - s, and then has 1 / (1 - s) samples

   Rounding: <= 3 ulp   [bound bilateral_history_share ulp 3]
   Model:    the mean of all samples, those of the past times their similarity
   Source:   Herzog et al. 2010; Knecht 2009, as in 004, section 5
*/
LOBE_API float bilateral_history_share(float total, float count, float most) {
    float old = lobe_at_least(total, 0) * lobe_at_least(lobe_min(count, most), 0);
    return old / (old + 1);
}

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
