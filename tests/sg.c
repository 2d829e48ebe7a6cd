/*
 sg.c - tests of sg.h against closed forms in double with unit-normalised axes; test_closed_forms holds those
 to quadrature. Everything drawn is recorded, so that a failure prints its input.
*/
#include "../sg.h"
#include "exact.h"
#include "record.h"
#include "tokuyoshi.h"
#include "test.h"
#include <float.h>

#define PI REFERENCE_PI

static unsigned bits_of(float x) {
    unsigned bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static float of_bits(unsigned bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static int finite_vector(lobe_vec3 v) {
    return test_is_finite(v.x) && test_is_finite(v.y) && test_is_finite(v.z);
}

static int finite_lobe(sg_lobe g) {
    return finite_vector(g.axis) && test_is_finite(g.sharpness) && test_is_finite(g.log_amplitude);
}

/* ---- input ---- */

static double uniform(double low, double high) {
    return record(low + (high - low) * test_uniform(&test_random));
}

static double log_uniform(double low, double high) {
    return record((double)(float)test_log_uniform(&test_random, low, high));
}

/* A float direction near a given one, of a length anywhere within 1e-7 of 1. */
static lobe_vec3 nearly_unit(vec v) {
    lobe_vec3 w;
    do w = narrow(combine((1 + 1e-7 * (2 * test_uniform(&test_random) - 1)) / length(v), v, 0, v));
    while (fabs(length(wide(w)) - 1) > 1e-7);
    record_vector(w);
    return w;
}

static lobe_vec3 random_axis(void) {
    return nearly_unit(random_direction());
}

/* Which angle companions are drawn at; the hard cases have tests of their own that fix it. */
enum { SAME, OPPOSED, ANYWHERE, CLOSE, ON_FLANK, NEARLY_OPPOSED, NEAR, ANGLES };
static int fixed_angle = ANGLES;

/* An axis at one of the interesting angles from another: 0, pi, any, 1e-7, on the flank of a lobe of that sharpness,
   near pi, near 0. */
static lobe_vec3 companion(lobe_vec3 axis, double sharpness) {
    double angle = test_log_uniform(&test_random, 1e-8, 1);
    int kind = fixed_angle == ANGLES ? pick(ANGLES) : fixed_angle;
    if (kind == SAME || kind == OPPOSED) {
        record_vector(lobe_scale(axis, kind == SAME ? 1 : -1));
        return lobe_scale(axis, kind == SAME ? 1 : -1);
    }
    if (kind == ANYWHERE) return random_axis();
    if (kind == CLOSE) angle = 1e-7;
    if (kind == ON_FLANK) angle = fmin(PI, test_log_uniform(&test_random, 0.1, 20) / sqrt(sharpness + 0.1));
    return nearly_unit(turned(unit(wide(axis)), kind == NEARLY_OPPOSED ? PI - angle : angle));
}

static sg_lobe lobe_of(lobe_vec3 axis, double sharpness, double log_amplitude) {
    sg_lobe g;
    g.axis = axis;
    g.sharpness = (float)sharpness;
    g.log_amplitude = (float)log_amplitude;
    return g;
}

/* Two lobes; in half of the draws the sharpnesses are (nearly) the same, the hard case when opposed. */
static void draw_pair(double low, double high, sg_lobe *a, sg_lobe *b) {
    double la, lb;
    int kind = pick(4);
    begin();
    la = log_uniform(low, high);
    lb = log_uniform(low, high);
    if (kind == 0) lb = record(la);
    if (kind == 1) lb = record((double)(float)fmin(high, la * (1 + test_log_uniform(&test_random, 1e-7, 1))));
    *a = lobe_of(random_axis(), la, 0);
    *b = lobe_of(companion(a->axis, fmin(la, lb)), lb, 0);
}

/* ---- primitives ---- */

static void check_exp2(test_bound *bound, float x) {
    double wanted = fmin(exp2((double)x), 0x1p122);
    begin();
    record((double)x);
    if (x < -126.5f)
        that(lobe_exp2(x) == 0, "2^x is 0 below -126.5");
    else
        within(bound, (double)lobe_exp2(x), wanted, wanted + (x < -126 ? 1e7 * (double)FLT_MIN : 0));
}

static void test_exp2(void) {
    test_bound bound = test_bound_of("sg.h", "lobe_exp2", "rel");
    unsigned bits;
    int i;
    for (bits = 0; bits < 0x7F800000u; bits += 20011) {
        check_exp2(&bound, of_bits(bits));
        check_exp2(&bound, -of_bits(bits));
    }
    check_exp2(&bound, FLT_MAX);
    check_exp2(&bound, -FLT_MAX);
    for (i = -2 * 126; i < 2 * 128; i++) { /* where the integer part changes */
        float edge = 0.5f * (float)i;
        check_exp2(&bound, edge);
        check_exp2(&bound, edge * (1 + FLT_EPSILON));
        check_exp2(&bound, edge * (1 - FLT_EPSILON));
    }
    for (i = 0; i < test_few(100000); i++) check_exp2(&bound, (float)(-127 + 255 * test_uniform(&test_random)));
    test_report(&bound);
}

static void test_phi(void) {
    test_bound bound = test_bound_of("sg.h", "lobe_phi", "rel");
    unsigned bits, step;
    for (bits = 0; bits < 0x7F800000u; bits += step) {
        double x = (double)of_bits(bits), wanted = exact_phi(x);
        step = x > 0.01 && x < 128 ? 509 : 20011;
        begin();
        record(x);
        within(&bound, (double)lobe_phi(of_bits(bits)), wanted, wanted + 1e7 * (double)FLT_MIN);
    }
    begin();
    that(lobe_phi(0) == 1, "phi(0) is 1");
    that(lobe_phi(FLT_MAX) < FLT_MIN, "phi vanishes at infinity");
    test_report(&bound);
}

static void test_log(void) {
    test_bound bound = test_bound_of("sg.h", "lobe_log", "rel");
    test_bound slope = test_bound_of("sg.h", "lobe_log1m_slope", "rel");
    unsigned bits;
    int i;
    for (bits = bits_of(FLT_MIN); bits <= bits_of(FLT_MAX); bits += 10007) {
        double x = (double)of_bits(bits), wanted = log(x);
        begin();
        record(x);
        within(&bound, (double)lobe_log(of_bits(bits)), wanted, fabs(wanted));
    }
    for (i = 0; i < test_few(100000); i++) {
        double x;
        begin();
        x = record((double)(float)(1 + (i % 2 ? 1 : -1) * test_log_uniform(&test_random, 1e-7, 0.5)));
        within(&bound, (double)lobe_log((float)x), log(x), fabs(log(x)));
        x = record((double)(float)(i % 2 ? test_log_uniform(&test_random, 1e-29, 1)
                                         : 1 - test_log_uniform(&test_random, 6e-8, 1)));
        x = fmin(x, 1 - 0x1p-24);
        within(&slope, (double)lobe_log1m_slope((float)x), -log1p(-x) / x, -log1p(-x) / x);
    }
    begin();
    that(lobe_log(1) == 0 && lobe_log1m_slope(0) == 1, "ln 1 is 0 and its slope there 1");
    that(lobe_log(0) == lobe_log(FLT_MIN) && test_is_finite(lobe_log1m_slope(1)), "logarithms of 0 are finite");
    test_report(&bound);
    test_report(&slope);
}

static void test_turn(void) {
    test_bound bound = test_bound_of("sg.h", "lobe_turn", "abs");
    int i;
    volatile float zero = 0;
    for (i = 0; i <= 200000; i++) {
        float v = i <= 64 ? (float)i / 64 : (float)test_uniform(&test_random), c, s;
        begin();
        record((double)v);
        lobe_turn(v, &c, &s);
        within(&bound, (double)c, cos(2 * PI * (double)v), 1);
        within(&bound, (double)s, sin(2 * PI * (double)v), 1);
    }
    { /* outside of [0, 1] as at the nearer end, since it becomes an integer */
        const float outside[] = {-1e30f, -0.3f, 1.2f, 1e30f, 1 / zero, zero / zero, -zero / zero};
        for (i = 0; i < COUNT(outside); i++) {
            float c, s;
            begin();
            record((double)outside[i]);
            lobe_turn(outside[i], &c, &s);
            within(&bound, (double)c, 1, 1);
            within(&bound, (double)s, 0, 1);
        }
    }
    test_report(&bound);
}

static void test_vectors(void) {
    test_bound bound = stated("lobe_normalize_or rel", 3e-7);
    int i;
    for (i = 0; i < 20000; i++) {
        vec v = random_direction();
        double size;
        begin();
        size = log_uniform(1e-15, 5e17);
        within(&bound, distance(wide(lobe_normalize_or(narrow(combine(size, v, 0, v)), lobe_vector(0, 0, 0))), v), 0,
               1);
    }
    that(lobe_normalize_or(lobe_vector(0, 0, 0), lobe_vector(0, 1, 0)).y == 1, "the fallback of a null vector");
    for (i = 0; i < 1000; i++) {
        vec a = random_direction(), b = random_direction(), c = wide(lobe_cross(narrow(a), narrow(b))), wanted;
        begin();
        wanted.x = a.y * b.z - a.z * b.y;
        wanted.y = a.z * b.x - a.x * b.z;
        wanted.z = a.x * b.y - a.y * b.x;
        within(&bound, distance(c, wanted), 0, 1);
    }
    test_report(&bound);
}

/* ---- the references themselves ---- */

typedef struct {
    sg_lobe a, b;
    vec normal;
} integrand;

static double product_of_lobes(const double w[3], const void *context) {
    const integrand *f = (const integrand *)context;
    return exp(exact_log_eval(f->a, vec_of(w)) + exact_log_eval(f->b, vec_of(w)));
}

static double lobe_times_cosine(const double w[3], const void *context) {
    const integrand *f = (const integrand *)context;
    return exp(exact_log_eval(f->a, vec_of(w))) * fmax(0, dot(f->normal, vec_of(w)));
}

static void test_closed_forms(void) {
    test_bound product = stated("closed form of the product integral", 1e-8);
    test_bound cosine = stated("quadrature of the clamped cosine", 5e-5);
    test_bound identity = stated("f(c) - f(-c)", 1e-7);
    int i;
    for (i = 0; i < 60; i++) {
        integrand f;
        exact_product p;
        double axis[3], wanted;
        draw_pair(1e-3, 1e5, &f.a, &f.b);
        p = multiply_lobes(f.a, f.b);
        if (p.log_loss < -80) continue;
        axis[0] = p.axis.x;
        axis[1] = p.axis.y;
        axis[2] = p.axis.z;
        wanted = exp(p.log_loss) * exact_integral(p.sharpness);
        within(&product, reference_sphere(product_of_lobes, &f, axis, p.sharpness), wanted, wanted);
    }
    for (i = 0; i < 3; i++) {
        integrand f;
        double axis[3], l;
        begin();
        l = log_uniform(0.1, 30);
        f.normal = unit(wide(random_axis()));
        f.a = lobe_of(nearly_unit(turned(f.normal, 0.4 + 0.8 * i)), l, 0);
        axis[0] = (double)f.a.axis.x;
        axis[1] = (double)f.a.axis.y;
        axis[2] = (double)f.a.axis.z;
        within(&cosine, exact_cosine(l, dot(f.normal, unit(wide(f.a.axis)))) * exact_integral(l),
               reference_sphere_azimuth(lobe_times_cosine, &f, axis, l, 512), 1);
    }
    for (i = 0; i < 500; i++) {
        double l, c;
        begin();
        l = log_uniform(0.1, 1e6);
        c = uniform(0, 1);
        within(&identity, exact_cosine(l, c) - exact_cosine(l, -c), c * (1 / tanh(l) - 1 / l), 1);
    }
    test_report(&product);
    test_report(&cosine);
    test_report(&identity);
}

/* ---- spherical Gaussians ---- */

static void test_eval(void) {
    test_bound bound = test_bound_of("sg.h", "sg_eval", "conditioned");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        sg_lobe g, dir;
        double ln;
        draw_pair(bound.low, bound.high, &g, &dir);
        g.log_amplitude = i % 2 ? (float)uniform(-20, 20) : 0;
        ln = (double)g.log_amplitude + exact_log_eval(g, unit(wide(dir.axis)));
        within(&bound, (double)sg_eval(g, dir.axis), exp(ln),
               conditioned(1, ln, fabs((double)g.log_amplitude) + fabs(ln - (double)g.log_amplitude)));
    }
    test_report(&bound);
}

static void test_integral(void) {
    test_bound bound = test_bound_of("sg.h", "sg_integral", "rel");
    const volatile unsigned infinity = 0x7F800000u; /* hidden from -ffast-math */
    unsigned bits;
    for (bits = bits_of((float)bound.low); bits <= bits_of((float)bound.high); bits += 16381) {
        double wanted = exact_integral((double)of_bits(bits));
        begin();
        record((double)of_bits(bits));
        within(&bound, (double)sg_integral(of_bits(bits)), wanted, wanted);
    }
    within(&bound, (double)sg_integral(0), 4 * PI, 4 * PI);
    that(sg_integral(FLT_MAX) < 0x1p-122f && sg_integral(of_bits(infinity)) == 0, "no integral at infinity");
    test_report(&bound);
}

static void test_normalize(void) {
    test_bound bound = test_bound_of("sg.h", "sg_normalize", "rel");
    int i;
    for (i = 0; i < test_draws(50000); i++) {
        sg_lobe g, n;
        begin();
        g = lobe_of(random_axis(), log_uniform(bound.low, bound.high), uniform(-50, 50));
        n = sg_normalize(g);
        within(&bound, exp((double)n.log_amplitude) * exact_integral((double)g.sharpness), 1, 1);
        that(!memcmp(&n.axis, &g.axis, sizeof n.axis) && n.sharpness == g.sharpness, "normalising keeps the shape");
    }
    test_report(&bound);
}

/* What share of an SG lies within an angle of t = 1 - cos */
static double exact_share(double sharpness, double t) {
    return sharpness < 1e-12 ? t / 2 : expm1(-sharpness * t) / expm1(-2 * sharpness);
}

static void test_sample(void) {
    test_bound share = test_bound_of("sg.h", "sg_sample", "share");
    test_bound size = test_bound_of("sg.h", "sg_sample", "length");
    sg_lobe g = lobe_of(lobe_vector(0, 0, -1), 1e30, 0);
    int i;
    for (i = 0; i < test_few(100000); i++) {
        vec axis = random_direction(), w;
        double l, u, chord;
        begin();
        l = i % 8 ? log_uniform(share.low, share.high) : record(0);
        u = record((double)(float)(i % 3 ? test_uniform(&test_random) : test_log_uniform(&test_random, 1e-9, 1)));
        if (i % 3 == 2) u = record((double)(1 - (float)u));
        g = lobe_of(narrow(axis), l, uniform(-100, 100));
        w = wide(sg_sample(g, (float)u, (float)uniform(0, 1)));
        chord = distance(unit(w), unit(wide(g.axis)));
        within(&share, exact_share(l, 0.5 * chord * chord), u, TEST_EPSILON * (1 + sqrt(l)));
        within(&size, length(w), 1, 1);
    }
    for (i = 0; i < 20000; i++) { /* u = 1 is the far end, where rounding must not pass it */
        lobe_vec3 w;
        begin();
        g = lobe_of(random_axis(), log_uniform(1e-8, 1e2), 0);
        w = sg_sample(g, 1, (float)uniform(0, 1));
        that(finite_vector(w), "the last sample is finite");
        within(&size, length(wide(w)), length(wide(g.axis)), 1);
    }
    g = lobe_of(lobe_vector(0, 0, -1), 1e30, 0);
    begin();
    that(sg_sample(g, 1, 0.3f).z < -0.999999f && sg_sample(g, 0, 0).z < -0.999999f,
         "an infinitely sharp SG is its axis");
    g.sharpness = 0;
    that(sg_sample(g, 0, 0.7f).z < -0.999999f && sg_sample(g, 1, 0.7f).z > 0.999999f,
         "u = 0 is the axis, u = 1 opposite");
    test_report(&share);
    test_report(&size);
}

/* Independent draws fall as often as they should into 16 x 16 cells of equal share around the axis, and their mean
   direction has the length that it should have. */
static void test_sample_distribution(void) {
    enum { SIDE = 16, DRAWS = SIDE * SIDE * 200 };
    static const double sharpness[] = {0, 1e-8, 0.1, 1, 10, 1e3, 1e6, 1e9};
    int i, k;
    for (k = 0; k < COUNT(sharpness); k++) {
        int cells[SIDE * SIDE] = {0}, cell;
        double l = sharpness[k], d[3], a[3], b[3], chi = 0, sum = 0, squares = 0, mean, deviation;
        lobe_vec3 axis;
        begin();
        record(l);
        axis = random_axis();
        d[0] = unit(wide(axis)).x;
        d[1] = unit(wide(axis)).y;
        d[2] = unit(wide(axis)).z;
        reference_frame(d, a, b);
        for (i = 0; i < DRAWS; i++) {
            float u = (float)test_uniform(&test_random), v = (float)test_uniform(&test_random);
            vec w = unit(wide(sg_sample(lobe_of(axis, l, 3), u, v)));
            double chord = distance(w, unit(wide(axis))), t = 0.5 * chord * chord;
            double turn = atan2(w.x * a[0] + w.y * a[1] + w.z * a[2], w.x * b[0] + w.y * b[1] + w.z * b[2]);
            int row = (int)(SIDE * exact_share(l, t)), column = (int)(SIDE * (turn / (2 * PI) + 0.5));
            cells[(row < SIDE ? row : SIDE - 1) * SIDE + (column < SIDE ? column : SIDE - 1)]++;
            sum += t;
            squares += t * t;
        }
        for (cell = 0; cell < SIDE * SIDE; cell++) {
            double expected = (double)DRAWS / (SIDE * SIDE), excess = cells[cell] - expected;
            chi += excess * excess / expected;
        }
        record(chi);
        that(chi < 367 && chi > 161, "chi-square of 255 degrees of freedom, five deviations up, 1e-6 down");
        mean = sum / DRAWS;
        deviation = sqrt((squares / DRAWS - mean * mean) / DRAWS);
        record(mean);
        that(fabs(1 - mean - (l < 1e-3 ? l / 3 : 1 / tanh(l) - 1 / l)) < 4 * deviation, "mean is coth l - 1 / l");
    }
}

static void test_pdf(void) {
    test_bound bound = test_bound_of("sg.h", "sg_pdf", "conditioned");
    int i;
    for (i = 0; i < test_few(100000); i++) {
        sg_lobe g, dir;
        double ln, peak;
        draw_pair(bound.low, bound.high, &g, &dir);
        g.log_amplitude = (float)uniform(-20, 20);
        ln = exact_log_eval(g, unit(wide(dir.axis)));
        peak = 1 / exact_integral((double)g.sharpness);
        within(&bound, (double)sg_pdf(g, dir.axis), peak * exp(ln), conditioned(peak, ln, -ln));
    }
    test_report(&bound);
}

static void test_product(void) {
    test_bound peak = test_bound_of("sg.h", "sg_product", "conditioned");
    test_bound sharpness = stated("sg_product sharpness, of the sum", 8);
    test_bound axis = stated("sg_product axis, times sharpness over the sum", 8);
    int i;
    for (i = 0; i < test_few(200000); i++) {
        sg_lobe a, b, g;
        exact_product p;
        double ln;
        draw_pair(peak.low, peak.high, &a, &b);
        a.log_amplitude = (float)uniform(-10, 10);
        b.log_amplitude = (float)uniform(-10, 10);
        g = sg_product(a, b);
        p = multiply_lobes(a, b);
        ln = (double)a.log_amplitude + (double)b.log_amplitude + p.log_loss;
        within(&peak, exp((double)g.log_amplitude), exp(ln),
               conditioned(1, ln, fabs((double)a.log_amplitude) + fabs((double)b.log_amplitude) - p.log_loss));
        within(&sharpness, (double)g.sharpness, p.sharpness, p.sum * TEST_EPSILON);
        if (p.sharpness > 1e-5 * p.sum)
            within(&axis, distance(unit(wide(g.axis)), p.axis), 0, p.sum / p.sharpness * TEST_EPSILON);
        if (a.sharpness == b.sharpness && lobe_add(a.axis, b.axis).x == 0 && lobe_add(a.axis, b.axis).y == 0 &&
            lobe_add(a.axis, b.axis).z == 0)
            that(g.sharpness == 0 && !memcmp(&g.axis, &a.axis, sizeof g.axis), "equal lobes opposed");
    }
    test_report(&peak);
    test_report(&sharpness);
    test_report(&axis);
}

/* The values themselves, on the flanks of product lobes that a float axis can still point at. */
static void test_product_values(void) {
    test_bound bound = test_bound_of("sg.h", "sg_product", "conditioned");
    int i;
    for (i = 0; i < test_few(100000); i++) {
        sg_lobe a, b, g;
        vec w;
        double ln, got;
        draw_pair(bound.low, bound.high, &a, &b);
        g = sg_product(a, b);
        w = unit(wide(g.axis));
        if (i % 2) w = turned(w, fmin(PI, test_log_uniform(&test_random, 0.01, 3) / sqrt((double)g.sharpness + 0.1)));
        ln = exact_log_eval(a, w) + exact_log_eval(b, w);
        got = exp((double)g.log_amplitude + exact_log_eval(g, w));
        record_vector(narrow(w));
        within(&bound, got, exp(ln),
               conditioned(1, ln, (double)g.sharpness * (distance(w, unit(wide(g.axis))) + 1e-7) - ln));
    }
    test_report(&bound);
}

static void test_product_integral(void) {
    test_bound exact = test_bound_of("sg.h", "sg_product_integral", "conditioned");
    test_bound approx = test_bound_of("sg.h", "sg_product_integral_approx", "conditioned");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        sg_lobe a, b;
        exact_product p;
        double aligned, chord, loss, amplitude;
        draw_pair(exact.low, exact.high, &a, &b);
        if (i % 2) a.log_amplitude = (float)uniform(-10, 0), b.log_amplitude = (float)uniform(-10, 0);
        amplitude = (double)a.log_amplitude + (double)b.log_amplitude;
        p = multiply_lobes(a, b);
        aligned = exact_integral(p.sharpness);
        within(&exact, (double)sg_product_integral(a, b), aligned * exp(amplitude + p.log_loss),
               conditioned(aligned, amplitude + p.log_loss, -amplitude - p.log_loss));
        chord = distance(unit(wide(a.axis)), unit(wide(b.axis)));
        loss = -0.5 * chord * chord * (double)a.sharpness * ((double)b.sharpness / p.sum);
        aligned = 2 * PI / p.sum;
        within(&approx, (double)sg_product_integral_approx(a, b), aligned * exp(amplitude + loss),
               conditioned(aligned, amplitude + loss, -amplitude - loss));
    }
    test_report(&exact);
    test_report(&approx);
}

