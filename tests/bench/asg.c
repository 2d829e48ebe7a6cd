/* asg.c - the rows for asg.h. References are quadrature, or the formula in double. */
#include "asg_columns.h"
#include "../exact_asg.h"

/* ---- inputs ---- */

static double uniform(void) {
    return test_uniform(&test_random);
}

static double log_uniform(double low, double high) {
    return test_log_uniform(&test_random, low, high);
}

static void put(float *in, const double v[3]) {
    int k;
    for (k = 0; k < 3; k++) in[k] = (float)v[k];
}

static void turned(const double axis[3], double angle, double out[3]) {
    double u[3], v[3], phi = 2 * REFERENCE_PI * uniform();
    int k;
    reference_frame(axis, u, v);
    for (k = 0; k < 3; k++) out[k] = cos(angle) * axis[k] + sin(angle) * (cos(phi) * u[k] + sin(phi) * v[k]);
}

static void put_lobe(float *in, const double z[3], double lx, double ly) {
    asg_lobe a = lobe_around(z, 7 * uniform(), lx, ly);
    in[0] = a.x.x, in[1] = a.x.y, in[2] = a.x.z;
    in[3] = a.y.x, in[4] = a.y.y, in[5] = a.y.z;
    in[6] = a.z.x, in[7] = a.z.y, in[8] = a.z.z;
    in[9] = a.sharpness_x;
    in[10] = a.sharpness_y;
    in[11] = 0;
}

/* A lobe and a light where the value is above 1 % of that of aligned axes: by our own form, which is near enough */
static void draw_light_over(float *in, double low, double high) {
    double z[3], axis[3], lx, ly, lg, angle;
    asg_lobe a;
    sg_lobe g, ahead;
    do {
        test_direction(&test_random, z);
        lx = log_uniform(low, high);
        ly = log_uniform(low, high);
        lg = log_uniform(low, high);
        angle = uniform() < 0.75 ? 4 * uniform() * sqrt(1 / (0.5 * lg + 0.5) + 1 / (fmin(lx, ly) + 0.5))
                                 : acos(1 - 2 * uniform());
        put_lobe(in + ASG_A, z, lx, ly);
        turned(z, fmin(angle, REFERENCE_PI), axis);
        put(in + SG_B, axis);
        in[SG_B + 3] = (float)lg;
        in[SG_B + 4] = 0;
        a = asg_in(in, 1, ASG_A);
        g = lobe_in(in, 1, SG_B);
        ahead = g;
        ahead.axis = a.z;
    } while (!(asg_sg_integral(a, g) > 0.01f * asg_sg_integral(a, ahead)));
}

static void draw_soft_light(float *in) {
    draw_light_over(in, 0.1, 1e3);
}

static void draw_sharp_light(float *in) {
    draw_light_over(in, 10, 1e5);
}

static void draw_pair_over(float *in, double low, double high, double ratio) {
    double z[3], other[3], l[4], least = log_uniform(low, high), angle;
    int k;
    for (k = 0; k < 4; k++) l[k] = fmin(least * log_uniform(1, ratio), high);
    l[(int)(4 * uniform())] = least;
    angle = uniform() < 0.7 ? 3 * uniform() / sqrt(least + 0.3) : acos(1 - 2 * uniform());
    test_direction(&test_random, z);
    put_lobe(in + ASG_A, z, l[0], l[1]);
    turned(z, fmin(angle, REFERENCE_PI), other);
    put_lobe(in + ASG_B, other, l[2], l[3]);
}

static void draw_soft_pair(float *in) {
    draw_pair_over(in, 0.1, 1e3, 1e3);
}

static void draw_sharp_pair(float *in) {
    draw_pair_over(in, 1e3, 1e6, 1e3);
}

