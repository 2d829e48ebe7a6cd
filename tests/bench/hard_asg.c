/* hard_asg.c - hard cases of asg.h and bilateral.h. The printed forms are those of asg_loops.c and bilateral_loops.c. */
#include "asg_columns.h"
#include "hard_cases.h"
#include "../../bilateral.h"
#include "../exact_asg.h"
#include <float.h>

BENCH_DECLARE(printed_asg_eval);
BENCH_DECLARE(printed_asg_integral);
BENCH_DECLARE(printed_asg_sg_integral);
BENCH_DECLARE(printed_asg_ggx_lobe);
BENCH_DECLARE(printed_sg_weight);
BENCH_DECLARE(cardano_asg_libm);

static void put_asg(int column, asg_lobe a) {
    hard_put(column, a.x);
    hard_put(column + 3, a.y);
    hard_put(column + 6, a.z);
    hard_in.column[column + 9][0] = a.sharpness_x;
    hard_in.column[column + 10][0] = a.sharpness_y;
}

static double ran(bench_loop *loop, int column) {
    loop(&hard_in, &hard_out);
    return (double)hard_out.column[column][0];
}

static const double skew[3] = {0.3, -0.54, 0.8};

/* The axis, turned by an angle across one that is a turn away */
static void off(double angle, double turn, double axis[3]) {
    double z[3] = {skew[0], skew[1], skew[2]}, u[3], v[3];
    int k;
    normalize(z);
    reference_frame(z, u, v);
    for (k = 0; k < 3; k++) axis[k] = cos(angle) * z[k] + sin(angle) * (cos(turn) * u[k] + sin(turn) * v[k]);
}

static asg_lobe lobe_off(double angle, double turned, double lx, double ly) {
    double z[3];
    off(angle, 0.4, z);
    return lobe_around(z, turned, lx, ly);
}

static double directional(double sharpness, double exponent) {
    double e = fabs(exponent);
    return TEST_EPSILON * (1 + e + sqrt(sharpness * e) + TEST_EPSILON * sharpness);
}

/* ---- asg.h ---- */

static void evaluate(const char *name, double lx, double ly, double angle) {
    asg_lobe a = lobe_off(0, 0.3, lx, ly);
    exact_asg exact = exact_of(a);
    double axis[3], z, e;
    sg_lobe dir;
    off(angle, 1, axis);
    dir = sg_around(axis, 1);
    widen(dir.axis, axis);
    z = dot(axis, exact.z);
    e = log(exact_eval(&exact, axis) / z);
    put_asg(ASG_A, a);
    hard_put(SG_B, dir.axis);
    hard_case_row_printed(hard_case_of("asg.h", "asg_eval", "directional", name, (double)asg_eval(a, dir.axis),
                                       exact_eval(&exact, axis),
                                       exp(e) * (TEST_EPSILON + z * directional(fmax(lx, ly), e))),
                          ran(printed_asg_eval_scalar, 0));
}

static void integrate(const char *name, const char *kind, double lx, double ly) {
    asg_lobe a = lobe_off(0, 0.3, lx, ly);
    double wanted = reference_integral((double)a.sharpness_x, (double)a.sharpness_y);
    put_asg(ASG_A, a);
    hard_case_row_printed(hard_case_of("asg.h", "asg_integral", kind, name, (double)asg_integral(a), wanted, wanted),
                          ran(printed_asg_integral_scalar, 0));
}

/* An SG that is next to a point, for which the integral is the lobe's value times the SG's */
static void with_point(const char *name, double lx, double ly, double sharpness, double angle) {
    asg_lobe a = lobe_off(0, 0.3, lx, ly);
    exact_asg exact = exact_of(a);
    double axis[3], wanted, e;
    sg_lobe g;
    off(angle, 1, axis);
    g = sg_around(axis, sharpness);
    widen(g.axis, axis);
    normalize(axis);
    wanted = exact_eval(&exact, axis);
    e = log(wanted / dot(axis, exact.z));
    wanted *= 2 * REFERENCE_PI / (double)g.sharpness;
    put_asg(ASG_A, a);
    hard_put(SG_B, g.axis);
    hard_in.column[SG_B + 3][0] = g.sharpness;
    hard_in.column[SG_B + 4][0] = 0;
    hard_case_row_printed(hard_case_of("asg.h", "asg_sg_integral", "directional", name, (double)asg_sg_integral(a, g),
                                       wanted, wanted * directional(fmax(lx, ly), e)),
                          ran(printed_asg_sg_integral_scalar, 0));
}

