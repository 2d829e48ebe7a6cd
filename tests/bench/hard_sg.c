/* hard_sg.c - hard cases of sg.h. The printed forms are those of sg_loops.c. */
#include "sg_columns.h"
#include "hard_cases.h"
#include "../exact.h"

BENCH_DECLARE(printed_eval);
BENCH_DECLARE(printed_integral);
BENCH_DECLARE(printed_sample);
BENCH_DECLARE(printed_product);
BENCH_DECLARE(printed_product_integral);
BENCH_DECLARE(printed_product_integral_approx);
BENCH_DECLARE(printed_convolve);
BENCH_DECLARE(printed_sharpness);
BENCH_DECLARE(printed_ggx_lobe);
BENCH_DECLARE(printed_vsgl_diffuse);
BENCH_DECLARE(printed_vsl);
BENCH_DECLARE(constant_cosine);

static double ran(bench_loop *loop, int column) {
    loop(&hard_in, &hard_out);
    return (double)hard_out.column[column][0];
}

/* Of two lobes, or of a lobe and a direction */
static double printed(bench_loop *loop, int column, sg_lobe a, sg_lobe b) {
    hard_put(LOBE_A, a.axis);
    hard_in.column[LOBE_A + 3][0] = a.sharpness;
    hard_put(LOBE_B, b.axis);
    hard_in.column[LOBE_B + 3][0] = b.sharpness;
    return ran(loop, column);
}

static vec skew(void) { /* an axis whose length as floats is not 1 */
    vec v = {0.3, -0.54, 0.8};
    return unit(v);
}

static vec off(vec a, double angle) { /* that far from it */
    vec x = {1, 0, 0};
    x = unit(combine(1, x, -dot(x, a), a));
    return combine(cos(angle), a, sin(angle), x);
}

static sg_lobe lobe(vec axis, double sharpness) {
    sg_lobe g;
    g.axis = narrow(axis);
    g.sharpness = (float)sharpness;
    g.log_amplitude = 0;
    return g;
}

static void evaluate(const char *name, double sharpness, double angle) {
    sg_lobe g = lobe(skew(), sharpness), dir = lobe(off(skew(), angle), 0);
    double ln = exact_log_eval(g, unit(wide(dir.axis)));
    hard_case_row_printed(hard_case_of("sg.h", "sg_eval", "conditioned", name, (double)sg_eval(g, dir.axis), exp(ln),
                                       conditioned(1, ln, -ln)),
                          printed(printed_eval_scalar, 0, g, dir));
}

static void integrate(const char *name, double sharpness) {
    sg_lobe g = lobe(skew(), sharpness);
    double wanted = exact_integral((double)g.sharpness);
    hard_case_row_printed(
        hard_case_of("sg.h", "sg_integral", "rel", name, (double)sg_integral(g.sharpness), wanted, wanted),
        printed(printed_integral_scalar, 0, g, g));
}

static void draw(const char *name, double sharpness) {
    sg_lobe g = lobe(skew(), sharpness);
    const float u = 0.5f;
    double l = (double)g.sharpness, share[2];
    lobe_vec3 w = sg_sample(g, u, 0.25f);
    int k;
    hard_in.column[UNIFORM_U][0] = u;
    hard_in.column[UNIFORM_V][0] = 0.25f;
    printed(printed_sample_scalar, 0, g, g);
    for (k = 0; k < 2; k++) { /* of the lobe, within the direction's angle */
        double chord;
        if (k) w = lobe_vector(hard_out.column[0][0], hard_out.column[1][0], hard_out.column[2][0]);
        chord = distance(unit(wide(w)), unit(wide(g.axis)));
        share[k] = expm1(-0.5 * l * chord * chord) / expm1(-2 * l);
    }
    hard_case_row_printed(
        hard_case_of("sg.h", "sg_sample", "share", name, share[0], (double)u, TEST_EPSILON * (1 + sqrt(l))), share[1]);
}

static void multiply_peak(const char *name, double la, double lb, double angle) {
    sg_lobe a = lobe(skew(), la), b = lobe(off(skew(), angle), lb), g = sg_product(a, b);
    exact_product p = multiply_lobes(a, b);
    hard_case_row_printed(hard_case_of("sg.h", "sg_product", "conditioned", name, exp((double)g.log_amplitude),
                                       exp(p.log_loss), conditioned(1, p.log_loss, -p.log_loss)),
                          exp(printed(printed_product_scalar, 4, a, b)));
}

static void multiply_integral(const char *name, double la, double lb, double angle) {
    sg_lobe a = lobe(skew(), la), b = lobe(off(skew(), angle), lb);
    exact_product p = multiply_lobes(a, b);
    double aligned = exact_integral(p.sharpness);
    hard_case_row_printed(hard_case_of("sg.h", "sg_product_integral", "conditioned", name,
                                       (double)sg_product_integral(a, b), aligned * exp(p.log_loss),
                                       conditioned(aligned, p.log_loss, -p.log_loss)),
                          printed(printed_product_integral_scalar, 0, a, b));
}

