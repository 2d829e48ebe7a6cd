/* Unit tests of asg.h against exact_asg.h. */
#include "exact_asg.h"
#include "test.h"
#include <float.h>
#include <stddef.h>

/* What rounding of the directions costs a lobe of the given sharpness and exponent: see the head of asg.h. */
static double directional(double sharpness, double exponent) {
    double e = fabs(exponent);
    return TEST_EPSILON * (1 + e + sqrt(sharpness * e) + TEST_EPSILON * sharpness);
}

/* ---- evaluate and integrate ---- */

static void eval_matches(void) {
    test_bound bound = test_bound_of("asg.h", "asg_eval", "directional");
    test_rng rng = {101 + test_seed};
    int i;
    for (i = 0; i < test_few(200000); i++) {
        double axis[3], dir[3], lx = test_log_uniform(&rng, bound.low, bound.high), ly = lx, wanted, e, z, inputs[8];
        asg_lobe a;
        exact_asg exact;
        int kind = i % 8;
        test_direction(&rng, axis);
        if (kind & 1) ly = test_log_uniform(&rng, bound.low, bound.high);
        a = lobe_around(axis, 7 * test_uniform(&rng), lx, ly);
        if (kind < 2)
            test_direction(&rng, dir);
        else if (kind < 6)
            direction_near(&rng, axis, fmin(5 * test_uniform(&rng) / sqrt(fmax(lx, ly)), 3), dir);
        else
            direction_near(&rng, axis, REFERENCE_PI / 2 + 1e-6 * (test_uniform(&rng) - 0.5), dir);
        widen(narrow(dir), dir);
        exact = exact_of(a);
        z = fmax(dot(dir, exact.z), 0);
        e = -exact.lx * pow(dot(dir, exact.x), 2) - exact.ly * pow(dot(dir, exact.y), 2);
        wanted = z * exp(e);
        if (exp(e) < 1e-25) { /* where floats end */
            test_that(asg_eval(a, narrow(dir)) < 1e-24f, "next to nothing far from the axis", dir, 3);
            continue;
        }
        inputs[0] = (double)a.sharpness_x;
        inputs[1] = (double)a.sharpness_y;
        for (kind = 0; kind < 3; kind++) {
            inputs[2 + kind] = exact.z[kind];
            inputs[5 + kind] = dir[kind];
        }
        test_within(&bound, (double)asg_eval(a, narrow(dir)), wanted,
                    exp(e) * (TEST_EPSILON + z * directional(fmax(lx, ly), e)), inputs, 8);
    }
    test_report(&bound);
}

static void eval_named_cases(void) {
    const double up[3] = {0, 0, 1};
    const float sharpness[3] = {0, 1, 1e10f};
    int i;
    for (i = 0; i < 3; i++) {
        asg_lobe a = lobe_around(up, 0, (double)sharpness[i], 2 * (double)sharpness[i]);
        double s = (double)sharpness[i];
        test_that(asg_eval(a, lobe_vector(0, 0, 1)) == 1, "1 along the axis", &s, 1);
        test_that(asg_eval(a, lobe_vector(0, 0, -1)) == 0, "0 opposite the axis", &s, 1);
        test_that(asg_eval(a, a.x) == 0 && asg_eval(a, a.y) == 0, "0 at the horizon", &s, 1);
        a.log_amplitude = -3;
        test_that(fabs((double)asg_eval(a, a.z) - exp(-3.0)) < 1e-7, "the amplitude along the axis", &s, 1);
    }
}

/* The formula of asg_integral in double */
static double integral_formula(double lx, double ly) {
    double l = fmax(lx, ly), u = fmin(lx, ly), d = l - u;
    double b = 1 + 0.27323954 * d * d / ((13.62806 + d * (1.851625 + d)) * (1 + 0.145226 * u));
    return REFERENCE_PI * sqrt(-expm1(-l) / l * -expm1(-b * u) / u);
}

static void integral_matches(void) {
    const double up[3] = {0, 0, 1};
    test_bound bound = test_bound_of("asg.h", "asg_integral", "rel");
    test_bound round = test_bound_of("asg.h", "asg_integral", "isotropic");
    test_bound rough = test_bound_of("asg.h", "asg_integral_approx", "model");
    test_bound formula = test_bound_of("asg.h", "asg_integral", "formula");
    test_rng rng = {102 + test_seed};
    double l;
    int i;
    for (i = 0; i < test_draws(3000); i++) {
        double inputs[2], wanted;
        asg_lobe a;
        inputs[0] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[1] = fmin(inputs[0] * test_log_uniform(&rng, 1, i & 1 ? 1e5 : 100), bound.high);
        a = lobe_around(up, 0, inputs[i % 2], inputs[1 - i % 2]);
        wanted = integral_formula((double)a.sharpness_x, (double)a.sharpness_y);
        test_within(&formula, (double)asg_integral(a), wanted, wanted, inputs, 2);
        if (i >= 3000) continue; /* quadrature takes long */
        wanted = reference_integral((double)a.sharpness_x, (double)a.sharpness_y);
        test_within(&bound, (double)asg_integral(a), wanted, wanted, inputs, 2);
        if (inputs[0] >= rough.low) test_within(&rough, (double)asg_integral_approx(a), wanted, wanted, inputs, 2);
    }
    for (l = round.low; l <= round.high; l *= 1.37) {
        asg_lobe a = lobe_around(up, 0, l, l);
        double exact = (double)a.sharpness_x, wanted = REFERENCE_PI * -expm1(-exact) / exact;
        test_within(&round, (double)asg_integral(a), wanted, wanted, &exact, 1);
        if (l >= rough.low) test_within(&rough, (double)asg_integral_approx(a), wanted, wanted, &exact, 1);
    }
    l = 0;
    test_within(&round, (double)asg_integral(lobe_around(up, 0, 0, 0)), REFERENCE_PI, REFERENCE_PI, &l, 1);
    test_report(&bound);
    test_report(&formula);
    test_report(&round);
    test_report(&rough);
}

/* The quadrature itself, against the general one of reference.h and closed forms. */
typedef struct {
    exact_asg lobe[2];
    double axis[3], sharpness;
} product_context;

static double product_value(const double w[3], const void *context) {
    const product_context *p = (const product_context *)context;
    return exact_eval(&p->lobe[0], w) * exact_eval(&p->lobe[1], w) * exp(p->sharpness * (dot(w, p->axis) - 1));
}

static double light_value(const double w[3], const void *context) {
    const product_context *p = (const product_context *)context;
    return exact_eval(&p->lobe[0], w) * exp(p->sharpness * (dot(w, p->axis) - 1));
}

static void quadratures_agree(void) {
    test_rng rng = {103 + test_seed};
    int i, k;
    for (i = 0; i < 8; i++) {
        product_context p;
        double z[3], other[3], got, wanted, inputs[2];
        asg_lobe a, b;
        sg_lobe g;
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), test_log_uniform(&rng, 0.1, 20), test_log_uniform(&rng, 0.1, 20));
        direction_near(&rng, z, test_uniform(&rng), other);
        b = lobe_around(other, 7 * test_uniform(&rng), test_log_uniform(&rng, 0.1, 20), 1);
        direction_near(&rng, z, test_uniform(&rng), other);
        g = sg_around(other, test_log_uniform(&rng, 0.1, 20));
        p.lobe[0] = exact_of(a);
        p.lobe[1] = exact_of(b);
        widen(g.axis, p.axis);
        normalize(p.axis);
        p.sharpness = (double)g.sharpness;
        got = inputs[0] = reference_product(a, &b, &g);
        wanted = inputs[1] = reference_sphere_azimuth(product_value, &p, p.lobe[0].z, 10, 400);
        test_that(fabs(got / wanted - 1) < 1e-4, "two quadratures agree", inputs, 2);
        got = inputs[0] = reference_product(a, NULL, NULL);
        wanted = inputs[1] = reference_integral((double)a.sharpness_x, (double)a.sharpness_y);
        test_that(fabs(got / wanted - 1) < 1e-9, "quadrature and disk integral agree", inputs, 2);
    }
    /* a light at the horizon and next to the pole of the quadrature's own frame */
    for (i = 0; i < 5; i++) {
        const double up[3] = {0, 0, 1};
        product_context p;
        double axis[3], azimuth = REFERENCE_PI / 2 + 0.001 * (i - 2), got, wanted, inputs[2];
        asg_lobe a = lobe_around(up, 0, 0.03, 0.03);
        sg_lobe g;
        p.lobe[0] = exact_of(a);
        for (k = 0; k < 3; k++) {
            axis[k] =
                sin(1.5698) * (cos(azimuth) * p.lobe[0].x[k] + sin(azimuth) * p.lobe[0].y[k]) + cos(1.5698) * up[k];
        }
        g = sg_around(axis, 48000);
        widen(g.axis, p.axis);
        normalize(p.axis);
        p.sharpness = (double)g.sharpness;
        got = inputs[0] = reference_product(a, NULL, &g);
        wanted = inputs[1] = reference_sphere_azimuth(light_value, &p, p.axis, p.sharpness, 1000);
        test_that(fabs(got / wanted - 1) < 1e-4, "two quadratures agree at the pole", inputs, 2);
    }
}

/* ---- ASG times SG ---- */

static void sg_integrals_match(void) {
    test_bound bound = test_bound_of("asg.h", "asg_sg_integral", "aligned");
    test_bound rms = test_bound_of("asg.h", "asg_sg_integral", "rms");
    test_bound sharp = test_bound_of("asg.h", "asg_sg_integral", "sharp");
    test_bound xu = test_bound_of("asg.h", "asg_sg_integral_xu", "aligned");
    test_bound xu_rms = test_bound_of("asg.h", "asg_sg_integral_xu", "rms");
    test_rng rng = {104 + test_seed};
    double squares = 0, xu_squares = 0;
    int i, count = 0, xu_count = 0;
    for (i = 0; i < test_few(1200); i++) {
        double z[3], axis[3], inputs[4], wanted, aligned, lx, ly, lg, angle;
        asg_lobe a;
        sg_lobe g, ahead;
        test_direction(&rng, z);
        lx = test_log_uniform(&rng, bound.low, bound.high);
        ly = test_log_uniform(&rng, bound.low, bound.high);
        lg = test_log_uniform(&rng, bound.low, bound.high);
        angle = i % 4 ? fmin(4 * test_uniform(&rng) * sqrt(1 / (0.5 * lg + 0.5) + 1 / (fmin(lx, ly) + 0.5)), 3.14)
                      : acos(1 - 2 * test_uniform(&rng));
        if (i % 50 == 1) angle = 0;
        if (i % 50 == 2) angle = REFERENCE_PI / 2;
        if (i % 50 == 3) angle = REFERENCE_PI;
        a = lobe_around(z, 7 * test_uniform(&rng), lx, ly);
        direction_near(&rng, z, angle, axis);
        g = sg_around(axis, lg);
        ahead = sg_around(z, lg);
        wanted = reference_product(a, NULL, &g);
        aligned = reference_product(a, NULL, &ahead);
        inputs[0] = lx;
        inputs[1] = ly;
        inputs[2] = lg;
        inputs[3] = angle;
        test_within(&bound, (double)asg_sg_integral(a, g), wanted, aligned, inputs, 4);
        if (lg >= sharp.low && fmin(lx, ly) >= sharp.low) {
            test_within(&sharp, (double)asg_sg_integral(a, g), wanted, aligned, inputs, 4);
        }
        if (wanted > 0.01 * aligned) {
            squares += pow((double)asg_sg_integral(a, g) / wanted - 1, 2);
            count++;
        }
        if (lg < xu.low || fmin(lx, ly) < xu.low) continue;
        test_within(&xu, (double)asg_sg_integral_xu(a, g), wanted, aligned, inputs, 4);
        if (wanted > 0.01 * aligned) {
            xu_squares += pow((double)asg_sg_integral_xu(a, g) / wanted - 1, 2);
            xu_count++;
        }
    }
    test_within(&rms, sqrt(squares / count), 0, 1, NULL, 0);
    test_within(&xu_rms, sqrt(xu_squares / xu_count), 0, 1, NULL, 0);
    test_report(&bound);
    test_report(&rms);
    test_report(&sharp);
    test_report(&xu);
    test_report(&xu_rms);
}

