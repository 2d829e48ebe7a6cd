/*
 sg.h - spherical Gaussians and virtual spherical Gaussian lights, version 1.0.0

   #include "sg.h"

   lobe_vec3 normal = {0, 0, 1}, sun = {0, 0.6f, 0.8f};
   sg_lobe light = {sun, 50, 0};                      // axis, sharpness, log amplitude
   sg_lobe diffuse = sg_diffuse_lobe(normal);
   float at_sun = sg_eval(light, sun);                // 1
   float lit = sg_product_integral(light, diffuse);   // reflected radiance per unit of albedo

 Configuration, before inclusion:

   macro        | default       | effect
   LOBE_VEC3    | a struct      | the engine's own vector type with fields x, y, z
   LOBE_API     | static inline | linkage of every function, with inline
   LOBE_ASSERT  | nothing       | called with each domain condition, e.g. assert

 Conventions: an SG is G(w) = exp(log_amplitude + sharpness (dot(w, axis) - 1)). Directions have unit length
 (to 1e-7) and point away from the surface; wi points towards the incoming light. alpha is GGX or Beckmann
 roughness. Colour stays outside the lobe. Lengths are in any one unit; powers in watts or any one unit.

 Errors: "conditioned" is in (1 + |ln g|) 2^-24, g the exact value: what rounding of the inputs alone costs an
 exponential; where ln g is a sum, |ln g| stands for the sum of its terms' sizes. "ulp" is the spacing of floats at the
 exact value. "rel" is relative. Values below 2^-122, or below that of the peak, may be flushed to 0. Bounds hold for
 the sharpness range given.

 Edges: a sharpness below 0 counts as 0, one above 1e30 as that or as infinite. Amplitudes saturate at 2^122. Out of
 finite input comes no NaN and no infinity: for unit directions, any sharpness, log amplitudes up to 1e30 in size,
 lengths up to 1e5 and powers up to 1e18.

 Loops: a plain loop over any function here, on arrays that hold one number each, becomes vector code in gcc and clang
 by -O3 and an instruction set alone. That takes exponentials, logarithms and turns of our own, since the C library's
 are calls; a sqrtf that may not set errno; and minima by the bits, where a float comparison, which may trap, would stay
 a branch. All of it is C99 without intrinsics, and as right with -ffast-math.

 Functions:

   sg_eval                          value in a direction
   sg_integral                      over the sphere
   sg_normalize                     scales the amplitude to unit integral
   sg_sample, sg_pdf                a direction drawn from it; its density
   sg_product                       of two SGs, again an SG
   sg_product_integral, _approx     exact; Iwasaki 2012
   sg_convolve                      with a normalised SG kernel
   sg_cosine_integral, _approx      against a clamped cosine; by a shorter fit
   sg_mean_length                   Toksvig: length of the mean direction
   sg_sharpness_from_mean_length    its inverse
   sg_diffuse_lobe                  Lambert reflection lobe, normalised
   sg_reflection_lobe               microfacet reflection lobe from the sharpness of an NDF
   sg_ggx_lobe, sg_beckmann_lobe, sg_phong_lobe
   vsgl_moments_from_vpl, vsgl_moments_add, vsgl_moments_scale
   vsgl_from_moments                the light of a cluster of virtual point lights: linear sums, for mipmaps
   vsgl_cluster_from_vpl, vsgl_cluster_merge
   vsgl_from_cluster                the same light by merging, for any sharpness and any place
   vsgl_incoming_lobe               its radiance seen from a point
   vsgl_diffuse, _integral          its light reflected by a diffuse surface: the papers', accurate
   vsl_lobe                         the solid angle of a virtual spherical light

 Papers named in the sources: 000 and 002 are Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual
 Spherical Gaussian Lights (000 the supplement); 001 is Tokuyoshi 2015, Virtual Spherical Gaussian Lights for
 Real-Time Glossy Indirect Illumination (supplement); 004 is Tokuyoshi 2015, Specular Lobe-Aware Filtering and
 Upsampling for Interactive Indirect Illumination.
*/
#ifndef LOBE_SG_H
#define LOBE_SG_H

#ifndef LOBE_VERSION
#define LOBE_VERSION 10000 /* 10000 major + 100 minor + patch */
#elif LOBE_VERSION != 10000
#error "headers of different versions of Lobe"
#endif

#include <math.h>
#include <string.h>

/* Says that sqrtf has no effect but its value: gcc, which otherwise heeds errno, then vectorises it. */
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wredundant-decls"
#if !defined(__cplusplus)
extern __attribute__((__const__)) float sqrtf(float);
#elif defined(__GLIBC__)
extern "C" __attribute__((__const__)) float sqrtf(float) __THROW;
#endif
#pragma GCC diagnostic pop
#endif

#ifndef LOBE_API
#define LOBE_API static inline
#endif
#ifdef __GNUC__
#define LOBE_INLINE                                                                                                    \
    LOBE_API __attribute__((always_inline)) /* for what would stay a call in a loop, since it is large */
#else
#define LOBE_INLINE LOBE_API
#endif
#ifndef LOBE_ASSERT
#define LOBE_ASSERT(condition) ((void)0)
#endif

/* ---- types ---- */

#ifdef LOBE_VEC3
typedef LOBE_VEC3 lobe_vec3;
#else
typedef struct lobe_vec3 {
    float x, y, z;
} lobe_vec3;
#endif

typedef struct sg_lobe {
    lobe_vec3 axis;
    float sharpness;
    float log_amplitude; /* natural logarithm of the peak value */
} sg_lobe;

enum { VSGL_DIFFUSE = 0, VSGL_SPECULAR = 1 };

/* Power-weighted sums over virtual point lights; 16 floats, all linear, so they may be added, scaled and mipmapped.
   The weight of a component is the mean of its power's three channels. */
typedef struct vsgl_moments {
    lobe_vec3 power[2];     /* reflected power Phi R, diffuse and specular */
    lobe_vec3 direction[2]; /* weight times mean emission direction, diffuse and specular */
    lobe_vec3 position;     /* both weights times position relative to an origin */
    float position_squared; /* both weights times squared distance from that origin */
} vsgl_moments;

/* A cluster of virtual point lights that may be merged with others, at any sharpness and far from the origin. */
typedef struct vsgl_cluster {
    lobe_vec3 power[2];   /* reflected power Phi R, diffuse and specular */
    sg_lobe direction[2]; /* axis; weight times mean length; minus what that is short of the weight */
    lobe_vec3 origin;     /* a position in the cluster */
    lobe_vec3 offset;     /* of the mean position from it */
    float spread;         /* weight times variance of the position */
} vsgl_cluster;

/* A virtual spherical Gaussian light. Radiant intensity of a component: intensity[k] * sg_eval(emission[k], w). */
typedef struct vsgl {
    lobe_vec3 position;     /* mean */
    float variance;         /* of the position, length squared */
    sg_lobe emission[2];    /* peak 1, diffuse and specular */
    lobe_vec3 intensity[2]; /* peak radiant intensity, the paper's c_v */
} vsgl;

