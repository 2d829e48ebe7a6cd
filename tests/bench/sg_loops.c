/*
 sg_loops.c - one loop for each function of sg.h, which must become vector code, and one for each alternative: the
 papers' forms as printed with the C library's functions, and published approximations.
*/
#include "../tokuyoshi.h"
#include "sg_columns.h"

#define FROM &in->column[0][i], BENCH_COUNT
#define A lobe_in(FROM, LOBE_A)
#define B lobe_in(FROM, LOBE_B)
#define SHARPNESS in->column[LOBE_A + 3][i]
#define COSINE in->column[LOBE_COSINE][i]
#define OUT(k) out->column[k][i]

static inline void put_lobe(bench_output *restrict out, int i, int column, sg_lobe g) {
    out->column[column][i] = g.axis.x;
    out->column[column + 1][i] = g.axis.y;
    out->column[column + 2][i] = g.axis.z;
    out->column[column + 3][i] = g.sharpness;
    out->column[column + 4][i] = g.log_amplitude;
}

/* The light of one VPL, or of a cluster about it, for the shading functions. */
static inline vsgl light_in(const float *in, int stride) {
    vsgl v;
    sg_lobe lobe =
        sg_ggx_lobe(vector_in(in, stride, VPL_NORMAL), vector_in(in, stride, VPL_WI), in[VPL_ALPHA * stride]);
    v.position = vector_in(in, stride, VPL_POSITION);
    v.variance = in[VPL_VARIANCE * stride];
    v.emission[0] = lobe;
    v.emission[1] = lobe;
    v.intensity[0] = lobe_vector(1, 1, 1);
    v.intensity[1] = lobe_vector(1, 1, 1);
    return v;
}

#define LIGHT light_in(FROM)
#define POINT vector_in(FROM, VPL_POINT)
#define FACING vector_in(FROM, VPL_FACING)
#define NORMAL vector_in(FROM, VPL_NORMAL)
#define WI vector_in(FROM, VPL_WI)
#define ALPHA in->column[VPL_ALPHA][i]
#define POSITION vector_in(FROM, VPL_POSITION)

/* ---- ours ---- */

BENCH_LOOP(our_eval, OUT(0) = sg_eval(A, B.axis);)
BENCH_LOOP(our_integral, OUT(0) = sg_integral(SHARPNESS);)
BENCH_LOOP(our_normalize, OUT(0) = sg_normalize(A).log_amplitude;)
BENCH_LOOP(our_sample, {
    lobe_vec3 w = sg_sample(A, in->column[UNIFORM_U][i], in->column[UNIFORM_V][i]);
    OUT(0) = w.x;
    OUT(1) = w.y;
    OUT(2) = w.z;
})
BENCH_LOOP(our_pdf, OUT(0) = sg_pdf(A, B.axis);)
BENCH_LOOP(our_product, put_lobe(out, i, 0, sg_product(A, B));)
BENCH_LOOP(our_product_integral, OUT(0) = sg_product_integral(A, B);)
BENCH_LOOP(our_product_integral_approx, OUT(0) = sg_product_integral_approx(A, B);)
BENCH_LOOP(our_convolve, {
    sg_lobe g = sg_convolve(A, in->column[LOBE_B + 3][i]);
    OUT(0) = g.sharpness;
    OUT(1) = g.log_amplitude;
})
BENCH_LOOP(our_cosine, OUT(0) = sg_cosine_integral(A, B.axis);)
BENCH_LOOP(our_cosine_approx, OUT(0) = sg_cosine_integral_approx(A, B.axis);)
BENCH_LOOP(our_cosine_mean, OUT(0) = lobe_cosine_mean(SHARPNESS, COSINE);)
BENCH_LOOP(our_cosine_mean_approx, OUT(0) = lobe_cosine_mean_approx(SHARPNESS, COSINE);)
BENCH_LOOP(our_mean_length, OUT(0) = sg_mean_length(SHARPNESS);)
BENCH_LOOP(our_sharpness, OUT(0) = sg_sharpness_from_mean_length(SHARPNESS);)
BENCH_LOOP(our_diffuse_lobe, OUT(0) = sg_eval(sg_diffuse_lobe(A.axis), B.axis);)
BENCH_LOOP(our_ggx_lobe, put_lobe(out, i, 0, sg_ggx_lobe(NORMAL, WI, ALPHA));)
BENCH_LOOP(our_phong_lobe, put_lobe(out, i, 0, sg_phong_lobe(NORMAL, WI, ALPHA));)
BENCH_LOOP(our_moments, {
    lobe_vec3 none = lobe_vector(0, 0, 0), one = lobe_vector(1, 1, 1);
    vsgl_moments m = vsgl_moments_from_vpl(POSITION, NORMAL, WI, none, one, ALPHA);
    vsgl_moments n = vsgl_moments_from_vpl(POINT, NORMAL, WI, none, one, ALPHA);
    vsgl v = vsgl_from_moments(vsgl_moments_scale(vsgl_moments_add(m, n), 0.5f), lobe_vector(0, 0, 0));
    put_lobe(out, i, 0, v.emission[VSGL_SPECULAR]);
    OUT(5) = v.variance;
})
BENCH_LOOP(our_cluster, {
    lobe_vec3 none = lobe_vector(0, 0, 0), one = lobe_vector(1, 1, 1);
    vsgl_cluster m = vsgl_cluster_from_vpl(POSITION, NORMAL, WI, none, one, ALPHA);
    vsgl_cluster n = vsgl_cluster_from_vpl(POINT, NORMAL, WI, none, one, ALPHA);
    vsgl v = vsgl_from_cluster(vsgl_cluster_merge(m, n));
    put_lobe(out, i, 0, v.emission[VSGL_SPECULAR]);
    OUT(5) = v.variance;
})
BENCH_LOOP(our_incoming, put_lobe(out, i, 0, vsgl_incoming_lobe(LIGHT, VSGL_SPECULAR, POINT));)
BENCH_LOOP(our_vsgl_diffuse, OUT(0) = vsgl_diffuse(LIGHT, VSGL_SPECULAR, POINT, FACING);)
BENCH_LOOP(our_vsgl_diffuse_integral, OUT(0) = vsgl_diffuse_integral(LIGHT, VSGL_SPECULAR, POINT, FACING);)
BENCH_LOOP(our_vsl, put_lobe(out, i, 0, vsl_lobe(POSITION, in->column[VPL_VARIANCE][i], POINT));)