/* The hard cases one by one: values, products and integrals of axes at one angle. */
static void test_angle(int angle) {
    fixed_angle = angle;
    test_eval();
    test_product();
    test_product_integral();
    fixed_angle = ANGLES;
}

static void test_identical_axes(void) {
    test_angle(SAME);
}

static void test_close_axes(void) {
    test_angle(CLOSE);
}

static void test_random_axes(void) {
    test_angle(ANYWHERE);
}

static void test_axes_on_the_flank(void) {
    test_angle(ON_FLANK);
}

static void test_antipodal_axes(void) {
    test_angle(OPPOSED);
    test_angle(NEARLY_OPPOSED);
}

/* Aligned lobes up to the sharpness that stays finite, where a product of two sharpnesses would not. */
static void test_aligned(void) {
    test_bound bound = stated("aligned lobes rel", 1e-6);
    int i;
    for (i = 0; i < 20000; i++) {
        sg_lobe a, b, g;
        double sum;
        begin();
        a = lobe_of(random_axis(), log_uniform(1e-25, 1e30), 0);
        b = lobe_of(a.axis, pick(2) ? log_uniform(1e-8, 1e30) : (double)a.sharpness, 0);
        sum = (double)a.sharpness + (double)b.sharpness;
        g = sg_product(a, b);
        that(g.log_amplitude == 0 && sg_eval(a, a.axis) == 1, "aligned lobes lose nothing");
        within(&bound, (double)g.sharpness, sum, sum);
        within(&bound, (double)sg_product_integral(a, b), exact_integral(sum), exact_integral(sum));
        sum = fmax(sum, 1e-8); /* which is what this form counts it as */
        within(&bound, (double)sg_product_integral_approx(a, b), 2 * PI / sum, 2 * PI / sum);
    }
    test_report(&bound);
}