/* ---- small numerics ---- */

#define LOBE_PI 3.14159265f
#define LOBE_LOG2E 1.44269504f
#define LOBE_TINY 1e-30f /* keeps quotients finite */
#define LOBE_HUGE 1e30f

LOBE_API float lobe_min(float a, float b) {
    return a < b ? a : b;
}

LOBE_API float lobe_max(float a, float b) {
    return a > b ? a : b;
}

/* max(x, low) and min(x, high) for low, high >= 0: by the bits, which order like the values there. Next to a division
   or a conversion gcc vectorises no minimum of floats, since it may trap. */
LOBE_API float lobe_at_least(float x, float low) {
    int a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &low, sizeof b);
    a = a > b ? a : b;
    memcpy(&x, &a, sizeof x);
    return x;
}

LOBE_API float lobe_at_most(float x, float high) {
    int a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &high, sizeof b);
    a = a < b ? a : b;
    memcpy(&x, &a, sizeof x);
    return x;
}

/* a where condition is 1, b where it is 0: both are computed, as vector code has it */
LOBE_API float lobe_select(int condition, float a, float b) {
    unsigned i, j, mask = 0u - (unsigned)condition;
    memcpy(&i, &a, sizeof i);
    memcpy(&j, &b, sizeof j);
    i = (i & mask) | (j & ~mask);
    memcpy(&a, &i, sizeof a);
    return a;
}