/* ---- as printed, with the C library ---- */

BENCH_LOOP(printed_eval, OUT(0) = expf(A.log_amplitude + SHARPNESS * (lobe_dot(A.axis, B.axis) - 1));)
BENCH_LOOP(printed_integral, OUT(0) = 2 * LOBE_PI * (1 - expf(-2 * SHARPNESS)) / SHARPNESS;)
BENCH_LOOP(expm1_integral, OUT(0) = -2 * LOBE_PI * expm1f(-2 * SHARPNESS) / SHARPNESS;)
BENCH_LOOP(printed_normalize, OUT(0) = logf(SHARPNESS / (2 * LOBE_PI * (1 - expf(-2 * SHARPNESS))));)
BENCH_LOOP(printed_pdf, OUT(0) = SHARPNESS / (2 * LOBE_PI * (1 - expf(-2 * SHARPNESS))) *
                                 expf(SHARPNESS * (lobe_dot(A.axis, B.axis) - 1));)

/* 001, Eq. 1 */
static inline sg_lobe printed_product_of(sg_lobe a, sg_lobe b) {
    sg_lobe g;
    lobe_vec3 m = lobe_add(lobe_scale(a.axis, a.sharpness), lobe_scale(b.axis, b.sharpness));
    g.sharpness = sqrtf(lobe_dot(m, m));
    g.axis = lobe_scale(m, 1 / g.sharpness);
    g.log_amplitude = a.log_amplitude + b.log_amplitude + g.sharpness - a.sharpness - b.sharpness;
    return g;
}

BENCH_LOOP(printed_product, put_lobe(out, i, 0, printed_product_of(A, B));)
BENCH_LOOP(printed_product_integral, {
    sg_lobe g = printed_product_of(A, B);
    OUT(0) = expf(g.log_amplitude) * (2 * LOBE_PI / g.sharpness) * (1 - expf(-2 * g.sharpness));
})

