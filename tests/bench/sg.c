/* sg.c - the rows for sg.h. */
#include "sg_columns.h"
#include "../exact.h"

/* ---- inputs ---- */

static double uniform(void) {
    return test_uniform(&test_random);
}

static double log_uniform(double low, double high) {
    return test_log_uniform(&test_random, low, high);
}

static void put(float *in, vec v) {
    lobe_vec3 w = narrow(v);
    in[0] = w.x;
    in[1] = w.y;
    in[2] = w.z;
}

/* Two lobes of any sharpness; the second axis the same, opposed, anywhere, or on the flank of the blunter lobe, where
   the values are that count. */
static void draw_pair(float *in) {
    vec a = random_direction(), b = a;
    double la = log_uniform(1e-8, 1e10), lb = log_uniform(1e-8, 1e10), least = la < lb ? la : lb, kind = 8 * uniform();
    if (kind < 1) b = combine(-1, a, 0, a);
    if (kind >= 2) b = turned(a, fmin(REFERENCE_PI, log_uniform(0.1, 6) / sqrt(least + 0.1)));
    if (kind >= 7) b = random_direction();
    put(in + LOBE_A, a);
    in[LOBE_A + 3] = (float)la;
    put(in + LOBE_B, b);
    in[LOBE_B + 3] = (float)lb;
    in[UNIFORM_U] = (float)uniform();
    in[UNIFORM_V] = (float)uniform();
}

static void draw_flank(float *in) { /* where a lobe crosses the horizon, in three of four draws */
    vec a = random_direction();
    double l = log_uniform(1e-3, 1e6), angle = REFERENCE_PI / 2 + (2 * uniform() - 1) * 4 / sqrt(1 + l);
    put(in + LOBE_A, a);
    in[LOBE_A + 3] = (float)l;
    put(in + LOBE_B, uniform() < 0.25 ? random_direction() : turned(a, fmin(REFERENCE_PI, fmax(0, angle))));
}

static void draw_cosine(float *in) {
    draw_flank(in);
    in[LOBE_COSINE] = (float)dot(unit(wide(vector_in(in, 1, LOBE_A))), unit(wide(vector_in(in, 1, LOBE_B))));
}

static void draw_sharp_flank(float *in) {
    do draw_flank(in);
    while (in[LOBE_A + 3] < 4);
}

static void draw_length(float *in) { /* of a mean direction */
    double l = log_uniform(1e-8, 1e5);
    in[LOBE_A + 3] = (float)(l / (l + 1));
}

static void draw_surface(float *in) {
    vec normal = random_direction();
    put(in + VPL_NORMAL, normal);
    put(in + VPL_WI, turned(normal, 1.5 * uniform()));
    in[VPL_ALPHA] = (float)log_uniform(1e-4, 1);
}

static void draw_exponent(float *in) {
    draw_surface(in);
    in[VPL_ALPHA] = (float)log_uniform(1, 1e8);
}

static void draw_two_vpls(float *in) { /* the same but for their places, 1e4 away and within .01 to 10 of each other */
    vec place = random_direction();
    draw_surface(in);
    place = combine(1e4, place, 0, place);
    put(in + VPL_POSITION, place);
    put(in + VPL_POINT, combine(1, place, log_uniform(0.01, 10), random_direction()));
}

static void draw_light(float *in) { /* lit places where the lobe is above e^-20, or so */
    vec away, normal, position = random_direction();
    double alpha, cosine;
    draw_surface(in);
    alpha = (double)in[VPL_ALPHA];
    normal = unit(wide(vector_in(in, 1, VPL_NORMAL)));
    away = unit(wide(vector_in(in, 1, VPL_WI)));
    cosine = dot(normal, away);
    away = combine(2 * cosine, normal, -1, away);
    away = turned(away, fmin(2, log_uniform(0.01, 6) * alpha * (cosine + 0.1)));
    put(in + VPL_POSITION, combine(10, position, 0, position));
    put(in + VPL_POINT, combine(10, position, log_uniform(0.1, 100), away));
    put(in + VPL_FACING, turned(combine(-1, away, 0, away), 2 * uniform()));
    in[VPL_VARIANCE] = (float)log_uniform(1e-4, 100);
}