LOBE_API lobe_vec3 lobe_vector(float x, float y, float z) {
    lobe_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

LOBE_API lobe_vec3 lobe_add(lobe_vec3 a, lobe_vec3 b) {
    return lobe_vector(a.x + b.x, a.y + b.y, a.z + b.z);
}

LOBE_API lobe_vec3 lobe_sub(lobe_vec3 a, lobe_vec3 b) {
    return lobe_vector(a.x - b.x, a.y - b.y, a.z - b.z);
}

LOBE_API lobe_vec3 lobe_scale(lobe_vec3 a, float s) {
    return lobe_vector(a.x * s, a.y * s, a.z * s);
}

LOBE_API float lobe_dot(lobe_vec3 a, lobe_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

LOBE_API lobe_vec3 lobe_cross(lobe_vec3 a, lobe_vec3 b) {
    return lobe_vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* v / |v| for lengths from 1e-15 to 1e18; the fallback below 1e-18. Chosen field by field, since clang does not
   vectorise a choice of structs. */
LOBE_API lobe_vec3 lobe_normalize_or(lobe_vec3 v, lobe_vec3 fallback) {
    float size = sqrtf(lobe_dot(v, v)), inverse = 1 / lobe_at_least(size, 1e-18f);
    int long_enough = size > 1e-18f;
    return lobe_vector(lobe_select(long_enough, v.x * inverse, fallback.x),
                       lobe_select(long_enough, v.y * inverse, fallback.y),
                       lobe_select(long_enough, v.z * inverse, fallback.z));
}

/* The mean of three channels: the scalar weight of a colour. */
LOBE_API float lobe_mean(lobe_vec3 colour) {
    return (colour.x + colour.y + colour.z) * 0.333333333f;
}

/* (2^r - 1) / r for |r| <= 1/2, to 2^-25 */
LOBE_API float lobe_exp2_slope(float r) {
    float r2 = r * r;
    return (0.693147182f + 0.240226477f * r) +
           r2 * ((0.0555035956f + 0.00961850304f * r) + r2 * (0.00133909856f + 0.000153275338f * r));
}

/* Splits x = k + r with integer k and |r| <= 1/2; returns r, sets k and 2^k. Saturates below -127 (to 0), where the
   bits of negative floats order as unsigned integers, and above 122: times a few powers of 2 still finite. */
LOBE_API float lobe_exp2_split(float x, float *whole, float *power) {
    unsigned u;
    int s;
    x = lobe_at_most(x, 122);
    memcpy(&u, &x, sizeof u);
    u = u < 0xC2FE0000u ? u : 0xC2FE0000u; /* -127 */
    memcpy(&x, &u, sizeof x);
    s = (int)(x + 127.5f); /* k + 127, never negative */
    u = (unsigned)s << 23;
    memcpy(power, &u, sizeof *power);
    *whole = (float)(s - 127);
    return x - *whole;
}

/* 2^x; 0 below -126.5, 2^122 above 122.   [bound lobe_exp2 rel 1.1e-7] */
LOBE_API float lobe_exp2(float x) {
    float whole, power, r = lobe_exp2_split(x, &whole, &power);
    return power * (1 + r * lobe_exp2_slope(r));
}

LOBE_API float lobe_exp(float x) {
    return lobe_exp2(LOBE_LOG2E * x);
}

/* (1 - e^-x) / x for x >= 0; 1 at 0 and below, 0 at infinity.   [bound lobe_phi rel 2.5e-7]
   With -x log2(e) = k + r all terms are positive, and the last is exactly 0 for k = 0, in whatever order they are
   added. */
LOBE_API float lobe_phi(float x) {
    float whole, power, r, slope;
    x = lobe_at_least(x, LOBE_TINY);
    r = lobe_exp2_split(-LOBE_LOG2E * x, &whole, &power);
    slope = lobe_exp2_slope(r);
    return power * slope * LOBE_LOG2E + (1 - power * (1 - whole * slope)) / x;
}

/* ln(1 + f) / f for -.293 <= f <= .415, to 2^-24 */
LOBE_API float lobe_log_slope(float f) {
    float f2 = f * f;
    return 1 + f * ((-0.499999911f + 0.333339512f * f) +
                    f2 * ((-0.250017554f + 0.199620724f * f) +
                          f2 * ((-0.165705085f + 0.149179727f * f) + f2 * (-0.143075228f + 0.0873484462f * f))));
}

/* ln x; at 0 and below 2^-126 that of 2^-126.   [bound lobe_log rel 2e-7] */
LOBE_API float lobe_log(float x) {
    unsigned u;
    float f;
    x = lobe_at_least(x, 1.17549435e-38f);
    memcpy(&u, &x, sizeof u);
    u += 0x3F800000u - 0x3F3504F3u; /* so that the mantissa starts at sqrt(1/2) */
    x = (float)((int)(u >> 23) - 127);
    u = (u & 0x007FFFFFu) + 0x3F3504F3u;
    memcpy(&f, &u, sizeof f);
    f -= 1;
    return 0.693147181f * x + f * lobe_log_slope(f);
}

/* -ln(1 - x) / x for x in [0, 1], which counts as at most 1 - 2^-24; 1 at 0.   [bound lobe_log1m_slope rel 3e-7]
   1 - x = 2^-m (1 + f), where 2^m - 1 is made of integers: in floats it could be added in another order. */
LOBE_API float lobe_log1m_slope(float x) {
    unsigned u;
    int m;
    float f;
    x = lobe_at_least(lobe_at_most(x, 0.999999940f), LOBE_TINY);
    f = 1 - x;
    memcpy(&u, &f, sizeof u);
    m = 127 - (int)((u + (0x3F800000u - 0x3F3504F3u)) >> 23);
    f = (float)((1 << m) - 1) - x * (float)(1 << m);
    return (0.693147181f * (float)m - f * lobe_log_slope(f)) / x;
}

/* cos and sin of 2 pi v for v in [0, 1], clamped to it.   [bound lobe_turn abs 1.3e-7] */
LOBE_API void lobe_turn(float v, float *cosine, float *sine) {
    float turns = 4 * lobe_at_most(lobe_at_least(v, 0), 1);
    int quarter = (int)(turns + 0.5f), odd = quarter & 1, negative = (quarter >> 1) & 1;
    float r = turns - (float)quarter, r2 = r * r;
    float s = r * (1.57079637f + r2 * (-0.645963490f + r2 * (0.0796800330f - 0.00460165786f * r2)));
    float c = 1 + r2 * (-1.23370051f + r2 * (0.253669232f + r2 * (-0.0208602883f + 0.000904021726f * r2)));
    *cosine = lobe_select(odd, s, c) * (float)(1 - 2 * (odd ^ negative));
    *sine = lobe_select(odd, c, s) * (float)(1 - 2 * negative);
}

/* Two unit vectors perpendicular to a unit axis and to each other, after Duff et al. 2017 */
LOBE_API void lobe_frame(lobe_vec3 axis, lobe_vec3 *x, lobe_vec3 *y) {
    float sign = copysignf(1, axis.z), s = -1 / (sign + axis.z), t = axis.x * axis.y * s;
    *x = lobe_vector(1 + sign * axis.x * axis.x * s, sign * t, -sign * axis.x);
    *y = lobe_vector(t, sign + axis.y * axis.y * s, -axis.y);
}

/* |a - b|^2 of unit vectors, insensitive to a difference of their lengths: the part of a - b along a + b is removed. */
LOBE_API float lobe_chord_squared(lobe_vec3 a, lobe_vec3 b) {
    lobe_vec3 d = lobe_sub(a, b);
    float along = lobe_dot(d, lobe_add(a, b)); /* twice that part for neighbours; for others it is rounding */
    return lobe_at_least(lobe_dot(d, d) - 0.25f * along * along, 0);
}

/* ---- evaluate and integrate ---- */

/*
 sg_eval - value of an SG in a direction

   g, dir     sharpness [0, 1e30]
   returns    exp(log_amplitude + sharpness (dot(dir, axis) - 1)); 0 below 2^-126, saturates at 2^122

   Rounding: <= 9.5 (1 + |ln g|) 2^-24   [bound sg_eval conditioned 9.5 over 1e-8 1e10]
   Model:    exact
   Source:   000, section 2, as -sharpness |dir - axis|^2 / 2, which does not cancel near the axis
*/
LOBE_API float sg_eval(sg_lobe g, lobe_vec3 dir) {
    LOBE_ASSERT(g.sharpness >= 0);
    return lobe_exp(g.log_amplitude - 0.5f * g.sharpness * lobe_chord_squared(g.axis, dir));
}

/*
 sg_integral - integral of a unit-amplitude SG over the sphere

   sharpness  [0, 1e30]
   returns    (0, 4 pi]; 4 pi at 0, 0 at infinity

   Rounding: <= 3e-7 relative   [bound sg_integral rel 3e-7 over 1e-30 1e30]
   Model:    exact
   Source:   000, section 2: 2 pi (1 - exp(-2 sharpness)) / sharpness
*/
LOBE_API float sg_integral(float sharpness) {
    LOBE_ASSERT(sharpness >= 0);
    return 4 * LOBE_PI * lobe_phi(2 * sharpness);
}

/*
 sg_normalize - the SG with the same axis and sharpness whose integral is 1 (von Mises-Fisher)

   g          sharpness [0, 1e30]; its amplitude does not matter
   returns    g with log_amplitude = -ln(sg_integral(sharpness))

   Rounding: integral within 2.5e-6 of 1 for sharpness up to 1e10   [bound sg_normalize rel 2.5e-6 over 1e-8 1e10]
   Model:    exact
   Source:   000, section 2
*/
LOBE_API sg_lobe sg_normalize(sg_lobe g) {
    g.log_amplitude = -lobe_log(sg_integral(g.sharpness));
    return g;
}

/*
 sg_sample - a direction drawn in proportion to an SG

   g          sharpness [0, 1e30]; its amplitude does not matter
   u, v       [0, 1]; evenly spread over the unit square for directions spread like the SG; u = 0 is the axis
   returns    a direction of density sg_pdf(g, direction)

   Rounding: the lobe's share within the direction's angle is u to 6 (1 + sqrt(sharpness)) 2^-24, the second term for
             directions being floats   [bound sg_sample share 6 over 1e-8 1e10]
             Lengths are 1 to 5e-7 for an axis of length 1   [bound sg_sample length 5e-7]
   Model:    exact
   Source:   inversion of 1 - exp(-sharpness t) for t = 1 - cos, by t = -ln(1 - x) / sharpness, x = u (1 - exp(-2
             sharpness)), with both functions divided by their arguments, so that sharpness 0 is the whole sphere
*/
LOBE_API lobe_vec3 sg_sample(sg_lobe g, float u, float v) {
    float reach = 2 * lobe_phi(2 * g.sharpness) * u, slope = lobe_log1m_slope(g.sharpness * reach);
    float t = lobe_at_most(reach * slope, 2), sine = sqrtf(t * (2 - t)), x, y;
    lobe_vec3 a, b;
    LOBE_ASSERT(g.sharpness >= 0 && u >= 0 && u <= 1 && v >= 0 && v <= 1);
    lobe_frame(g.axis, &a, &b);
    lobe_turn(v, &x, &y);
    return lobe_add(lobe_scale(g.axis, 1 - t), lobe_scale(lobe_add(lobe_scale(a, x), lobe_scale(b, y)), sine));
}

/*
 sg_pdf - density of sg_sample per solid angle

   g, dir     sharpness [0, 1e30]; the amplitude of g does not matter
   returns    sg_eval(sg_normalize(g), dir)

   Rounding: <= 12 (1 + |ln g|) 2^-24, g the value over its peak   [bound sg_pdf conditioned 12 over 1e-8 1e10]
   Model:    exact
   Source:   000, section 2
*/
LOBE_API float sg_pdf(sg_lobe g, lobe_vec3 dir) {
    LOBE_ASSERT(g.sharpness >= 0);
    return lobe_exp(-0.5f * g.sharpness * lobe_chord_squared(g.axis, dir)) /
           sg_integral(lobe_at_most(g.sharpness, LOBE_HUGE));
}

/* A lobe's sharpness as the product takes it. */
LOBE_API float lobe_sharpness(sg_lobe g) {
    return lobe_at_most(lobe_at_least(g.sharpness, 0), LOBE_HUGE);
}

/* The weighted mean (la a + lb b) / (la + lb) of two axes: the axis of the product, unnormalised; exactly 0 for opposed
   lobes of equal sharpness. */
LOBE_API lobe_vec3 lobe_product_mean(sg_lobe a, sg_lobe b) {
    float la = lobe_sharpness(a), lb = lobe_sharpness(b), difference = (la - lb) / lobe_at_least(la + lb, LOBE_TINY);
    return lobe_scale(lobe_add(lobe_add(a.axis, b.axis), lobe_scale(lobe_sub(a.axis, b.axis), difference)), 0.5f);
}

/* Where two SGs multiply: sharpness of the product from its mean axis, and log of what the misalignment costs (<= 0),
   which is |la a + lb b| - la - lb without cancellation. */
LOBE_API float lobe_product_sharpness(sg_lobe a, sg_lobe b, lobe_vec3 mean, float *log_loss) {
    float la = lobe_sharpness(a), lb = lobe_sharpness(b), sum = la + lb;
    float sharpness = sum * sqrtf(lobe_dot(mean, mean)), chord2 = lobe_chord_squared(a.axis, b.axis);
    /* the minimum does nothing, but keeps -ffast-math from forming la * lb, which may overflow */
    *log_loss = -(la * chord2) * lobe_at_most(lb / lobe_at_least(sharpness + sum, LOBE_TINY), 1);
    return sharpness;
}

/*
 sg_product - the product of two SGs, which is an SG

   a, b       sharpness [0, 1e30]
   returns    a lobe with sg_eval(result, w) = sg_eval(a, w) sg_eval(b, w); for opposed axes of equal sharpness the
              result has sharpness 0 and the axis of a

   Rounding: values <= 11 (1 + |ln g| + sharpness (2^-23 + angle to the axis)) 2^-24, the last term for the axis being
             floats   [bound sg_product conditioned 11 over 1e-8 1e10]
   Model:    exact
   Source:   001, Eq. 1
*/
LOBE_API sg_lobe sg_product(sg_lobe a, sg_lobe b) {
    sg_lobe g;
    lobe_vec3 mean = lobe_product_mean(a, b);
    float log_loss;
    LOBE_ASSERT(a.sharpness >= 0 && b.sharpness >= 0);
    g.sharpness = lobe_product_sharpness(a, b, mean, &log_loss);
    g.log_amplitude = a.log_amplitude + b.log_amplitude + log_loss;
    g.axis = lobe_normalize_or(mean, a.axis);
    return g;
}

/*
 sg_product_integral - integral of the product of two SGs over the sphere

   a, b       sharpness [0, 1e30]
   returns    [0, 4 pi] times both amplitudes; 4 pi when both sharpnesses are 0

   Rounding: <= 12 (1 + |ln g|) 2^-24, g the value over that of aligned axes
             [bound sg_product_integral conditioned 12 over 1e-8 1e10]
   Model:    exact
   Source:   Tsai and Shih 2006; 000, section 2 with 001, Eq. 1
*/
LOBE_API float sg_product_integral(sg_lobe a, sg_lobe b) {
    float log_loss, sharpness;
    LOBE_ASSERT(a.sharpness >= 0 && b.sharpness >= 0);
    sharpness = lobe_product_sharpness(a, b, lobe_product_mean(a, b), &log_loss);
    return lobe_exp(a.log_amplitude + b.log_amplitude + log_loss) * sg_integral(sharpness);
}

/*
 sg_product_integral_approx - Iwasaki's form of the same integral, without a square root

   a, b       sharpness [0, 1e30], their sum at least about 10 for the model to hold
   returns    [0, 2 pi / (sum of sharpness)] times both amplitudes; the sum counts as at
              least 1e-8, the amplitudes' product as at most 5e29

   Rounding: <= 12 (1 + |ln g|) 2^-24, g the value over that of aligned axes
             [bound sg_product_integral_approx conditioned 12 over 1e-8 1e10]
   Model:    relative error 1 / (exp(2 sum) - 1) for aligned axes; within .033 of the aligned value at any angle when
             both sharpnesses are at least 4, the worst for equal ones
             [bound sg_product_integral_approx model 0.033 over 4 1e5]
   Source:   Iwasaki, Dobashi and Nishita 2012; 004, section 4.1
*/
LOBE_API float sg_product_integral_approx(sg_lobe a, sg_lobe b) {
    /* log2(e) / 2 over the sum of sharpnesses saves a rounding of the exponent, which is one of base 2 */
    float inverse = 0.721347520f / lobe_at_least(a.sharpness + b.sharpness, 1e-8f);
    float chord2 = lobe_chord_squared(a.axis, b.axis);
    /* the minimum keeps -ffast-math from forming the product of sharpnesses, as in lobe_product_sharpness */
    float loss = chord2 * (a.sharpness * lobe_at_most(b.sharpness * inverse, 1));
    float value = lobe_exp2(LOBE_LOG2E * (a.log_amplitude + b.log_amplitude) - loss);
    LOBE_ASSERT(a.sharpness >= 0 && b.sharpness >= 0);
    return 8.71034436f * inverse * lobe_at_most(value, 5e29f); /* 2 pi over that constant */
}

/*
 sg_convolve - an SG blurred by a normalised SG kernel

   g          sharpness [0, 1e30]
   kappa      sharpness of the kernel, (0, infinity], counts as at least 1e-8; infinity leaves g as it is
   returns    the same axis, sharpness / (1 + sharpness / kappa), the amplitude scaled by the same factor

   Rounding: <= 2e-7 relative in sharpness   [bound sg_convolve rel 2e-7 over 1e-8 1e10]
   Model:    Iwasaki's product integral; the flat-space integral is kept exactly
   Source:   004, Eq. 10 times kappa / (2 pi)
*/
LOBE_API sg_lobe sg_convolve(sg_lobe g, float kappa) {
    float sharpness = lobe_at_least(g.sharpness, 0), ratio = sharpness / lobe_at_least(kappa, 1e-8f);
    LOBE_ASSERT(g.sharpness >= 0 && kappa > 0);
    g.sharpness = sharpness / (1 + ratio);
    g.log_amplitude -= lobe_log(1 + ratio);
    return g;
}

/* The clamped cosine's mean over an SG, f(c), for the cosine c of axis and normal. f(c) - f(-c) = c (coth l - 1/l)
   holds exactly, so only the tail f(-|c|) is fitted: by z^-1/2 P(1/w) exp(-(x^2 / (w + z) + Q(x z^-1/2, 1/z))) for
   x = |c| l, where w^2 = l^2 + const and z^2 = l^2 - x^2 + const are smooth down to sharpness 0 and up to |c| = 1. The
   limit for sharp lobes, a plane Gaussian's, is fitted too. */
LOBE_API float lobe_cosine_mean(float sharpness, float cosine) {
    float l = lobe_at_most(lobe_at_least(sharpness, 0), 1e18f), l2 = l * l, x = lobe_at_most(fabsf(cosine), 1) * l;
    float above = lobe_at_most(lobe_at_least(cosine, 0), 1);
    float w = sqrtf(l2 + 10.080625f), z = sqrtf((l - x) * (l + x) + 13.883076f);
    float u = 3.175f / w, u2 = u * u, r = 1 / z, v = sqrtf(r), y2 = lobe_at_most(x * (x * r), 100);
    float q1 = 1.25318596f + r * (-0.700925667f + r * 3.07821469f);
    float q2 = -0.21428287f + r * (-0.126762269f + r * 1.92073004f);
    float q3 = 0.0295007156f + r * (-0.063974765f - r * 0.312272612f);
    float q4 = -0.00220048637f + r * 0.0151185746f;
    float exponent = x * (x / (w + z)) + y2 * (q2 + y2 * q4) + v * (x * (q1 + y2 * q3));
    float peak = (0.39893968f - u * 0.0436513933f) + u2 * (0.107626766f + u * 0.0196575116f);
    /* the mean length coth l - 1/l is 1 - loss, of which 1 - l / w is formed without the ones */
    float slope = (-0.31499975f + u * 0.503122666f) +
                  u2 * ((-0.341972456f + u * 0.444359873f) + u2 * (-0.313914669f + u * 0.0817299432f));
    float short_by = u * (3.175f / (w + l)), loss = short_by + (short_by - 1) * (u * slope);
    /* Legendre's expansion, where all this rounds worse */
    float series =
        0.25f + l * (cosine * (0.166666667f - 0.0111111111f * l2) + l * (0.03125f * (cosine * cosine) - 0.0104166667f));
    return lobe_select(l < 0.1f, series, peak * v * lobe_exp(-exponent) + (above - above * loss));
}

/* The same by a shorter fit: one division, one square root and a short exponential. */
LOBE_API float lobe_cosine_mean_approx(float sharpness, float cosine) {
    float l = lobe_at_most(lobe_at_least(sharpness, 0), 1e18f), x = lobe_at_most(fabsf(cosine), 1) * l;
    float h = (l + 2.57784986f) / (l * (l + 2.49227571f) + 7.00595474f), h2 = h * h, v = sqrtf(h), y2 = x * (x * h);
    float even = ((-1.31730588f - h * 0.65896567f) + h2 * (4.65359893f - h * 7.03151852f)) +
                 y2 * ((-0.648479621f + h * 0.7934065f) - y2 * 0.110719097f);
    float odd = (-1.76199382f + h * 0.447495883f) + y2 * (0.299139938f - h * 1.17481288f);
    float mean = l * h * (1 + h * (-1.03907259f + h * (5.65793909f - h * 9.70163327f)));
    float whole, power, e = lobe_exp2_split(even + v * (x * odd), &whole, &power);
    e = power *
        (0.999928057f + e * (0.693260968f + e * (0.242611125f + e * 0.0551716685f))); /* 2^x to 1e-4, as the rest is */
    return v * e + mean * lobe_at_least(cosine, 0);
}

/*
 sg_cosine_integral - integral of an SG times max(dot(w, normal), 0) over the sphere

   g          sharpness [0, 1e30]; above 1e18 it counts as 1e18 for the cosine
   returns    [0, pi] times the amplitude; pi at sharpness 0, 0 only where it underflows; all within the model's error

   Rounding: below the model's, or 1e-7 over sg_integral
   Model:    over sg_integral, within 3.1e-5 absolute; within 7e-6 for sharpness up to 1, and 8.5e-6 from 100 on; where it
             is above 1e-3 within 2 % relative
             [bound sg_cosine_integral abs 3.1e-5 over 1e-3 1e6] [bound sg_cosine_integral wide 7e-6 over 1e-3 1]
             [bound sg_cosine_integral sharp 8.5e-6 over 100 1e6] [bound sg_cosine_integral rel 2e-2 over 1e-3 1e6]
             At each of these sharpnesses at least as accurate as Tokuyoshi et al. 2024; with -ffast-math to 2^-24
   Source:   fitted for this library, see lobe_cosine_mean
*/
LOBE_API float sg_cosine_integral(sg_lobe g, lobe_vec3 normal) {
    LOBE_ASSERT(g.sharpness >= 0);
    return lobe_exp(g.log_amplitude) * sg_integral(g.sharpness) *
           lobe_cosine_mean(g.sharpness, lobe_dot(g.axis, normal));
}

/*
 sg_cosine_integral_approx - the same integral by a shorter fit

   g          sharpness [0, 1e30]
   returns    at least 0, and 0 in the far tail, times the amplitude

   Rounding: below the model's
   Model:    over sg_integral, within 4.5e-4 absolute   [bound sg_cosine_integral_approx abs 4.5e-4 over 1e-3 1e6]
   Source:   fitted for this library, see lobe_cosine_mean
*/
LOBE_API float sg_cosine_integral_approx(sg_lobe g, lobe_vec3 normal) {
    LOBE_ASSERT(g.sharpness >= 0);
    return lobe_exp(g.log_amplitude) * sg_integral(g.sharpness) *
           lobe_cosine_mean_approx(g.sharpness, lobe_dot(g.axis, normal));
}

/*
 sg_mean_length - length of the mean direction of a normalised SG, after Toksvig

   sharpness  [0, 1e30]
   returns    sharpness / (sharpness + 1), in [0, 1]

   Rounding: <= 2 ulp   [bound sg_mean_length ulp 2 over 1e-30 1e30]
   Model:    against the exact coth(l) - 1/l: at most .19 too large, at sharpness near 1; below 1 / l^2 above 10
             [bound sg_mean_length model 0.19 over 1e-4 1e4]
   Source:   Toksvig 2005; 000, section 3.1
*/
LOBE_API float sg_mean_length(float sharpness) {
    LOBE_ASSERT(sharpness >= 0);
    sharpness = lobe_at_least(sharpness, 0);
    return sharpness / (sharpness + 1);
}

/*
 sg_sharpness_from_mean_length - the sharpness whose Toksvig mean length is given

   mean_length  [0, 1]; clamped to it
   returns      mean_length / (1 - mean_length), saturating at 2^25: a float this near 1 tells no more

   Rounding: <= 2 ulp of the given length's own value   [bound sg_sharpness_from_mean_length ulp 2 over 1e-30 1]
   Model:    exact inverse of sg_mean_length; a round trip loses (sharpness + 2) 2^-23 relative
             [bound sg_sharpness_from_mean_length round_trip 0x1p-23]
   Source:   Toksvig 2005; 000, section 3.1
*/
LOBE_API float sg_sharpness_from_mean_length(float mean_length) {
    float clamped = lobe_at_least(lobe_at_most(mean_length, 1), 0);
    LOBE_ASSERT(mean_length >= 0 && mean_length <= 1.001f);
    return clamped / lobe_at_least(1 - clamped, 2.98023224e-8f); /* 2^-25 */
}

/* ---- reflection lobes ---- */

/*
 sg_diffuse_lobe - the Lambert reflection lobe as a normalised SG of sharpness 2

   returns    the lobe whose value times the albedo stands for BRDF times cosine; its integral is 1

   Rounding: integral within 3e-7 of 1   [bound sg_diffuse_lobe rel 3e-7]
   Model:    against max(cos, 0) / pi: within .053   [bound sg_diffuse_lobe model 0.053]
   Source:   000, Eq. 1
*/
LOBE_API sg_lobe sg_diffuse_lobe(lobe_vec3 normal) {
    sg_lobe g;
    g.axis = normal;
    g.sharpness = 2;
    g.log_amplitude = -1.12624444f; /* -ln(pi (1 - e^-4)) */
    return g;
}

/*
 sg_reflection_lobe - reflection lobe of a microfacet BRDF from the SG of its normal distribution

   normal, wi      wi may lie below the horizon; dot(wi, normal) is taken as at least 1e-4 in size
   half_sharpness  sharpness of the NDF as an SG of the half vector: 2 / alpha^2, or a Phong exponent
   returns         peak 1, around the mirror direction, sharpness half_sharpness / (4 |dot(mirror, normal)|)

   Rounding: sharpness <= 8 / |dot(wi, normal)| ulp, as of a rounded wi   [bound sg_reflection_lobe ulp 8]
   Model:    first-order warp of half vectors: the anisotropy at grazing angles is lost, see asg_ggx_lobe
   Source:   Wang et al. 2009; 000, section 2.1
*/
LOBE_API sg_lobe sg_reflection_lobe(lobe_vec3 normal, lobe_vec3 wi, float half_sharpness) {
    sg_lobe g;
    float cos_theta = lobe_dot(wi, normal);
    LOBE_ASSERT(half_sharpness >= 0);
    g.axis = lobe_normalize_or(lobe_sub(lobe_scale(normal, 2 * cos_theta), wi), normal);
    g.sharpness =
        lobe_at_most(lobe_at_least(half_sharpness, 0) / (4 * lobe_at_least(fabsf(cos_theta), 1e-4f)), LOBE_HUGE);
    g.log_amplitude = 0;
    return g;
}

/* sg_ggx_lobe, sg_beckmann_lobe, sg_phong_lobe - sg_reflection_lobe for alpha in [1e-4, 1] (clamped below) and for a
   Blinn-Phong exponent [0, 1e9]; the errors are its. GGX has heavier tails than any SG. sg_normalize makes any of them
   integrate to 1. */
LOBE_API sg_lobe sg_ggx_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) {
    float clamped = lobe_at_least(alpha, 1e-4f);
    return sg_reflection_lobe(normal, wi, 2 / (clamped * clamped));
}

LOBE_API sg_lobe sg_beckmann_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) {
    return sg_ggx_lobe(normal, wi, alpha); /* the same curvature at the peak */
}

LOBE_API sg_lobe sg_phong_lobe(lobe_vec3 normal, lobe_vec3 wi, float exponent) {
    return sg_reflection_lobe(normal, wi, exponent);
}

/* ---- virtual spherical Gaussian lights ---- */

/*
 vsgl_moments_from_vpl - the sums of one virtual point light

   offset     position relative to an origin near the cluster (for a scene far from 0: the scene's centre)
   normal     of the lit surface; wi towards the light that lit it
   diffuse    reflected power of the diffuse component, Phi R_d
   specular   reflected power of the specular component, Phi R_s
   alpha      GGX roughness of the specular component

   Rounding: <= 7 ulp of each vector's length, of each scalar   [bound vsgl_moments_from_vpl ulp 7]
   Model:    000, section 3.1: normalised SG lobes, Toksvig's mean length
   Source:   000, sections 3.1 to 3.3
*/
LOBE_API vsgl_moments vsgl_moments_from_vpl(lobe_vec3 offset, lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 diffuse,
                                            lobe_vec3 specular, float alpha) {
    vsgl_moments m;
    float wd = lobe_mean(diffuse), ws = lobe_mean(specular);
    sg_lobe lobe = sg_ggx_lobe(normal, wi, alpha);
    m.power[VSGL_DIFFUSE] = diffuse;
    m.power[VSGL_SPECULAR] = specular;
    m.direction[VSGL_DIFFUSE] = lobe_scale(normal, wd * sg_mean_length(2));
    m.direction[VSGL_SPECULAR] = lobe_scale(lobe.axis, ws * sg_mean_length(lobe.sharpness));
    m.position = lobe_scale(offset, wd + ws);
    m.position_squared = lobe_dot(offset, offset) * (wd + ws);
    return m;
}

/*
 vsgl_moments_add, vsgl_moments_scale - entry by entry

   Rounding: 2^-24 of each entry   [bound vsgl_moments_add rel 0x1p-24] [bound vsgl_moments_scale rel 0x1p-24]
   Model:    exact
   Source:   000, sections 3.1 to 3.3
*/
LOBE_API vsgl_moments vsgl_moments_add(vsgl_moments a, vsgl_moments b) {
    a.power[0] = lobe_add(a.power[0], b.power[0]);
    a.power[1] = lobe_add(a.power[1], b.power[1]);
    a.direction[0] = lobe_add(a.direction[0], b.direction[0]);
    a.direction[1] = lobe_add(a.direction[1], b.direction[1]);
    a.position = lobe_add(a.position, b.position);
    a.position_squared += b.position_squared;
    return a;
}

LOBE_API vsgl_moments vsgl_moments_scale(vsgl_moments m, float s) {
    m.power[0] = lobe_scale(m.power[0], s);
    m.power[1] = lobe_scale(m.power[1], s);
    m.direction[0] = lobe_scale(m.direction[0], s);
    m.direction[1] = lobe_scale(m.direction[1], s);
    m.position = lobe_scale(m.position, s);
    m.position_squared *= s;
    return m;
}

/* One component's lobe. */
LOBE_API sg_lobe lobe_vsgl_emission(lobe_vec3 power, lobe_vec3 direction) {
    sg_lobe g;
    lobe_vec3 mean = lobe_scale(direction, 1 / lobe_at_least(lobe_mean(power), LOBE_TINY));
    g.axis = lobe_normalize_or(mean, lobe_vector(0, 0, 1));
    g.sharpness = sg_sharpness_from_mean_length(lobe_at_most(sqrtf(lobe_dot(mean, mean)), 1));
    g.log_amplitude = 0;
    return g;
}

/*
 vsgl_from_moments - the virtual SG light of a cluster

   m          sums over the cluster; a component without power gets intensity 0
   origin     the origin that the positions were summed from
   returns    mean position, variance >= 0, a lobe of peak 1 and the peak intensity for each component

   Rounding: the variance loses (|mean - origin|^2 + variance) 2^-21 absolute: keep the origin near; the sharpness
             loses (sharpness + 4) 1.25 2^-21 relative and saturates at 2^25
             [bound vsgl_from_moments variance 0x1p-21] [bound vsgl_from_moments sharpness 0x1.4p-21]
   Model:    000: one SG for each component, one isotropic Gaussian for the positions
   Source:   000, sections 3.1 and 3.2
*/
LOBE_API vsgl vsgl_from_moments(vsgl_moments m, lobe_vec3 origin) {
    vsgl v;
    float weight = lobe_mean(m.power[0]) + lobe_mean(m.power[1]), inverse = 1 / lobe_at_least(weight, LOBE_TINY);
    lobe_vec3 mean = lobe_scale(m.position, inverse);
    v.position = lobe_add(origin, mean);
    v.variance = lobe_at_least(m.position_squared * inverse - lobe_dot(mean, mean), 0);
    v.emission[0] = lobe_vsgl_emission(m.power[0], m.direction[0]);
    v.emission[1] = lobe_vsgl_emission(m.power[1], m.direction[1]);
    v.intensity[0] = lobe_scale(m.power[0], 1 / sg_integral(v.emission[0].sharpness));
    v.intensity[1] = lobe_scale(m.power[1], 1 / sg_integral(v.emission[1].sharpness));
    return v;
}

/*
 vsgl_cluster_from_vpl - the cluster of one virtual point light

   position   in the scene, up to 1e5 from 0: no origin need be chosen
   others     as in vsgl_moments_from_vpl, which is what a GPU can mipmap; this is what stays exact

   Rounding: its light has a variance of 0, and its lobe's sharpness to 3e-7 relative up to 1e10
             [bound vsgl_cluster_from_vpl sharpness 3e-7 over 1e-3 1e10]
   Model:    as vsgl_moments_from_vpl
   Source:   000, section 3.1, with 1 - length beside the length, which near 1 tells nothing
*/
LOBE_API vsgl_cluster vsgl_cluster_from_vpl(lobe_vec3 position, lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 diffuse,
                                            lobe_vec3 specular, float alpha) {
    vsgl_cluster c;
    sg_lobe lobe = sg_ggx_lobe(normal, wi, alpha);
    float dd = lobe_mean(diffuse) / 3, ds = lobe_mean(specular) / (lobe.sharpness + 1);
    c.power[VSGL_DIFFUSE] = diffuse;
    c.power[VSGL_SPECULAR] = specular;
    c.direction[VSGL_DIFFUSE].axis = normal;
    c.direction[VSGL_DIFFUSE].sharpness = 2 * dd;
    c.direction[VSGL_DIFFUSE].log_amplitude = -dd;
    c.direction[VSGL_SPECULAR].axis = lobe.axis;
    c.direction[VSGL_SPECULAR].sharpness = lobe.sharpness * ds;
    c.direction[VSGL_SPECULAR].log_amplitude = -ds;
    c.origin = position;
    c.offset = lobe_vector(0, 0, 0);
    c.spread = 0;
    return c;
}

/*
 vsgl_cluster_merge - the cluster of two clusters' lights

   a, b       in any order and grouping; one of power 0 changes nothing
   returns    their union

   Rounding: variance within 1e-5 relative and mean position within 2.5e-6 of the cluster's size, wherever it lies;
             sharpness within 2e-6 relative; of 4096 lights, merged in pairs, and these in pairs. Added one by one they
             have a sharpness within 2.5e-4, as in any sum of floats
             [bound vsgl_cluster_merge variance 1e-5 over .01 100] [bound vsgl_cluster_merge mean 2.5e-6]
             [bound vsgl_cluster_merge sharpness 2e-6] [bound vsgl_cluster_merge chained 2.5e-4]
   Model:    exact: the same sums as vsgl_moments_add
   Source:   mean directions w_i l_i / (l_i + 1) add like the exponents of SGs, so that sg_product adds them, and minus
             its log amplitude is the sum of w_i / (l_i + 1) and what the directions' spread takes; variances after
             Chan, Golub and LeVeque 1979
*/
LOBE_API vsgl_cluster vsgl_cluster_merge(vsgl_cluster a, vsgl_cluster b) {
    vsgl_cluster c;
    float wa = lobe_mean(a.power[0]) + lobe_mean(a.power[1]), wb = lobe_mean(b.power[0]) + lobe_mean(b.power[1]);
    float inverse = 1 / lobe_at_least(wa + wb, LOBE_TINY), share;
    int first = wa >= wb;
    /* near positions have an exact difference; the minimum keeps -ffast-math from adding offsets to positions first */
    float x = lobe_at_most(b.origin.x - a.origin.x, LOBE_HUGE) + (b.offset.x - a.offset.x);
    float y = lobe_at_most(b.origin.y - a.origin.y, LOBE_HUGE) + (b.offset.y - a.offset.y);
    float z = lobe_at_most(b.origin.z - a.origin.z, LOBE_HUGE) + (b.offset.z - a.offset.z);
    c.power[0] = lobe_add(a.power[0], b.power[0]);
    c.power[1] = lobe_add(a.power[1], b.power[1]);
    c.direction[0] = sg_product(a.direction[0], b.direction[0]);
    c.direction[1] = sg_product(a.direction[1], b.direction[1]);
    /* the heavier one's origin, and the mean from there */
    share = lobe_select(first, wb, -wa) * inverse;
    c.origin.x = lobe_select(first, a.origin.x, b.origin.x);
    c.origin.y = lobe_select(first, a.origin.y, b.origin.y);
    c.origin.z = lobe_select(first, a.origin.z, b.origin.z);
    c.offset.x = lobe_select(first, a.offset.x, b.offset.x) + share * x;
    c.offset.y = lobe_select(first, a.offset.y, b.offset.y) + share * y;
    c.offset.z = lobe_select(first, a.offset.z, b.offset.z) + share * z;
    c.spread = a.spread + b.spread + wa * (wb * inverse) * (x * x + y * y + z * z);
    return c;
}

/* Toksvig's r / (1 - r) from both, each times the weight. */
LOBE_API float lobe_cluster_sharpness(sg_lobe direction) {
    return lobe_at_most(direction.sharpness / lobe_at_least(-direction.log_amplitude, 1e-37f), 1e18f);
}

/*
 vsgl_from_cluster - the virtual SG light of a cluster

   c          a component without power gets intensity 0
   returns    as vsgl_from_moments; the sharpness saturates at 1e18

   Rounding: <= 6 ulp of each figure that the cluster holds   [bound vsgl_from_cluster ulp 6]
   Model:    as vsgl_from_moments
   Source:   000, sections 3.1 and 3.2
*/
LOBE_API vsgl vsgl_from_cluster(vsgl_cluster c) {
    vsgl v;
    v.position = lobe_add(c.origin, c.offset);
    v.variance = c.spread / lobe_at_least(lobe_mean(c.power[0]) + lobe_mean(c.power[1]), LOBE_TINY);
    v.emission[0].axis = c.direction[0].axis;
    v.emission[1].axis = c.direction[1].axis;
    v.emission[0].sharpness = lobe_cluster_sharpness(c.direction[0]);
    v.emission[1].sharpness = lobe_cluster_sharpness(c.direction[1]);
    v.emission[0].log_amplitude = 0;
    v.emission[1].log_amplitude = 0;
    v.intensity[0] = lobe_scale(c.power[0], 1 / sg_integral(v.emission[0].sharpness));
    v.intensity[1] = lobe_scale(c.power[1], 1 / sg_integral(v.emission[1].sharpness));
    return v;
}

/* The incoming lobe but for its factor inverse_variance / (2 pi): the product of the light's extent, of sharpness d^2 /
   variance for the distance d, and its emission, with all sharpnesses times the variance: a variance of 0 is the point
   light. */
LOBE_API sg_lobe lobe_vsgl_incoming(vsgl v, int component, lobe_vec3 place, float *inverse_variance) {
    sg_lobe g;
    lobe_vec3 offset = lobe_sub(v.position, place), back, pull;
    float squared = lobe_dot(offset, offset), inverse, distance, sharpness, weight, size, chord2;
    /* field by field: an index would go through memory and stop vectorisation */
    back.x = -(component ? v.emission[1].axis.x : v.emission[0].axis.x);
    back.y = -(component ? v.emission[1].axis.y : v.emission[0].axis.y);
    back.z = -(component ? v.emission[1].axis.z : v.emission[0].axis.z);
    sharpness = component ? v.emission[1].sharpness : v.emission[0].sharpness;
    inverse = 1 / sqrtf(lobe_at_least(squared, LOBE_TINY));
    distance = squared * inverse;
    chord2 = lobe_chord_squared(lobe_scale(offset, inverse), back);
    weight = lobe_at_most(v.variance * sharpness, 1e18f); /* whose square is finite */
    pull = lobe_add(lobe_scale(offset, distance), lobe_scale(back, weight));
    size = sqrtf(lobe_dot(pull, pull));
    *inverse_variance = 1 / lobe_at_least(v.variance, 1e-20f);
    g.axis = lobe_normalize_or(pull, back);
    g.sharpness = size * *inverse_variance;
    g.log_amplitude =
        -(sharpness * chord2) * lobe_at_most(squared / lobe_at_least(size + squared + weight, LOBE_TINY), 1);
    return g;
}

/*
 vsgl_incoming_lobe - radiance that arrives at a point from one component of a virtual SG light

   component  VSGL_DIFFUSE or VSGL_SPECULAR
   place      at most 1e5 from the light; at the light itself the lobe points along the emission
   returns    the lobe that, times v.intensity[component], is the incoming radiance; visibility is the caller's

   Rounding: <= 80 (1 + |ln g| + angle * sharpness of the emission) 2^-24 in the integral, g the value over that on the
             emission's axis, the last term for directions being floats   [bound vsgl_incoming_lobe conditioned 80]
   Model:    000, section 4.1: positions projected onto the sphere around the point
   Source:   000, Eq. 7
*/
LOBE_API sg_lobe vsgl_incoming_lobe(vsgl v, int component, lobe_vec3 place) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, &inverse_variance);
    g.log_amplitude += lobe_log(inverse_variance * (0.5f / LOBE_PI));
    return g;
}