/* The formula of asg_sg_integral in double, without its care for rounding and for extremes */
static double sg_integral_formula(const exact_asg *a, const double axis[3], double sharpness) {
    double nu = 0.5 * sharpness, x = nu * dot(a->x, axis), y = nu * dot(a->y, axis), z = nu * dot(a->z, axis);
    double rx = (nu + 0.9009611) / (a->lx + nu + 0.9009611), ry = (nu + 0.9009611) / (a->ly + nu + 0.9009611);
    double d = 0.25 * (1 + rx + ry), tau = d + sqrt(d * d + rx * x * rx * x + ry * y * ry * y + z * z);
    double p = 1 / (a->lx + tau), q = 1 / (a->ly + tau), t = 1 / tau;
    double mx2 = x * x * p * p, my2 = y * y * q * q, mz2 = z * z * t * t, sum = 0.5 * (p + q + t);
    double excess = sum + mx2 + my2 + mz2 - 1;
    double k2 = tau * ((0.5 * p + 2 * mx2) * p + (0.5 * q + 2 * my2) * q) + 0.5 * t + 2 * mz2;
    double exponent = pow(tau - nu, 2) * t - (a->lx * x * x * p + a->ly * y * y * q) * t +
                      excess * tau * (1 - 0.41055794 * k2) * (0.8921123 * sum - 0.592386 * excess);
    double side = sqrt(2 * t) * z,
           tail = pow(fmax(1 - 0.259302 * fabs(side), 0), 4) * (0.8032341 - 0.239188 * fabs(side));
    double mean = (1 + 0.03304771 * t * k2) * sqrt(t) * (fabs(side) + tail);
    double split = side * (2.554556 + (mz2 + 0.598075 * t) * (-0.826906 + 1.124705 * fabs(side)));
    return REFERENCE_PI * exp(exponent) * mean * sqrt(p * q / k2) / (1 + exp(-split));
}

static void sg_integral_rounds(void) {
    test_bound bound = test_bound_of("asg.h", "asg_sg_integral", "formula");
    test_rng rng = {129 + test_seed};
    int i, k;
    for (i = 0; i < test_few(50000); i++) {
        double z[3], axis[3], inputs[4], wanted, aligned, e, angle;
        asg_lobe a;
        sg_lobe g;
        exact_asg exact;
        test_direction(&rng, z);
        for (k = 0; k < 3; k++) { /* the widest lobes round worst */
            inputs[k] = test_log_uniform(&rng, bound.low, i % 2 ? 10 * bound.low : bound.high);
        }
        angle = 4 * test_uniform(&rng) * sqrt(2 / (inputs[2] + 1) + 1 / (fmin(inputs[0], inputs[1]) + 0.5));
        if (i % 4 == 0) angle = acos(1 - 2 * test_uniform(&rng));
        inputs[3] = fmin(angle, REFERENCE_PI);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        exact = exact_of(a);
        direction_near(&rng, z, inputs[3], axis);
        g = sg_around(axis, inputs[2]);
        widen(g.axis, axis);
        normalize(axis);
        wanted = sg_integral_formula(&exact, axis, (double)g.sharpness);
        aligned = sg_integral_formula(&exact, exact.z, (double)g.sharpness);
        e = log(wanted / aligned);
        if (!(e > -40)) continue;
        test_within(&bound, (double)asg_sg_integral(a, g), wanted,
                    wanted * directional(fmax(fmax(inputs[0], inputs[1]), inputs[2]), e), inputs, 4);
    }
    test_report(&bound);
}

/* How much the accurate form gains on Xu's where it has something to gain: for each of four ranges of the smaller
   sharpness and the light's. */
static void sg_integral_gains(void) {
    test_bound bound = test_bound_of("asg.h", "asg_sg_integral", "ratio");
    test_rng rng = {123 + test_seed};
    double squares[4] = {0}, xu_squares[4] = {0}, inputs[4];
    int i, range;
    for (i = 0; i < test_few(1600); i++) {
        double z[3], axis[3], wanted, aligned, angle;
        asg_lobe a;
        sg_lobe g;
        for (range = 0; range < 3; range++) inputs[range] = test_log_uniform(&rng, bound.low, bound.high);
        angle =
            i % 4 ? 4 * test_uniform(&rng) * sqrt(1 / (0.5 * inputs[2] + 0.5) + 1 / (fmin(inputs[0], inputs[1]) + 0.5))
                  : acos(1 - 2 * test_uniform(&rng));
        inputs[3] = fmin(angle, REFERENCE_PI);
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        direction_near(&rng, z, inputs[3], axis);
        g = sg_around(axis, inputs[2]);
        wanted = reference_product(a, NULL, &g);
        g = sg_around(z, inputs[2]);
        aligned = reference_product(a, NULL, &g);
        g = sg_around(axis, inputs[2]);
        range = (fmin(inputs[0], inputs[1]) < 10 ? 0 : 1) + (inputs[2] < 10 ? 0 : 2);
        if (wanted < 0.01 * aligned) continue;
        squares[range] += pow((double)asg_sg_integral(a, g) / wanted - 1, 2);
        xu_squares[range] += pow((double)asg_sg_integral_xu(a, g) / wanted - 1, 2);
    }
    for (range = 0; range < 4; range++) {
        inputs[0] = range;
        test_within(&bound, sqrt(squares[range] / xu_squares[range]), 0, 1, inputs, 1);
    }
    test_report(&bound);
}

/* ---- the rule for the form ---- */

typedef struct {
    double lx, ly, lg, angle, azimuth; /* of the light in the lobe's frame */
    int form;                          /* at most */
} form_case;

static int form_of(asg_lobe a, const form_case *c, double tolerance) {
    return asg_sg_form(a, (float)c->lg, (float)tolerance);
}

/* The loss over the least tolerance for which the rule gives a form no dearer than that; 0 where there is none. */
static double form_loss(const form_case *c) {
    const double up[3] = {0, 0, 1};
    const asg_lobe a = lobe_around(up, 0, c->lx, c->ly);
    const exact_asg exact = exact_of(a);
    double low = 1e-4, high = 0.5, axis[3], got, wanted, aligned;
    sg_lobe g = sg_around(up, c->lg);
    int i, form;
    if (form_of(a, c, high) > c->form) return 0;
    for (i = 0; i < 40 && form_of(a, c, low) > c->form; i++) {
        double middle = sqrt(low * high);
        if (form_of(a, c, middle) > c->form)
            low = middle;
        else
            high = middle;
    }
    if (form_of(a, c, low) <= c->form) high = low;
    aligned = reference_product(a, NULL, &g);
    for (i = 0; i < 3; i++) {
        axis[i] = cos(c->angle) * up[i] + sin(c->angle) * (cos(c->azimuth) * exact.x[i] + sin(c->azimuth) * exact.y[i]);
    }
    g = sg_around(axis, c->lg);
    wanted = reference_product(a, NULL, &g);
    form = form_of(a, c, high);
    got = form == ASG_FORM_SG   ? (double)sg_product_integral(asg_isotropic(a), g)
          : form == ASG_FORM_XU ? (double)asg_sg_integral_xu(a, g)
                                : (double)asg_sg_integral(a, g);
    return fabs(got - wanted) / aligned / high;
}

static form_case any_form_case(test_rng *rng, int form) {
    form_case c;
    double nu;
    c.form = form;
    c.lx = test_log_uniform(rng, 1e-2, 1e5);
    c.ly = c.lx * test_log_uniform(rng, 1, test_uniform(rng) < 0.5 ? 3 : 1e3);
    if (test_uniform(rng) < 0.4) c.ly = c.lx;
    c.lg = test_log_uniform(rng, 0.1, 1e6);
    nu = 0.5 * c.lg;
    c.angle = 2.5 * test_uniform(rng) / sqrt(c.lx * nu / (c.lx + nu) + 0.3);
    if (test_uniform(rng) < 0.2) c.angle = REFERENCE_PI / 2 + (test_uniform(rng) - 0.5) / sqrt(nu + 1);
    if (test_uniform(rng) < 0.1) c.angle = 0;
    c.azimuth = 0.5 * REFERENCE_PI * (test_uniform(rng) < 0.5 ? floor(2 * test_uniform(rng)) : test_uniform(rng));
    return c;
}

/* The rule never loses more than it says: random cases, and a climb from the worst of them. */
static void form_keeps_its_word(void) {
    test_bound bound = test_bound_of("asg.h", "asg_sg_form", "loss");
    test_rng rng = {124 + test_seed};
    int form, start, i;
    for (form = ASG_FORM_SG; form <= ASG_FORM_XU; form++) {
        double least = 0;
        for (start = 0; start < test_few(12); start++) {
            double best = -1, inputs[6], step = 0.3;
            form_case c;
            memset(&c, 0, sizeof c);
            for (i = 0; i < 100; i++) {
                form_case next = c;
                double loss;
                if (i < 40) {
                    next = any_form_case(&rng, form);
                } else {
                    next.lx *= exp(step * (2 * test_uniform(&rng) - 1));
                    next.ly = c.ly == c.lx ? next.lx : next.ly * exp(step * (2 * test_uniform(&rng) - 1));
                    next.lg *= exp(step * (2 * test_uniform(&rng) - 1));
                    next.angle = fmin(next.angle * exp(step * (2 * test_uniform(&rng) - 1)), REFERENCE_PI);
                    next.azimuth += step * (2 * test_uniform(&rng) - 1);
                }
                loss = form_loss(&next);
                inputs[0] = next.lx;
                inputs[1] = next.ly;
                inputs[2] = next.lg;
                inputs[3] = next.angle;
                inputs[4] = next.azimuth;
                inputs[5] = form;
                test_within(&bound, loss, 0, 1, inputs, 6);
                if (loss > best) {
                    best = loss;
                    c = next;
                } else if (i > 60) {
                    step *= 0.93;
                }
            }
            least = fmax(least, best);
        }
        test_that(least > 0.5, "a tolerance is used up to half somewhere", &least, 1);
    }
    test_report(&bound);
}