static void draw_sphere(float *in) {
    vec away = random_direction();
    put(in + VPL_POSITION, random_direction());
    put(in + VPL_POINT, combine(1, wide(vector_in(in, 1, VPL_POSITION)), log_uniform(1.001, 1e4), away));
    in[VPL_VARIANCE] = 1; /* the radius */
}

/* ---- what is exact, and the units ---- */

static double relative(const double *wanted, const float *out) {
    return ((double)out[0] - wanted[0]) / wanted[1];
}

static double sharpness_of(const float *in) {
    return (double)in[LOBE_A + 3];
}

static double log_value(const float *in) {
    return exact_log_eval(lobe_in(in, 1, LOBE_A), unit(wide(vector_in(in, 1, LOBE_B))));
}

static void exact_eval(const float *in, double *wanted) {
    double ln = log_value(in);
    wanted[0] = exp(ln);
    wanted[1] = conditioned(1, ln, -ln);
}

static void exact_density(const float *in, double *wanted) {
    double ln = log_value(in), peak = 1 / exact_integral(sharpness_of(in));
    wanted[0] = peak * exp(ln);
    wanted[1] = conditioned(peak, ln, -ln);
}

static void exact_whole(const float *in, double *wanted) {
    wanted[0] = wanted[1] = exact_integral(sharpness_of(in));
}

static void exact_normalized(const float *in, double *wanted) {
    wanted[0] = -log(exact_integral(sharpness_of(in)));
    wanted[1] = 1 + fabs(wanted[0]);
}

static void exact_sample(const float *in, double *wanted) {
    vec axis = unit(wide(vector_in(in, 1, LOBE_A)));
    wanted[0] = (double)in[UNIFORM_U];
    wanted[1] = axis.x;
    wanted[2] = axis.y;
    wanted[3] = axis.z;
    wanted[4] = sharpness_of(in);
}

/* The share of the lobe within the direction's angle, less u, in what floats of a direction tell of it */
static double share_error(const double *wanted, const float *out) {
    vec axis = {wanted[1], wanted[2], wanted[3]};
    double chord = distance(unit(wide(lobe_vector(out[0], out[1], out[2]))), axis), l = wanted[4];
    double share = expm1(-0.5 * l * chord * chord) / expm1(-2 * l);
    return (share - wanted[0]) / (TEST_EPSILON * (1 + sqrt(l)));
}

static exact_product product_of(const float *in) {
    return multiply_lobes(lobe_in(in, 1, LOBE_A), lobe_in(in, 1, LOBE_B));
}

static void exact_lobes_product(const float *in, double *wanted) {
    exact_product p = product_of(in);
    wanted[0] = p.log_loss;
    wanted[1] = p.sharpness;
    wanted[2] = p.sum;
}

static double product_error(const double *wanted, const float *out) {
    double peak = (exp((double)out[4]) - exp(wanted[0])) / conditioned(1, wanted[0], -wanted[0]);
    return fmax(fabs(peak), fabs((double)out[3] - wanted[1]) / (wanted[2] * TEST_EPSILON));
}

static void exact_product_integral(const float *in, double *wanted) {
    exact_product p = product_of(in);
    double aligned = exact_integral(p.sharpness);
    wanted[0] = aligned * exp(p.log_loss);
    wanted[1] = conditioned(aligned, p.log_loss, -p.log_loss);
}