static void test_product_integral_approx_model(void) {
    test_bound bound = test_bound_of("sg.h", "sg_product_integral_approx", "model");
    int i;
    for (i = 0; i < test_few(100000); i++) {
        sg_lobe a, b;
        exact_product p;
        double aligned;
        draw_pair(bound.low, bound.high, &a, &b);
        p = multiply_lobes(a, b);
        aligned = exact_integral(p.sum);
        within(&bound, (double)sg_product_integral_approx(a, b), exp(p.log_loss) * exact_integral(p.sharpness),
               aligned);
    }
    for (i = 0; i < 1000; i++) { /* aligned; the sums where exp(-2 sum) stands clear of rounding */
        sg_lobe a = lobe_of(lobe_vector(0, 0, 1), 0, 0), b = a;
        double sum, error;
        begin();
        sum = log_uniform(0.01, 6);
        a.sharpness = b.sharpness = (float)(sum / 2);
        error = (double)sg_product_integral_approx(a, b) / exact_integral(sum) - 1;
        that(error < 1.00001 / expm1(2 * sum) + 1e-6, "Iwasaki's form for aligned axes");
    }
    test_report(&bound);
}

static void test_convolve(void) {
    test_bound bound = test_bound_of("sg.h", "sg_convolve", "rel");
    test_bound amplitude = stated("sg_convolve amplitude", 4);
    const volatile unsigned infinity = 0x7F800000u; /* hidden from -ffast-math */
    int i;
    for (i = 0; i < 50000; i++) {
        sg_lobe g, h;
        double kappa, factor;
        begin();
        g = lobe_of(random_axis(), log_uniform(bound.low, bound.high), 0);
        kappa = log_uniform(bound.low, bound.high);
        h = sg_convolve(g, (float)kappa);
        factor = 1 / (1 + (double)g.sharpness / kappa);
        within(&bound, (double)h.sharpness, (double)g.sharpness * factor, (double)g.sharpness * factor);
        within(&amplitude, (double)h.log_amplitude, log(factor), TEST_EPSILON * (1 - log(factor)));
        that(!memcmp(&h.axis, &g.axis, sizeof h.axis), "convolving keeps the axis");
        h = sg_convolve(g, of_bits(infinity));
        that(h.sharpness == g.sharpness && h.log_amplitude == g.log_amplitude, "an infinitely sharp kernel");
    }
    test_report(&bound);
    test_report(&amplitude);
}

/* Draws axis and normal at an angle; the error of the accurate form and of the short one. */
static void check_cosine(test_bound *bound, test_bound *approx, double l, double angle) {
    lobe_vec3 normal, axis;
    double exact, scale;
    sg_lobe g;
    float got;
    normal = random_axis();
    axis = nearly_unit(turned(unit(wide(normal)), angle));
    exact = exact_cosine(l, dot(unit(wide(axis)), unit(wide(normal))));
    g = lobe_of(axis, l, uniform(-1, 1));
    scale = exp(-(double)g.log_amplitude) / exact_integral(l);
    got = sg_cosine_integral(g, normal);
    within(bound, (double)got * scale, exact, 1);
    that(got >= 0 && (got > 0 || exact * exact_integral(l) < 1e-25), "a cosine integral is positive");
    got = sg_cosine_integral_approx(g, normal);
    within(approx, (double)got * scale, exact, 1);
    that(got >= 0, "a cosine integral is not negative");
}

static double horizon_angle(double l) { /* where the lobe crosses the horizon */
    return fmin(PI, fmax(0, PI / 2 + uniform(-4, 4) / sqrt(1 + l)));
}