static void multiply_approx(const char *name, double la, double lb, double angle) {
    sg_lobe a = lobe(skew(), la), b = lobe(off(skew(), angle), lb);
    double chord = distance(unit(wide(a.axis)), unit(wide(b.axis))), sum = (double)a.sharpness + (double)b.sharpness;
    double loss = -0.5 * chord * chord * (double)a.sharpness * ((double)b.sharpness / sum),
           aligned = 2 * REFERENCE_PI / sum;
    hard_case_row_printed(hard_case_of("sg.h", "sg_product_integral_approx", "conditioned", name,
                                       (double)sg_product_integral_approx(a, b), aligned * exp(loss),
                                       conditioned(aligned, loss, -loss)),
                          printed(printed_product_integral_approx_scalar, 0, a, b));
}

static void convolve(const char *name, double sharpness, double kappa) {
    sg_lobe g = lobe(skew(), sharpness), kernel = lobe(skew(), kappa);
    double wanted = (double)g.sharpness / (1 + (double)g.sharpness / (double)kernel.sharpness);
    hard_case_row_printed(hard_case_of("sg.h", "sg_convolve", "rel", name,
                                       (double)sg_convolve(g, kernel.sharpness).sharpness, wanted, wanted),
                          printed(printed_convolve_scalar, 0, g, kernel));
}

/* Beside it the cosine of the axis, which the papers take for constant */
static void cosine(const char *name, double sharpness, double angle) {
    sg_lobe g = lobe(skew(), sharpness), normal = lobe(off(skew(), angle), 0);
    double whole = exact_integral((double)g.sharpness);
    double mean = exact_cosine((double)g.sharpness, dot(unit(wide(g.axis)), unit(wide(normal.axis))));
    hard_case_row_printed(hard_case_of("sg.h", "sg_cosine_integral", "abs", name,
                                       (double)sg_cosine_integral(g, normal.axis), whole * mean, whole),
                          printed(constant_cosine_scalar, 0, g, normal));
}

static void reflect(const char *name, double alpha, double incidence) {
    const float a = (float)alpha;
    lobe_vec3 normal = narrow(skew()), wi = narrow(off(skew(), acos(incidence)));
    double c = dot(unit(wide(normal)), unit(wide(wi))), wanted = 1 / (2 * (double)a * (double)a * c);
    hard_put(VPL_NORMAL, normal);
    hard_put(VPL_WI, wi);
    hard_in.column[VPL_ALPHA][0] = a;
    hard_case_row_printed(hard_case_of("sg.h", "sg_reflection_lobe", "ulp", name,
                                       (double)sg_ggx_lobe(normal, wi, a).sharpness, wanted, test_ulp(wanted) / c),
                          ran(printed_ggx_lobe_scalar, 3));
}

/* Two lights of equal power, their variance by merging, by moments from an origin near them, and as printed by moments
   from 0: the mean square less the square of the mean. */
static void variance(const char *by_merging, const char *by_moments, double far_away, double apart) {
    const lobe_vec3 none = lobe_vector(0, 0, 0), one = lobe_vector(1, 1, 1), normal = narrow(skew());
    const lobe_vec3 first = narrow(combine(far_away, skew(), 0, skew())),
                    second = narrow(combine(1, wide(first), apart, off(skew(), 1)));
    const vec gap = combine(1, wide(second), -1, wide(first));
    const double wanted = 0.25 * dot(gap, gap);
    const vsgl merged =
        vsgl_from_cluster(vsgl_cluster_merge(vsgl_cluster_from_vpl(first, normal, normal, none, one, .1f),
                                             vsgl_cluster_from_vpl(second, normal, normal, none, one, .1f)));
    const lobe_vec3 apart_by = lobe_sub(second, first);
    const vsgl summed =
        vsgl_from_moments(vsgl_moments_add(vsgl_moments_from_vpl(none, normal, normal, none, one, .1f),
                                           vsgl_moments_from_vpl(apart_by, normal, normal, none, one, .1f)),
                          first);
    const lobe_vec3 mean = lobe_scale(lobe_add(first, second), 0.5f);
    const float squares = 0.5f * (lobe_dot(first, first) + lobe_dot(second, second));
    const double naive = (double)(squares - lobe_dot(mean, mean));
    hard_case_row_printed(
        hard_case_of("sg.h", "vsgl_cluster_merge", "variance", by_merging, (double)merged.variance, wanted, wanted),
        naive);
    hard_case_row_printed(hard_case_of("sg.h", "vsgl_from_moments", "variance", by_moments, (double)summed.variance,
                                       wanted, 2 * wanted), /* the squared mean is as much */
                          naive);
}

static void sharpness_of_two(const char *name, double alpha) {
    const lobe_vec3 none = lobe_vector(0, 0, 0), one = lobe_vector(1, 1, 1), normal = narrow(skew());
    const float a = (float)alpha;
    const vsgl_cluster c = vsgl_cluster_from_vpl(none, normal, normal, none, one, a);
    const double wanted = 1 / (2 * (double)a * (double)a);
    hard_in.column[LOBE_A + 3][0] = (float)wanted / ((float)wanted + 1); /* the mean's length */
    hard_case_row_printed(hard_case_of("sg.h", "vsgl_cluster_merge", "sharpness", name,
                                       (double)vsgl_from_cluster(vsgl_cluster_merge(c, c)).emission[1].sharpness,
                                       wanted, wanted),
                          ran(printed_sharpness_scalar, 0));
}