static void draw_lobe(float *in) {
    double z[3], dir[3], l = log_uniform(1e-2, 1e5), m = log_uniform(1e-2, 1e5);
    test_direction(&test_random, z);
    put_lobe(in + ASG_A, z, l, m);
    turned(z, fmin(3 * uniform() / sqrt(fmax(l, m) + 1), 1.5), dir);
    put(in + SG_B, dir);
    in[SG_B + 3] = (float)log_uniform(1e-2, 1e5);
}

static void draw_surface(float *in) {
    double normal[3], tangent[3], wi[3], mirror[3], toward[3], cosine, distance = log_uniform(0.1, 100);
    int k;
    test_direction(&test_random, normal);
    turned(normal, REFERENCE_PI / 2, tangent);
    turned(normal, acos(0.1 + 0.9 * uniform()), wi);
    put(in + SURFACE_NORMAL, normal);
    put(in + SURFACE_TANGENT, tangent);
    put(in + SURFACE_WI, wi);
    in[SURFACE_ALPHA_X] = (float)log_uniform(0.02, 0.5);
    in[SURFACE_ALPHA_Y] = (float)log_uniform(0.02, 0.5);
    cosine = dot(normal, wi);
    for (k = 0; k < 3; k++) mirror[k] = 2 * cosine * normal[k] - wi[k];
    turned(mirror, (double)in[SURFACE_ALPHA_X] * cosine * uniform(), toward);
    for (k = 0; k < 3; k++) {
        in[LIGHT_POSITION + k] = (float)(distance * toward[k]);
        in[LIGHT_EMISSION + k] = (float)-toward[k];
    }
    in[LIGHT_SHARPNESS] = (float)log_uniform(0.5, 50);
    in[LIGHT_VARIANCE] = (float)(distance * distance * log_uniform(1e-4, 1e-2));
}

static void draw_exponents(float *in) {
    draw_surface(in);
    in[SURFACE_ALPHA_X] = (float)log_uniform(10, 1e5);
    in[SURFACE_ALPHA_Y] = (float)log_uniform(10, 1e5);
}

/* ---- what is exact, and the units ---- */

static double relative(const double *wanted, const float *out) {
    return ((double)out[0] - wanted[0]) / wanted[1];
}

static void exact_value(const float *in, double *wanted) {
    exact_asg a = exact_of(asg_in(in, 1, ASG_A));
    double dir[3], e, l = fmax(a.lx, a.ly);
    widen(vector_in(in, 1, SG_B), dir);
    wanted[0] = exact_eval(&a, dir);
    e = fabs(log(wanted[0] / dot(dir, a.z)));
    wanted[1] = wanted[0] * TEST_EPSILON * (1 + e + sqrt(l * e) + TEST_EPSILON * l);
}

static void exact_whole(const float *in, double *wanted) {
    wanted[0] = wanted[1] = reference_integral((double)in[ASG_A + 9], (double)in[ASG_A + 10]);
}

static void exact_light(const float *in, double *wanted) {
    sg_lobe g = lobe_in(in, 1, SG_B);
    wanted[0] = wanted[1] = reference_product(asg_in(in, 1, ASG_A), NULL, &g);
}

static void exact_pair(const float *in, double *wanted) {
    asg_lobe a = asg_in(in, 1, ASG_A), b = asg_in(in, 1, ASG_B);
    wanted[0] = reference_product(a, &b, NULL);
    wanted[1] = sqrt(reference_product(a, &a, NULL) * reference_product(b, &b, NULL));
}

static void exact_mean(const float *in, double *wanted) {
    wanted[0] = wanted[1] = 2 * sqrt((double)in[ASG_A + 9] * (double)in[ASG_A + 10]);
}

static void exact_nothing(const float *in, double *wanted) {
    (void)in;
    wanted[0] = 0;
}

static double no_error(const double *wanted, const float *out) {
    return out[0] >= 0 && out[0] <= 2 ? wanted[0] : HUGE_VAL;
}