static void test_cosine_integral(void) {
    test_bound bound = test_bound_of("sg.h", "sg_cosine_integral", "abs");
    test_bound wide_lobes = test_bound_of("sg.h", "sg_cosine_integral", "wide");
    test_bound sharp = test_bound_of("sg.h", "sg_cosine_integral", "sharp");
    test_bound approx = test_bound_of("sg.h", "sg_cosine_integral_approx", "abs");
    int i;
    for (i = 0; i < test_few(20000); i++) {
        double l;
        begin();
        l = log_uniform(bound.low, bound.high);
        check_cosine(&bound, &approx, l, i % 2 ? horizon_angle(l) : uniform(0, PI));
        begin();
        l = log_uniform(wide_lobes.low, wide_lobes.high);
        check_cosine(&wide_lobes, &approx, l, uniform(0, PI));
        begin();
        l = log_uniform(sharp.low, sharp.high);
        if (i % 4 == 0) l = record((double)(float)sharp.low); /* the worst is there, at the horizon */
        check_cosine(&sharp, &approx, l, i % 8 == 0 ? PI / 2 : i % 2 ? horizon_angle(l) : uniform(0, PI));
    }
    for (i = 0; i <= 200; i++) {
        double angle;
        begin();
        angle = record(PI * i / 200);
        check_cosine(&wide_lobes, &approx, 0, angle);
        check_cosine(&wide_lobes, &approx, 1e-30, angle);
        check_cosine(&sharp, &approx, 1e10, angle);
    }
    for (i = 0; i < test_draws(20000); i++) { /* beyond the stated range */
        begin();
        check_cosine(i % 2 ? &wide_lobes : &sharp, &approx, i % 2 ? log_uniform(1e-12, 1e-3) : log_uniform(1e6, 1e30),
                     uniform(0, PI));
    }
    for (i = 0; i < 100; i++) {
        float l = (float)test_log_uniform(&test_random, 0.1, 1e10);
        double in = (double)l;
        test_that(lobe_cosine_mean(l, 1.5f) == lobe_cosine_mean(l, 1) &&
                      lobe_cosine_mean(l, -1.5f) == lobe_cosine_mean(l, -1),
                  "a cosine counts as -1 to 1", &in, 1);
        test_that(lobe_cosine_mean_approx(l, -1.5f) == lobe_cosine_mean_approx(l, -1), "a cosine counts as -1 to 1",
                  &in, 1);
    }
    test_report(&bound);
    test_report(&wide_lobes);
    test_report(&sharp);
    test_report(&approx);
}

/* At each sharpness the largest errors over all angles, in floats: ours, and that of Tokuyoshi et al. 2024 */
static void test_cosine_against_tokuyoshi(void) {
    test_bound rel = test_bound_of("sg.h", "sg_cosine_integral", "rel");
    enum { SHARPNESSES = 100, COSINES = 160 };
    int i, k;
    for (i = 0; i <= SHARPNESSES; i++) {
        double l = (double)(float)(rel.low * pow(rel.high / rel.low, (double)i / SHARPNESSES)), ours = 0, theirs = 0;
        for (k = 0; k <= COSINES; k++) {
            double flank = (k - COSINES / 4) * 8.0 / COSINES / sqrt(1 + l),
                   all = (k - COSINES / 2) / (COSINES / 4.0) - 1;
            float c = (float)(k <= COSINES / 2 ? fmax(-1, fmin(1, flank)) : all), got;
            double exact = exact_cosine(l, (double)c);
            begin();
            record(l);
            record((double)c);
            got = lobe_cosine_mean((float)l, c);
            ours = fmax(ours, fabs((double)got - exact));
            theirs = fmax(theirs, fabs((double)tokuyoshi_2024((float)l, c) / exact_integral(l) - exact));
            if (exact > 1e-3) within(&rel, (double)got, exact, exact);
        }
        record(ours);
        record(theirs);
#ifdef __FAST_MATH__
        theirs += 0x1p-24; /* another order of additions */
#endif
        that(ours <= theirs, "as accurate as Tokuyoshi et al. 2024");
    }
    test_report(&rel);
}

static void test_toksvig(void) {
    test_bound mean = test_bound_of("sg.h", "sg_mean_length", "ulp");
    test_bound model = test_bound_of("sg.h", "sg_mean_length", "model");
    test_bound inverse = test_bound_of("sg.h", "sg_sharpness_from_mean_length", "ulp");
    test_bound round_trip = test_bound_of("sg.h", "sg_sharpness_from_mean_length", "round_trip");
    int i;
    for (i = 0; i < test_draws(50000); i++) {
        double l, wanted, r;
        begin();
        l = log_uniform(mean.low, mean.high);
        wanted = l / (l + 1);
        within(&mean, (double)sg_mean_length((float)l), wanted, test_ulp(wanted));
        l = log_uniform(model.low, model.high);
        wanted = l < 0.01 ? l / 3 - l * l * l / 45 : 1 / tanh(l) - 1 / l;
        within(&model, (double)sg_mean_length((float)l), wanted, 1);
        that(l < 10 || fabs((double)sg_mean_length((float)l) - wanted) < 1 / (l * l) + 1e-7, "below 1 / l^2");
        r = i % 2 ? log_uniform(inverse.low, inverse.high) : record((double)(1 - (float)log_uniform(6e-8, 1)));
        if (r < 1)
            within(&inverse, (double)sg_sharpness_from_mean_length((float)r), r / (1 - r), test_ulp(r / (1 - r)));
        l = log_uniform(1e-20, 1e5);
        within(&round_trip, (double)sg_sharpness_from_mean_length(sg_mean_length((float)l)), l, l * (l + 2));
    }
    that(sg_sharpness_from_mean_length(1) == 0x1p25f && sg_sharpness_from_mean_length(0) == 0, "Toksvig's ends");
    that(sg_sharpness_from_mean_length(1.0001f) == 0x1p25f, "a mean length that rounding made too long");
    test_report(&mean);
    test_report(&model);
    test_report(&inverse);
    test_report(&round_trip);
}

/* ---- reflection lobes ---- */

static void test_diffuse_lobe(void) {
    test_bound rel = test_bound_of("sg.h", "sg_diffuse_lobe", "rel");
    test_bound model = test_bound_of("sg.h", "sg_diffuse_lobe", "model");
    sg_lobe g = sg_diffuse_lobe(lobe_vector(0, 0, 1));
    int i;
    begin();
    that(g.sharpness == 2 && g.axis.z == 1, "the diffuse lobe has sharpness 2 around the normal");
    within(&rel, exp((double)g.log_amplitude) * exact_integral(2), 1, 1);
    for (i = 0; i <= 1000; i++) {
        double theta = PI * i / 1000;
        begin();
        record(theta);
        within(&model, (double)sg_eval(g, lobe_vector((float)sin(theta), 0, (float)cos(theta))),
               fmax(0, cos(theta)) / PI, 1);
    }
    test_report(&rel);
    test_report(&model);
}

static void test_reflection_lobe(void) {
    test_bound bound = test_bound_of("sg.h", "sg_reflection_lobe", "ulp");
    test_bound mirror = stated("sg_reflection_lobe axis", 8);
    int i;
    for (i = 0; i < test_few(110000); i++) {
        lobe_vec3 normal, wi;
        vec n, w;
        double cosine, half, wanted;
        sg_lobe g, ggx;
        begin();
        normal = random_axis();
        wi = i % 2 ? random_axis() : nearly_unit(turned(unit(wide(normal)), PI / 2 + uniform(-0.1, 0.1)));
        half = log_uniform(1e-3, 1e8);
        n = unit(wide(normal));
        w = unit(wide(wi));
        cosine = dot(n, w);
        wanted = half / (4 * fmax(fabs(cosine), 1e-4));
        g = sg_reflection_lobe(normal, wi, (float)half);
        within(&bound, (double)g.sharpness, wanted, test_ulp(wanted) / fmax(fabs(cosine), 1e-4));
        within(&mirror, distance(wide(g.axis), combine(2 * cosine, n, -1, w)), 0, TEST_EPSILON);
        that(g.log_amplitude == 0, "a reflection lobe's peak is 1");
        g = sg_phong_lobe(normal, wi, (float)half);
        within(&bound, (double)g.sharpness, wanted, test_ulp(wanted) / fmax(fabs(cosine), 1e-4));
        half = log_uniform(1e-4, 1);
        wanted = 2 / (half * half) / (4 * fmax(fabs(cosine), 1e-4));
        ggx = sg_ggx_lobe(normal, wi, (float)half);
        within(&bound, (double)ggx.sharpness, wanted, test_ulp(wanted) / fmax(fabs(cosine), 1e-4));
        g = sg_beckmann_lobe(normal, wi, (float)half);
        within(&bound, (double)g.sharpness, wanted, test_ulp(wanted) / fmax(fabs(cosine), 1e-4));
    }
    {
        lobe_vec3 z = lobe_vector(0, 0, 1), x = lobe_vector(1, 0, 0);
        sg_lobe g = sg_ggx_lobe(z, x, 0.5f), sharp = sg_ggx_lobe(z, z, 0);
        begin();
        that(g.axis.x == -1 && g.sharpness == 8 / 4e-4f, "grazing light goes straight on");
        that(fabsf(sharp.sharpness - 5e7f) < 50 && sharp.axis.z == 1, "alpha is clamped to 1e-4");
    }
    test_report(&bound);
    test_report(&mirror);
}

/* ---- virtual spherical Gaussian lights ---- */

typedef struct {
    lobe_vec3 offset, normal, wi, power[2];
    float alpha;
} vpl;

static vpl draw_vpl(double extent) {
    vpl p;
    int k;
    vec offset = random_direction();
    p.offset = narrow(combine(log_uniform(1e-3, 1) * extent, offset, 0, offset));
    record_vector(p.offset);
    p.normal = random_axis();
    p.wi = nearly_unit(turned(unit(wide(p.normal)), uniform(0, 1.2)));
    for (k = 0; k < 2; k++) {
        p.power[k] = lobe_vector((float)log_uniform(1e-3, 1e3), (float)log_uniform(1e-3, 1e3), 1);
    }
    p.alpha = (float)log_uniform(1e-3, 1);
    return p;
}

static vsgl_moments moments_of(vpl p) {
    return vsgl_moments_from_vpl(p.offset, p.normal, p.wi, p.power[VSGL_DIFFUSE], p.power[VSGL_SPECULAR], p.alpha);
}

static double exact_mean(lobe_vec3 colour) {
    return ((double)colour.x + (double)colour.y + (double)colour.z) / 3;
}

/* The emission of a VPL: axis, sharpness. */
static vec exact_emission(vpl p, int k, double *sharpness) {
    vec n = unit(wide(p.normal)), w = unit(wide(p.wi));
    double cosine = dot(n, w);
    *sharpness = k == VSGL_DIFFUSE ? 2 : 0.5 / ((double)p.alpha * (double)p.alpha * fabs(cosine));
    return k == VSGL_DIFFUSE ? n : combine(2 * cosine, n, -1, w);
}