/* Light of an incoming lobe reflected by a white Lambert surface that it meets head-on. The minimum keeps -ffast-math
   from an order that underflows. */
LOBE_API float lobe_vsgl_flux(sg_lobe g, float inverse_variance) {
    return 2 / LOBE_PI * lobe_exp(g.log_amplitude) *
           lobe_at_most(inverse_variance * lobe_phi(2 * g.sharpness), LOBE_HUGE);
}

/*
 vsgl_diffuse - light of one component of a virtual SG light reflected by a Lambert surface

   component  VSGL_DIFFUSE or VSGL_SPECULAR
   place      of the surface with that normal, at most 1e5 from the light
   returns    reflected radiance per unit of v.intensity[component] and albedo; visibility is the caller's

   Rounding: <= 16 units of vsgl_incoming_lobe times the value for cosine 1; a variance of 0 gives the point light
             [bound vsgl_diffuse conditioned 16]
   Model:    the cosine is constant over the incoming lobe: right for small or far lights, black for a lobe that points
             below the horizon, up to 4 times too bright for a wide one; sg_cosine_integral does not have this error
   Source:   000, section 4.2
*/
LOBE_API float vsgl_diffuse(vsgl v, int component, lobe_vec3 place, lobe_vec3 normal) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, &inverse_variance);
    return lobe_vsgl_flux(g, inverse_variance) * lobe_max(lobe_dot(g.axis, normal), 0);
}