static void exact_convolved(const float *in, double *wanted) {
    double kappa = (double)in[SG_B + 3], rx = 2 * (double)in[ASG_A + 9] / kappa,
           ry = 2 * (double)in[ASG_A + 10] / kappa;
    wanted[0] = (double)in[ASG_A + 9] / (1 + rx);
    wanted[1] = (double)in[ASG_A + 10] / (1 + ry);
    wanted[2] = -0.5 * (log1p(rx) + log1p(ry));
}

static double convolved_error(const double *wanted, const float *out) {
    double sharpness = fmax(fabs((double)out[0] / wanted[0] - 1), fabs((double)out[1] / wanted[1] - 1));
    return fmax(sharpness, fabs((double)out[2] - wanted[2]) / (1 - wanted[2]));
}

/* Mirror direction and both sharpnesses */
static void exact_reflection(const float *in, double hx, double hy, double *wanted) {
    double n[3], t[3], b[3], wi[3], across[3], along[3], cosine, px, py, qx, qy, middle, radius, size;
    int k;
    widen(vector_in(in, 1, SURFACE_NORMAL), n);
    widen(vector_in(in, 1, SURFACE_TANGENT), t);
    widen(vector_in(in, 1, SURFACE_WI), wi);
    cosine = dot(n, wi) / (sqrt(dot(n, n) * dot(wi, wi)));
    for (k = 0; k < 3; k++) wanted[k] = 2 * cosine * n[k] - wi[k];
    cross(n, wi, across);
    size = sqrt(dot(across, across));
    for (k = 0; k < 3; k++) across[k] = size > 0 ? across[k] / size : t[k];
    cross(across, n, along);
    cross(n, t, b);
    px = 0.5 * sqrt(hx) * dot(along, t);
    py = 0.5 * sqrt(hx) * dot(across, t) / cosine;
    qx = 0.5 * sqrt(hy) * dot(along, b);
    qy = 0.5 * sqrt(hy) * dot(across, b) / cosine;
    middle = 0.5 * (px * px + qx * qx + py * py + qy * qy);
    radius = hypot(0.5 * (px * px + qx * qx - py * py - qy * qy), px * py + qx * qy);
    wanted[4] = middle + radius;
    wanted[3] = hx * hy / (16 * cosine * cosine) / wanted[4];
}

static void exact_ggx(const float *in, double *wanted) {
    double h = 1 / ((double)in[SURFACE_ALPHA_X] * (double)in[SURFACE_ALPHA_X]);
    exact_reflection(in, h, h, wanted);
}

static void exact_ggx_aniso(const float *in, double *wanted) {
    double x = (double)in[SURFACE_ALPHA_X], y = (double)in[SURFACE_ALPHA_Y];
    exact_reflection(in, 1 / (x * x), 1 / (y * y), wanted);
}

static void exact_phong(const float *in, double *wanted) {
    exact_reflection(in, 0.5 * (double)in[SURFACE_ALPHA_X], 0.5 * (double)in[SURFACE_ALPHA_X], wanted);
}

static void exact_ashikhmin(const float *in, double *wanted) {
    exact_reflection(in, 0.5 * (double)in[SURFACE_ALPHA_X], 0.5 * (double)in[SURFACE_ALPHA_Y], wanted);
}

static double lobe_error(const double *wanted, const float *out) {
    double off = 0, sharpness = fmax(fabs((double)out[6] / wanted[3] - 1), fabs((double)out[7] / wanted[4] - 1));
    int k;
    for (k = 0; k < 3; k++) off = fmax(off, fabs((double)out[k] - wanted[k]));
    return fmax(off, sharpness);
}