static void test_moments(void) {
    enum { MOMENTS = sizeof(vsgl_moments) / sizeof(float) };
    test_bound bound = test_bound_of("sg.h", "vsgl_moments_from_vpl", "ulp");
    test_bound add = test_bound_of("sg.h", "vsgl_moments_add", "rel");
    test_bound scale = test_bound_of("sg.h", "vsgl_moments_scale", "rel");
    int i, k;
    for (i = 0; i < test_draws(20000); i++) {
        vpl p;
        vsgl_moments m, n, sum, scaled;
        double weight, squared, s;
        float a[MOMENTS], b[MOMENTS], c[MOMENTS], d[MOMENTS];
        begin();
        p = draw_vpl(100);
        m = moments_of(p);
        weight = exact_mean(p.power[0]) + exact_mean(p.power[1]);
        squared = weight * dot(wide(p.offset), wide(p.offset));
        for (k = 0; k < 2; k++) {
            double l, w = exact_mean(p.power[k]);
            vec axis = exact_emission(p, k, &l);
            w *= l / (l + 1);
            that(!memcmp(&m.power[k], &p.power[k], sizeof p.power[k]), "a VPL's power");
            within(&bound, distance(wide(m.direction[k]), combine(w, axis, 0, axis)), 0, w * 2 * TEST_EPSILON);
        }
        within(&bound, distance(wide(m.position), combine(weight, wide(p.offset), 0, wide(p.offset))), 0,
               weight * length(wide(p.offset)) * 2 * TEST_EPSILON);
        within(&bound, (double)m.position_squared, squared, test_ulp(squared));

        n = moments_of(draw_vpl(100));
        s = uniform(0, 2);
        sum = vsgl_moments_add(m, n);
        scaled = vsgl_moments_scale(m, (float)s);
        memcpy(a, &m, sizeof m);
        memcpy(b, &n, sizeof n);
        memcpy(c, &sum, sizeof sum);
        memcpy(d, &scaled, sizeof scaled);
        for (k = 0; k < MOMENTS; k++) {
            double wanted = (double)a[k] + (double)b[k];
            within(&add, (double)c[k], wanted, fabs(wanted));
            wanted = (double)a[k] * (double)(float)s;
            within(&scale, (double)d[k], wanted, fabs(wanted));
        }
    }
    test_report(&add);
    test_report(&scale);
    test_report(&bound);
}

/* The light of moments against the same sums' formulas in double. */
static void check_variance(test_bound *bound, vsgl_moments m, lobe_vec3 origin) {
    vsgl v = vsgl_from_moments(m, origin);
    double weight = exact_mean(m.power[0]) + exact_mean(m.power[1]);
    vec mean = combine(1 / weight, wide(m.position), 0, wide(m.position));
    double mean_squared = dot(mean, mean), variance = (double)m.position_squared / weight - mean_squared;
    that(v.variance >= 0, "a variance is never negative");
    within(bound, (double)v.variance, fmax(0, variance), mean_squared + fmax(0, variance));
    that(distance(wide(v.position), combine(1, mean, 1, wide(origin))) <=
             8 * TEST_EPSILON * (length(mean) + length(wide(origin))),
         "the mean position");
}

static void test_vsgl_of_one_vpl(void) {
    test_bound variance = test_bound_of("sg.h", "vsgl_from_moments", "variance");
    test_bound of_vpl = stated("variance of one VPL, of |offset|^2", 0x1p-20);
    test_bound sharpness = test_bound_of("sg.h", "vsgl_from_moments", "sharpness");
    test_bound power = stated("power of one VPL rel", 1e-6);
    int i, k;
    for (i = 0; i < 50000; i++) {
        lobe_vec3 origin;
        vpl p;
        vsgl v;
        begin();
        origin = narrow(combine(log_uniform(1e-3, 1e4), random_direction(), 0, random_direction()));
        record_vector(origin);
        p = draw_vpl(100);
        check_variance(&variance, moments_of(p), origin);
        v = vsgl_from_moments(moments_of(p), origin);
        within(&of_vpl, (double)v.variance, 0, dot(wide(p.offset), wide(p.offset)));
        for (k = 0; k < 2; k++) {
            double l, total = exact_mean(v.intensity[k]) * exact_integral((double)v.emission[k].sharpness);
            vec axis = exact_emission(p, k, &l);
            that(distance(wide(v.emission[k].axis), axis) < 12 * TEST_EPSILON, "the axis of one VPL");
            if (l < 1e5) within(&sharpness, (double)v.emission[k].sharpness, l, l * (l + 4));
            that(v.emission[k].sharpness <= 0x1p25f, "sharpness saturates at 2^25");
            that(v.emission[k].log_amplitude == 0, "the peak is 1");
            within(&power, total, exact_mean(p.power[k]), exact_mean(p.power[k]));
        }
    }
    test_report(&variance);
    test_report(&of_vpl);
    test_report(&sharpness);
    test_report(&power);
}

/* A disc of radius 1 whose centre lies at some distance from the sums' origin, summed as a mipmap does. */
static void test_vsgl_of_a_disc(void) {
    enum { LEVELS = 10, VPLS = 1 << LEVELS };
    static const double distances[] = {0, 1, 10, 100};
    static vsgl_moments sums[VPLS];
    test_bound bound = test_bound_of("sg.h", "vsgl_from_moments", "variance");
    test_bound disc = stated("variance of a disc, of |mean|^2 + variance", (2 + 0.5 * LEVELS) * 0x1p-22);
    test_bound toksvig = stated("sharpness of a disc rel", 2e-5);
    test_bound aim = stated("axis of a disc, over its mean length", 2e-6);
    int trial, i, k, n;
    for (trial = 0; trial < 20; trial++) {
        lobe_vec3 origin = lobe_vector(1000, -2000, 500);
        vec centre, normal = random_direction(), mean = {0, 0, 0}, direction[2] = {{0, 0, 0}, {0, 0, 0}};
        double weights = 0, powers[2] = {0, 0}, squares = 0, variance;
        vsgl v;
        begin();
        centre = random_direction();
        centre = combine(record(distances[trial % COUNT(distances)]), centre, 0, centre);
        for (i = 0; i < VPLS; i++) {
            vec offset = combine(1, centre, sqrt(test_uniform(&test_random)), turned(normal, PI / 2));
            vpl p;
            double w;
            inputs = 1;
            p = draw_vpl(1);
            p.offset = narrow(offset);
            p.normal = nearly_unit(turned(normal, 0.5 * test_uniform(&test_random)));
            w = exact_mean(p.power[0]) + exact_mean(p.power[1]);
            weights += w;
            mean = combine(1, mean, w, wide(p.offset));
            squares += w * dot(wide(p.offset), wide(p.offset));
            for (k = 0; k < 2; k++) {
                double l, power = exact_mean(p.power[k]);
                vec axis = exact_emission(p, k, &l);
                powers[k] += power;
                direction[k] = combine(1, direction[k], power * l / (l + 1), axis);
            }
            sums[i] = moments_of(p);
        }
        for (n = VPLS / 2; n; n /= 2) {
            for (i = 0; i < n; i++) sums[i] = vsgl_moments_scale(vsgl_moments_add(sums[i], sums[i + n]), 0.5f);
        }
        mean = combine(1 / weights, mean, 0, mean);
        variance = squares / weights - dot(mean, mean);
        check_variance(&bound, sums[0], origin);
        v = vsgl_from_moments(sums[0], origin);
        within(&disc, (double)v.variance, variance, dot(mean, mean) + variance);
        for (k = 0; k < 2; k++) {
            double r = length(direction[k]) / powers[k];
            within(&toksvig, (double)v.emission[k].sharpness, r / (1 - r), r / (1 - r));
            within(&toksvig, exact_mean(v.intensity[k]) * exact_integral((double)v.emission[k].sharpness) * VPLS,
                   powers[k], powers[k]);
            within(&aim, distance(wide(v.emission[k].axis), unit(direction[k])), 0, 1 / r);
        }
    }
    test_report(&bound);
    test_report(&disc);
    test_report(&toksvig);
    test_report(&aim);
}

static void test_vsgl_without_power(void) {
    vsgl_moments m;
    vsgl v;
    int k;
    memset(&m, 0, sizeof m);
    v = vsgl_from_moments(m, lobe_vector(1, 2, 3));
    begin();
    that(v.position.x == 1 && v.position.y == 2 && v.position.z == 3 && v.variance == 0, "no power: at the origin");
    for (k = 0; k < 2; k++) {
        that(v.intensity[k].x == 0 && v.intensity[k].y == 0 && v.intensity[k].z == 0, "no power: no intensity");
        that(finite_lobe(v.emission[k]) && fabs(length(wide(v.emission[k].axis)) - 1) < 1e-6, "no power: an axis");
    }
}

/* ---- clusters that merge ---- */

static vsgl_cluster cluster_of(vpl p, lobe_vec3 position) {
    return vsgl_cluster_from_vpl(position, p.normal, p.wi, p.power[0], p.power[1], p.alpha);
}

static vpl draw_vpl_of(lobe_vec3 normal, double alpha) {
    vpl p = draw_vpl(1);
    p.normal = normal;
    p.wi = nearly_unit(turned(unit(wide(normal)), uniform(0, 1)));
    p.alpha = (float)alpha;
    return p;
}

