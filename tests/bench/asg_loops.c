/*
 asg_loops.c - one loop for each function of asg.h, which must become vector code, and one for each alternative: the
 papers' forms as printed, with the C library's functions, and the product of ASGs by Cardano's formula.
*/
#include "../cardano.h"
#include "asg_columns.h"

#define FROM &in->column[0][i], BENCH_COUNT
#define A asg_in(FROM, ASG_A)
#define B asg_in(FROM, ASG_B)
#define G lobe_in(FROM, SG_B)
#define NORMAL vector_in(FROM, SURFACE_NORMAL)
#define TANGENT vector_in(FROM, SURFACE_TANGENT)
#define WI vector_in(FROM, SURFACE_WI)
#define ALPHA_X in->column[SURFACE_ALPHA_X][i]
#define ALPHA_Y in->column[SURFACE_ALPHA_Y][i]
#define OUT(k) out->column[k][i]

static inline void put_asg(bench_output *restrict out, int i, asg_lobe a) {
    out->column[0][i] = a.z.x;
    out->column[1][i] = a.z.y;
    out->column[2][i] = a.z.z;
    out->column[3][i] = a.y.x;
    out->column[4][i] = a.y.y;
    out->column[5][i] = a.y.z;
    out->column[6][i] = a.sharpness_x;
    out->column[7][i] = a.sharpness_y;
}

/* ---- ours ---- */

BENCH_LOOP(our_asg_eval, OUT(0) = asg_eval(A, G.axis);)
BENCH_LOOP(our_asg_integral, OUT(0) = asg_integral(A);)
BENCH_LOOP(our_asg_integral_approx, OUT(0) = asg_integral_approx(A);)
BENCH_LOOP(our_asg_sg_integral, OUT(0) = asg_sg_integral(A, G);)
BENCH_LOOP(our_asg_sg_integral_xu, OUT(0) = asg_sg_integral_xu(A, G);)
BENCH_LOOP(our_asg_isotropic, OUT(0) = asg_isotropic(A).sharpness;)
BENCH_LOOP(our_asg_as_sg, OUT(0) = sg_product_integral(asg_isotropic(A), G);)
BENCH_LOOP(our_asg_sg_form, OUT(0) = (float)asg_sg_form(A, G.sharpness, 0.01f);)
BENCH_LOOP(our_asg_product_integral, OUT(0) = asg_product_integral(A, B);)
BENCH_LOOP(our_asg_product_integral_xu, OUT(0) = asg_product_integral_xu(A, B);)
BENCH_LOOP(our_asg_convolve, {
    asg_lobe a = asg_convolve(A, G.sharpness);
    OUT(0) = a.sharpness_x;
    OUT(1) = a.sharpness_y;
    OUT(2) = a.log_amplitude;
})
BENCH_LOOP(our_asg_ggx_lobe, put_asg(out, i, asg_ggx_lobe(NORMAL, WI, ALPHA_X));)
BENCH_LOOP(our_asg_phong_lobe, put_asg(out, i, asg_phong_lobe(NORMAL, WI, ALPHA_X));)
BENCH_LOOP(our_asg_ggx_lobe_aniso, put_asg(out, i, asg_ggx_lobe_aniso(NORMAL, TANGENT, WI, ALPHA_X, ALPHA_Y));)
BENCH_LOOP(our_asg_ashikhmin_lobe, put_asg(out, i, asg_ashikhmin_lobe(NORMAL, TANGENT, WI, ALPHA_X, ALPHA_Y));)
BENCH_LOOP(our_asg_vsgl_specular, {
    lobe_vec3 none = lobe_vector(0, 0, 0);
    OUT(0) = asg_vsgl_specular(asg_vsgl_in(FROM), VSGL_SPECULAR, none, NORMAL, WI, ALPHA_X,
                               asg_ggx_lobe(NORMAL, WI, ALPHA_X));
})

/* ---- as printed ---- */

static inline float printed_eval(asg_lobe a, lobe_vec3 w) {
    float x = lobe_dot(a.x, w), y = lobe_dot(a.y, w), z = lobe_dot(a.z, w);
    return expf(a.log_amplitude) * (z > 0 ? z : 0) * expf(-a.sharpness_x * x * x - a.sharpness_y * y * y);
}

static inline float printed_sg_integral(asg_lobe a, sg_lobe g) { /* 001, Eq. 2 */
    float nu = 0.5f * g.sharpness, lx = a.sharpness_x, ly = a.sharpness_y;
    a.sharpness_x = lx * nu / (lx + nu);
    a.sharpness_y = ly * nu / (ly + nu);
    return expf(g.log_amplitude) * LOBE_PI * printed_eval(a, g.axis) / sqrtf((lx + nu) * (ly + nu));
}