/* Iwasaki et al. 2012 */
BENCH_LOOP(printed_product_integral_approx, {
    sg_lobe a = A;
    sg_lobe b = B;
    float sum = a.sharpness + b.sharpness;
    OUT(0) = 2 * LOBE_PI / sum *
             expf(a.log_amplitude + b.log_amplitude + a.sharpness * b.sharpness / sum * (lobe_dot(a.axis, b.axis) - 1));
})
BENCH_LOOP(printed_convolve, {
    float kappa = in->column[LOBE_B + 3][i];
    OUT(0) = SHARPNESS * kappa / (SHARPNESS + kappa);
    OUT(1) = logf(kappa / (SHARPNESS + kappa));
})
BENCH_LOOP(printed_mean_length, OUT(0) = SHARPNESS / (SHARPNESS + 1);)
BENCH_LOOP(printed_sharpness, OUT(0) = SHARPNESS / (1 - SHARPNESS);)
BENCH_LOOP(printed_sample, {
    float u = in->column[UNIFORM_U][i];
    float v = in->column[UNIFORM_V][i];
    float z = 1 + logf(u + (1 - u) * expf(-2 * SHARPNESS)) / SHARPNESS;
    float r = sqrtf(1 - z * z);
    lobe_vec3 x;
    lobe_vec3 y;
    lobe_vec3 w;
    lobe_frame(A.axis, &x, &y);
    w = lobe_add(lobe_scale(A.axis, z),
                 lobe_add(lobe_scale(x, r * cosf(2 * LOBE_PI * v)), lobe_scale(y, r * sinf(2 * LOBE_PI * v))));
    OUT(0) = w.x;
    OUT(1) = w.y;
    OUT(2) = w.z;
})

/* 000, section 2.1 */
BENCH_LOOP(printed_ggx_lobe, {
    sg_lobe g;
    float cosine = lobe_dot(NORMAL, WI);
    g.axis = lobe_sub(lobe_scale(NORMAL, 2 * cosine), WI);
    g.sharpness = 1 / (2 * ALPHA * ALPHA * fabsf(lobe_dot(g.axis, NORMAL)));
    g.log_amplitude = 0;
    put_lobe(out, i, 0, g);
})

/* 000, Eq. 7, of which the amplitude is kept as a logarithm */
static inline sg_lobe printed_incoming_of(vsgl v, lobe_vec3 point) {
    sg_lobe extent;
    sg_lobe emission = v.emission[VSGL_SPECULAR];
    sg_lobe g;
    lobe_vec3 offset = lobe_sub(v.position, point);
    float squared = lobe_dot(offset, offset);
    extent.axis = lobe_scale(offset, 1 / sqrtf(squared));
    extent.sharpness = squared / v.variance;
    extent.log_amplitude = 0;
    emission.axis = lobe_scale(emission.axis, -1);
    g = printed_product_of(extent, emission);
    g.log_amplitude += logf(1 / (2 * LOBE_PI * v.variance));
    return g;
}

BENCH_LOOP(printed_incoming, put_lobe(out, i, 0, printed_incoming_of(LIGHT, POINT));)
BENCH_LOOP(printed_vsgl_diffuse, {
    sg_lobe g = printed_incoming_of(LIGHT, POINT);
    float cosine = lobe_dot(g.axis, FACING);
    OUT(0) = expf(g.log_amplitude) * 2 * (1 - expf(-2 * g.sharpness)) / g.sharpness * (cosine > 0 ? cosine : 0);
})
BENCH_LOOP(point_light_diffuse, {
    vsgl v = LIGHT;
    lobe_vec3 offset = lobe_sub(v.position, POINT);
    float squared = lobe_dot(offset, offset);
    lobe_vec3 axis = lobe_scale(offset, 1 / sqrtf(squared));
    float cosine = lobe_dot(axis, FACING);
    OUT(0) = sg_eval(v.emission[VSGL_SPECULAR], lobe_scale(axis, -1)) * (cosine > 0 ? cosine : 0) / (LOBE_PI * squared);
})

/* 001, section B */
BENCH_LOOP(printed_vsl, {
    lobe_vec3 offset = lobe_sub(POSITION, POINT);
    float distance = sqrtf(lobe_dot(offset, offset));
    float sine = in->column[VPL_VARIANCE][i] / distance;
    sg_lobe g;
    g.axis = lobe_scale(offset, 1 / distance);
    g.sharpness = 4 * LOBE_PI / (2 * LOBE_PI * (1 - cosf(asinf(sine < 1 ? sine : 1))));
    g.log_amplitude = 0;
    put_lobe(out, i, 0, g);
})

/* ---- the clamped cosine, as others have approximated it ---- */

/* 000, section 4.2 */
BENCH_LOOP(constant_cosine, {
    float c = lobe_dot(A.axis, B.axis);
    OUT(0) = sg_integral(SHARPNESS) * (c > 0 ? c : 0);
})

