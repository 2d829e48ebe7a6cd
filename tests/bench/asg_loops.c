/*
 asg_loops.c - one loop for each function of asg.h, which must become vector code, and one for each alternative: the
 papers' forms as printed, with the C library's functions, and the product of ASGs by Cardano's formula.
*/
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

/* ---- the product of two ASGs as the papers did it: eigenvalues of the summed quadratic form by Cardano's formula,
   its lowest eigenvector as the longest cross product of two rows ---- */

/* acos on [-1, 1] after Abramowitz and Stegun 4.4.46, to 7e-8 */
static inline float poly_acos(float x) {
    float a = fabsf(x), root = sqrtf(lobe_at_least(1 - a, 0));
    float p = 0.0308918810f + a * (-0.0170881256f + a * (0.0066700901f - 0.0012624911f * a));
    p = root * (1.5707963050f + a * (-0.2145988016f + a * (0.0889789874f + a * (-0.0501743046f + a * p))));
    return lobe_select(x < 0, LOBE_PI - p, p);
}

/* cos and sin on [0, pi / 3] */
static inline float poly_cos(float t2) {
    return 1 + t2 * (-0.5f + t2 * (0.0416666418f + t2 * (-0.00138873162f + t2 * 2.44331568e-5f)));
}

static inline float poly_sin(float t, float t2) {
    return t * (1 + t2 * (-0.166666657f + t2 * (0.00833301712f - t2 * 0.000195152830f)));
}

#define CARDANO(name, real, ACOS_COS_SIN, SQRT, EXP, SELECT)                                                           \
    static inline float name(asg_lobe a, asg_lobe b) {                                                                 \
        const real l1 = a.sharpness_x, l2 = a.sharpness_y, l3 = b.sharpness_x, l4 = b.sharpness_y;                     \
        const real ax = a.x.x, ay = a.x.y, az = a.x.z, bx = a.y.x, by = a.y.y, bz = a.y.z;                             \
        const real cx = b.x.x, cy = b.x.y, cz = b.x.z, dx = b.y.x, dy = b.y.y, dz = b.y.z;                             \
        const real third = (real)1 / 3;                                                                                \
        real xx = l1 * ax * ax + l2 * bx * bx + l3 * cx * cx + l4 * dx * dx;                                           \
        real yy = l1 * ay * ay + l2 * by * by + l3 * cy * cy + l4 * dy * dy;                                           \
        real zz = l1 * az * az + l2 * bz * bz + l3 * cz * cz + l4 * dz * dz;                                           \
        real xy = l1 * ax * ay + l2 * bx * by + l3 * cx * cy + l4 * dx * dy;                                           \
        real xz = l1 * ax * az + l2 * bx * bz + l3 * cx * cz + l4 * dx * dz;                                           \
        real yz = l1 * ay * az + l2 * by * bz + l3 * cy * cz + l4 * dy * dz;                                           \
        real m = (xx + yy + zz) * third, u = xx - m, v = yy - m, w = zz - m;                                           \
        real xy2 = xy * xy, xz2 = xz * xz, yz2 = yz * yz, c, s, e1, e2, e3, d0, d1, d2, px, py, pz, za, zb;            \
        real p = (u * u + v * v + w * w + 2 * (xy2 + xz2 + yz2)) * (third / 2), root = SQRT(p);                        \
        real q = (u * (v * w - yz2) - xy * (xy * w - yz * xz) + xz * (xy * yz - v * xz)) / 2;                          \
        real r = q / (p * root + (real)1e-30), r0x, r0y, r0z, r1x, r1y, r1z, r2x, r2y, r2z;                            \
        r = SELECT(r < 1, r, 1);                                                                                       \
        r = SELECT(r > -1, r, -1);                                                                                     \
        ACOS_COS_SIN(r, c, s)                                                                                          \
        e1 = m + 2 * root * c;                                                                                         \
        e3 = m - root * (c + (real)1.7320508075688772 * s);                                                            \
        e2 = 3 * m - e1 - e3;                                                                                          \
        u = xx - e3;                                                                                                   \
        v = yy - e3;                                                                                                   \
        w = zz - e3;                                                                                                   \
        r0x = xy * yz - xz * v, r0y = xz * xy - u * yz, r0z = u * v - xy2;                                             \
        r1x = xy * w - xz * yz, r1y = xz2 - u * w, r1z = u * yz - xy * xz;                                             \
        r2x = v * w - yz2, r2y = yz * xz - xy * w, r2z = xy * yz - v * xz;                                             \
        d0 = r0x * r0x + r0y * r0y + r0z * r0z;                                                                        \
        d1 = r1x * r1x + r1y * r1y + r1z * r1z;                                                                        \
        d2 = r2x * r2x + r2y * r2y + r2z * r2z;                                                                        \
        px = SELECT(d1 > d0, r1x, r0x), py = SELECT(d1 > d0, r1y, r0y), pz = SELECT(d1 > d0, r1z, r0z);                \
        d0 = SELECT(d1 > d0, d1, d0);                                                                                  \
        px = SELECT(d2 > d0, r2x, px), py = SELECT(d2 > d0, r2y, py), pz = SELECT(d2 > d0, r2z, pz);                   \
        d0 = SELECT(d2 > d0, d2, d0);                                                                                  \
        za = px * a.z.x + py * a.z.y + pz * a.z.z;                                                                     \
        zb = px * b.z.x + py * b.z.y + pz * b.z.z;                                                                     \
        za *= zb;                                                                                                      \
        za = SELECT(za > 0, za, 0);                                                                                    \
        return (float)((real)LOBE_PI * EXP(a.log_amplitude + b.log_amplitude - e3) * za /                              \
                       (d0 * SQRT((e1 - e3) * (e2 - e3))));                                                            \
    }

#define POLYNOMIALS(r, c, s)                                                                                           \
    {                                                                                                                  \
        float t = poly_acos(r) * 0.333333333f, t2 = t * t;                                                             \
        c = poly_cos(t2);                                                                                              \
        s = poly_sin(t, t2);                                                                                           \
    }
#define FLOAT_LIBM(r, c, s)                                                                                            \
    {                                                                                                                  \
        float t = acosf(r) * 0.333333333f;                                                                             \
        c = cosf(t);                                                                                                   \
        s = sinf(t);                                                                                                   \
    }
#define DOUBLE_LIBM(r, c, s)                                                                                           \
    {                                                                                                                  \
        double t = acos(r) / 3;                                                                                        \
        c = cos(t);                                                                                                    \
        s = sin(t);                                                                                                    \
    }
#define CHOOSE(condition, a, b) ((condition) ? (a) : (b))

CARDANO(cardano_float, float, POLYNOMIALS, sqrtf, lobe_exp, lobe_select)
CARDANO(cardano_libm, float, FLOAT_LIBM, sqrtf, expf, CHOOSE)
/* the conversions of floats to double are the point */
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#endif
CARDANO(cardano_double, double, DOUBLE_LIBM, sqrt, exp, CHOOSE)

BENCH_LOOP(cardano_asg_float, OUT(0) = cardano_float(A, B);)
BENCH_LOOP(cardano_asg_libm, OUT(0) = cardano_libm(A, B);)
BENCH_LOOP(cardano_asg_double, OUT(0) = cardano_double(A, B);)