/* The thresholds as they are stated, from both sides */
static void form_thresholds(void) {
    const double up[3] = {0, 0, 1};
    double in[3];
    int k, i;
    for (k = 0; k < 3; k++) {
        float tolerance = k == 0 ? 1e-4f : k == 1 ? 1e-3f : 1e-2f, light;
        double share = .17 / (double)tolerance, reach = 1 + 2.5 * (double)tolerance;
        asg_lobe round = lobe_around(up, 0, share, share), thin = lobe_around(up, 0, 100, 1e6);
        asg_lobe oval = lobe_around(up, 0, 10 * share, 10 * share * pow(1 + 0.85 * (reach - 1), 2));
        asg_lobe longer = lobe_around(up, 0, 10 * share, 10 * share * pow(1 + 1.3 * (reach - 1), 2));
        asg_lobe wide = lobe_around(up, 0, 0.1, 0.1);
        in[0] = (double)tolerance;
        for (i = -2; i <= 12; i++) {
            light = (float)pow(10, i);
            in[1] = i;
            test_that(asg_sg_form(round, light, tolerance) == ASG_FORM_SG, "an SG for lobes of .16 / tolerance", in, 2);
            round.sharpness_x = round.sharpness_y = (float)(0.13 / (double)tolerance);
            test_that(asg_sg_form(round, (float)(0.26 / (double)tolerance), tolerance) != ASG_FORM_SG,
                      "not for wider ones with a light as wide", in, 2);
            round.sharpness_x = round.sharpness_y = (float)share;
        }
        test_that(asg_sg_form(oval, 1e30f, tolerance) == ASG_FORM_SG, "nor for lobes nearly round", in, 1);
        test_that(asg_sg_form(longer, 1e30f, tolerance) != ASG_FORM_SG, "but for longer ones", in, 1);
        light = (float)(2 * 0.62 / (double)tolerance);
        test_that(asg_sg_form(thin, light, tolerance) == ASG_FORM_XU, "Xu's form from .6 / tolerance", in, 1);
        light = (float)(2 * 0.2 / (double)tolerance);
        test_that(asg_sg_form(thin, light, tolerance) == ASG_FORM_ACCURATE, "not for wider lights", in, 1);
        light = (float)(2 * pow(0.32 / (double)tolerance, 2));
        test_that(asg_sg_form(wide, light, tolerance) == ASG_FORM_XU, "Xu's form for wide lobes", in, 1);
        light = (float)(2 * pow(0.25 / (double)tolerance, 2));
        test_that(asg_sg_form(wide, light, tolerance) == ASG_FORM_ACCURATE, "not for wider lights", in, 1);
    }
}

/* Xu's form counts what is above 1e18 as that, and does not vanish there. */
static void xu_saturates(void) {
    const double up[3] = {0, 0, 1};
    static const double sharpness[] = {2e18, 1e20, 1e25, 1e30};
    asg_lobe a = lobe_around(up, 0, 10, 20), sharp = lobe_around(up, 0, 1e18, 1e18);
    double most, most_sharp;
    sg_lobe g;
    int i;
    g.axis = lobe_vector(0, 0, 1);
    g.log_amplitude = 0;
    g.sharpness = 2e18f;
    most = (double)asg_sg_integral_xu(a, g);
    most_sharp = (double)asg_sg_integral_xu(sharp, g);
    test_that(most > 3e-18 && most_sharp > 1.5e-18, "something is left at 1e18", &most, 1);
    for (i = 0; i < 4; i++) {
        double input = sharpness[i], got;
        g.sharpness = (float)sharpness[i];
        got = (double)asg_sg_integral_xu(a, g);
        test_that(fabs(got - most) <= 1e-6 * most, "a sharper SG is the same", &input, 1);
        sharp.sharpness_x = (float)sharpness[i];
        sharp.sharpness_y = (float)sharpness[3 - i];
        g.sharpness = 2e18f;
        got = (double)asg_sg_integral_xu(sharp, g);
        test_that(fabs(got - most_sharp) <= 1e-6 * most_sharp, "and a sharper ASG", &input, 1);
    }
}

/* Amplitudes do nothing but multiply. */
static void amplitudes(void) {
    test_bound bound = {{0}, 1e-5, 0, 0, 0};
    test_rng rng = {118 + test_seed};
    int i, k;
    strcpy(bound.label, "amplitudes multiply");
    for (i = 0; i < test_draws(100000); i++) {
        double z[3], other[3], inputs[7];
        asg_lobe a, b;
        sg_lobe g;
        test_direction(&rng, z);
        for (k = 0; k < 5; k++) inputs[k] = test_log_uniform(&rng, 1, 100);
        direction_near(&rng, z, 0.2 * test_uniform(&rng), other);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        b = lobe_around(other, 7 * test_uniform(&rng), inputs[2], inputs[3]);
        g.axis = narrow(other);
        g.sharpness = (float)inputs[4];
        g.log_amplitude = 0;
        {
            float plain[] = {asg_eval(a, g.axis),          asg_integral(a),       asg_integral_approx(a),
                             asg_sg_integral_xu(a, g),     asg_sg_integral(a, g), asg_product_integral(a, b),
                             asg_product_integral_xu(a, b)};
            a.log_amplitude = (float)(inputs[5] = 6 * test_uniform(&rng) - 3);
            b.log_amplitude = g.log_amplitude = (float)(inputs[6] = 6 * test_uniform(&rng) - 3);
            {
                float got[] = {asg_eval(a, g.axis),          asg_integral(a),       asg_integral_approx(a),
                               asg_sg_integral_xu(a, g),     asg_sg_integral(a, g), asg_product_integral(a, b),
                               asg_product_integral_xu(a, b)};
                for (k = 0; k < 7; k++) {
                    double wanted = (double)plain[k] * exp(inputs[5] + (k > 2 ? inputs[6] : 0));
                    test_within(&bound, (double)got[k], wanted, wanted, inputs, 7);
                }
            }
        }
    }
    { /* also that of a reflection lobe, up to e^10 */
        lobe_vec3 normal = lobe_vector(0, 0, 1), wi = lobe_vector(0, -0.6f, 0.8f), place = lobe_vector(0, 0, 0);
        asg_lobe reflection = asg_ggx_lobe(normal, wi, 0.3f);
        vsgl light;
        double plain, wanted;
        memset(&light, 0, sizeof light);
        light.position = lobe_vector(0, 3, 4);
        light.variance = 0.01f;
        light.emission[0].axis = lobe_vector(0, -0.6f, -0.8f);
        light.emission[0].sharpness = 2;
        plain = (double)asg_vsgl_specular(light, VSGL_DIFFUSE, place, normal, wi, 0.3f, reflection);
        reflection.log_amplitude = 9.9f;
        wanted = plain * exp((double)reflection.log_amplitude);
        test_within(&bound, (double)asg_vsgl_specular(light, VSGL_DIFFUSE, place, normal, wi, 0.3f, reflection), wanted,
                    wanted, &plain, 1);
    }
}

static void form_named_cases(void) {
    const double up[3] = {0, 0, 1};
    double l = 0;
    asg_lobe round = lobe_around(up, 0, 500, 500), thin = lobe_around(up, 0, 100, 2500);
    asg_lobe none = lobe_around(up, 0, 0, 0);
    test_that(asg_sg_form(round, 2e3f, 0.01f) == ASG_FORM_SG, "an SG will do for a round, sharp lobe", &l, 1);
    test_that(asg_sg_form(thin, 2e3f, 0.01f) == ASG_FORM_XU, "Xu's form will do for a thin, sharp lobe", &l, 1);
    test_that(asg_sg_form(thin, 10, 0.01f) == ASG_FORM_ACCURATE, "not for a wide light", &l, 1);
    test_that(asg_sg_form(round, 2e3f, 0) == ASG_FORM_ACCURATE, "no tolerance needs the accurate form", &l, 1);
    test_that(asg_sg_form(none, 0, 0.5f) == ASG_FORM_ACCURATE, "so do lobes of sharpness 0", &l, 1);
    test_that(asg_sg_form(none, 1e30f, 0.05f) == ASG_FORM_XU, "but not for a point light", &l, 1);
}

static void isotropic_matches(void) {
    test_bound bound = test_bound_of("asg.h", "asg_isotropic", "ulp");
    test_rng rng = {125 + test_seed};
    int i;
    for (i = 0; i < test_draws(20000); i++) {
        double z[3], inputs[2], wanted;
        asg_lobe a;
        sg_lobe g;
        inputs[0] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[1] = test_log_uniform(&rng, bound.low, bound.high);
        test_direction(&rng, z);
        a = lobe_around(z, 1, inputs[0], inputs[1]);
        a.log_amplitude = 2;
        g = asg_isotropic(a);
        wanted = 2 * sqrt((double)a.sharpness_x * (double)a.sharpness_y);
        test_within(&bound, (double)g.sharpness, wanted, test_ulp(wanted), inputs, 2);
        test_that(g.log_amplitude == 2 && g.axis.x == a.z.x && g.axis.y == a.z.y && g.axis.z == a.z.z,
                  "axis and amplitude stay", inputs, 2);
    }
    test_report(&bound);
}

/* Against an SG that is a point, both are the lobe's value times the SG's integral. */
static void sg_integrals_sharp_limit(void) {
    test_bound bound = test_bound_of("asg.h", "asg_sg_integral", "directional");
    test_bound xu = test_bound_of("asg.h", "asg_sg_integral_xu", "directional");
    test_rng rng = {105 + test_seed};
    int i;
    for (i = 0; i < test_draws(20000); i++) {
        double z[3], axis[3], inputs[4], wanted, e, lx = test_log_uniform(&rng, 1, 1e3);
        double ly = test_log_uniform(&rng, 1, 1e3), lg = test_log_uniform(&rng, bound.low, bound.high), unit;
        asg_lobe a;
        sg_lobe g;
        exact_asg exact;
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), lx, ly);
        exact = exact_of(a);
        direction_near(&rng, z, fmin(2 * test_uniform(&rng) / sqrt(fmin(lx, ly)), 1.2), axis);
        g = sg_around(axis, lg);
        widen(g.axis, axis);
        normalize(axis);
        inputs[0] = lx;
        inputs[1] = ly;
        inputs[2] = lg;
        wanted = inputs[3] = exact_eval(&exact, axis);
        e = log(wanted / dot(axis, exact.z));
        unit = directional(fmax(lx, ly), e);
        wanted *= 2 * REFERENCE_PI / (double)g.sharpness;
        if (wanted < 1e-36) continue;
        test_within(&bound, (double)asg_sg_integral(a, g), wanted, wanted * unit, inputs, 4);
        if (lg <= xu.high) test_within(&xu, (double)asg_sg_integral_xu(a, g), wanted, wanted * unit, inputs, 4);
    }
    test_report(&bound);
    test_report(&xu);
}