/* The cosine as the SG of sharpness 2.133 and amplitude 1.17 */
BENCH_LOOP(inner_product_cosine, {
    sg_lobe cosine;
    cosine.axis = B.axis;
    cosine.sharpness = 2.133f;
    cosine.log_amplitude = 0.157003749f;
    OUT(0) = sg_product_integral(A, cosine);
})

/* Hill's fit, in Pettineo 2016, SG Series Part 3: Diffuse Lighting From an SG Light Source */
BENCH_LOOP(hill_cosine, {
    float l = SHARPNESS;
    float c = lobe_dot(A.axis, B.axis);
    float e = expf(-l);
    float e2 = e * e;
    float scale = 1 + 2 * e2 - 1 / l;
    float bias = (e - e2) / l - e2;
    float x = sqrtf(1 - scale);
    float x0 = 0.36f * c;
    float x1 = x / (4 * 0.36f);
    float n = x0 + x1;
    float clamped = c < 0 ? 0 : c > 1 ? 1 : c;
    float y = fabsf(x0) <= x1 ? n * n / x : clamped;
    OUT(0) = 2 * LOBE_PI / l * (scale * y + bias);
})

/* Tokuyoshi 2022, Accurate Diffuse Lighting from Spherical Gaussian Lights: the difference of two hemispherical
   integrals, of the SG and of its product with an SG that is nearly linear */
static inline float tokuyoshi_hemisphere(float cosine, float sharpness) {
    float steepness = sharpness * sqrtf((0.5f * sharpness + 0.65173288269f) /
                                        ((sharpness + 1.34182800331f) * sharpness + 7.22166877990f));
    float clamped = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    float share = 0.5f + 0.5f * erff(steepness * clamped) / erff(steepness);
    float e = expf(-sharpness);
    return (e + (1 - e) * share) * -expm1f(-sharpness) / sharpness;
}

BENCH_LOOP(tokuyoshi_2022_cosine, {
    sg_lobe linear;
    sg_lobe product;
    float difference;
    linear.axis = B.axis;
    linear.sharpness = 0.00084560872241f;
    linear.log_amplitude = 0;
    product = sg_product(A, linear);
    difference = tokuyoshi_hemisphere(lobe_dot(product.axis, B.axis), product.sharpness) *
                     expf(product.log_amplitude + linear.sharpness) -
                 tokuyoshi_hemisphere(lobe_dot(A.axis, B.axis), SHARPNESS);
    OUT(0) = 2 * LOBE_PI * 1182.2467339678f * (difference > 0 ? difference : 0);
})

BENCH_LOOP(tokuyoshi_2024_cosine, OUT(0) = tokuyoshi_2024(SHARPNESS, lobe_dot(A.axis, B.axis));)

/* The same over the SG's integral, on our primitives, as one would write it for vector code: the error
   function after Abramowitz and Stegun 7.1.26, the difference of exponentials as it stands. */
static inline float erfc_slope(float x) { /* e^(x^2) erfc(x) for x >= 0, to 1.5e-7 */
    float t = 1 / (1 + 0.3275911f * x);
    return t * (0.254829592f + t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
}

BENCH_LOOP(tokuyoshi_2024_mean, {
    float l = lobe_at_most(SHARPNESS, 1e12f);
    float c = COSINE;
    float a = lobe_at_most(fabsf(c), 1);
    float t = tokuyoshi_steepness(l);
    float tz = t * a;
    float e = lobe_exp(-l);
    float ez = lobe_exp(-tz * tz);
    float et = lobe_exp(-t * t);
    float share = lobe_at_most(lobe_at_least(c, 0), 1) - 0.5f * (a * (erfc_slope(tz) * ez) - erfc_slope(t) * et) +
                  0.282094792f * (ez - et) / lobe_at_least(t, LOBE_TINY);
    float inverse = 1 / lobe_at_least(l, LOBE_TINY);
    float phi_sharp = (1 - e) * inverse;
    float series = 0.5f + l * (-1.0f / 6 + l * (1.0f / 24 + l * (-1.0f / 120 + l * (1.0f / 720 - l * (1.0f / 5040)))));
    float upper = lobe_select(l < 0.5f, series, (1 - phi_sharp) * inverse);
    float phi = lobe_select(l < 0.5f, 1 - l * series, phi_sharp);
    float lower = e * (phi - upper);
    OUT(0) = (lower + (upper - lower) * lobe_at_most(lobe_at_least(share, 0), 1)) / (phi * (1 + e));
})