static void multiply(const char *name, const char *kind, asg_lobe a, asg_lobe b) {
    double wanted = reference_product(a, &b, NULL);
    double aligned = sqrt(reference_product(a, &a, NULL) * reference_product(b, &b, NULL)), unit = aligned;
    const double most =
        fmax(fmax((double)a.sharpness_x, (double)a.sharpness_y), fmax((double)b.sharpness_x, (double)b.sharpness_y));
    if (!strcmp(kind, "directional")) unit = wanted * directional(most, log(wanted / aligned));
    put_asg(ASG_A, a);
    put_asg(ASG_B, b);
    hard_in.column[ASG_A + 11][0] = hard_in.column[ASG_B + 11][0] = 0;
    hard_case_row_printed(
        hard_case_of("asg.h", "asg_product_integral", kind, name, (double)asg_product_integral(a, b), wanted, unit),
        ran(cardano_asg_libm_scalar, 0));
}

static void reflect(const char *name, double alpha, double incidence) {
    const float width = (float)alpha;
    double n[3], w[3], cosine, wanted;
    lobe_vec3 normal, wi;
    off(0, 0, n);
    off(acos(incidence), 1, w);
    normal = narrow(n);
    wi = narrow(w);
    widen(normal, n);
    widen(wi, w);
    normalize(n);
    normalize(w);
    cosine = dot(n, w);
    wanted = 0.25 / ((double)width * (double)width * cosine * cosine);
    hard_put(SURFACE_NORMAL, normal);
    hard_put(SURFACE_WI, wi);
    hard_in.column[SURFACE_ALPHA_X][0] = width;
    hard_case_row_printed(hard_case_of("asg.h", "asg_reflection_lobe", "cosine", name,
                                       (double)asg_ggx_lobe(normal, wi, width).sharpness_y, wanted,
                                       wanted * TEST_EPSILON / cosine),
                          ran(printed_asg_ggx_lobe_scalar, 7));
}

/* ---- bilateral.h ---- */

static sg_lobe sg_off(double angle, double sharpness) {
    double axis[3];
    off(angle, 0.4, axis);
    return sg_around(axis, sharpness);
}

/* Eq. 12 */
static double exact_weight(sg_lobe i, sg_lobe j, double beta, double *unit) {
    double a[3], b[3], li = (double)i.sharpness, lj = (double)j.sharpness, chord = 0, ratio = li / lj, e, l;
    int k;
    widen(i.axis, a);
    widen(j.axis, b);
    normalize(a);
    normalize(b);
    for (k = 0; k < 3; k++) chord += (a[k] - b[k]) * (a[k] - b[k]);
    e = -beta * (0.5 * log(4 / ((1 + ratio) * (1 + 1 / ratio))) - 0.5 * chord * li * (lj / (li + lj)));
    l = beta * fmin(li, lj);
    *unit = exp(-e) * (1 + e + beta + sqrt(l * fmax(e, 0)) + TEST_EPSILON * l) * TEST_EPSILON + 2 * (double)FLT_MIN;
    return exp(-e);
}

static void weigh(const char *name, sg_lobe i, sg_lobe j, double beta) {
    double unit, wanted = exact_weight(i, j, beta, &unit);
    hard_put(LOBE_A, i.axis);
    hard_put(LOBE_B, j.axis);
    hard_in.column[LOBE_A + 3][0] = i.sharpness;
    hard_in.column[LOBE_B + 3][0] = j.sharpness;
    hard_in.column[UNIFORM_U][0] = (float)beta;
    hard_case_row_printed(hard_case_of("bilateral.h", "bilateral_sg_weight", "similarity", name,
                                       (double)bilateral_sg_weight(i, j, (float)beta), wanted, unit),
                          ran(printed_sg_weight_scalar, 0));
}

