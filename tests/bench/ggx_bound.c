/* ggx_bound.c - the rows for ggx_bound.h. */
#include "ggx_bound_columns.h"
#include "../exact.h"

/* ---- inputs ---- */

static double uniform(void) {
    return test_uniform(&test_random);
}

static void put(float *in, vec v) {
    lobe_vec3 w = narrow(v);
    in[0] = w.x;
    in[1] = w.y;
    in[2] = w.z;
}

/* A light of any incidence, and a direction near the mirror's; for the NDF the direction is the half vector. */
static void draw_light(float *in, double low, int half_vector) {
    vec n = random_direction(), wi = turned(n, acos(0.02 + 0.98 * uniform())), h, t = turned(n, REFERENCE_PI / 2);
    double alpha = test_log_uniform(&test_random, low, 1);
    h = turned(n, atan(alpha * test_log_uniform(&test_random, 1e-2, 10)));
    put(in + VPL_AT, combine(10, random_direction(), 0, n));
    put(in + VPL_FRONT, n);
    put(in + VPL_TO_LIGHT, wi);
    put(in + VPL_OUT, half_vector ? h : combine(2 * dot(wi, h), h, -1, wi));
    put(in + VPL_TANGENT, t);
    in[VPL_ALPHA_X] = (float)alpha;
    in[VPL_ALPHA_Y] = (float)test_log_uniform(&test_random, low, 1);
    in[VPL_FLUX] = (float)test_log_uniform(&test_random, 1e-3, 1);
    in[VPL_FRESNEL] = 1;
    in[VPL_DELTA] = 0.001f;
    in[VPL_XI] = ggx_xi((unsigned)(4294967296.0 * uniform()));
}

static void draw_half_vector(float *in) {
    draw_light(in, 1e-3, 1);
}

static void draw_reflection(float *in) {
    draw_light(in, 1e-3, 0);
}

static void draw_isotropic(float *in) {
    draw_light(in, 0.05, 0);
    in[VPL_ALPHA_Y] = in[VPL_ALPHA_X];
}

/* ---- what is exact ---- */

static vec vector_of(const float *in, int column) {
    return unit(wide(vector_in(in, 1, column)));
}

static double exact_density(vec h, vec n, double a) {
    vec s = combine(1, h, -dot(h, n), n);
    double c = dot(h, n), base = a * a * c * c + dot(s, s);
    return c > 0 ? a * a / (REFERENCE_PI * base * base) : 0;
}

static void exact_ndf(const float *in, double *wanted) {
    double a = (double)in[VPL_ALPHA_X];
    wanted[0] = exact_density(vector_of(in, VPL_OUT), vector_of(in, VPL_FRONT), a);
    wanted[1] = wanted[0] * (1 + 1 / a) * TEST_EPSILON;
}

static double slope(double cosine, double a) {
    return sqrt(a * a + (1 - a * a) * cosine * cosine);
}

static void exact_separable(const float *in, double *wanted) {
    vec n = vector_of(in, VPL_FRONT), wi = vector_of(in, VPL_TO_LIGHT), wo = vector_of(in, VPL_OUT);
    double ci = dot(n, wi), co = dot(n, wo), a = (double)in[VPL_ALPHA_X];
    wanted[0] = 0;
    wanted[1] = 1;
    if (co <= 1e-3) return;
    wanted[0] = exact_density(unit(combine(1, wi, 1, wo)), n, a) * co / ((ci + slope(ci, a)) * (co + slope(co, a)));
    wanted[1] = wanted[0] * ((1 + 1 / a) * 2 / length(combine(1, wi, 1, wo)) + 1 / ci + 1 / co) * TEST_EPSILON;
}