/* No direction of the SG may beat the lobe's own axis, however extreme the two. */
static void sg_integrals_stay_below_aligned(void) {
    test_rng rng = {120 + test_seed};
    int i;
    for (i = 0; i < test_few(200000); i++) {
        double z[3], axis[3], inputs[4], aligned, got, least; /* of the exponent */
        asg_lobe a;
        inputs[0] = test_log_uniform(&rng, 1e-3, 1e12);
        inputs[1] = test_log_uniform(&rng, 1e-3, 1e12);
        inputs[2] = test_log_uniform(&rng, 1e-3, 1e12);
        inputs[3] = i % 2 ? acos(1 - 2 * test_uniform(&rng)) : 1.2 + 0.8 * test_uniform(&rng);
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        direction_near(&rng, z, inputs[3], axis);
        got = (double)asg_sg_integral(a, sg_around(axis, inputs[2]));
        aligned = (double)asg_sg_integral(a, sg_around(z, inputs[2]));
        test_that(got <= 1.05 * aligned, "at most the value for aligned axes", inputs, 4);
        least = fmin(fmin(inputs[0], inputs[1]), inputs[2]) * 0.25 * pow(sin(fmin(inputs[3], REFERENCE_PI / 2)), 2);
        test_that(least < 60 || got <= 1e-12 * aligned, "next to nothing far from the axis", inputs, 4);
    }
}

/* ---- ASG times ASG ---- */

static double weight(double both, double first, double second) {
    return both / sqrt(first * second);
}

static void products_match(void) {
    test_bound bound = test_bound_of("asg.h", "asg_product_integral", "aligned");
    test_bound rms = test_bound_of("asg.h", "asg_product_integral", "rms");
    test_bound sharp = test_bound_of("asg.h", "asg_product_integral", "sharp");
    test_bound xu = test_bound_of("asg.h", "asg_product_integral_xu", "aligned");
    test_bound xu_rms = test_bound_of("asg.h", "asg_product_integral_xu", "rms");
    test_bound xu_weights = test_bound_of("asg.h", "asg_product_integral_xu", "weight");
    test_rng rng = {106 + test_seed};
    double squares = 0, xu_squares = 0;
    int i, k, count = 0, xu_count = 0;
    for (i = 0; i < test_few(400); i++) {
        double z[3], other[3], l[4], inputs[5], wanted, first, second, aligned, got, smallest, angle;
        asg_lobe a, b;
        smallest = test_log_uniform(&rng, bound.low, i % 2 ? 10 : 0.1 * bound.high);
        for (k = 0; k < 4; k++) l[k] = inputs[k] = fmin(smallest * test_log_uniform(&rng, 1, 1e3), bound.high);
        l[i & 3] = inputs[i & 3] = smallest;
        angle = i % 3 ? fmin(3 * test_uniform(&rng) / sqrt(smallest + 0.3), 3.1) : acos(1 - 2 * test_uniform(&rng));
        if (i % 40 == 0) angle = 0;
        if (i % 40 == 1) angle = REFERENCE_PI;
        if (i % 40 == 2) angle = REFERENCE_PI / 2;
        if (i % 40 == 3) angle = 0, l[0] = l[1] = l[2] = l[3] = smallest = xu.low; /* Xu's worst */
        inputs[4] = angle;
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), l[0], l[1]);
        direction_near(&rng, z, angle, other);
        b = lobe_around(other, 7 * test_uniform(&rng), l[2], l[3]);
        wanted = reference_product(a, &b, NULL);
        first = reference_product(a, &a, NULL);
        second = reference_product(b, &b, NULL);
        aligned = sqrt(first * second);
        test_within(&bound, (double)asg_product_integral(a, b), wanted, aligned, inputs, 5);
        if (wanted > 0.01 * aligned) {
            squares += pow((double)asg_product_integral(a, b) / wanted - 1, 2);
            count++;
            if (smallest >= sharp.low) {
                test_within(&sharp, (double)asg_product_integral(a, b), wanted, wanted, inputs, 5);
            }
        }
        if (smallest < xu.low) continue;
        got = (double)asg_product_integral_xu(a, b);
        test_within(&xu, got, wanted, aligned, inputs, 5);
        if (wanted > 0.01 * aligned && i % 40 != 3) {
            xu_squares += pow(got / wanted - 1, 2);
            xu_count++;
        }
        got = weight(got, (double)asg_product_integral_xu(a, a), (double)asg_product_integral_xu(b, b));
        test_within(&xu_weights, got, weight(wanted, first, second), 1, inputs, 5);
    }
    test_within(&rms, sqrt(squares / count), 0, 1, NULL, 0);
    test_within(&xu_rms, sqrt(xu_squares / xu_count), 0, 1, NULL, 0);
    test_report(&bound);
    test_report(&rms);
    test_report(&sharp);
    test_report(&xu);
    test_report(&xu_rms);
    test_report(&xu_weights);
}

/* The formula of asg_product_integral in double, from the matrix itself */
static double product_formula(asg_lobe first, asg_lobe second) {
    const exact_asg a = exact_of(first), b = exact_of(second);
    double q[3][3], adj[3][3], trace, m2 = 0, det = 0, tau, value, slope, bend, d, e2, e3, u, v, g0, g1, g2, g, h, c[3];
    const double *pairs[3][2];
    int i, j, k;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            q[i][j] = a.lx * a.x[i] * a.x[j] + a.ly * a.y[i] * a.y[j] + b.lx * b.x[i] * b.x[j] + b.ly * b.y[i] * b.y[j];
        }
    }
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            adj[j][i] = q[i1][j1] * q[i2][j2] - q[i1][j2] * q[i2][j1];
        }
        m2 += adj[i][i];
    }
    for (k = 0; k < 3; k++) det += q[0][k] * adj[k][0];
    trace = q[0][0] + q[1][1] + q[2][2];
    tau = 1.321882 - det / (m2 + 1);
    value = ((tau + trace - 1.5) * tau + m2 - trace) * tau + det - 0.5 * m2;
    slope = (3 * tau + 2 * (trace - 1.5)) * tau + m2 - trace;
    bend = 3 * tau + trace - 1.5;
    tau -= value * slope / (slope * slope - value * bend);
    d = 0.5 * ((3 * tau + 2 * trace) * tau + m2);
    e3 = 0.125 / d;
    e2 = fmin(2 * e3 * (trace + 3 * tau), 1.0 / 3);
    u = 3 * e2;
    v = 27 * e3;
    g0 = v * (-0.2112965 + 0.2494492 * u);
    g1 = 0.6530841 + u * (2.875329 - 2.399835 * u) + v * (0.9055348 - 0.8977529 * u);
    g2 = 0.2046798 + u * (-2.830942 + 1.493817 * u) + v * (-0.8580086 + 1.091629 * u);
    g = 4 * e3 * (g1 + g2);
    h = g0 + g2 * (2 * tau * e3 - e2);
    pairs[0][0] = pairs[0][1] = pairs[1][0] = a.z;
    pairs[1][1] = pairs[2][0] = pairs[2][1] = b.z;
    for (k = 0; k < 3; k++) { /* the fitted moment of the two axes: za.za, za.zb, zb.zb */
        double form = 0, adjugate = 0, cosine = dot(pairs[k][0], pairs[k][1]);
        for (i = 0; i < 3; i++) {
            for (j = 0; j < 3; j++) {
                form += pairs[k][0][i] * q[i][j] * pairs[k][1][j];
                adjugate += pairs[k][0][i] * adj[i][j] * pairs[k][1][j];
            }
        }
        /* of one axis with itself also the form itself: for two it is 0 in the limit of aligned axes */
        c[k] =
            h * cosine + g * (adjugate + tau * (trace + tau) * cosine) + (k == 1 ? 0 : (2 * g2 * e3 - g * tau) * form);
    }
    u = sqrt(c[0] * c[2]);
    v = sqrt(fmax((u - c[1]) * (u + c[1]), 0));
    v = 0.5 * fmax(c[1], 0) +
        0.5 / REFERENCE_PI * v * v * v / (u * u + fabs(c[1]) * (1.5707963 * u + 0.4292037 * fabs(c[1])));
    return REFERENCE_PI * v * exp(tau) / sqrt(d * (1 - 2 * e2));
}

static void product_rounds(void) {
    test_bound bound = test_bound_of("asg.h", "asg_product_integral", "formula");
    test_rng rng = {130 + test_seed};
    int i, k;
    for (i = 0; i < test_few(50000); i++) {
        double z[3], other[3], inputs[5], wanted, aligned, smallest = test_log_uniform(&rng, bound.low, bound.high);
        double most = 0, e;
        asg_lobe a, b;
        test_direction(&rng, z);
        for (k = 0; k < 4; k++) {
            inputs[k] = fmin(smallest * test_log_uniform(&rng, 1, 100), bound.high);
            most = fmax(most, inputs[k]);
        }
        inputs[4] = fmin(3 * test_uniform(&rng) / sqrt(smallest + 0.3), 3.1);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        direction_near(&rng, z, inputs[4], other);
        b = lobe_around(other, 7 * test_uniform(&rng), inputs[2], inputs[3]);
        wanted = product_formula(a, b);
        aligned = sqrt(product_formula(a, a) * product_formula(b, b));
        e = log(wanted / aligned);
        if (!(e > -4.6)) continue; /* nearly opposed lobes cancel */
        test_within(&bound, (double)asg_product_integral(a, b), wanted, wanted * directional(most, e), inputs, 5);
    }
    test_report(&bound);
}

/* Sharp lobes, where the model is exact: what is left is rounding. */
static void products_round(void) {
    test_bound bound = test_bound_of("asg.h", "asg_product_integral", "directional");
    test_bound xu = test_bound_of("asg.h", "asg_product_integral_xu", "directional");
    test_rng rng = {107 + test_seed};
    int i;
    for (i = 0; i < test_few(300); i++) {
        double z[3], other[3], inputs[5], wanted, aligned, e, unit, smallest;
        asg_lobe a, b;
        test_direction(&rng, z);
        smallest = test_log_uniform(&rng, bound.low, bound.high);
        inputs[0] = fmin(smallest * test_log_uniform(&rng, 1, 100), bound.high);
        inputs[1] = fmin(smallest * test_log_uniform(&rng, 1, 100), bound.high);
        inputs[2] = fmin(smallest * test_log_uniform(&rng, 1, 100), bound.high);
        inputs[3] = smallest;
        inputs[4] = i % 4 ? 3 * test_uniform(&rng) / sqrt(smallest) : 0;
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        direction_near(&rng, z, inputs[4], other);
        b = i % 4 ? lobe_around(other, 7 * test_uniform(&rng), inputs[2], inputs[3]) : a;
        wanted = reference_product(a, &b, NULL);
        aligned = sqrt(reference_product(a, &a, NULL) * reference_product(b, &b, NULL));
        e = log(wanted / aligned);
        if (!(e > -20)) continue;
        unit = wanted * directional(fmax(fmax(inputs[0], inputs[1]), fmax(inputs[2], inputs[3])), e);
        test_within(&bound, (double)asg_product_integral(a, b), wanted, unit, inputs, 5);
        test_within(&xu, (double)asg_product_integral_xu(a, b), wanted, unit, inputs, 5);
    }
    test_report(&bound);
    test_report(&xu);
}