static void exact_iwasaki(const float *in, double *wanted) {
    exact_product p = product_of(in);
    sg_lobe a = lobe_in(in, 1, LOBE_A), b = lobe_in(in, 1, LOBE_B);
    double chord = distance(unit(wide(a.axis)), unit(wide(b.axis)));
    double loss = -0.5 * chord * chord * (double)a.sharpness * ((double)b.sharpness / p.sum),
           aligned = 2 * REFERENCE_PI / p.sum;
    wanted[0] = aligned * exp(loss);
    wanted[1] = conditioned(aligned, loss, -loss);
}

static void exact_convolved(const float *in, double *wanted) {
    double kappa = (double)in[LOBE_B + 3], ratio = sharpness_of(in) / kappa;
    wanted[0] = sharpness_of(in) / (1 + ratio);
    wanted[1] = -log1p(ratio);
}

static double convolved_error(const double *wanted, const float *out) {
    return fmax(fabs((double)out[0] / wanted[0] - 1), fabs((double)out[1] - wanted[1]) / (1 - wanted[1]));
}

static void exact_cosine_integral(const float *in, double *wanted) {
    double c = dot(unit(wide(vector_in(in, 1, LOBE_A))), unit(wide(vector_in(in, 1, LOBE_B))));
    wanted[1] = exact_integral(sharpness_of(in));
    wanted[0] = wanted[1] * exact_cosine(sharpness_of(in), c);
}

static void exact_cosine_mean(const float *in, double *wanted) {
    wanted[0] = exact_cosine(sharpness_of(in), (double)in[LOBE_COSINE]);
    wanted[1] = 1;
}

static void exact_clamped_cosine(const float *in, double *wanted) {
    wanted[0] = fmax(0, dot(unit(wide(vector_in(in, 1, LOBE_A))), unit(wide(vector_in(in, 1, LOBE_B))))) / REFERENCE_PI;
    wanted[1] = 1;
}

static void exact_length(const float *in, double *wanted) {
    wanted[0] = wanted[1] = sharpness_of(in) / (sharpness_of(in) + 1);
}

static void exact_sharpness(const float *in, double *wanted) {
    wanted[0] = wanted[1] = sharpness_of(in) / (1 - sharpness_of(in));
}

static void exact_reflection(const float *in, double half, double *wanted) {
    vec normal = unit(wide(vector_in(in, 1, VPL_NORMAL))), wi = unit(wide(vector_in(in, 1, VPL_WI)));
    double cosine = dot(normal, wi);
    vec mirror = combine(2 * cosine, normal, -1, wi);
    wanted[0] = mirror.x;
    wanted[1] = mirror.y;
    wanted[2] = mirror.z;
    wanted[3] = half / (4 * fabs(cosine));
}

static void exact_ggx(const float *in, double *wanted) {
    exact_reflection(in, 2 / ((double)in[VPL_ALPHA] * (double)in[VPL_ALPHA]), wanted);
}

static void exact_phong(const float *in, double *wanted) {
    exact_reflection(in, (double)in[VPL_ALPHA], wanted);
}

static double lobe_error(const double *wanted, const float *out) {
    vec axis = {wanted[0], wanted[1], wanted[2]};
    return fmax(distance(wide(lobe_vector(out[0], out[1], out[2])), axis), fabs((double)out[3] / wanted[3] - 1));
}

static void exact_pair_of_vpls(const float *in, double *wanted) {
    vec gap = combine(1, wide(vector_in(in, 1, VPL_POSITION)), -1, wide(vector_in(in, 1, VPL_POINT)));
    exact_ggx(in, wanted);
    wanted[4] = 0.25 * dot(gap, gap);
}

static double cluster_error(const double *wanted, const float *out) {
    return fmax(fabs((double)out[3] / wanted[3] - 1), fabs((double)out[5] / wanted[4] - 1));
}