static void test_cluster_of_one_vpl(void) {
    test_bound sharpness = test_bound_of("sg.h", "vsgl_cluster_from_vpl", "sharpness");
    test_bound ulp = test_bound_of("sg.h", "vsgl_from_cluster", "ulp");
    test_bound point_light = stated("one VPL against the point light", 1e-6 / TEST_EPSILON);
    int i, k;
    for (i = 0; i < test_few(100000); i++) {
        lobe_vec3 position, target, normal;
        vsgl v;
        vpl p;
        begin();
        position = narrow(combine(log_uniform(1e-3, 1e5), random_direction(), 0, random_direction()));
        record_vector(position);
        p = draw_vpl_of(random_axis(), log_uniform(1e-4, 1));
        if (i % 2) p.wi = nearly_unit(turned(unit(wide(p.normal)), PI / 2 - log_uniform(1e-4, 1))); /* sharper still */
        v = vsgl_from_cluster(cluster_of(p, position));
        that(v.variance == 0 && !memcmp(&v.position, &position, sizeof position), "one VPL has no extent");
        target = narrow(combine(1, wide(position), log_uniform(1e-2, 1e3), unit(random_direction())));
        normal = random_axis();
        for (k = 0; k < 2; k++) {
            sg_lobe lobe = k ? sg_ggx_lobe(p.normal, p.wi, p.alpha) : sg_diffuse_lobe(p.normal);
            double l = (double)lobe.sharpness, power = exact_mean(p.power[k]), chord, log_value, cosine, aligned, r;
            vec away = combine(1, wide(target), -1, wide(position));
            that(!memcmp(&v.emission[k].axis, &lobe.axis, sizeof lobe.axis), "the axis of one VPL");
            that(v.emission[k].log_amplitude == 0, "the peak is 1");
            if (l >= sharpness.low && l <= sharpness.high) within(&sharpness, (double)v.emission[k].sharpness, l, l);
            within(&ulp, exact_mean(v.intensity[k]), power / exact_integral(l), test_ulp(power / exact_integral(l)));
            /* the point light: exp(-l chord^2 / 2) cos / (pi d^2); where the direction in floats tells its value */
            r = length(away);
            chord = distance(combine(1 / r, away, 0, away), unit(wide(lobe.axis)));
            log_value = -0.5 * l * chord * chord;
            cosine = -dot(away, unit(wide(normal))) / r;
            aligned = 1 / (PI * r * r);
            within(&point_light, (double)vsgl_diffuse(v, k, target, normal), aligned * exp(log_value) * fmax(0, cosine),
                   conditioned(aligned, log_value, l * chord - log_value));
        }
    }
    test_report(&sharpness);
    test_report(&ulp);
    test_report(&point_light);
}

/* Patches of VPLs anywhere in a scene of 1e4 units, of lobes as sharp as can be, merged as a tree and one by one. */
/* The figures that a cluster holds, see the struct: weight times mean length, and what that is short of the weight; and
   the sharpness of lights whose weight is all but nothing. */
static void test_cluster_figures(void) {
    test_bound figure = stated("weights of mean lengths", 1e-6);
    test_bound sharpness = test_bound_of("sg.h", "vsgl_cluster_from_vpl", "sharpness");
    int i, k;
    for (i = 0; i < 20000; i++) {
        vpl p;
        vsgl_cluster c;
        vsgl v;
        begin();
        p = draw_vpl_of(random_axis(), log_uniform(1e-4, 1));
        for (k = 0; k < 2; k++) {
            float weak = (float)record(log_uniform(1e-25, 1e15));
            p.power[k] =
                lobe_scale(lobe_vector((float)log_uniform(0.1, 1), (float)uniform(0, 1), (float)uniform(0, 1)), weak);
            record_vector(p.power[k]);
        }
        c = cluster_of(p, lobe_vector(0, 0, 0));
        v = vsgl_from_cluster(c);
        for (k = 0; k < 2; k++) {
            sg_lobe lobe = k ? sg_ggx_lobe(p.normal, p.wi, p.alpha) : sg_diffuse_lobe(p.normal);
            double l = (double)lobe.sharpness, weight = exact_mean(p.power[k]);
            within(&figure, (double)c.direction[k].sharpness, weight * l / (l + 1), weight);
            within(&figure, (double)c.direction[k].log_amplitude, -weight / (l + 1), weight / (l + 1));
            if (l <= sharpness.high) within(&sharpness, (double)v.emission[k].sharpness, l, l);
        }
    }
}

static void test_cluster_merge(void) {
    enum { LEVELS = 12, VPLS = 1 << LEVELS };
    static vsgl_cluster leaf[VPLS];
    test_bound variance = test_bound_of("sg.h", "vsgl_cluster_merge", "variance");
    test_bound mean = test_bound_of("sg.h", "vsgl_cluster_merge", "mean");
    test_bound sharpness = test_bound_of("sg.h", "vsgl_cluster_merge", "sharpness");
    test_bound chained = test_bound_of("sg.h", "vsgl_cluster_merge", "chained");
    int trial, i, k, n;
    for (trial = 0; trial < 40; trial++) {
        int chain = trial % 4 == 3; /* each VPL added to the sum of those before it */
        vec where = random_direction(), facing = random_direction(), centre = {0, 0, 0}, direction[2];
        double radius, alpha, weight = 0, spread = 0, deficit[2] = {0, 0}, cone;
        lobe_vec3 first = {0, 0, 0}, mean_of_cluster;
        vsgl_cluster sum;
        vsgl v;
        begin();
        where = combine(trial % 2 ? 1e4 : 1, where, 0, where);
        radius = log_uniform(variance.low, variance.high);
        alpha = log_uniform(1e-4, 1);
        cone = log_uniform(1e-6, 1);
        memset(direction, 0, sizeof direction);
        for (i = 0; i < VPLS; i++) {
            lobe_vec3 position =
                narrow(combine(1, where, radius * sqrt(test_uniform(&test_random)), turned(facing, PI / 2)));
            vpl p;
            double w;
            inputs = 3;
            p = draw_vpl_of(nearly_unit(turned(facing, cone * test_uniform(&test_random))), alpha);
            if (i == 0) first = position;
            leaf[i] = cluster_of(p, position);
            w = exact_mean(p.power[0]) + exact_mean(p.power[1]);
            weight += w;
            centre = combine(1, centre, w, combine(1, wide(position), -1, wide(first)));
            spread += w * dot(combine(1, wide(position), -1, wide(first)), combine(1, wide(position), -1, wide(first)));
        }
        centre = combine(1 / weight, centre, 0, centre);
        spread = spread / weight - dot(centre, centre);
        /* mean directions: the sum's length, and what it is short of the weights, that by differences of directions */
        for (k = 0; k < 2; k++) {
            for (i = 0; i < VPLS; i++) {
                sg_lobe lobe = leaf[i].direction[k];
                direction[k] = combine(1, direction[k], (double)lobe.sharpness, unit(wide(lobe.axis)));
            }
            for (i = 0; i < VPLS; i++) {
                sg_lobe lobe = leaf[i].direction[k];
                double chord = distance(unit(wide(lobe.axis)), unit(direction[k]));
                deficit[k] += 0.5 * (double)lobe.sharpness * chord * chord - (double)lobe.log_amplitude;
            }
        }
        if (chain) {
            for (sum = leaf[0], i = 1; i < VPLS; i++) sum = vsgl_cluster_merge(sum, leaf[i]);
        } else {
            for (n = VPLS / 2; n; n /= 2)
                for (i = 0; i < n; i++) leaf[i] = vsgl_cluster_merge(leaf[i], leaf[i + n]);
            sum = leaf[0];
        }
        v = vsgl_from_cluster(sum);
        that(v.variance >= 0, "a variance is never negative");
        within(&variance, (double)v.variance, spread, spread);
        mean_of_cluster = sum.offset;
        within(&mean,
               distance(combine(1, wide(mean_of_cluster), 1, combine(1, wide(sum.origin), -1, wide(first))), centre), 0,
               radius);
        for (k = 0; k < 2; k++) {
            double l = length(direction[k]) / deficit[k];
            within(chain ? &chained : &sharpness, (double)v.emission[k].sharpness, l, l);
        }
    }
    test_report(&variance);
    test_report(&mean);
    test_report(&sharpness);
    test_report(&chained);
}

static void test_cluster_against_moments(void) {
    test_bound bound = stated("clusters and moments", 1e-5);
    int i, k;
    for (i = 0; i < 20000; i++) {
        vsgl_cluster sum, none;
        vsgl_moments moments;
        vsgl a, b;
        vpl p;
        begin();
        p = draw_vpl(10);
        sum = cluster_of(p, p.offset);
        moments = moments_of(p);
        for (k = 0; k < 3; k++) {
            p = draw_vpl_of(random_axis(), 0.3);
            sum = vsgl_cluster_merge(sum, cluster_of(p, p.offset));
            moments = vsgl_moments_add(moments, moments_of(p));
        }
        a = vsgl_from_cluster(sum);
        b = vsgl_from_moments(moments, lobe_vector(0, 0, 0));
        within(&bound, distance(wide(a.position), wide(b.position)), 0, 10);
        within(&bound, (double)a.variance, (double)b.variance, 100);
        for (k = 0; k < 2; k++) {
            double l = (double)b.emission[k].sharpness;
            within(&bound, distance(wide(a.emission[k].axis), wide(b.emission[k].axis)), 0, 1 + 1 / l);
            within(&bound, (double)a.emission[k].sharpness, l, (1 + l) * (1 + l));
            within(&bound, exact_mean(a.intensity[k]) / exact_mean(b.intensity[k]), 1, 1 + l);
        }
        /* nothing merged with it, on either side, leaves a cluster as it is */
        memset(&none, 0, sizeof none);
        none.direction[0].axis = none.direction[1].axis = lobe_vector(0, 0, 1);
        for (k = 0; k < 2; k++) {
            b = vsgl_from_cluster(k ? vsgl_cluster_merge(sum, none) : vsgl_cluster_merge(none, sum));
            within(&bound, distance(wide(a.position), wide(b.position)), 0, 1);
            within(&bound, (double)b.variance, (double)a.variance, (double)a.variance);
        }
    }
    test_report(&bound);
}