/* Eigenvalues and, in columns, eigenvectors of the two lobes' summed quadratic forms, by Jacobi's method. */
static void eigensystem(asg_lobe first, asg_lobe second, double values[3], double v[3][3]) {
    exact_asg lobe[2];
    double q[3][3];
    int i, j, k, n, sweep;
    lobe[0] = exact_of(first);
    lobe[1] = exact_of(second);
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            q[i][j] = 0;
            v[i][j] = i == j;
            for (n = 0; n < 2; n++) {
                q[i][j] += lobe[n].lx * lobe[n].x[i] * lobe[n].x[j] + lobe[n].ly * lobe[n].y[i] * lobe[n].y[j];
            }
        }
    }
    for (sweep = 0; sweep < 12; sweep++) {
        for (i = 0; i < 2; i++) {
            for (j = i + 1; j < 3; j++) {
                double angle = 0.5 * atan2(2 * q[i][j], q[j][j] - q[i][i]), c = cos(angle), s = sin(angle);
                for (k = 0; k < 3; k++) {
                    double a = q[k][i], b = q[k][j];
                    q[k][i] = c * a - s * b;
                    q[k][j] = s * a + c * b;
                    a = v[k][i];
                    b = v[k][j];
                    v[k][i] = c * a - s * b;
                    v[k][j] = s * a + c * b;
                }
                for (k = 0; k < 3; k++) {
                    double a = q[i][k], b = q[j][k];
                    q[i][k] = c * a - s * b;
                    q[j][k] = s * a + c * b;
                }
            }
        }
    }
    for (i = 0; i < 3; i++) values[i] = q[i][i];
}

/* Xu's form with eigenvectors, in double. */
static double xu_by_eigenvectors(asg_lobe first, asg_lobe second) {
    const exact_asg one = exact_of(first), two = exact_of(second);
    double values[3], v[3][3], lowest[3], gap = 1;
    int i, least = 0;
    eigensystem(first, second, values, v);
    for (i = 1; i < 3; i++) {
        if (values[i] < values[least]) least = i;
    }
    for (i = 0; i < 3; i++) {
        if (i != least) gap *= values[i] - values[least];
        lowest[i] = v[i][least];
    }
    return REFERENCE_PI * exp(-values[least]) * fmax(dot(lowest, one.z) * dot(lowest, two.z), 0) / sqrt(gap);
}

static void xu_needs_no_eigenvectors(void) {
    test_bound bound = test_bound_of("asg.h", "asg_product_integral_xu", "eigenvectors");
    test_rng rng = {121 + test_seed};
    int i, k;
    for (i = 0; i < test_draws(20000); i++) {
        double z[3], other[3], l[4], inputs[5], wanted, mean, smallest = test_log_uniform(&rng, bound.low, 1e4);
        asg_lobe a, b;
        for (k = 0; k < 4; k++) {
            l[k] = inputs[k] = fmin(smallest * test_log_uniform(&rng, 1, 100), bound.high);
        }
        inputs[4] = 3 * test_uniform(&rng) / sqrt(smallest);
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), l[0], l[1]);
        direction_near(&rng, z, inputs[4], other);
        b = lobe_around(other, 7 * test_uniform(&rng), l[2], l[3]);
        mean = sqrt(xu_by_eigenvectors(a, a) * xu_by_eigenvectors(b, b));
        wanted = xu_by_eigenvectors(a, b);
        if (wanted > 0.01 * mean) {
            test_within(&bound, (double)asg_product_integral_xu(a, b), wanted, wanted, inputs, 5);
        }
    }
    test_report(&bound);
}

#ifndef __FAST_MATH__
/* Whether a * b + c is rounded once, of a number whose square rounds. */
static int contracts(volatile float number) {
    float x = number, y = number;
    return x * y - (1 + 0x1p-11f) != 0;
}
#endif

static void products_are_bounded(void) {
    test_bound excess = test_bound_of("asg.h", "asg_product_integral", "excess");
    test_bound symmetric = test_bound_of("asg.h", "asg_product_integral", "symmetric");
    test_rng rng = {108 + test_seed};
    int i;
    for (i = 0; i < test_few(100000); i++) {
        double inputs[5], w, back, first, second;
        asg_lobe a, b;
        draw_near_asgs(&rng, i, 1e9, inputs, &a, &b);
        first = (double)asg_product_integral(a, a);
        second = (double)asg_product_integral(b, b);
        w = weight((double)asg_product_integral(a, b), first, second);
        back = weight((double)asg_product_integral(b, a), first, second);
        test_that(w >= 0, "an integral is not negative", inputs, 5);
#ifndef __FAST_MATH__ /* then sums are as written, if they are not contracted; no shader's are */
        test_that(test_slack > 1 || contracts(1 + 0x1p-12f) || asg_product_integral(a, b) == asg_product_integral(b, a),
                  "exactly symmetric", inputs, 5);
#endif
        test_within(&excess, fmax(w, 1), 1, 1, inputs, 5);
        test_within(&symmetric, w, back, 1, inputs, 5);
    }
    test_report(&excess);
    test_report(&symmetric);
}

static int nearly(float a, float b) {
    return fabsf(a - b) <= 1e-3f * fabsf(b);
}

/* Sharpness above what a function counts is counted as that. */
static void extremes_saturate(void) {
    test_rng rng = {131 + test_seed};
    int i;
    for (i = 0; i < test_few(2000); i++) {
        const double z[3] = {0, 0, 1}; /* whose products are exact: nothing cancels */
        double axis[3], inputs[2], other = test_log_uniform(&rng, 1e-3, 1e30);
        asg_lobe a, c, d;
        sg_lobe g;
        inputs[0] = test_log_uniform(&rng, 1e19, 1e30);
        inputs[1] = other;
        a = lobe_around(z, 0, inputs[0], other);
        if (i % 2) a.sharpness_x = (float)other, a.sharpness_y = (float)inputs[0];
        c = d = a;
        c.sharpness_x = fminf(a.sharpness_x, 1e12f), c.sharpness_y = fminf(a.sharpness_y, 1e12f);
        d.sharpness_x = fminf(a.sharpness_x, 1e9f), d.sharpness_y = fminf(a.sharpness_y, 1e9f);
        direction_near(&rng, z, i % 3 ? 0 : test_log_uniform(&rng, 1e-6, 3), axis);
        g = sg_around(axis, test_log_uniform(&rng, 1e-3, 1e30));
        test_that(nearly(asg_sg_integral_xu(a, g), asg_sg_integral_xu(c, g)), "Xu's form counts at most 1e12", inputs,
                  2);
        test_that(nearly(asg_sg_integral(a, g), asg_sg_integral(c, g)), "the accurate one at most 1e12", inputs, 2);
        test_that(nearly(asg_product_integral(a, a), asg_product_integral(d, d)), "products at most 1e9", inputs, 2);
        test_that(nearly(asg_product_integral_xu(a, a), asg_product_integral_xu(d, d)), "also Xu's", inputs, 2);
    }
}

static void opposed_lobes_part(void) {
    double l;
    for (l = 0; l < 1e8; l = 10 * l + 0.1) {
        const double up[3] = {0, 0, 1}, down[3] = {0, 0, -1};
        asg_lobe a = lobe_around(up, 0, l, l), b = lobe_around(down, 1, l, l);
        double self = (double)asg_product_integral(a, a);
        test_that((double)asg_product_integral(a, b) <= 0.01 * self, "opposed lobes do not meet", &l, 1);
        test_that(asg_product_integral_xu(a, b) == 0, "nor in Xu's model", &l, 1);
    }
}

/* ---- convolution ---- */

static void convolve_widens(void) {
    test_bound bound = test_bound_of("asg.h", "asg_convolve", "rel");
    test_rng rng = {109 + test_seed};
    int i;
    for (i = 0; i < test_draws(20000); i++) {
        double z[3], inputs[3], sx, sy, wanted, fx, fy;
        asg_lobe a, b;
        test_direction(&rng, z);
        inputs[0] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[1] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[2] = test_log_uniform(&rng, bound.low, bound.high);
        a = lobe_around(z, 1, inputs[0], inputs[1]);
        b = asg_convolve(a, (float)inputs[2]);
        fx = 1 + 2 * (double)a.sharpness_x / (double)(float)inputs[2];
        fy = 1 + 2 * (double)a.sharpness_y / (double)(float)inputs[2];
        sx = (double)a.sharpness_x / fx;
        sy = (double)a.sharpness_y / fy;
        wanted = -0.5 * log(fx * fy);
        test_within(&bound, (double)b.sharpness_x, sx, sx, inputs, 3);
        test_within(&bound, (double)b.sharpness_y, sy, sy, inputs, 3);
        test_within(&bound, (double)b.log_amplitude, wanted, 1 + fabs(wanted), inputs, 3);
        b = asg_convolve(a, HUGE_VALF);
        test_that(b.sharpness_x == a.sharpness_x && b.sharpness_y == a.sharpness_y && b.log_amplitude == 0,
                  "a kernel of infinite sharpness changes nothing", inputs, 3);
    }
    test_report(&bound);
}

/* An ASG and the SG of twice its sharpness blur alike; twice by kappa is once by kappa / 2; the integral
   stays. */
static void convolve_is_consistent(void) {
    test_rng rng = {110 + test_seed};
    int i;
    for (i = 0; i < test_few(2000); i++) {
        const double up[3] = {0, 0, 1};
        double inputs[2];
        asg_lobe a, once, twice;
        sg_lobe g;
        inputs[0] = test_log_uniform(&rng, 1e-3, 1e6);
        inputs[1] = test_log_uniform(&rng, 1e-3, 1e6);
        a = lobe_around(up, 0, inputs[0], 3 * inputs[0]);
        once = asg_convolve(a, (float)(0.5 * inputs[1]));
        twice = asg_convolve(asg_convolve(a, (float)inputs[1]), (float)inputs[1]);
        test_that(fabs((double)(once.sharpness_x / twice.sharpness_x) - 1) < 1e-6 &&
                      fabs((double)(once.sharpness_y / twice.sharpness_y) - 1) < 1e-6 &&
                      fabs((double)(once.log_amplitude - twice.log_amplitude)) < 2e-5,
                  "two small kernels make a large one", inputs, 2);
        test_that(fabs((double)(asg_integral_approx(once) / asg_integral_approx(a)) - 1) < 1e-5 ||
                      (double)once.sharpness_x < 1e-3,
                  "the flat integral stays", inputs, 2);
        g = sg_around(up, 2 * (double)a.sharpness_x);
        g = sg_convolve(g, (float)inputs[1]);
        a.sharpness_y = a.sharpness_x;
        a = asg_convolve(a, (float)inputs[1]);
        test_that(fabs(2 * (double)(a.sharpness_x / g.sharpness) - 1) < 1e-6 &&
                      fabs((double)(a.log_amplitude - g.log_amplitude)) < 1e-5,
                  "as an SG of twice the sharpness", inputs, 2);
    }
}