/* Section 4.2 of 000 in double, with the lobe as floats give it */
static void exact_specular(const float *in, double *wanted) {
    exact_asg a =
        exact_of(asg_ggx_lobe(vector_in(in, 1, SURFACE_NORMAL), vector_in(in, 1, SURFACE_WI), in[SURFACE_ALPHA_X]));
    double n[3], wi[3], offset[3], emission[3], axis[3], variance = (double)in[LIGHT_VARIANCE], log_peak;
    double nu, x, y, e, co, ci, a2, smith;
    widen(vector_in(in, 1, SURFACE_NORMAL), n);
    widen(vector_in(in, 1, SURFACE_WI), wi);
    widen(vector_in(in, 1, LIGHT_POSITION), offset);
    widen(vector_in(in, 1, LIGHT_EMISSION), emission);
    nu = 0.5 * exact_incoming(offset, emission, (double)in[LIGHT_SHARPNESS], 1 / variance, axis, &log_peak);
    x = dot(axis, a.x);
    y = dot(axis, a.y);
    co = fmax(dot(axis, n), 1e-30);
    ci = dot(wi, n);
    a2 = pow((double)in[SURFACE_ALPHA_X], 2);
    e = log_peak - a.lx * nu / (a.lx + nu) * x * x - a.ly * nu / (a.ly + nu) * y * y;
    smith = 0.5 / (co * sqrt(a2 + (1 - a2) * ci * ci) + ci * sqrt(a2 + (1 - a2) * co * co));
    wanted[0] = exp(e) * 0.5 / variance / sqrt((a.lx + nu) * (a.ly + nu)) * fmax(dot(axis, a.z), 0) * co * smith /
                (REFERENCE_PI * a2);
    wanted[1] = wanted[0];
}

/* ---- the rows ---- */

BENCH_DECLARE(our_asg_eval);
BENCH_DECLARE(our_asg_integral);
BENCH_DECLARE(our_asg_integral_approx);
BENCH_DECLARE(our_asg_sg_integral);
BENCH_DECLARE(our_asg_sg_integral_xu);
BENCH_DECLARE(our_asg_isotropic);
BENCH_DECLARE(our_asg_as_sg);
BENCH_DECLARE(our_asg_sg_form);
BENCH_DECLARE(our_asg_product_integral);
BENCH_DECLARE(our_asg_product_integral_xu);
BENCH_DECLARE(our_asg_convolve);
BENCH_DECLARE(our_asg_ggx_lobe);
BENCH_DECLARE(our_asg_phong_lobe);
BENCH_DECLARE(our_asg_ggx_lobe_aniso);
BENCH_DECLARE(our_asg_ashikhmin_lobe);
BENCH_DECLARE(our_asg_vsgl_specular);
BENCH_DECLARE(printed_asg_eval);
BENCH_DECLARE(printed_asg_integral);
BENCH_DECLARE(printed_asg_sg_integral);
BENCH_DECLARE(printed_asg_convolve);
BENCH_DECLARE(printed_asg_ggx_lobe);
BENCH_DECLARE(printed_asg_vsgl_specular);
BENCH_DECLARE(cardano_asg_float);
BENCH_DECLARE(cardano_asg_libm);
BENCH_DECLARE(cardano_asg_double);

#define LIGHT_FORMS                                                                                                    \
    {                                                                                                                  \
        BENCH_FORM("asg_sg_integral", our_asg_sg_integral), BENCH_FORM("asg_sg_integral_xu", our_asg_sg_integral_xu),  \
            BENCH_FORM("sg_product_integral of asg_isotropic", our_asg_as_sg),                                         \
            BENCH_FORM("Xu, as printed, libm", printed_asg_sg_integral)                                                \
    }
#define PAIR_FORMS                                                                                                     \
    {                                                                                                                  \
        BENCH_FORM("asg_product_integral", our_asg_product_integral),                                                  \
            BENCH_FORM("asg_product_integral_xu", our_asg_product_integral_xu),                                        \
            BENCH_FORM("Cardano, float, polynomials", cardano_asg_float),                                              \
            BENCH_FORM("Cardano, float, libm", cardano_asg_libm), {                                                    \
            "Cardano, double, libm", "cardano_asg_double", cardano_asg_double_scalar, cardano_asg_double_vector, 0     \
        }                                                                                                              \
    }