/* Eq. 7 */
static exact_product incoming_of(const float *in, double *aligned) {
    double lobe[4], variance = (double)in[VPL_VARIANCE];
    vec offset = combine(1, wide(vector_in(in, 1, VPL_POSITION)), -1, wide(vector_in(in, 1, VPL_POINT))), back;
    exact_product p;
    exact_ggx(in, lobe);
    back.x = -lobe[0];
    back.y = -lobe[1];
    back.z = -lobe[2];
    p = multiply(dot(offset, offset) / variance, unit(offset), lobe[3], back);
    *aligned = exact_integral(p.sharpness) / (2 * REFERENCE_PI * variance);
    return p;
}

static void exact_incoming(const float *in, double *wanted) {
    double aligned;
    exact_product p = incoming_of(in, &aligned);
    wanted[0] = aligned * exp(p.log_loss);
    wanted[1] = aligned;
}

static double incoming_error(const double *wanted, const float *out) {
    return (exp((double)out[4]) * exact_integral((double)out[3]) - wanted[0]) / wanted[1];
}

static void exact_diffuse(const float *in, double *wanted) {
    double aligned;
    exact_product p = incoming_of(in, &aligned);
    wanted[1] = aligned / REFERENCE_PI;
    wanted[0] =
        wanted[1] * exp(p.log_loss) * exact_cosine(p.sharpness, dot(p.axis, unit(wide(vector_in(in, 1, VPL_FACING)))));
}

static void exact_vsl(const float *in, double *wanted) {
    vec offset = combine(1, wide(vector_in(in, 1, VPL_POSITION)), -1, wide(vector_in(in, 1, VPL_POINT)));
    double s = (double)in[VPL_VARIANCE] / length(offset);
    offset = unit(offset);
    wanted[0] = offset.x;
    wanted[1] = offset.y;
    wanted[2] = offset.z;
    wanted[3] = 2 * (1 + sqrt((1 - s) * (1 + s))) / (s * s);
}

/* ---- the rows ---- */

BENCH_DECLARE(our_eval);
BENCH_DECLARE(our_integral);
BENCH_DECLARE(our_normalize);
BENCH_DECLARE(our_sample);
BENCH_DECLARE(our_pdf);
BENCH_DECLARE(our_product);
BENCH_DECLARE(our_product_integral);
BENCH_DECLARE(our_product_integral_approx);
BENCH_DECLARE(our_convolve);
BENCH_DECLARE(our_cosine);
BENCH_DECLARE(our_cosine_approx);
BENCH_DECLARE(our_cosine_mean);
BENCH_DECLARE(our_cosine_mean_approx);
BENCH_DECLARE(tokuyoshi_2024_mean);
BENCH_DECLARE(our_mean_length);
BENCH_DECLARE(our_sharpness);
BENCH_DECLARE(our_diffuse_lobe);
BENCH_DECLARE(our_ggx_lobe);
BENCH_DECLARE(our_phong_lobe);
BENCH_DECLARE(our_moments);
BENCH_DECLARE(our_cluster);
BENCH_DECLARE(our_incoming);
BENCH_DECLARE(our_vsgl_diffuse);
BENCH_DECLARE(our_vsgl_diffuse_integral);
BENCH_DECLARE(our_vsl);
BENCH_DECLARE(printed_eval);
BENCH_DECLARE(printed_integral);
BENCH_DECLARE(expm1_integral);
BENCH_DECLARE(printed_normalize);
BENCH_DECLARE(printed_sample);
BENCH_DECLARE(printed_pdf);
BENCH_DECLARE(printed_product);
BENCH_DECLARE(printed_product_integral);
BENCH_DECLARE(printed_product_integral_approx);
BENCH_DECLARE(printed_convolve);
BENCH_DECLARE(printed_mean_length);
BENCH_DECLARE(printed_sharpness);
BENCH_DECLARE(printed_ggx_lobe);
BENCH_DECLARE(printed_incoming);
BENCH_DECLARE(printed_vsgl_diffuse);
BENCH_DECLARE(point_light_diffuse);
BENCH_DECLARE(printed_vsl);
BENCH_DECLARE(constant_cosine);
BENCH_DECLARE(inner_product_cosine);
BENCH_DECLARE(hill_cosine);
BENCH_DECLARE(tokuyoshi_2022_cosine);
BENCH_DECLARE(tokuyoshi_2024_cosine);