static inline asg_lobe printed_convolve(asg_lobe a, float kappa) { /* 004, section 4.2 */
    float scale = kappa / sqrtf((2 * a.sharpness_x + kappa) * (2 * a.sharpness_y + kappa));
    a.sharpness_x = a.sharpness_x * kappa / (2 * a.sharpness_x + kappa);
    a.sharpness_y = a.sharpness_y * kappa / (2 * a.sharpness_y + kappa);
    a.log_amplitude = logf(expf(a.log_amplitude) * scale);
    return a;
}

static inline asg_lobe printed_ggx_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) { /* 000, section 4.2 */
    asg_lobe a;
    float cosine = lobe_dot(wi, normal), size;
    a.z = lobe_sub(lobe_scale(normal, 2 * cosine), wi);
    a.y = lobe_cross(normal, a.z);
    size = sqrtf(lobe_dot(a.y, a.y));
    a.y = lobe_scale(a.y, 1 / size);
    a.x = lobe_cross(a.y, a.z);
    a.sharpness_x = 1 / (4 * alpha * alpha);
    a.sharpness_y = 1 / (4 * alpha * alpha * cosine * cosine);
    a.log_amplitude = 0;
    return a;
}

static inline float printed_vsgl_specular(vsgl v, lobe_vec3 normal, lobe_vec3 wi, float alpha) { /* 000, 4.1 and 4.2 */
    float distance = sqrtf(lobe_dot(v.position, v.position)), extent = distance * distance / v.variance;
    float emission = v.emission[1].sharpness, size, ci = lobe_dot(wi, normal), co, smith, a2 = alpha * alpha;
    lobe_vec3 sum = lobe_sub(lobe_scale(v.position, extent / distance), lobe_scale(v.emission[1].axis, emission));
    sg_lobe g;
    size = sqrtf(lobe_dot(sum, sum));
    g.axis = lobe_scale(sum, 1 / size);
    g.sharpness = size;
    g.log_amplitude = 0;
    co = lobe_dot(g.axis, normal);
    if (!(co > 0)) return 0;
    smith = 0.5f / (co * sqrtf(a2 + (1 - a2) * ci * ci) + ci * sqrtf(a2 + (1 - a2) * co * co));
    return expf(size - extent - emission) / (2 * LOBE_PI * v.variance) * co * smith / (LOBE_PI * a2) *
           printed_sg_integral(printed_ggx_lobe(normal, wi, alpha), g);
}

BENCH_LOOP(printed_asg_eval, OUT(0) = printed_eval(A, G.axis);)
BENCH_LOOP(printed_asg_integral, OUT(0) = LOBE_PI / sqrtf(A.sharpness_x * A.sharpness_y);)
BENCH_LOOP(printed_asg_sg_integral, OUT(0) = printed_sg_integral(A, G);)
BENCH_LOOP(printed_asg_convolve, {
    asg_lobe a = printed_convolve(A, G.sharpness);
    OUT(0) = a.sharpness_x;
    OUT(1) = a.sharpness_y;
    OUT(2) = a.log_amplitude;
})
BENCH_LOOP(printed_asg_ggx_lobe, put_asg(out, i, printed_ggx_lobe(NORMAL, WI, ALPHA_X));)
BENCH_LOOP(printed_asg_vsgl_specular, OUT(0) = printed_vsgl_specular(asg_vsgl_in(FROM), NORMAL, WI, ALPHA_X);)

/* ---- the product of two ASGs by Cardano's formula ---- */

#define FLOAT_LIBM(r, c, s)                                                                                            \
    {                                                                                                                  \
        float t = acosf(r) * 0.333333333f;                                                                             \
        c = cosf(t);                                                                                                   \
        s = sinf(t);                                                                                                   \
    }
#define CHOOSE(condition, a, b) ((condition) ? (a) : (b))

CARDANO(cardano_libm, float, FLOAT_LIBM, sqrtf, expf, CHOOSE)

#ifndef __cplusplus /* counted.h makes no double of a float */
#define DOUBLE_LIBM(r, c, s)                                                                                           \
    {                                                                                                                  \
        double t = acos(r) / 3;                                                                                        \
        c = cos(t);                                                                                                    \
        s = sin(t);                                                                                                    \
    }

/* the conversions of floats to double are the point */
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#endif
CARDANO(cardano_double, double, DOUBLE_LIBM, sqrt, exp, CHOOSE)
BENCH_LOOP(cardano_asg_double, OUT(0) = cardano_double(A, B);)
#endif

BENCH_LOOP(cardano_asg_float, OUT(0) = cardano_float(A, B);)
BENCH_LOOP(cardano_asg_libm, OUT(0) = cardano_libm(A, B);)