static void test_vsl(void) {
    test_bound conditioned_bound = test_bound_of("sg.h", "vsl_lobe", "conditioned");
    test_bound rel = test_bound_of("sg.h", "vsl_lobe", "rel");
    test_bound solid_angle = test_bound_of("sg.h", "vsl_lobe", "solid_angle");
    test_bound cosine = test_bound_of("sg.h", "vsl_lobe", "cosine");
    int i;
    for (i = 0; i < test_draws(50000); i++) {
        lobe_vec3 center, point;
        double radius, d, s, c, l, cone;
        sg_lobe g;
        vec offset;
        begin();
        d = log_uniform(1e-3, 1e4);
        s = i % 4 ? log_uniform(conditioned_bound.low, conditioned_bound.high) : uniform(0.9, 2);
        radius = (double)(float)(d * s);
        center = narrow(combine(d, random_direction(), 0, random_direction()));
        point = lobe_vector(0, 0, 0);
        record_vector(center);
        record(radius);
        offset = wide(center);
        g = vsl_lobe(center, (float)radius, point);
        s = fmin(1, radius / length(offset));
        c = sqrt((1 - s) * (1 + s));
        l = 2 * (1 + c) / (s * s);
        within(&rel, (double)g.sharpness, l, l);
        within(&conditioned_bound, (double)g.sharpness, l, l * TEST_EPSILON * (1 + fmin(1 / fmax(c, 1e-9), 4096)));
        that(distance(wide(g.axis), unit(offset)) < 3e-7 && g.log_amplitude == 0, "towards the center, of peak 1");
        cone = 4 * PI / l;
        within(&solid_angle, 2 * exact_integral((double)g.sharpness), cone, cone);
        within(&cosine, 1 / tanh(l) - 1 / l, 0.5 * (1 + c), 1);
    }
    begin();
    that(vsl_lobe(lobe_vector(1, 0, 0), 0, lobe_vector(0, 0, 0)).sharpness >= 0.99e18f, "a point is infinitely sharp");
    that(vsl_lobe(lobe_vector(1, 0, 0), 1, lobe_vector(1, 0, 0)).sharpness == 2, "the center sees half the sphere");
    that(vsl_lobe(lobe_vector(1, 0, 0), 1, lobe_vector(1, 0, 0)).axis.z == 1 &&
             vsl_lobe(lobe_vector(1, 0, 0), 1, lobe_vector(1, 0, 0)).axis.x == 0,
         "and looks along z");
    test_report(&conditioned_bound);
    test_report(&rel);
    test_report(&solid_angle);
    test_report(&cosine);
}

/* ---- the light at a point ---- */

typedef struct {
    vsgl light;
    int component; /* the other one is nonsense */
    lobe_vec3 point, normal;
} lit_point;

static lit_point draw_lit_point(void) {
    lit_point s;
    double l, away;
    lobe_vec3 to_light;
    memset(&s, 0, sizeof s);
    begin();
    s.component = pick(2) ? VSGL_SPECULAR : VSGL_DIFFUSE;
    l = pick(8) ? log_uniform(1e-3, 3e7) : record(0);
    away = pick(16) ? log_uniform(1e-3, 1e4) : record(0);
    s.light.variance = (float)(pick(4) ? log_uniform(1e-12, 1e4) : record(0));
    if (pick(4) == 0) s.light.variance = (float)record((double)(float)(away * away / (l + 1e-9))); /* as sharp */
    s.light.position = narrow(combine(pick(2) * 100, random_direction(), 0, random_direction()));
    to_light = random_axis();
    s.point = narrow(combine(1, wide(s.light.position), -away, wide(to_light)));
    s.light.emission[s.component] = lobe_of(companion(to_light, l), l, 0);
    s.light.emission[!s.component] = lobe_of(lobe_vector(0, 0, 1), 1e6, 0);
    s.normal = pick(2) ? companion(to_light, 1) : random_axis();
    record_vector(s.light.position);
    record_vector(s.point);
    return s;
}

typedef struct {
    exact_product lobe;
    double aligned; /* integral of the incoming radiance per unit of intensity, but for exp(log_loss) */
    double size;    /* of the terms that lose digits, for conditioned() */
} incoming;

/* Eq. 7, and the point light that it becomes for no variance. */
static incoming exact_incoming(lit_point s) {
    incoming in;
    vec offset = combine(1, wide(s.light.position), -1, wide(s.point));
    vec back = unit(combine(-1, wide(s.light.emission[s.component].axis), 0, offset));
    double squared = dot(offset, offset), variance = (double)s.light.variance;
    double l = (double)s.light.emission[s.component].sharpness, chord;
    vec to_light = squared > 0 ? unit(offset) : back;
    chord = distance(to_light, back);
    if (variance > 0) {
        in.lobe = multiply(squared / variance, to_light, l, back);
        in.aligned = exact_integral(in.lobe.sharpness) / (2 * PI * variance);
    } else {
        in.lobe = multiply(1, to_light, 0, back);
        in.lobe.log_loss = -0.5 * l * chord * chord;
        in.aligned = 1 / squared;
    }
    in.size = l * chord - in.lobe.log_loss;
    return in;
}

static int is_singular(lit_point s) { /* a point light, at the point */
    return s.light.variance == 0 && distance(wide(s.light.position), wide(s.point)) == 0;
}

static void test_incoming_lobe(void) {
    test_bound bound = test_bound_of("sg.h", "vsgl_incoming_lobe", "conditioned");
    test_bound naive = stated("Eq. 7 as printed, in long double", 1e-9);
    int i;
    for (i = 0; i < test_few(200000); i++) {
        lit_point s = draw_lit_point();
        sg_lobe g = vsgl_incoming_lobe(s.light, s.component, s.point);
        incoming in = exact_incoming(s);
        double got = exp((double)g.log_amplitude) * exact_integral((double)g.sharpness);
        double wanted = in.aligned * exp(in.lobe.log_loss);
        that(finite_lobe(g), "an incoming lobe is finite");
        if (is_singular(s)) continue;
        within(&bound, got, wanted, conditioned(in.aligned, in.lobe.log_loss, in.size));
        if (in.lobe.sharpness > 1e-3 * in.lobe.sum)
            that(distance(unit(wide(g.axis)), in.lobe.axis) < 1e-6 * in.lobe.sum / in.lobe.sharpness,
                 "the axis of an incoming lobe");
        if (s.light.variance > 0 && in.lobe.sum < 1e4 && in.lobe.sharpness > 1e-2) {
            long double variance = (long double)s.light.variance, lambda = (long double)in.lobe.sharpness;
            long double c = expl(lambda - (long double)in.lobe.sum) / (2 * (long double)PI * variance);
            long double whole = c * 2 * (long double)PI / lambda * (1 - expl(-2 * lambda));
            within(&naive, wanted, (double)whole, (double)whole + 1e-100);
        }
    }
    test_report(&bound);
    test_report(&naive);
}

static void test_vsgl_diffuse(void) {
    test_bound bound = test_bound_of("sg.h", "vsgl_diffuse", "conditioned");
    test_bound integral = test_bound_of("sg.h", "vsgl_diffuse_integral", "conditioned");
    test_bound cosine_model = test_bound_of("sg.h", "sg_cosine_integral", "abs");
    int i;
    for (i = 0; i < test_draws(200000); i++) {
        lit_point s = draw_lit_point();
        incoming in = exact_incoming(s);
        double got = (double)vsgl_diffuse(s.light, s.component, s.point, s.normal);
        double overhead = in.aligned * exp(in.lobe.log_loss) / PI, cosine = dot(in.lobe.axis, unit(wide(s.normal)));
        double unit_of_error = conditioned(in.aligned / PI, in.lobe.log_loss, in.size);
        if (is_singular(s)) continue;
        if (in.lobe.sharpness > 0) unit_of_error *= in.lobe.sum / in.lobe.sharpness; /* how uncertain the axis is */
        within(&bound, got, overhead * fmax(0, cosine), unit_of_error);
        if (i % 8 == 0 || test_least) {
            double wanted =
                overhead * (s.light.variance > 0 ? exact_cosine(in.lobe.sharpness, cosine) : fmax(0, cosine));
            got = (double)vsgl_diffuse_integral(s.light, s.component, s.point, s.normal);
            within(&integral, fmax(0, fabs(got - wanted) - cosine_model.limit * overhead), 0, unit_of_error);
        }
        if (i % 16 == 0 && s.light.variance > 0 && in.lobe.sharpness < 1e10)
            that(got <= 4 * overhead * exact_cosine(in.lobe.sharpness, cosine) + bound.limit * unit_of_error,
                 "a constant cosine is at most 4 times too bright");
    }
    test_report(&bound);
    test_report(&integral);
}

static double incoming_radiance(const double w[3], const void *context) {
    const lit_point *s = (const lit_point *)context;
    vec offset = combine(1, wide(s->light.position), -1, wide(s->point)), d = vec_of(w);
    vec back = combine(-1, unit(wide(s->light.emission[s->component].axis)), 0, d);
    double l = (double)s->light.emission[s->component].sharpness, variance = (double)s->light.variance;
    double r = length(offset), chord = distance(d, back), extent = distance(combine(r, d, 0, d), offset);
    return exp(-0.5 * (extent * extent / variance + l * chord * chord)) / (2 * PI * variance);
}