/* A light that emits at a surface which it meets head-on */
static void light_up(const char *name, double alpha, double far_away, double spread) {
    const float a = (float)alpha;
    const lobe_vec3 normal = lobe_vector(0, 0, 1), place = lobe_vector(0, 0, (float)far_away);
    sg_lobe emission = sg_ggx_lobe(normal, normal, a);
    double l = 1 / (2 * (double)a * (double)a), v = (double)(float)spread, wanted;
    exact_product p =
        multiply(far_away * far_away / v, vec_of((const double[]){0, 0, -1}), l, vec_of((const double[]){0, 0, -1}));
    vsgl light;
    light.position = lobe_vector(0, 0, 0);
    light.variance = (float)spread;
    light.emission[0] = light.emission[1] = emission;
    light.intensity[0] = light.intensity[1] = lobe_vector(1, 1, 1);
    wanted = exact_integral(p.sharpness) / (2 * REFERENCE_PI * v) / REFERENCE_PI;
    hard_put(VPL_POSITION, light.position);
    hard_put(VPL_NORMAL, normal);
    hard_put(VPL_WI, normal);
    hard_put(VPL_POINT, place);
    hard_put(VPL_FACING, lobe_vector(0, 0, -1));
    hard_in.column[VPL_ALPHA][0] = a;
    hard_in.column[VPL_VARIANCE][0] = (float)spread;
    hard_case_row_printed(hard_case_of("sg.h", "vsgl_diffuse", "conditioned", name,
                                       (double)vsgl_diffuse(light, VSGL_SPECULAR, place, lobe_vector(0, 0, -1)), wanted,
                                       wanted * TEST_EPSILON),
                          ran(printed_vsgl_diffuse_scalar, 0));
}

static void solid_angle(const char *name, double away) {
    const float d = (float)away;
    double sine = 1 / (double)d, c = sqrt((1 - sine) * (1 + sine)), wanted = 2 * (1 + c) / (sine * sine);
    const lobe_vec3 center = lobe_vector(0, 0, 0), place = lobe_vector(0, 0, d);
    hard_put(VPL_POSITION, center);
    hard_put(VPL_POINT, place);
    hard_in.column[VPL_VARIANCE][0] = 1;
    hard_case_row_printed(hard_case_of("sg.h", "vsl_lobe", "conditioned", name,
                                       (double)vsl_lobe(center, 1, place).sharpness, wanted,
                                       wanted * (1 + 1 / c) * TEST_EPSILON),
                          ran(printed_vsl_scalar, 3));
}

void hard_sg(void) {
    evaluate("sharpness 1e10, on its axis", 1e10, 0);
    evaluate("sharpness 1e10, 1e-5 off its axis", 1e10, 1e-5);
    evaluate("sharpness 1e-8, opposed", 1e-8, REFERENCE_PI);
    evaluate("sharpness 0", 0, 1);
    integrate("sharpness 0", 0);
    integrate("sharpness 1e-8", 1e-8);
    integrate("sharpness 1e10", 1e10);
    draw("sharpness 1e10, half of the lobe", 1e10);
    draw("sharpness 1e-8, half of the sphere", 1e-8);
    multiply_peak("two of sharpness 1e10, the same axis", 1e10, 1e10, 0);
    multiply_peak("two of sharpness 1e10, axes 1e-5 apart", 1e10, 1e10, 1e-5);
    multiply_integral("both of sharpness 0", 0, 0, 1);
    multiply_integral("two of sharpness 1e10, axes 1e-7 apart", 1e10, 1e10, 1e-7);
    multiply_integral("sharpness 1e10 and 1e-8, opposed", 1e10, 1e-8, REFERENCE_PI);
    multiply_integral("two of sharpness 20, opposed", 20, 20, REFERENCE_PI);
    multiply_approx("two of sharpness 1e10, axes 1e-5 apart", 1e10, 1e10, 1e-5);
    convolve("sharpness 1e10 with 1e-8", 1e10, 1e-8);
    cosine("sharpness 1e6, at the horizon", 1e6, REFERENCE_PI / 2);
    cosine("sharpness 1e-3, opposed", 1e-3, REFERENCE_PI);
    reflect("alpha 1e-4, incidence at a cosine of .001", 1e-4, 1e-3);
    variance("two lights 1 apart, 1e4 from the origin", "the same, summed from one of them", 1e4, 1);
    variance("two lights 1 apart, 1000 from the origin", "the same, summed from one of them", 1000, 1);
    sharpness_of_two("two lights of alpha 1e-4", 1e-4);
    light_up("alpha 1e-4, variance 1e-4, 1e4 away", 1e-4, 1e4, 1e-4);
    solid_angle("radius 1, 1e4 away", 1e4);
    solid_angle("radius 1, 1.0001 away", 1.0001);
}