/* The other way round, to the last bit */
static void turn_round(const char *name, sg_lobe i, sg_lobe j, double beta) {
    hard_case_row(hard_case_within("bilateral_sg_weight", "1", 0, name, (double)bilateral_sg_weight(i, j, (float)beta),
                                   (double)bilateral_sg_weight(j, i, (float)beta)));
}

static void weigh_asgs(const char *name, const char *kind, asg_lobe i, asg_lobe j) {
    double wanted =
        !strcmp(kind, "symmetric")
            ? (double)bilateral_asg_weight(j, i, 1)
            : reference_product(i, &j, NULL) / sqrt(reference_product(i, &i, NULL) * reference_product(j, &j, NULL));
    hard_case_row(hard_case_of("bilateral.h", "bilateral_asg_weight", kind, name, (double)bilateral_asg_weight(i, j, 1),
                               wanted, 1));
}

void hard_asg(void) {
    const asg_lobe sharp = lobe_off(0, 0.3, 1e8, 1e6);
    evaluate("sharpness 1e10 and 1, 1e-5 off its axis", 1e10, 1, 1e-5);
    evaluate("sharpness 1e-8, 89 degrees off", 1e-8, 1e-8, 89 * REFERENCE_PI / 180);
    integrate("sharpness 0", "isotropic", 0, 0);
    integrate("sharpness 1e-8", "isotropic", 1e-8, 1e-8);
    integrate("sharpness 1e5 and .01", "rel", 1e5, 0.01);
    with_point("sharpness 1000 and 1, with an SG of 1e12", 1000, 1, 1e12, 0.05);
    multiply("sharpness 1e8 and 1e6, the same lobe twice", "directional", sharp, sharp);
    multiply("the same, axes 1e-7 apart", "directional", sharp, lobe_off(1e-7, 0.3, 1e8, 1e6));
    multiply("the same, turned by 1e-7", "directional", sharp, lobe_off(0, 0.3 + 1e-7, 1e8, 1e6));
    multiply("the same, 1e-4 sharper", "directional", sharp, lobe_off(0, 0.3, 1.0001e8, 1.0001e6));
    multiply("isotropic, sharpness 1e6 twice", "directional", lobe_off(0, 0.3, 1e6, 1e6), lobe_off(0, 0.3, 1e6, 1e6));
    multiply("sharpness 100, opposed", "aligned", lobe_off(0, 0.3, 100, 100), lobe_off(REFERENCE_PI, 0.3, 100, 100));
    multiply("sharpness .01, opposed", "aligned", lobe_off(0, 0.3, .01, .01), lobe_off(REFERENCE_PI, 0.3, .01, .01));
    reflect("alpha 1e-4, incidence at a cosine of .001", 1e-4, 1e-3);
    weigh("sharpness 1e10, the same lobe twice", sg_off(0, 1e10), sg_off(0, 1e10), 20);
    weigh("sharpness 1e10, axes 1e-7 apart", sg_off(0, 1e10), sg_off(1e-7, 1e10), 20);
    weigh("sharpness 1e10 and 2e10, axes 5e-6 apart", sg_off(0, 1e10), sg_off(5e-6, 2e10), 20);
    turn_round("the same, the other way round", sg_off(0, 1e10), sg_off(5e-6, 2e10), 20);
    weigh("sharpness 1e10 and 1, opposed, beta 1", sg_off(0, 1e10), sg_off(REFERENCE_PI, 1), 1);
    weigh("sharpness 1e10, opposed", sg_off(0, 1e10), sg_off(REFERENCE_PI, 1e10), 20);
    weigh("sharpness 1e-8, opposed", sg_off(0, 1e-8), sg_off(REFERENCE_PI, 1e-8), 20);
    weigh_asgs("sharpness 1e8 and 1e6, the same lobe twice", "model", sharp, sharp);
    weigh_asgs("the same, axes 1e-7 apart", "model", sharp, lobe_off(1e-7, 0.3, 1e8, 1e6));
    weigh_asgs("the same, the other way round", "symmetric", sharp, lobe_off(1e-7, 0.3, 1e8, 1e6));
}