const bench_row asg_bench[] = {
    {"asg_eval",
     "sharpness 1e-2 .. 1e5",
     "directional units",
     4,
     draw_lobe,
     exact_value,
     relative,
     {BENCH_FORM("asg_eval", our_asg_eval), BENCH_FORM("as printed, libm", printed_asg_eval)}},
    {"asg_integral",
     "sharpness 1e-2 .. 1e5",
     "relative",
     1,
     draw_lobe,
     exact_whole,
     relative,
     {
         BENCH_FORM("asg_integral", our_asg_integral),
         BENCH_FORM("asg_integral_approx", our_asg_integral_approx),
         BENCH_FORM("as printed, libm", printed_asg_integral),
     }},
    {"asg_sg_integral", "sharpness .1 .. 1e3, values above 1 % of aligned", "relative", 1, draw_soft_light, exact_light,
     relative, LIGHT_FORMS},
    {"asg_sg_integral", "sharpness 10 .. 1e5, values above 1 % of aligned", "relative", 1, draw_sharp_light,
     exact_light, relative, LIGHT_FORMS},
    {"asg_isotropic",
     "sharpness 1e-2 .. 1e5",
     "relative",
     4,
     draw_lobe,
     exact_mean,
     relative,
     {BENCH_FORM("asg_isotropic", our_asg_isotropic)}},
    {"asg_sg_form",
     "sharpness 1e-2 .. 1e5",
     "nothing, a choice",
     1,
     draw_lobe,
     exact_nothing,
     no_error,
     {BENCH_FORM("asg_sg_form", our_asg_sg_form)}},
    {"asg_product_integral", "sharpness .1 .. 1e3, any angle", "the mean of both with themselves", 1, draw_soft_pair,
     exact_pair, relative, PAIR_FORMS},
    {"asg_product_integral", "sharpness 1e3 .. 1e6, any angle", "the mean of both with themselves", 1, draw_sharp_pair,
     exact_pair, relative, PAIR_FORMS},
    {"asg_convolve",
     "sharpness 1e-2 .. 1e5",
     "relative",
     4,
     draw_lobe,
     exact_convolved,
     convolved_error,
     {BENCH_FORM("asg_convolve", our_asg_convolve), BENCH_FORM("as printed, libm", printed_asg_convolve)}},
    {"asg_ggx_lobe",
     "alpha .02 .. .5, cos .1 .. 1",
     "axis, and relative",
     4,
     draw_surface,
     exact_ggx,
     lobe_error,
     {BENCH_FORM("asg_ggx_lobe", our_asg_ggx_lobe), BENCH_FORM("as printed, libm", printed_asg_ggx_lobe)}},
    {"asg_ggx_lobe_aniso",
     "alphas .02 .. .5, cos .1 .. 1",
     "axis, and relative",
     4,
     draw_surface,
     exact_ggx_aniso,
     lobe_error,
     {BENCH_FORM("asg_ggx_lobe_aniso", our_asg_ggx_lobe_aniso)}},
    {"asg_phong_lobe",
     "exponent 10 .. 1e5, cos .1 .. 1",
     "axis, and relative",
     4,
     draw_exponents,
     exact_phong,
     lobe_error,
     {BENCH_FORM("asg_phong_lobe", our_asg_phong_lobe)}},
    {"asg_ashikhmin_lobe",
     "exponents 10 .. 1e5, cos .1 .. 1",
     "axis, and relative",
     4,
     draw_exponents,
     exact_ashikhmin,
     lobe_error,
     {BENCH_FORM("asg_ashikhmin_lobe", our_asg_ashikhmin_lobe)}},
    {"asg_vsgl_specular",
     "with asg_ggx_lobe, lights within alpha of the mirror direction",
     "relative to the formula",
     4,
     draw_surface,
     exact_specular,
     relative,
     {
         BENCH_FORM("asg_vsgl_specular", our_asg_vsgl_specular),
         BENCH_FORM("as printed, libm", printed_asg_vsgl_specular),
     }},
    {0},
};