/* Section 4.2 by quadrature of Eq. 5's Gaussian on the sphere around the point, and what its constant cosine costs. */
static void test_vsgl_diffuse_model(void) {
    test_bound bound = stated("vsgl_diffuse against quadrature", 1e-5);
    int i;
    for (i = 0; i < 200; i++) {
        lit_point s = draw_lit_point();
        incoming in = exact_incoming(s);
        double axis[3], cosine = fmax(0, dot(in.lobe.axis, unit(wide(s.normal)))), radiance;
        if (in.lobe.log_loss < -20 || s.light.variance == 0 || in.lobe.sum > 1e5 * (1 + in.lobe.sharpness)) continue;
        if (in.lobe.sharpness > 1e5 || in.lobe.sharpness < 0.01 * in.lobe.sum) continue;
        axis[0] = in.lobe.axis.x;
        axis[1] = in.lobe.axis.y;
        axis[2] = in.lobe.axis.z;
        radiance = reference_sphere(incoming_radiance, &s, axis, in.lobe.sharpness) / PI;
        within(&bound, (double)vsgl_diffuse(s.light, s.component, s.point, s.normal), radiance * cosine, radiance);
    }
    test_report(&bound);
}

/* ---- no NaN, no infinity ---- */

/* 0, or a magnitude with a binary exponent in [low, high]. */
static float wild(int low, int high) {
    double u = 17 * test_uniform(&test_random);
    if (u < 1) return (float)record(0);
    return (float)record(ldexp(1 + test_uniform(&test_random), low + (int)((u - 1) / 16 * (high + 1 - low))));
}

static lobe_vec3 wild_vector(int low, int high) {
    float x = wild(low, high), y = wild(low, high), z = wild(low, high);
    unsigned signs = (unsigned)pick(8);
    return lobe_vector(signs & 1 ? -x : x, signs & 2 ? -y : y, signs & 4 ? -z : z);
}

static lobe_vec3 wild_axis(lobe_vec3 other) {
    int choice = pick(8);
    lobe_vec3 axis = lobe_normalize_or(wild_vector(-30, 0), lobe_vector(0, 0, 1));
    axis = choice == 0 ? other : choice == 1 ? lobe_scale(other, -1) : axis;
    record_vector(axis);
    return axis;
}

static lobe_vec3 wild_colour(void) {
    return lobe_vector(wild(-140, 60), wild(-140, 60), wild(-140, 60));
}

/* A float from anywhere in the domain of a scalar, or beyond it */
static float wild_scalar(int low, int high) {
    float x = wild(low, high);
    return pick(4) ? x : (float)record((double)-x);
}

static sg_lobe wild_lobe(lobe_vec3 axis) {
    sg_lobe g;
    g.axis = wild_axis(axis);
    g.sharpness = wild_scalar(-149, 127);
    g.log_amplitude = wild_scalar(-149, 99);
    return g;
}

static void check_finite_functions(void) {
    lobe_vec3 axis = wild_axis(lobe_vector(1, 0, 0)), wi = wild_axis(axis), w;
    sg_lobe a = wild_lobe(axis), b = wild_lobe(a.axis), g = sg_product(a, b), c;
    float alpha = wild_scalar(-149, 127), u = (float)test_uniform(&test_random), v = (float)test_uniform(&test_random);
    float eval = sg_eval(a, axis), integral = sg_integral(a.sharpness), pdf = sg_pdf(a, axis), mean, cosine, approx;
    that(test_is_finite(eval) && eval >= 0, "finite sg_eval");
    that(test_is_finite(integral) && integral >= 0 && integral < 12.567f, "finite sg_integral");
    that(finite_lobe(sg_normalize(a)), "finite sg_normalize");
    that(finite_lobe(g) && fabs(length(wide(g.axis)) - 1) < 1e-6, "finite sg_product, unit axis");
    w = sg_sample(a, u, v);
    that(finite_vector(w) && fabs(length(wide(w)) - 1) < 1e-6, "finite sg_sample, unit length");
    that(test_is_finite(pdf) && pdf >= 0, "finite sg_pdf");
    integral = sg_product_integral(a, b);
    approx = sg_product_integral_approx(a, b);
    that(test_is_finite(integral) && integral >= 0, "finite sg_product_integral");
    that(test_is_finite(approx) && approx >= 0, "finite sg_product_integral_approx");
    /* no larger than the amplitudes allow: lobe_exp2 turns a NaN into 2^122 */
    c = a;
    c.sharpness = fabsf(a.sharpness);
    c.log_amplitude = 0;
    that(sg_eval(c, axis) <= 1, "sg_eval is below its amplitude");
    that(sg_product_integral(c, c) < 12.567f, "sg_product_integral is below its amplitudes");
    that(finite_lobe(sg_convolve(a, alpha)), "finite sg_convolve");
    cosine = sg_cosine_integral(a, wi);
    approx = sg_cosine_integral_approx(a, wi);
    that(test_is_finite(cosine) && cosine >= 0, "finite sg_cosine_integral");
    that(test_is_finite(approx) && approx >= 0, "finite sg_cosine_integral_approx");
    that(sg_cosine_integral(c, wi) < 3.1416f && sg_cosine_integral_approx(c, wi) < 3.1416f, "at most pi");
    mean = sg_mean_length(a.sharpness);
    that(test_is_finite(mean) && mean >= 0 && mean <= 1, "finite sg_mean_length");
    that(test_is_finite(sg_sharpness_from_mean_length(alpha)), "finite sg_sharpness_from_mean_length");
    that(finite_lobe(sg_diffuse_lobe(axis)) && finite_lobe(sg_phong_lobe(axis, wi, a.sharpness)) &&
             finite_lobe(sg_ggx_lobe(axis, wi, alpha)) && finite_lobe(sg_beckmann_lobe(axis, wi, alpha)),
         "finite reflection lobes");
}

static void check_finite_light(void) {
    lobe_vec3 normal = wild_axis(lobe_vector(0, 1, 0)), wi = wild_axis(normal), point = wild_vector(-140, 16);
    float alpha = wild(-140, 0);
    vsgl_moments m =
        vsgl_moments_from_vpl(wild_vector(-140, 16), normal, wi, wild_colour(), wild_colour(), wild(-140, 0));
    vsgl_moments n =
        vsgl_moments_from_vpl(wild_vector(-140, 16), wi, normal, wild_colour(), wild_colour(), wild(-140, 0));
    vsgl v = vsgl_from_moments(vsgl_moments_scale(vsgl_moments_add(m, n), wild(-20, 0)), wild_vector(-140, 16));
    vsgl_cluster a = vsgl_cluster_from_vpl(wild_vector(-140, 16), normal, wi, wild_colour(), wild_colour(), alpha);
    vsgl_cluster b = vsgl_cluster_from_vpl(wild_vector(-140, 16), wi, normal, wild_colour(), wild_colour(), alpha);
    int k;
    if (pick(2)) v = vsgl_from_cluster(vsgl_cluster_merge(a, b));
    if (pick(4) == 0) point = v.position;
    that(finite_lobe(vsl_lobe(v.position, wild(-140, 16), point)), "finite vsl_lobe");
    that(finite_vector(v.position) && test_is_finite(v.variance) && v.variance >= 0, "finite vsgl_from_moments");
    for (k = 0; k < 2; k++) {
        float lit = vsgl_diffuse(v, k, point, wi);
        that(finite_vector(v.intensity[k]) && finite_lobe(v.emission[k]), "finite vsgl_from_moments");
        that(finite_lobe(vsgl_incoming_lobe(v, k, point)), "finite vsgl_incoming_lobe");
        that(lit >= 0 && lit < 1e20f, "finite vsgl_diffuse");
        lit = vsgl_diffuse_integral(v, k, point, wi);
        that(lit >= 0 && lit < 1e20f, "finite vsgl_diffuse_integral");
    }
}

static void test_finite(void) {
    int i;
    for (i = 0; i < test_draws(300000); i++) {
        begin();
        check_finite_functions();
        begin();
        check_finite_light();
    }
}

const test_case sg_tests[] = {{"sg_exp2", test_exp2},
                              {"sg_phi", test_phi},
                              {"sg_log", test_log},
                              {"sg_turn", test_turn},
                              {"sg_vectors", test_vectors},
                              {"sg_closed_forms", test_closed_forms},
                              {"sg_eval", test_eval},
                              {"sg_integral", test_integral},
                              {"sg_normalize", test_normalize},
                              {"sg_sample", test_sample},
                              {"sg_sample_distribution", test_sample_distribution},
                              {"sg_pdf", test_pdf},
                              {"sg_product", test_product},
                              {"sg_product_values", test_product_values},
                              {"sg_product_integral", test_product_integral},
                              {"sg_product_integral_approx", test_product_integral_approx_model},
                              {"sg_axes_identical", test_identical_axes},
                              {"sg_axes_1e-7_apart", test_close_axes},
                              {"sg_axes_random", test_random_axes},
                              {"sg_axes_on_the_flank", test_axes_on_the_flank},
                              {"sg_axes_antipodal", test_antipodal_axes},
                              {"sg_aligned", test_aligned},
                              {"sg_convolve", test_convolve},
                              {"sg_cosine_integral", test_cosine_integral},
                              {"sg_cosine_integral_tokuyoshi", test_cosine_against_tokuyoshi},
                              {"sg_toksvig", test_toksvig},
                              {"sg_diffuse_lobe", test_diffuse_lobe},
                              {"sg_reflection_lobe", test_reflection_lobe},
                              {"vsgl_moments", test_moments},
                              {"vsgl_of_one_vpl", test_vsgl_of_one_vpl},
                              {"vsgl_of_a_disc", test_vsgl_of_a_disc},
                              {"vsgl_without_power", test_vsgl_without_power},
                              {"vsgl_cluster_of_one_vpl", test_cluster_of_one_vpl},
                              {"vsgl_cluster_figures", test_cluster_figures},
                              {"vsgl_cluster_merge", test_cluster_merge},
                              {"vsgl_cluster_against_moments", test_cluster_against_moments},
                              {"vsl_lobe", test_vsl},
                              {"vsgl_incoming_lobe", test_incoming_lobe},
                              {"vsgl_diffuse", test_vsgl_diffuse},
                              {"vsgl_diffuse_model", test_vsgl_diffuse_model},
                              {"sg_finite", test_finite},
                              {0, 0}};