/* With the height-correlated masking, in the units of ggx_brdf_cos */
static void exact_correlated(const float *in, double *wanted) {
    vec n = vector_of(in, VPL_FRONT), wi = vector_of(in, VPL_TO_LIGHT), wo = vector_of(in, VPL_OUT);
    double ci = dot(n, wi), co = dot(n, wo), a = (double)in[VPL_ALPHA_X];
    exact_separable(in, wanted);
    if (co <= 1e-3) return;
    wanted[1] /= wanted[0];
    wanted[0] = exact_density(unit(combine(1, wi, 1, wo)), n, a) * co / (2 * (ci * slope(co, a) + co * slope(ci, a)));
    wanted[1] *= wanted[0];
}

static double in_units(const double *wanted, const float *out) {
    return wanted[0] > 0 ? ((double)out[0] - wanted[0]) / wanted[1] : 0;
}

/* Not an error: the volume over the spheroid's */
static void exact_volume(const float *in, double *wanted) {
    double a = (double)in[VPL_ALPHA_X], c = dot(vector_of(in, VPL_FRONT), vector_of(in, VPL_TO_LIGHT));
    double r2 =
        (double)in[VPL_FLUX] / (2 * REFERENCE_PI * (double)in[VPL_DELTA] * (double)in[VPL_XI] * (c + slope(c, a)));
    wanted[0] = r2 * sqrt(r2) * (1 + a * a) / (2 * a);
}

static double volume_ratio(const double *wanted, const float *out) {
    return (double)out[0] * (double)out[1] * (double)out[2] / wanted[0];
}

BENCH_DECLARE(our_ggx_ndf);
BENCH_DECLARE(usual_ggx_ndf);
BENCH_DECLARE(our_ggx_brdf_cos_separable);
BENCH_DECLARE(our_ggx_brdf_cos);
BENCH_DECLARE(usual_ggx_brdf_cos);
BENCH_DECLARE(our_ggx_bound_spheroid);
BENCH_DECLARE(our_ggx_bound_ellipsoid);
BENCH_DECLARE(our_ggx_bound_ellipsoid_aniso);
BENCH_DECLARE(our_ggx_bound_sphere);
BENCH_DECLARE(printed_ggx_bound_spheroid);

const bench_row ggx_bound_bench[] = {{"ggx_ndf",
                                      "alpha 1e-3 .. 1",
                                      "angular units",
                                      16,
                                      draw_half_vector,
                                      exact_ndf,
                                      in_units,
                                      {BENCH_FORM("ggx_ndf", our_ggx_ndf), BENCH_FORM("1 - cos^2", usual_ggx_ndf)}},
                                     {"ggx_brdf_cos",
                                      "alpha 1e-3 .. 1",
                                      "angular and grazing units",
                                      16,
                                      draw_reflection,
                                      exact_correlated,
                                      in_units,
                                      {BENCH_FORM("ggx_brdf_cos", our_ggx_brdf_cos)}},
                                     {"ggx_brdf_cos_separable",
                                      "alpha 1e-3 .. 1",
                                      "angular and grazing units",
                                      16,
                                      draw_reflection,
                                      exact_separable,
                                      in_units,
                                      {
                                          BENCH_FORM("ggx_brdf_cos_separable", our_ggx_brdf_cos_separable),
                                          BENCH_FORM("D G1 G1 / (4 cos)", usual_ggx_brdf_cos),
                                      }},
                                     {"ggx_bound",
                                      "alpha .05 .. 1, any incidence",
                                      "volumes of the spheroid: its size, not an error",
                                      4,
                                      draw_isotropic,
                                      exact_volume,
                                      volume_ratio,
                                      {
                                          BENCH_FORM("ggx_bound_ellipsoid", our_ggx_bound_ellipsoid),
                                          BENCH_FORM("ggx_bound_ellipsoid_aniso", our_ggx_bound_ellipsoid_aniso),
                                          BENCH_FORM("ggx_bound_spheroid", our_ggx_bound_spheroid),
                                          BENCH_FORM("spheroid as printed, not padded", printed_ggx_bound_spheroid),
                                          BENCH_FORM("ggx_bound_sphere", our_ggx_bound_sphere),
                                      }},
                                     {0}};