/*
 vsgl_diffuse_integral - the same light with the cosine integrated over the incoming lobe

   others     as in vsgl_diffuse
   returns    as vsgl_diffuse; positive also where the lobe's axis points below the horizon

   Rounding: <= 16 units of vsgl_incoming_lobe times the value for cosine 1
             [bound vsgl_diffuse_integral conditioned 16]
   Model:    that of sg_cosine_integral
   Source:   000, Eq. 7 with sg_cosine_integral
*/
LOBE_API float vsgl_diffuse_integral(vsgl v, int component, lobe_vec3 place, lobe_vec3 normal) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, &inverse_variance);
    return lobe_vsgl_flux(g, inverse_variance) * lobe_cosine_mean(g.sharpness, lobe_dot(g.axis, normal));
}

/* ---- virtual spherical lights ---- */

/*
 vsl_lobe - the solid angle of a virtual spherical light seen from a point, as an SG

   center, radius  of the sphere, radius [0, 1e5]
   place           at most 1e5 away; within the sphere it sees half of all directions, as on its surface
   returns         peak 1 towards the center, sharpness 4 pi / solid angle, 4 d^2 / radius^2 far away, at most 1e18;
                   its integral is half the solid angle

   Rounding: sharpness <= 5 (1 + 1 / cos) 2^-24 relative, but at most 6e-4, where sin = radius / distance
             [bound vsl_lobe conditioned 5 over 1e-6 1] [bound vsl_lobe rel 6e-4]
   Model:    twice the lobe has the cone's solid angle and mean cosine, but for exp(-2 sharpness): within .019 relative
             and .038   [bound vsl_lobe solid_angle .019] [bound vsl_lobe cosine .038]
   Source:   001, section B, with 1 - cos as sin^2 / (1 + cos)
*/
LOBE_API sg_lobe vsl_lobe(lobe_vec3 center, float radius, lobe_vec3 place) {
    sg_lobe g;
    lobe_vec3 offset = lobe_sub(center, place);
    float squared = lobe_dot(offset, offset), sine2;
    sine2 = lobe_at_most(radius * radius / lobe_at_least(squared, LOBE_TINY), 1);
    LOBE_ASSERT(radius >= 0);
    g.axis = lobe_normalize_or(offset, lobe_vector(0, 0, 1));
    g.sharpness = 2 * (1 + sqrtf(1 - sine2)) / lobe_at_least(sine2, 4e-18f);
    g.log_amplitude = 0;
    return g;
}

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