/* The blurred lobe's value is the integral of the lobe against the kernel there. */
static void convolve_matches_quadrature(void) {
    const double up[3] = {0, 0, 1};
    test_bound bound = test_bound_of("asg.h", "asg_convolve", "model");
    test_rng rng = {111 + test_seed};
    int i;
    for (i = 0; i < 60; i++) {
        double dir[3], inputs[4], wanted, got;
        asg_lobe a;
        sg_lobe kernel;
        inputs[0] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[1] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[2] = test_log_uniform(&rng, bound.low, bound.high);
        inputs[3] = fmin(3 * test_uniform(&rng) * sqrt(1 / fmin(inputs[0], inputs[1]) + 2 / inputs[2]), 1.5);
        a = lobe_around(up, 0, inputs[0], inputs[1]);
        direction_near(&rng, up, inputs[3], dir);
        kernel = sg_around(dir, inputs[2]);
        kernel.log_amplitude = logf(kernel.sharpness / (2 * LOBE_PI));
        wanted = reference_product(a, NULL, &kernel);
        a = asg_convolve(a, kernel.sharpness);
        got = (double)asg_eval(a, kernel.axis);
        test_within(&bound, got, wanted, exp((double)a.log_amplitude), inputs, 4);
    }
    test_report(&bound);
}

/* ---- reflection lobes ---- */

static void check_frame(test_bound *bound, asg_lobe a, const double *inputs, int count) {
    double x[3], y[3], z[3], turned[3];
    int k;
    widen(a.x, x);
    widen(a.y, y);
    widen(a.z, z);
    cross(x, y, turned);
    test_within(bound, dot(x, x), 1, 1, inputs, count);
    test_within(bound, dot(y, y), 1, 1, inputs, count);
    test_within(bound, dot(z, z), 1, 1, inputs, count);
    test_within(bound, dot(x, y), 0, 1, inputs, count);
    test_within(bound, dot(y, z), 0, 1, inputs, count);
    test_within(bound, dot(z, x), 0, 1, inputs, count);
    for (k = 0; k < 3; k++) test_within(bound, turned[k], z[k], 1, inputs, count);
}

static void ggx_frames(void) {
    test_bound bound = test_bound_of("asg.h", "asg_reflection_lobe", "orthonormal");
    test_bound round = test_bound_of("asg.h", "asg_reflection_lobe", "cosine");
    test_bound same = test_bound_of("asg.h", "asg_reflection_lobe_aniso", "cosine");
    test_rng rng = {112 + test_seed};
    int i, k;
    for (i = 0; i < test_few(100000); i++) {
        double n[3], w[3], t[3], mirror[3], inputs[7], cosine, angle, alpha, sx, sy;
        asg_lobe a, b, c;
        test_direction(&rng, n);
        if (i % 7 == 0) n[0] = n[1] = 0, n[2] = i & 8 ? 1 : -1;
        widen(narrow(n), n);
        switch (i % 6) {
        case 0:
            angle = 0;
            break;
        case 1:
            angle = test_log_uniform(&rng, 1e-9, 1);
            break;
        case 2:
            angle = REFERENCE_PI / 2 - test_log_uniform(&rng, 1e-9, 1);
            break;
        case 3:
            angle = REFERENCE_PI / 2 + test_log_uniform(&rng, 1e-9, 1);
            break;
        default:
            angle = acos(test_uniform(&rng));
            break;
        }
        direction_near(&rng, n, angle, w);
        if (angle == 0) {
            for (k = 0; k < 3; k++) w[k] = n[k];
        }
        widen(narrow(w), w);
        direction_near(&rng, n, REFERENCE_PI / 2, t);
        alpha = (double)(float)test_log_uniform(&rng, 1e-4, 1);
        for (k = 0; k < 3; k++) {
            inputs[k] = n[k];
            inputs[3 + k] = w[k];
        }
        inputs[6] = alpha;
        a = asg_ggx_lobe(narrow(n), narrow(w), (float)alpha);
        b = asg_ggx_lobe_aniso(narrow(n), narrow(t), narrow(w), (float)alpha, (float)alpha);
        c = asg_ggx_lobe_aniso(narrow(n), narrow(t), narrow(w), (float)alpha, (float)test_log_uniform(&rng, 1e-4, 1));
        check_frame(&bound, a, inputs, 7);
        check_frame(&bound, b, inputs, 7);
        check_frame(&bound, c, inputs, 7);
        test_that(a.log_amplitude == 0 && b.log_amplitude == 0, "the peak is 1", inputs, 7);
        for (k = 0; k < 3; k++) mirror[k] = 2 * dot(n, w) * n[k] - w[k];
        normalize(mirror);
        test_within(&bound, (double)a.z.x, mirror[0], 1, inputs, 7);
        test_within(&bound, (double)a.z.y, mirror[1], 1, inputs, 7);
        test_within(&bound, (double)a.z.z, mirror[2], 1, inputs, 7);
        cosine = fmax(fabs(dot(w, n)), 1e-4);
        sx = 0.25 / (alpha * alpha);
        sy = sx / (cosine * cosine);
        test_within(&round, (double)a.sharpness_x, sx, sx * TEST_EPSILON / cosine, inputs, 7);
        test_within(&round, (double)a.sharpness_y, sy, sy * TEST_EPSILON / cosine, inputs, 7);
        test_within(&same, (double)b.sharpness_x, sx, sx * TEST_EPSILON / cosine, inputs, 7);
        test_within(&same, (double)b.sharpness_y, sy, sy * TEST_EPSILON / cosine, inputs, 7);
        /* the across axis lies in the surface, where it is distinct */
        if (cosine < 0.9) {
            double y[3];
            widen(a.y, y);
            test_that(fabs(dot(y, n)) < 1e-6, "the narrow axis lies in the surface", inputs, 7);
            widen(b.y, y);
            test_that(fabs(dot(y, n)) < 1e-5, "also of the anisotropic form", inputs, 7);
        }
    }
    test_report(&bound);
    test_report(&round);
    test_report(&same);
}

/* Directions that differ by less than the squares of floats can hold, and sharpness as small */
static void frames_of_little(void) {
    test_bound bound = test_bound_of("asg.h", "asg_reflection_lobe", "orthonormal");
    test_rng rng = {117 + test_seed};
    int i, k;
    for (i = 0; i < test_draws(100000); i++) {
        double n[3], t[3], inputs[5], x = (double)(float)test_log_uniform(&rng, 1e-24, 1e-9);
        double y = (double)(float)test_log_uniform(&rng, 1e-24, 1e-9), tiny = test_log_uniform(&rng, 1e-42, 1);
        asg_lobe a;
        for (k = 0; k < 3; k++) n[k] = k == i % 3 ? (i & 4 ? 1 : -1) : k == (i + 1) % 3 ? x : -y;
        inputs[0] = i % 3, inputs[1] = x, inputs[2] = y, inputs[3] = tiny;
        a = asg_reflection_lobe(narrow(n), lobe_vector((float)round(n[0]), (float)round(n[1]), (float)round(n[2])),
                                100);
        check_frame(&bound, a, inputs, 3);
        test_direction(&rng, n);
        direction_near(&rng, n, REFERENCE_PI / 2, t);
        inputs[4] = i;
        a = asg_reflection_lobe_aniso(narrow(n), narrow(t), narrow(n), (float)tiny, (float)(tiny * (1 + i % 2)));
        check_frame(&bound, a, inputs, 5);
    }
    test_report(&bound);
}

static void half_vector(const double wi[3], const double w[3], double h[3]) {
    int k;
    for (k = 0; k < 3; k++) h[k] = wi[k] + w[k];
    normalize(h);
}

/* Near the peak the exponent is that of the normal distribution at the half vector. */
static void ggx_curvature(void) {
    test_bound bound = test_bound_of("asg.h", "asg_reflection_lobe_aniso", "curvature");
    test_rng rng = {113 + test_seed};
    int i;
    for (i = 0; i < 20000; i++) {
        const double n[3] = {0, 0, 1};
        double wi[3], z[3], w[3], h[3], t[3], b[3], inputs[5], wanted, got, turn = 7 * test_uniform(&rng);
        double ax = test_log_uniform(&rng, 0.01, 1), ay = test_log_uniform(&rng, 0.01, 1), x, y;
        asg_lobe a;
        exact_asg exact;
        direction_near(&rng, n, acos(0.1 + 0.9 * test_uniform(&rng)), wi);
        widen(narrow(wi), wi);
        normalize(wi);
        t[0] = cos(turn);
        t[1] = sin(turn);
        t[2] = 0;
        cross(n, t, b);
        if (i % 4 == 0) ay = ax;
        a = asg_ggx_lobe_aniso(narrow(n), narrow(t), narrow(wi), (float)ax, (float)ay);
        if (i % 4 == 0) a = asg_ggx_lobe(narrow(n), narrow(wi), (float)ax);
        exact = exact_of(a);
        z[0] = -wi[0];
        z[1] = -wi[1];
        z[2] = wi[2];
        direction_near(&rng, z, 1e-3 * wi[2], w);
        half_vector(wi, w, h);
        x = dot(h, t) / ax;
        y = dot(h, b) / ay;
        wanted = x * x + y * y;
        x = dot(w, exact.x);
        y = dot(w, exact.y);
        got = exact.lx * x * x + exact.ly * y * y;
        inputs[0] = ax;
        inputs[1] = ay;
        inputs[2] = turn;
        inputs[3] = wi[2];
        inputs[4] = wi[0];
        /* relative to the sharper axis's share: the wide one alone is second order where they differ much */
        test_within(&bound, got, wanted, wanted + 1e-3 * exact.ly * 1e-6 * wi[2] * wi[2], inputs, 5);
    }
    test_report(&bound);
}

typedef enum { NDF_GGX, NDF_BECKMANN, NDF_WARD, NDF_PHONG, NDF_ASHIKHMIN, NDFS } ndf_kind;

typedef struct {
    double wi[3], x, y; /* roughness or exponent along x and y; the normal is z */
    ndf_kind kind;
} ndf_context;

/* A distribution of half vectors over its peak, at that of w */
static double ndf_value(const double w[3], const void *context) {
    const ndf_context *c = (const ndf_context *)context;
    double h[3], sine2, slope2;
    half_vector(c->wi, w, h);
    if (h[2] <= 1e-6) return 0;
    slope2 = (h[0] * h[0] / (c->x * c->x) + h[1] * h[1] / (c->y * c->y)) / (h[2] * h[2]);
    sine2 = fmax(h[0] * h[0] + h[1] * h[1], 1e-30);
    switch (c->kind) {
    case NDF_GGX:
        return pow(h[2] * h[2] * (1 + slope2), -2);
    case NDF_BECKMANN:
        return exp(-slope2) * pow(h[2], -4);
    case NDF_WARD:
        return exp(-slope2);
    case NDF_PHONG:
        return pow(h[2], c->x);
    default:
        return pow(h[2], (c->x * h[0] * h[0] + c->y * h[1] * h[1]) / sine2);
    }
}