#define CONDITIONED "(1 + |ln g|) 2^-24"
#define PAIR "sharpness 1e-8 to 1e10, axes equal to opposed"

#define COSINE_FORMS                                                                                                   \
    BENCH_FORM("sg_cosine_integral", our_cosine), BENCH_FORM("sg_cosine_integral_approx", our_cosine_approx),          \
        BENCH_FORM("constant cosine (000)", constant_cosine),                                                          \
        BENCH_FORM("SG of 2.133, product integral", inner_product_cosine),                                             \
        BENCH_FORM("Hill's fit, libm", hill_cosine), BENCH_FORM("Tokuyoshi 2022, libm", tokuyoshi_2022_cosine),        \
        BENCH_FORM("Tokuyoshi 2024, libm", tokuyoshi_2024_cosine)

const bench_row sg_bench[] = {
    {"sg_eval",
     PAIR,
     CONDITIONED,
     16,
     draw_pair,
     exact_eval,
     relative,
     {BENCH_FORM("sg_eval", our_eval), BENCH_FORM("printed, libm", printed_eval)}},
    {"sg_integral",
     PAIR,
     "the value",
     16,
     draw_pair,
     exact_whole,
     relative,
     {BENCH_FORM("sg_integral", our_integral), BENCH_FORM("printed, libm", printed_integral),
      BENCH_FORM("with expm1, libm", expm1_integral)}},
    {"sg_normalize",
     PAIR,
     "1 + |log amplitude|",
     16,
     draw_pair,
     exact_normalized,
     relative,
     {BENCH_FORM("sg_normalize", our_normalize), BENCH_FORM("printed, libm", printed_normalize)}},
    {"sg_sample",
     PAIR,
     "share, (1 + sqrt(sharpness)) 2^-24",
     16,
     draw_pair,
     exact_sample,
     share_error,
     {BENCH_FORM("sg_sample", our_sample), BENCH_FORM("inversion, libm", printed_sample)}},
    {"sg_pdf",
     PAIR,
     CONDITIONED,
     16,
     draw_pair,
     exact_density,
     relative,
     {BENCH_FORM("sg_pdf", our_pdf), BENCH_FORM("printed, libm", printed_pdf)}},
    {"sg_product",
     PAIR,
     CONDITIONED " of the peak, 2^-24 of the sum",
     16,
     draw_pair,
     exact_lobes_product,
     product_error,
     {BENCH_FORM("sg_product", our_product), BENCH_FORM("printed, libm", printed_product)}},
    {"sg_product_integral",
     PAIR,
     CONDITIONED,
     16,
     draw_pair,
     exact_product_integral,
     relative,
     {BENCH_FORM("sg_product_integral", our_product_integral), BENCH_FORM("printed, libm", printed_product_integral),
      BENCH_FORM("sg_product_integral_approx", our_product_integral_approx),
      BENCH_FORM("Iwasaki printed, libm", printed_product_integral_approx)}},
    {"sg_product_integral_approx",
     PAIR,
     CONDITIONED " of its own formula",
     16,
     draw_pair,
     exact_iwasaki,
     relative,
     {BENCH_FORM("sg_product_integral_approx", our_product_integral_approx),
      BENCH_FORM("printed, libm", printed_product_integral_approx)}},
    {"sg_convolve",
     PAIR,
     "1 of sharpness, 1 + |log| of amplitude",
     16,
     draw_pair,
     exact_convolved,
     convolved_error,
     {BENCH_FORM("sg_convolve", our_convolve), BENCH_FORM("printed, libm", printed_convolve)}},
    {"sg_cosine_integral",
     "sharpness 1e-3 to 1e6, mostly at the horizon",
     "the SG's integral",
     2,
     draw_flank,
     exact_cosine_integral,
     relative,
     {COSINE_FORMS}},
    {"sg_cosine_integral, sharp",
     "sharpness 4 to 1e6",
     "the SG's integral",
     2,
     draw_sharp_flank,
     exact_cosine_integral,
     relative,
     {COSINE_FORMS}},
    {"lobe_cosine_mean",
     "sharpness 1e-3 to 1e6, mostly at the horizon",
     "1; all on our primitives",
     2,
     draw_cosine,
     exact_cosine_mean,
     relative,
     {BENCH_FORM("of sg_cosine_integral", our_cosine_mean),
      BENCH_FORM("of sg_cosine_integral_approx", our_cosine_mean_approx),
      BENCH_FORM("Tokuyoshi 2024", tokuyoshi_2024_mean)}},
    {"sg_mean_length",
     PAIR,
     "the value",
     16,
     draw_pair,
     exact_length,
     relative,
     {BENCH_FORM("sg_mean_length", our_mean_length), BENCH_FORM("printed", printed_mean_length)}},
    {"sg_sharpness_from_mean_length",
     "lengths of sharpness 1e-8 to 1e5",
     "the value",
     16,
     draw_length,
     exact_sharpness,
     relative,
     {BENCH_FORM("sg_sharpness_from_mean_length", our_sharpness), BENCH_FORM("printed", printed_sharpness)}},
    {"sg_diffuse_lobe",
     PAIR,
     "1, against max(cos, 0) / pi",
     16,
     draw_pair,
     exact_clamped_cosine,
     relative,
     {BENCH_FORM("sg_diffuse_lobe, sg_eval", our_diffuse_lobe)}},
    {"sg_ggx_lobe",
     "alpha 1e-4 to 1, angle to 1.5",
     "1 of axis, the sharpness",
     16,
     draw_surface,
     exact_ggx,
     lobe_error,
     {BENCH_FORM("sg_ggx_lobe", our_ggx_lobe), BENCH_FORM("printed", printed_ggx_lobe)}},
    {"sg_phong_lobe",
     "exponent 1 to 1e8, angle to 1.5",
     "1 of axis, the sharpness",
     16,
     draw_exponent,
     exact_phong,
     lobe_error,
     {BENCH_FORM("sg_phong_lobe", our_phong_lobe)}},
    {"vsgl_cluster_merge",
     "two VPLs of alpha 1e-4 to 1, .01 to 10 apart, 1e4 away",
     "the sharpness, the variance",
     16,
     draw_two_vpls,
     exact_pair_of_vpls,
     cluster_error,
     {BENCH_FORM("vsgl_cluster, from_vpl to light", our_cluster),
      BENCH_FORM("vsgl_moments, from_vpl to light", our_moments)}},
    {"vsgl_incoming_lobe",
     "alpha 1e-4 to 1, variance 1e-4 to 100, distance .1 to 100",
     "integral of aligned lobes",
     16,
     draw_light,
     exact_incoming,
     incoming_error,
     {BENCH_FORM("vsgl_incoming_lobe", our_incoming), BENCH_FORM("printed, libm", printed_incoming)}},
    {"vsgl_diffuse",
     "the same",
     "value of aligned lobes and cosine 1",
     2,
     draw_light,
     exact_diffuse,
     relative,
     {BENCH_FORM("vsgl_diffuse", our_vsgl_diffuse), BENCH_FORM("vsgl_diffuse_integral", our_vsgl_diffuse_integral),
      BENCH_FORM("printed, libm", printed_vsgl_diffuse), BENCH_FORM("point light", point_light_diffuse)}},
    {"vsl_lobe",
     "radius 1, distance 1.001 to 1e4",
     "1 of axis, the sharpness",
     16,
     draw_sphere,
     exact_vsl,
     lobe_error,
     {BENCH_FORM("vsl_lobe", our_vsl), BENCH_FORM("printed, libm", printed_vsl)}},
    {0}};