static asg_lobe ndf_lobe(const ndf_context *c, int anisotropic) {
    const lobe_vec3 normal = lobe_vector(0, 0, 1), tangent = lobe_vector(1, 0, 0), wi = narrow(c->wi);
    const float x = (float)c->x, y = (float)c->y;
    switch (c->kind) {
    case NDF_GGX:
        return anisotropic ? asg_ggx_lobe_aniso(normal, tangent, wi, x, y) : asg_ggx_lobe(normal, wi, x);
    case NDF_BECKMANN:
        return anisotropic ? asg_beckmann_lobe_aniso(normal, tangent, wi, x, y) : asg_beckmann_lobe(normal, wi, x);
    case NDF_WARD:
        return asg_ward_lobe(normal, tangent, wi, x, y);
    case NDF_PHONG:
        return asg_phong_lobe(normal, wi, x);
    default:
        return asg_ashikhmin_lobe(normal, tangent, wi, x, y);
    }
}

static void lobes_match_distributions(void) {
    static const char *const names[NDFS] = {"asg_ggx_lobe", "asg_beckmann_lobe", "asg_ward_lobe", "asg_phong_lobe",
                                            "asg_ashikhmin_lobe"};
    test_rng rng = {114 + test_seed};
    int kind, i, k;
    for (kind = 0; kind < NDFS; kind++) {
        test_bound integral = test_bound_of("asg.h", names[kind], "integral");
        test_bound value = test_bound_of("asg.h", names[kind], "value");
        test_bound sharp = test_bound_of("asg.h", names[kind], "sharp");
        for (i = 0; i < test_few(60); i++) {
            const double n[3] = {0, 0, 1};
            test_bound *bound = i % 3 ? &value : &sharp;
            const int anisotropic = i % 2 && kind != NDF_PHONG, power = kind == NDF_PHONG || kind == NDF_ASHIKHMIN;
            ndf_context c;
            double inputs[4], z[3], wanted, width;
            asg_lobe a;
            c.kind = (ndf_kind)kind;
            c.x = inputs[0] = test_log_uniform(&rng, bound->low, bound->high);
            c.y = inputs[1] =
                anisotropic ? fmin(fmax(c.x * test_log_uniform(&rng, 0.3, 3), bound->low), bound->high) : c.x;
            if (i % 4 == 1 && anisotropic) c.y = inputs[1] = fmax(0.3 * c.x, bound->low); /* the worst are there */
            inputs[2] = i % 4 < 2 ? 0.4 : 0.4 + 0.6 * test_uniform(&rng);
            inputs[3] = kind;
            direction_near(&rng, n, acos(inputs[2]), c.wi);
            a = ndf_lobe(&c, anisotropic);
            widen(a.z, z);
            normalize(z);
            width = power ? sqrt(2 / fmax(c.x, c.y)) : fmin(c.x, c.y);
            wanted = reference_sphere_azimuth(ndf_value, &c, z, 1 / (width * width), anisotropic ? 256 : 64);
            if (bound == &value) test_within(&integral, (double)asg_integral(a), wanted, wanted, inputs, 4);
            for (k = 0; k < test_few(500); k++) {
                double w[3];
                direction_near(&rng, z, fmin(width * test_log_uniform(&rng, 0.1, 30), 3), w);
                test_within(bound, (double)asg_eval(a, narrow(w)), ndf_value(w, &c), 1, inputs, 4);
            }
        }
        test_report(&integral);
        test_report(&value);
        test_report(&sharp);
    }
}

/* All of them are one lobe under other names of its sharpness. */
static void lobes_agree(void) {
    test_rng rng = {128 + test_seed};
    int i;
    for (i = 0; i < test_few(110000); i++) {
        const float alpha = (float)test_log_uniform(&rng, 1e-3, 1), sharpness = 1 / (alpha * alpha);
        double n[3], w[3], t[3], inputs[1];
        asg_lobe a, b;
        inputs[0] = (double)alpha;
        test_direction(&rng, n);
        direction_near(&rng, n, acos(0.1 + 0.9 * test_uniform(&rng)), w);
        direction_near(&rng, n, REFERENCE_PI / 2, t);
        a = asg_reflection_lobe(narrow(n), narrow(w), sharpness);
        b = asg_phong_lobe(narrow(n), narrow(w), 2 * sharpness);
        test_that(a.sharpness_x == b.sharpness_x && a.sharpness_y == b.sharpness_y, "Phong by exponent", inputs, 1);
        b = asg_beckmann_lobe(narrow(n), narrow(w), alpha);
        test_that(fabs((double)(a.sharpness_y / b.sharpness_y) - 1) < 1e-6, "Beckmann by roughness", inputs, 1);
        a = asg_reflection_lobe_aniso(narrow(n), narrow(t), narrow(w), sharpness, 9 * sharpness);
        b = asg_ashikhmin_lobe(narrow(n), narrow(t), narrow(w), 2 * sharpness, 18 * sharpness);
        test_that(a.sharpness_x == b.sharpness_x && a.sharpness_y == b.sharpness_y, "Ashikhmin by exponents", inputs,
                  1);
        b = asg_ward_lobe(narrow(n), narrow(t), narrow(w), alpha, alpha / 3);
        test_that(fabs((double)(a.sharpness_x / b.sharpness_x) - 1) < 1e-5 &&
                      fabs((double)(a.sharpness_y / b.sharpness_y) - 1) < 1e-5,
                  "Ward by roughness", inputs, 1);
        a = asg_beckmann_lobe_aniso(narrow(n), narrow(t), narrow(w), alpha, alpha / 3);
        test_that(fabs((double)(a.sharpness_x / b.sharpness_x) - 1) < 1e-5 &&
                      fabs((double)(a.sharpness_y / b.sharpness_y) - 1) < 1e-5,
                  "Beckmann as Ward", inputs, 1);
        if (i % 16) continue;
        a = asg_reflection_lobe_aniso(narrow(n), narrow(t), narrow(w), 0, 0);
        test_that(a.sharpness_x == 0 && a.sharpness_y == 0, "sharpness 0 stays 0", inputs, 1);
    }
}

/* ---- virtual spherical Gaussian lights ---- */

static double smith(double alpha, double ci, double co) {
    double a2 = alpha * alpha;
    return 0.5 / (co * sqrt(a2 + (1 - a2) * ci * ci) + ci * sqrt(a2 + (1 - a2) * co * co));
}

typedef struct {
    vsgl light;
    asg_lobe lobe;
    double point[3], normal[3], wi[3], alpha;
} shading;

/* A light above a surface, roughly where the surface mirrors the viewer. */
static shading make_shading(test_rng *rng, double distance, double variance, double alpha, double spread) {
    shading s;
    double position[3], mirror[3], toward[3], emission[3];
    int k;
    test_direction(rng, s.normal);
    widen(narrow(s.normal), s.normal);
    direction_near(rng, s.normal, acos(0.3 + 0.7 * test_uniform(rng)), s.wi);
    widen(narrow(s.wi), s.wi);
    s.alpha = (double)(float)alpha;
    for (k = 0; k < 3; k++) mirror[k] = 2 * dot(s.normal, s.wi) * s.normal[k] - s.wi[k];
    normalize(mirror);
    direction_near(rng, mirror, spread * alpha * test_uniform(rng), toward);
    for (k = 0; k < 3; k++) {
        s.point[k] = 0;
        position[k] = distance * toward[k];
        emission[k] = -toward[k];
    }
    direction_near(rng, emission, 0.5 * test_uniform(rng), emission);
    s.light.position = narrow(position);
    s.light.variance = (float)variance;
    for (k = 0; k < 2; k++) {
        s.light.emission[k] = sg_around(emission, test_log_uniform(rng, 0.5, 50));
        s.light.intensity[k] = lobe_vector(1, 1, 1);
    }
    s.lobe = asg_ggx_lobe(narrow(s.normal), narrow(s.wi), (float)s.alpha);
    return s;
}

static float shade(const shading *s) {
    return asg_vsgl_specular(s->light, VSGL_SPECULAR, narrow(s->point), narrow(s->normal), narrow(s->wi),
                             (float)s->alpha, s->lobe);
}

static double incoming(const shading *s, double axis[3], double *log_peak, double *inverse_variance) {
    double offset[3], emission[3];
    int k;
    widen(s->light.position, offset);
    widen(s->light.emission[VSGL_SPECULAR].axis, emission);
    for (k = 0; k < 3; k++) offset[k] -= s->point[k];
    *inverse_variance = 1 / fmax((double)s->light.variance, 1e-20);
    return exact_incoming(offset, emission, (double)s->light.emission[VSGL_SPECULAR].sharpness, *inverse_variance, axis,
                          log_peak);
}

/* Section 4.2 of 000 in double. */
static double shade_exactly(const shading *s, double *exponent, double *cosine) {
    exact_asg a = exact_of(s->lobe);
    double axis[3], log_peak, inverse_variance, nu = 0.5 * incoming(s, axis, &log_peak, &inverse_variance), co, x, y;
    x = dot(axis, a.x);
    y = dot(axis, a.y);
    co = fmax(dot(axis, s->normal), 0);
    *cosine = fmin(co, dot(axis, a.z));
    *exponent = log_peak - a.lx * nu / (a.lx + nu) * x * x - a.ly * nu / (a.ly + nu) * y * y;
    return exp(*exponent) * 0.5 * inverse_variance / sqrt((a.lx + nu) * (a.ly + nu)) * fmax(dot(axis, a.z), 0) * co *
           smith(s->alpha, dot(s->wi, s->normal), co) / (REFERENCE_PI * s->alpha * s->alpha);
}

static void specular_rounds(void) {
    test_bound bound = test_bound_of("asg.h", "asg_vsgl_specular", "directional");
    test_rng rng = {115 + test_seed};
    int i;
    for (i = 0; i < 2 * test_draws(25000); i++) {
        double inputs[3], wanted, exponent, co, distance = test_log_uniform(&rng, 1e-3, 1e4);
        double variance = i % 3 ? test_log_uniform(&rng, 1e-20, 1e6) : 0, alpha = test_log_uniform(&rng, 0.01, 1);
        shading s = make_shading(&rng, distance, variance, alpha, i % 2 ? 1 : 3);
        inputs[0] = distance;
        inputs[1] = variance;
        inputs[2] = alpha;
        wanted = shade_exactly(&s, &exponent, &co);
        if (exponent < -70 || co < 0.1 || wanted < 1e-36) continue;
        test_within(&bound, (double)shade(&s), wanted,
                    wanted * directional((double)fmaxf(s.lobe.sharpness_x, s.lobe.sharpness_y), exponent), inputs, 3);
    }
    test_report(&bound);
}

static void specular_point_light(void) {
    test_bound bound = test_bound_of("asg.h", "asg_vsgl_specular", "directional");
    test_rng rng = {116 + test_seed};
    int i;
    for (i = 0; i < 20000; i++) {
        double distance = test_log_uniform(&rng, 1e-3, 1e4), alpha = test_log_uniform(&rng, 0.1, 1), inputs[3], wanted;
        double toward[3], emission[3], co, exponent, variance = i % 2 ? 0 : 1e-9 * distance * distance;
        shading s = make_shading(&rng, distance, variance, alpha, i % 4 < 2 ? 1 : 3);
        exact_asg a = exact_of(s.lobe);
        sg_lobe light = s.light.emission[VSGL_SPECULAR];
        widen(s.light.position, toward);
        widen(light.axis, emission);
        normalize(emission);
        distance = sqrt(dot(toward, toward));
        normalize(toward);
        co = dot(toward, s.normal);
        if (fmin(co, dot(toward, a.z)) < 0.1) continue;
        exponent = (double)light.sharpness * (-dot(toward, emission) - 1) - a.lx * pow(dot(toward, a.x), 2) -
                   a.ly * pow(dot(toward, a.y), 2);
        wanted = exp(exponent) / (distance * distance) * dot(toward, a.z) * co *
                 smith(s.alpha, dot(s.wi, s.normal), co) / (REFERENCE_PI * s.alpha * s.alpha);
        if (wanted < 1e-36 || exponent < -70) continue;
        inputs[0] = distance;
        inputs[1] = variance;
        inputs[2] = alpha;
        test_within(&bound, (double)shade(&s), wanted, wanted * directional(fmax(a.lx, a.ly), exponent), inputs, 3);
    }
    test_report(&bound);
}

typedef struct {
    const shading *s;
    exact_asg lobe;
    double axis[3], sharpness;
} specular_context;

static double specular_value(const double w[3], const void *context) {
    const specular_context *c = (const specular_context *)context;
    double co = dot(w, c->s->normal);
    return co > 0 ? exp(c->sharpness * (dot(w, c->axis) - 1)) * exact_eval(&c->lobe, w) * co *
                        smith(c->s->alpha, dot(c->s->wi, c->s->normal), co)
                  : 0;
}

static void specular_matches_quadrature(void) {
    test_bound bound = test_bound_of("asg.h", "asg_vsgl_specular", "model");
    test_rng rng = {117 + test_seed};
    int i;
    for (i = 0; i < 60; i++) {
        double distance = 1 + 2 * test_uniform(&rng), inputs[3], wanted, log_peak, inverse_variance;
        specular_context c;
        shading s;
        inputs[0] = distance;
        inputs[1] = test_log_uniform(&rng, 1e-4, 1e-2) * distance * distance;
        inputs[2] = test_log_uniform(&rng, bound.low, bound.high);
        s = make_shading(&rng, distance, inputs[1], inputs[2], 1);
        c.s = &s;
        c.lobe = exact_of(s.lobe);
        c.sharpness = incoming(&s, c.axis, &log_peak, &inverse_variance);
        if (dot(c.axis, s.normal) < 0.2) continue;
        wanted = reference_sphere(specular_value, &c, c.axis, c.sharpness) * exp(log_peak) * inverse_variance /
                 (2 * REFERENCE_PI * REFERENCE_PI * s.alpha * s.alpha);
        test_within(&bound, (double)shade(&s), wanted, wanted, inputs, 3);
    }
    test_report(&bound);
}

/* ---- finite in, finite out ---- */

/* 0, or a size between 1e-30 and a limit of either sign. */
static float wild(test_rng *rng, double limit) {
    double sign = test_uniform(rng) < 0.5 ? -1 : 1;
    return test_uniform(rng) < 0.1 ? 0.0f : (float)(sign * test_log_uniform(rng, 1e-30, limit));
}

static lobe_vec3 wild_direction(test_rng *rng) {
    static const double corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    double v[3];
    if (test_uniform(rng) < 0.3) return narrow(corner[(int)(6 * test_uniform(rng))]);
    test_direction(rng, v);
    if (test_uniform(rng) < 0.1) v[2] = 1e-8 * v[2];
    normalize(v);
    return narrow(v);
}

static asg_lobe wild_lobe(test_rng *rng) {
    double z[3];
    asg_lobe a;
    widen(wild_direction(rng), z);
    normalize(z);
    a = lobe_around(z, test_uniform(rng) < 0.3 ? 0 : 7 * test_uniform(rng), fabs((double)wild(rng, 1e30)),
                    fabs((double)wild(rng, 1e30)));
    if (test_uniform(rng) < 0.2) a.sharpness_y = a.sharpness_x;
    a.log_amplitude = wild(rng, 1e30);
    return a;
}

static int finite_lobe(asg_lobe a) {
    return test_is_finite(a.x.x) && test_is_finite(a.x.y) && test_is_finite(a.x.z) && test_is_finite(a.y.x) &&
           test_is_finite(a.y.y) && test_is_finite(a.y.z) && test_is_finite(a.z.x) && test_is_finite(a.z.y) &&
           test_is_finite(a.z.z) && test_is_finite(a.sharpness_x) && test_is_finite(a.sharpness_y) &&
           test_is_finite(a.log_amplitude);
}

static void finite_everywhere(void) {
    test_rng rng = {118 + test_seed};
    int i, k;
    for (i = 0; i < test_draws(200000); i++) {
        asg_lobe a = wild_lobe(&rng), b = test_uniform(&rng) < 0.1 ? a : wild_lobe(&rng);
        lobe_vec3 n = wild_direction(&rng), w = wild_direction(&rng), t = wild_direction(&rng);
        float alpha_x = fabsf(wild(&rng, 1)), alpha_y = fabsf(wild(&rng, 1)),
              kappa = lobe_max(fabsf(wild(&rng, 1e30)), 1e-30f);
        sg_lobe g;
        vsgl v;
        double inputs[12];
        g.axis = wild_direction(&rng);
        g.sharpness = fabsf(wild(&rng, 1e30));
        g.log_amplitude = wild(&rng, 1e30);
        if (i % 3 == 0) a.z = lobe_scale(n, -1);
        if (i % 5 == 0) w = n;
        v.position = lobe_scale(wild_direction(&rng), fabsf(wild(&rng, 5e4)));
        v.variance = fabsf(wild(&rng, 1e10));
        for (k = 0; k < 2; k++) {
            v.emission[k].axis = wild_direction(&rng);
            v.emission[k].sharpness = fabsf(wild(&rng, 1e30));
            v.emission[k].log_amplitude = i & 1 ? 0 : wild(&rng, 1e30);
            v.intensity[k] = n;
        }
        inputs[0] = (double)a.sharpness_x;
        inputs[1] = (double)a.sharpness_y;
        inputs[2] = (double)b.sharpness_x;
        inputs[3] = (double)b.sharpness_y;
        inputs[4] = (double)g.sharpness;
        inputs[5] = (double)a.log_amplitude;
        inputs[6] = (double)b.log_amplitude;
        inputs[7] = (double)g.log_amplitude;
        inputs[8] = (double)kappa;
        inputs[9] = (double)alpha_x;
        inputs[10] = (double)v.variance;
        inputs[11] = (double)v.position.x;
        test_that(test_is_finite(asg_eval(a, w)), "asg_eval is finite", inputs, 12);
        test_that(test_is_finite(asg_integral(a)), "asg_integral is finite", inputs, 12);
        test_that(test_is_finite(asg_integral_approx(a)), "asg_integral_approx is finite", inputs, 12);
        test_that(test_is_finite(asg_sg_integral(a, g)), "asg_sg_integral is finite", inputs, 12);
        test_that(test_is_finite(asg_sg_integral_xu(a, g)), "asg_sg_integral_xu is finite", inputs, 12);
        test_that(test_is_finite(asg_product_integral(a, b)), "asg_product_integral is finite", inputs, 12);
        test_that(test_is_finite(asg_product_integral_xu(a, b)), "asg_product_integral_xu is finite", inputs, 12);
        test_that(finite_lobe(asg_convolve(a, kappa)), "asg_convolve is finite", inputs, 12);
        b = asg_ggx_lobe(n, w, alpha_x);
        test_that(finite_lobe(b), "asg_ggx_lobe is finite", inputs, 12);
        test_that(finite_lobe(asg_ggx_lobe_aniso(n, t, w, alpha_x, alpha_y)), "asg_ggx_lobe_aniso is finite", inputs,
                  12);
        test_that(finite_lobe(asg_ashikhmin_lobe(n, t, w, 1e9f * alpha_x, 1e9f * alpha_y)),
                  "asg_ashikhmin_lobe is finite", inputs, 12);
        test_that(finite_lobe(asg_phong_lobe(n, w, 1e9f * alpha_x)), "asg_phong_lobe is finite", inputs, 12);
        test_that(test_is_finite(asg_isotropic(a).sharpness), "asg_isotropic is finite", inputs, 12);
        k = asg_sg_form(a, g.sharpness, alpha_x);
        test_that(k == ASG_FORM_SG || k == ASG_FORM_XU || k == ASG_FORM_ACCURATE, "asg_sg_form is one", inputs, 12);
        test_that(test_is_finite(asg_vsgl_specular(v, i & 1, lobe_scale(t, alpha_x), n, w, alpha_x, b)),
                  "asg_vsgl_specular is finite", inputs, 12);
        test_that(test_is_finite(asg_vsgl_specular(v, i & 1, v.position, n, w, alpha_y, a)),
                  "asg_vsgl_specular is finite at the light and for any lobe", inputs, 12);
    }
}

const test_case asg_tests[] = {
    {"asg_eval", eval_matches},
    {"asg_eval_named_cases", eval_named_cases},
    {"asg_integral", integral_matches},
    {"asg_quadratures_agree", quadratures_agree},
    {"asg_sg_integral", sg_integrals_match},
    {"asg_sg_integral_formula", sg_integral_rounds},
    {"asg_sg_integral_gains", sg_integral_gains},
    {"asg_sg_form", form_keeps_its_word},
    {"asg_sg_form_named_cases", form_named_cases},
    {"asg_sg_form_thresholds", form_thresholds},
    {"asg_amplitudes", amplitudes},
    {"asg_sg_integral_xu_saturates", xu_saturates},
    {"asg_isotropic", isotropic_matches},
    {"asg_sg_integral_below_aligned", sg_integrals_stay_below_aligned},
    {"asg_sg_integral_sharp_limit", sg_integrals_sharp_limit},
    {"asg_product_integral", products_match},
    {"asg_product_integral_formula", product_rounds},
    {"asg_product_integral_rounding", products_round},
    {"asg_product_integral_xu", xu_needs_no_eigenvectors},
    {"asg_product_integral_bounds", products_are_bounded},
    {"asg_extremes", extremes_saturate},
    {"asg_opposed_lobes", opposed_lobes_part},
    {"asg_convolve", convolve_widens},
    {"asg_convolve_consistent", convolve_is_consistent},
    {"asg_convolve_quadrature", convolve_matches_quadrature},
    {"asg_ggx_frames", ggx_frames},
    {"asg_frames_of_little", frames_of_little},
    {"asg_ggx_curvature", ggx_curvature},
    {"asg_lobes_match_distributions", lobes_match_distributions},
    {"asg_lobes_agree", lobes_agree},
    {"asg_vsgl_specular_rounding", specular_rounds},
    {"asg_vsgl_specular_point_light", specular_point_light},
    {"asg_vsgl_specular_quadrature", specular_matches_quadrature},
    {"asg_finite", finite_everywhere},
    {0, 0},
};
