/* Unit tests of bilateral.h but for anisotropic lobes: against closed forms in double, which are held to quadrature. */
#include "../bilateral.h"
#include "exact.h"
#include <stdio.h>

enum { MOST_LOBES = 3, PART_PLANES = 6 };

static double log_uniform(double low, double high) {
    return test_log_uniform(&test_random, low, high);
}

static double uniform(void) {
    return test_uniform(&test_random);
}

static int pick(int count) {
    return (int)(uniform() * count);
}

static test_bound bound_of(const char *function, const char *kind) {
    return test_bound_of("bilateral.h", function, kind);
}

static sg_lobe lobe_of(vec axis, double sharpness, double log_amplitude) {
    sg_lobe g;
    g.axis = narrow(axis);
    g.sharpness = (float)sharpness;
    g.log_amplitude = (float)log_amplitude;
    return g;
}

/* ---- two pixels in double ---- */

/* ln of the overlap's root: of lengths' variances or of widths */
static double log_overlap(double a, double b) {
    return -log1p((a - b) * (a - b) / (4 * a * b));
}

static double exact_sg_log_weight(sg_lobe i, sg_lobe j, double beta) {
    double li = (double)i.sharpness, lj = (double)j.sharpness, chord = distance(unit(wide(i.axis)), unit(wide(j.axis)));
    return beta * (0.5 * log_overlap(li, lj) - 0.5 * chord * chord * li * (lj / (li + lj)));
}

static double exact_log_product(const sg_lobe *i, int ni, const sg_lobe *j, int nj) {
    double term[MOST_LOBES * MOST_LOBES], top = -HUGE_VAL, sum = 0;
    int l, m, count = 0;
    for (l = 0; l < ni; l++) {
        for (m = 0; m < nj; m++) {
            exact_product p = multiply_lobes(i[l], j[m]);
            term[count] =
                (double)i[l].log_amplitude + (double)j[m].log_amplitude + p.log_loss + log(exact_integral(p.sharpness));
            top = fmax(top, term[count++]);
        }
    }
    for (l = 0; l < count; l++) sum += exp(term[l] - top);
    return top + log(sum);
}

/* ln q of Eq. 11 */
static double exact_log_similarity(const sg_lobe *i, int ni, const sg_lobe *j, int nj) {
    return fmin(
        exact_log_product(i, ni, j, nj) - 0.5 * (exact_log_product(i, ni, i, ni) + exact_log_product(j, nj, j, nj)), 0);
}

/* The unit of the same name of bilateral.h */
static double similarity(double log_weight, double beta, double sharpness) {
    double e = -log_weight, l = beta * sharpness;
    return exp(log_weight) * (1 + e + beta + sqrt(l * e) + TEST_EPSILON * l) * TEST_EPSILON + 2 * (double)FLT_MIN;
}

static sg_lobe random_lobe(double low, double high) {
    vec axis = random_direction();
    return lobe_of(axis, log_uniform(low, high), 0);
}

/* Another lobe: equal, near, opposed or anywhere, so that the weight is not always 0 */
static sg_lobe other_lobe(sg_lobe i, double low, double high, double beta) {
    vec axis = unit(wide(i.axis));
    double l = pick(2) ? log_uniform(low, high) : (double)i.sharpness * log_uniform(0.9, 1.1);
    double angle = fmin(4 * uniform() / sqrt(1 + beta * fmin(l, (double)i.sharpness)), 3);
    l = fmin(fmax(l, low), high);
    switch (pick(6)) {
    case 0:
        return lobe_of(axis, l, 0);
    case 1:
        return lobe_of(turned(axis, 1e-7), l, 0);
    case 2:
        return lobe_of(combine(-1, axis, 0, axis), l, 0);
    case 3:
        return lobe_of(random_direction(), l, 0);
    default:
        return lobe_of(turned(axis, angle), l, 0);
    }
}

static void inputs_of(sg_lobe i, sg_lobe j, double beta, double inputs[9]) {
    inputs[0] = (double)i.axis.x, inputs[1] = (double)i.axis.y, inputs[2] = (double)i.axis.z;
    inputs[3] = (double)i.sharpness;
    inputs[4] = (double)j.axis.x, inputs[5] = (double)j.axis.y, inputs[6] = (double)j.axis.z;
    inputs[7] = (double)j.sharpness;
    inputs[8] = beta;
}

/* ---- Eqs. 3, 4 and section 3 ---- */

static void logarithm_matches(void) {
    test_bound bound = bound_of("lobe_bilateral_log2", "abs");
    unsigned bits;
    for (bits = 0x00800000u; bits < 0x7F000000u; bits += 997) {
        float x;
        double input;
        memcpy(&x, &bits, sizeof x);
        input = (double)x;
        test_within(&bound, (double)lobe_bilateral_log2(x), log2(input), fmax(1, 0.25 * fabs(log2(input))), &input, 1);
    }
    test_that(lobe_bilateral_log2(1) == 0, "the logarithm of 1", NULL, 0);
    test_report(&bound);
}

static void guides_match(void) {
    test_bound depth = bound_of("bilateral_depth_weight", "conditioned");
    test_bound normal = bound_of("bilateral_normal_weight", "conditioned");
    test_bound tap = bound_of("bilateral_normal_tap", "similarity");
    test_bound scale = bound_of("bilateral_scale", "ulp"), exponent = bound_of("bilateral_depth_exponent", "ulp");
    int k;
    for (k = 0; k < test_draws(200000); k++) {
        double inputs[9], variance = (double)(float)log_uniform(depth.low, depth.high), e, d, wanted;
        float z[2], s;
        sg_lobe i, j;
        z[0] = (float)(log_uniform(1e-3, 1e3) * (pick(2) ? 1 : -1));
        z[1] = (float)((double)z[0] + 6 * (uniform() - 0.5) * sqrt(variance));
        d = (double)z[0] - (double)z[1];
        e = 0.5 * d * d / variance;
        inputs[0] = (double)z[0], inputs[1] = (double)z[1], inputs[2] = variance;
        test_within(&depth, (double)bilateral_depth_weight(z[0], z[1], (float)variance), exp(-e),
                    exp(-e) * (1 + e) * TEST_EPSILON + 2 * (double)FLT_MIN, inputs, 3);
        d *= d;
        test_within(&exponent, (double)bilateral_depth_exponent(z[0], z[1]), -d, test_ulp(d), inputs, 3);
        variance = (double)(float)log_uniform(scale.low, scale.high);
        wanted = sqrt(0.5 / variance / log(2));
        test_within(&scale, (double)bilateral_scale((float)variance), wanted, test_ulp(wanted), &variance, 1);

        variance = (double)(float)log_uniform(normal.low, normal.high);
        i = random_lobe(1, 1);
        i.sharpness = (float)(1 / variance);
        j = other_lobe(i, 1e-20, 1e20, 1);
        inputs_of(i, j, variance, inputs);
        d = distance(unit(wide(i.axis)), unit(wide(j.axis)));
        e = 0.5 * d * d / variance;
        test_within(&normal, (double)bilateral_normal_weight(i.axis, j.axis, (float)variance), exp(-e),
                    exp(-e) * (1 + e) * TEST_EPSILON + 2 * (double)FLT_MIN, inputs, 9);
        if (variance < tap.low) continue;
        s = bilateral_scale((float)variance);
        test_within(&tap, (double)bilateral_normal_tap(0, lobe_scale(i.axis, s), lobe_scale(j.axis, s)), exp(-e),
                    similarity(-e, 1, 1 / variance), inputs, 9);
    }
    test_report(&depth);
    test_report(&normal);
    test_report(&tap);
    test_report(&scale);
    test_report(&exponent);
}

static double gaussian_log_weight(double d, double vi, double vj, double beta) {
    return beta * (0.25 * log_overlap(vi, vj) - 0.5 * d * d / (vi + vj));
}

static void gaussians_match(void) {
    test_bound bound = bound_of("bilateral_gaussian_weight", "similarity");
    int k;
    for (k = 0; k < test_few(100000); k++) {
        double inputs[5], d, wanted;
        inputs[0] = 0; /* exact means: their rounding is the caller's */
        inputs[2] = log_uniform(bound.low, bound.high);
        inputs[3] = pick(3) ? inputs[2] * log_uniform(0.5, 2) : log_uniform(bound.low, bound.high);
        inputs[4] = (double)(float)log_uniform(1e-3, 1e3);
        inputs[1] = 3 * (uniform() - 0.5) * sqrt((inputs[2] + inputs[3]) / inputs[4]);
        for (d = 0; d < 4; d++) inputs[(int)d] = (double)(float)inputs[(int)d];
        wanted = gaussian_log_weight(inputs[1], inputs[2], inputs[3], inputs[4]);
        test_within(&bound,
                    (double)bilateral_gaussian_weight((float)inputs[0], (float)inputs[2], (float)inputs[1],
                                                      (float)inputs[3], (float)inputs[4]),
                    exp(wanted), similarity(wanted, inputs[4], 0), inputs, 5);
    }
    test_that(bilateral_gaussian_weight(1, 1e-20f, 1, 1e-18f, 1) > 0.999999f, "variances below 1e-18 are alike", 0, 0);
    test_report(&bound);
}

/* Eqs. 7 and 8 as they stand, by the trapezoid rule */
static void gaussian_is_a_product_integral(void) {
    int k;
    for (k = 0; k < 50; k++) {
        double vi = log_uniform(0.1, 10), vj = log_uniform(0.1, 10), d = 6 * (uniform() - 0.5), x, s[3] = {0, 0, 0}, q;
        for (x = -60; x < 60; x += 0.01) {
            double a = exp(-0.5 * x * x / vi), b = exp(-0.5 * (x - d) * (x - d) / vj);
            s[0] += a * b;
            s[1] += a * a;
            s[2] += b * b;
        }
        q = s[0] / sqrt(s[1] * s[2]);
        test_that(fabs(exp(gaussian_log_weight(d, vi, vj, 1)) - q) < 1e-9, "the closed form is the integral", &d, 1);
    }
}

/* ---- Eq. 12 ---- */

static void sg_weights_match(void) {
    test_bound bound = bound_of("bilateral_sg_weight", "similarity"), tap = bound_of("bilateral_sg_tap", "similarity");
    test_bound power = bound_of("bilateral_sg_tap_power", "similarity");
    test_bound row = bound_of("bilateral_sg_taps", "similarity");
    int k;
    for (k = 0; k < 2 * test_draws(100000); k++) {
        int half = 1 + pick(15);
        double beta = k % 2 ? 2 * half : (double)(float)log_uniform(1e-3, 1e3), inputs[9], wanted, size;
        sg_lobe i = random_lobe(bound.low, bound.high), j = other_lobe(i, bound.low, bound.high, beta);
        bilateral_sg a = bilateral_sg_prepare(i, (float)beta), b = bilateral_sg_prepare(j, (float)beta);
        float weight = -1.5f;
        const float *planes[2][4];
        planes[0][0] = &a.axis.x, planes[0][1] = &a.axis.y, planes[0][2] = &a.axis.z, planes[0][3] = &a.width;
        planes[1][0] = &b.axis.x, planes[1][1] = &b.axis.y, planes[1][2] = &b.axis.z, planes[1][3] = &b.width;
        inputs_of(i, j, beta, inputs);
        wanted = exact_sg_log_weight(i, j, beta);
        size = fmin((double)i.sharpness, (double)j.sharpness);
        test_within(&bound, (double)bilateral_sg_weight(i, j, (float)beta), exp(wanted), similarity(wanted, beta, size),
                    inputs, 9);
        test_within(&tap, (double)bilateral_sg_tap(0, a, b, (float)beta), exp(wanted), similarity(wanted, beta, size),
                    inputs, 9);
        if (k % 2) {
            test_within(&power, (double)bilateral_sg_tap_power(0, a, b, half), exp(wanted),
                        similarity(wanted, beta, size) + 3 * TEST_EPSILON * beta / power.limit, inputs, 9);
        }
        bilateral_sg_taps(1, planes[0], planes[1], (float)beta, &weight);
        test_within(&row, (double)weight, exp(wanted) * exp2(-1.5), similarity(wanted, beta, size), inputs, 9);
    }
    test_report(&bound);
    test_report(&tap);
    test_report(&power);
    test_report(&row);
}

/* Fig. 4 of 004: Eqs. 11 and 12 of one lobe each for beta 20 */
static void sg_weight_is_near_the_integral(void) {
    test_bound model = bound_of("bilateral_sg_weight", "model"), sharp = bound_of("bilateral_sg_weight", "sharp");
    double last = 1;
    int k;
    for (k = 0; k < test_few(100000); k++) {
        double inputs[9], low = k % 2 ? sharp.low : model.low;
        sg_lobe i = random_lobe(low, k % 2 ? sharp.high : model.high), j = other_lobe(i, low, model.high, 20);
        test_bound *bound = k % 2 ? &sharp : &model;
        inputs_of(i, j, 20, inputs);
        test_within(bound, (double)bilateral_sg_weight(i, j, 20), (double)bilateral_sg_mixture_weight(&i, 1, &j, 1, 20),
                    1, inputs, 9);
    }
    for (k = 0; k < 5; k++) { /* the sharper, the nearer; far off for sharpness 1 */
        double l = pow(10, k), worst = 0, angle;
        for (angle = 0; angle <= REFERENCE_PI; angle += 0.001) {
            lobe_vec3 up = lobe_vector(0, 0, 1);
            sg_lobe i, j;
            i.axis = up;
            j.axis = lobe_vector((float)sin(angle), 0, (float)cos(angle));
            i.sharpness = j.sharpness = (float)l;
            i.log_amplitude = j.log_amplitude = 0;
            worst = fmax(worst,
                         fabs((double)(bilateral_sg_weight(i, j, 20) - bilateral_sg_mixture_weight(&i, 1, &j, 1, 20))));
        }
        test_that(worst < last && (k > 0 || worst > 0.05), "Eq. 12 nears Eq. 11", &l, 1);
        last = worst;
    }
    test_report(&model);
    test_report(&sharp);
}

/* ---- Eq. 11 ---- */

typedef struct {
    sg_lobe lobe[MOST_LOBES];
    int count;
} mixture;

/* Lobes about one direction, as those of a BRDF are, or anywhere */
static mixture random_mixture(vec axis, double low, double high) {
    mixture m;
    int l;
    m.count = 1 + pick(MOST_LOBES);
    for (l = 0; l < m.count; l++) {
        double angle = 0.3 * uniform();
        vec a = pick(3) ? turned(axis, angle) : pick(2) ? axis : random_direction();
        double sharpness = log_uniform(low, high);
        m.lobe[l] = lobe_of(a, sharpness, 4 * (uniform() - 0.5));
    }
    return m;
}

static mixture other_mixture(const mixture *i, vec axis, double low, double high) {
    mixture m = *i;
    vec other;
    int l;
    switch (pick(5)) {
    case 0:
        return random_mixture(axis, low, high);
    case 1:
        return random_mixture(random_direction(), low, high);
    case 2:
        return m;
    case 3: /* opposed lobe by lobe, the hard case */
        for (l = 0; l < m.count; l++) {
            double angle = log_uniform(1e-5, 0.5), ratio = pick(2) ? 1 : log_uniform(0.9, 1.1);
            other = unit(wide(m.lobe[l].axis));
            m.lobe[l] =
                lobe_of(turned(combine(-1, other, 0, other), angle),
                        fmin(fmax((double)m.lobe[l].sharpness * ratio, low), high), (double)m.lobe[l].log_amplitude);
        }
        return m;
    default:
        break;
    }
    for (l = 0; l < m.count; l++) {
        double angle = 2 * uniform() / sqrt(1 + (double)m.lobe[l].sharpness);
        other = turned(unit(wide(m.lobe[l].axis)), angle);
        m.lobe[l] = lobe_of(other, fmin(fmax((double)m.lobe[l].sharpness * log_uniform(0.8, 1.25), low), high),
                            (double)m.lobe[l].log_amplitude);
    }
    return m;
}

static void mixture_inputs(const mixture *i, const mixture *j, double *inputs) {
    int l;
    for (l = 0; l < MOST_LOBES; l++) {
        inputs[2 * l] = l < i->count ? (double)i->lobe[l].sharpness : 0;
        inputs[2 * l + 1] = l < j->count ? (double)j->lobe[l].sharpness : 0;
    }
}

/* The same number of planes for each: parts of amplitude 0 make up for lobes that are missing. */
static void prepare(const mixture *m, bilateral_sg_part parts[MOST_LOBES], const float *planes[]) {
    int l;
    memset(parts, 0, MOST_LOBES * sizeof *parts);
    for (l = 0; l < MOST_LOBES; l++) parts[l].axis.z = parts[l].sharpness = 1;
    bilateral_sg_mixture_prepare(m->lobe, m->count, parts);
    for (l = 0; l < MOST_LOBES; l++) {
        const float **plane = planes + PART_PLANES * l;
        plane[0] = &parts[l].axis.x, plane[1] = &parts[l].axis.y, plane[2] = &parts[l].axis.z;
        plane[3] = &parts[l].sharpness, plane[4] = &parts[l].amplitude, plane[5] = &parts[l].tail;
    }
}

static float product_of(const bilateral_sg_part *i, const bilateral_sg_part *j) {
    float sum = 0;
    int l, m;
    for (l = 0; l < MOST_LOBES; l++) {
        for (m = 0; m < MOST_LOBES; m++) sum += bilateral_sg_pair(i[l], j[m]);
    }
    return sum;
}

static double sharpest(const mixture *i, const mixture *j) {
    double most = 0;
    int l;
    for (l = 0; l < i->count; l++) most = fmax(most, (double)i->lobe[l].sharpness);
    for (l = 0; l < j->count; l++) most = fmax(most, (double)j->lobe[l].sharpness);
    return most;
}

/* Whether two axes, of one mixture or of both, are more than 150 degrees apart */
static int far_apart(const mixture *i, const mixture *j) {
    sg_lobe all[2 * MOST_LOBES];
    int l, m, count = 0;
    for (l = 0; l < i->count; l++) all[count++] = i->lobe[l];
    for (l = 0; l < j->count; l++) all[count++] = j->lobe[l];
    for (l = 0; l < count; l++) {
        for (m = 0; m < l; m++) {
            if (dot(wide(all[l].axis), wide(all[m].axis)) < -0.8660254) return 1;
        }
    }
    return 0;
}

static void mixtures_match(void) {
    test_bound bound = bound_of("bilateral_sg_mixture_weight", "similarity");
    test_bound tap = bound_of("bilateral_sg_mixture_tap", "similarity");
    test_bound row = bound_of("bilateral_sg_mixture_taps", "similarity");
    test_bound below = bound_of("bilateral_sg_mixture_tap", "below");
    test_bound apart = bound_of("bilateral_sg_mixture_tap", "apart");
    test_bound opposed = bound_of("bilateral_sg_mixture_tap", "opposed");
    test_bound dropped = bound_of("bilateral_sg_mixture_tap", "dropped");
    test_bound wide_lobes = bound_of("bilateral_sg_mixture_tap", "wide");
    int k;
    for (k = 0; 10 * k < test_draws(1000000); k++) { /* nine pairs of lobes each */
        double inputs[2 * MOST_LOBES + 1], log_q, unit_of_q, beta = (double)(float)log_uniform(1e-3, 1e3);
        double low = k % 3 ? bound.low : 16, high = k % 3 == 1 ? 20 : k % 3 == 2 ? bound.high : tap.high;
        vec axis = random_direction();
        mixture i, j;
        bilateral_sg_part a[MOST_LOBES], b[MOST_LOBES];
        const float *planes[2][PART_PLANES * MOST_LOBES];
        float weight = -1.5f, product;
        if (k % 2) low = fmax(low, k % 4 == 1 ? tap.low : below.low);
        if (k % 6 == 4) low = 1e-8;
        i = random_mixture(axis, low, high);
        j = other_mixture(&i, axis, low, high);
        log_q = exact_log_similarity(i.lobe, i.count, j.lobe, j.count);
        mixture_inputs(&i, &j, inputs);
        inputs[2 * MOST_LOBES] = beta;
        if (low >= bound.low && high <= bound.high) {
            test_within(&bound, (double)bilateral_sg_mixture_weight(i.lobe, i.count, j.lobe, j.count, (float)beta),
                        exp(beta * log_q), similarity(beta * log_q, beta, 0), inputs, 2 * MOST_LOBES + 1);
        }
        prepare(&i, a, planes[0]);
        prepare(&j, b, planes[1]);
        product = product_of(a, b);
        bilateral_sg_mixture_taps(1, MOST_LOBES, planes[0], planes[1], 1, &weight);
        if (low < below.low) {
            test_within(&wide_lobes, (double)bilateral_sg_mixture_tap(0, product, 1), exp(log_q), 1, inputs,
                        2 * MOST_LOBES);
            continue;
        }
        if (low < tap.low && far_apart(&i, &j)) {
            test_within(&opposed, (double)bilateral_sg_mixture_tap(0, product, 1), exp(log_q), 1, inputs,
                        2 * MOST_LOBES);
            continue;
        }
        unit_of_q = similarity(log_q, 1, sharpest(&i, &j)) + 1e-20;
        if (far_apart(&i, &j)) unit_of_q += (apart.limit * exp(log_q) + dropped.limit) / tap.limit;
        test_within(low < tap.low ? &below : &tap, (double)bilateral_sg_mixture_tap(0, product, 1), exp(log_q),
                    unit_of_q, inputs, 2 * MOST_LOBES);
        if (low >= tap.low) {
            test_within(&row, (double)weight, exp(log_q) * exp2(-1.5), unit_of_q, inputs, 2 * MOST_LOBES);
        }
    }
    test_report(&below);
    test_report(&bound);
    test_report(&tap);
    test_report(&row);
    test_report(&wide_lobes);
}

static void opposed_lobes_match(void) {
    test_bound bound = bound_of("bilateral_sg_mixture_tap", "opposed");
    int k;
    for (k = 0; k < test_draws(20000); k++) {
        double l = (double)(float)log_uniform(bound.low, bound.high), q;
        sg_lobe i = lobe_of(random_direction(), l, 0), j = i;
        bilateral_sg_part a, b;
        double angle = pick(2) ? log_uniform(1e-6, 1) : 0;
        vec away = turned(combine(-1, unit(wide(i.axis)), 0, unit(wide(i.axis))), angle);
        j.axis = narrow(away);
        bilateral_sg_mixture_prepare(&i, 1, &a);
        bilateral_sg_mixture_prepare(&j, 1, &b);
        q = exp(exact_log_similarity(&i, 1, &j, 1));
        test_within(&bound, (double)bilateral_sg_mixture_tap(0, bilateral_sg_pair(a, b), 1), q, 1, &l, 1);
    }
    test_report(&bound);
}

static double values_product(const double w[3], const void *context) {
    const mixture *pair = (const mixture *)context;
    double value = 1;
    int k, l;
    for (k = 0; k < 2; k++) {
        double sum = 0;
        for (l = 0; l < pair[k].count; l++) {
            sum += exp((double)pair[k].lobe[l].log_amplitude + exact_log_eval(pair[k].lobe[l], vec_of(w)));
        }
        value *= sum;
    }
    return value;
}

static double quadrature(const mixture *i, const mixture *j, vec axis) {
    double peak[3];
    mixture pair[2];
    pair[0] = *i;
    pair[1] = *j;
    peak[0] = axis.x, peak[1] = axis.y, peak[2] = axis.z;
    return reference_sphere_azimuth(values_product, pair, peak, 200, 256);
}

/* Eq. 8 of the mixtures themselves */
static void mixtures_match_quadrature(void) {
    int k;
    for (k = 0; k < test_few(20); k++) {
        vec axis = random_direction();
        mixture i = random_mixture(axis, 0.1, 60), j = other_mixture(&i, axis, 0.1, 60);
        double wanted = quadrature(&i, &j, axis) / sqrt(quadrature(&i, &i, axis) * quadrature(&j, &j, axis));
        double got = (double)bilateral_sg_mixture_weight(i.lobe, i.count, j.lobe, j.count, 1), inputs[2 * MOST_LOBES];
        mixture_inputs(&i, &j, inputs);
        test_that(fabs(got - wanted) < 2e-6, "Eq. 11 is the similarity of the mixtures", inputs, 2 * MOST_LOBES);
    }
}

/* ---- what a weight is ---- */

static void check_weight(const char *form, float w, float back, float own, double slack, const double *inputs) {
    char what[96];
    snprintf(what, sizeof what, "%s: a weight is in [0, 1]", form);
    test_that(test_is_finite(w) && w >= 0 && w <= 1, what, inputs, 9);
    snprintf(what, sizeof what, "%s: a pixel's weight with itself is 1", form);
#ifdef __FAST_MATH__ /* copies of the code may round differently, which wide lobes of mixtures magnify */
    if (!strcmp(form, "sg_mixture_tap")) own = (double)own > 1 - 6e-5 * (1 + inputs[8]) ? 1 : own;
#endif
    test_that(own == 1, what, inputs, 9);
    snprintf(what, sizeof what, "%s: a weight is symmetric", form);
    test_that(fabs((double)w - (double)back) <= slack * (double)w * (1 - log((double)w + 1e-30)), what, inputs, 9);
}

static void weights_are_weights(void) {
    int k;
    for (k = 0; 25 * k < test_draws(5000000); k++) { /* a dozen pairs of lobes each */
        float beta = (float)log_uniform(1e-3, 1e3), vi = (float)log_uniform(1e-6, 1e6),
              vj = (float)log_uniform(1e-6, 1e6);
        double inputs[9], low = k % 4 ? 1e-8 : 1e-30, high = k % 4 ? 1e10 : 1e30;
        sg_lobe i = random_lobe(low, high), j = other_lobe(i, low, high, (double)beta), pair[2][2];
        bilateral_sg a, b;
        bilateral_sg_part parts[2][2];
        int half = 1 + pick(15);
        double slack = 4e-7 * (1 + (double)beta); /* of compilers that change the order of products */
#ifndef __FAST_MATH__
        if (test_slack == 1) slack = 0;
#endif
        if (k % 50 == 0) i.sharpness = 0;
        if (k % 50 == 1) j.sharpness = 0;
        inputs_of(i, j, (double)beta, inputs);
        check_weight("normal_weight", bilateral_normal_weight(i.axis, j.axis, vi),
                     bilateral_normal_weight(j.axis, i.axis, vi), bilateral_normal_weight(i.axis, i.axis, vi), 0,
                     inputs);
        check_weight("depth_weight", bilateral_depth_weight(vi, vj, beta), bilateral_depth_weight(vj, vi, beta),
                     bilateral_depth_weight(vi, vi, beta), 0, inputs);
        check_weight("gaussian_weight", bilateral_gaussian_weight(vj, vi, vi, vj, beta),
                     bilateral_gaussian_weight(vi, vj, vj, vi, beta), bilateral_gaussian_weight(vj, vi, vj, vi, beta),
                     slack, inputs);
        check_weight("sg_weight", bilateral_sg_weight(i, j, beta), bilateral_sg_weight(j, i, beta),
                     bilateral_sg_weight(i, i, beta), slack, inputs);
        a = bilateral_sg_prepare(i, beta);
        b = bilateral_sg_prepare(j, beta);
        check_weight("sg_tap", bilateral_sg_tap(0, a, b, beta), bilateral_sg_tap(0, b, a, beta),
                     bilateral_sg_tap(0, a, a, beta), slack, inputs);
        check_weight("sg_tap_power", bilateral_sg_tap_power(0, a, b, half), bilateral_sg_tap_power(0, b, a, half),
                     bilateral_sg_tap_power(0, a, a, half), 0, inputs);
        pair[0][0] = i;
        pair[0][1] = random_lobe(low, high);
        pair[1][0] = j;
        pair[1][1] = other_lobe(pair[0][1], low, high, (double)beta);
        check_weight("sg_mixture_weight", bilateral_sg_mixture_weight(pair[0], 2, pair[1], 2, beta),
                     bilateral_sg_mixture_weight(pair[1], 2, pair[0], 2, beta),
                     bilateral_sg_mixture_weight(pair[0], 2, pair[0], 2, beta), 1e-4 * (1 + (double)beta), inputs);
        bilateral_sg_mixture_prepare(pair[0], 2, parts[0]);
        bilateral_sg_mixture_prepare(pair[1], 2, parts[1]);
        {
            float product[3] = {0, 0, 0};
            int l, m, n;
            for (n = 0; n < 3; n++) {
                for (l = 0; l < 2; l++) {
                    for (m = 0; m < 2; m++) product[n] += bilateral_sg_pair(parts[n == 1][l], parts[n == 0][m]);
                }
            }
            check_weight("sg_mixture_tap", bilateral_sg_mixture_tap(0, product[0], beta),
                         bilateral_sg_mixture_tap(0, product[1], beta), bilateral_sg_mixture_tap(0, product[2], beta),
                         5e-5 * (1 + (double)beta), inputs);
        }
    }
}

/* Rows of several blocks: each pixel has the weight of its tap, and nothing is written beside the row. */
static void rows_are_taps(void) {
    static const int counts[] = {1, 2, 127, 128, 129, 256, 300, 511};
    enum { MOST = 513, PLANES = 13, LOBES = 2 };
    static float plane[2][PLANES][2 * MOST], weight[MOST], wanted[MOST], allowed[MOST];
    const float *planes[2][PLANES];
    const test_bound opposed = bound_of("bilateral_sg_mixture_tap", "opposed");
    float beta = 2;
    int n, form, x, p, k;
    for (n = 0; n < 3 * (int)(sizeof counts / sizeof *counts); n++) {
        int count = counts[n / 3];
        form = n % 3;
        for (p = 0; p < 2; p++)
            for (k = 0; k < PLANES; k++) planes[p][k] = plane[p][k] + MOST; /* zeros before it */
        weight[0] = weight[count + 1] = 42;
        for (x = 0; x < count; x++) {
            /* no lobe of the second block, and no second one of the first, has a tail */
            int tails = x / 128 != 1;
            sg_lobe i[LOBES], j[LOBES];
            float exponent = (float)(-2 * uniform());
            weight[1 + x] = exponent;
            allowed[x] = 1e-4f;
            i[0] = random_lobe(tails ? 0.05 : 16, 1e3);
            i[1] = random_lobe(tails && x / 128 ? 0.05 : 16, 1e3);
            j[0] = other_lobe(i[0], tails ? 0.05 : 16, 1e3, 1);
            j[1] = other_lobe(i[1], tails && x / 128 ? 0.05 : 16, 1e3, 1);
            if (form == 0) {
                bilateral_sg s[2];
                s[0] = bilateral_sg_prepare(i[0], beta);
                s[1] = bilateral_sg_prepare(j[0], beta);
                for (p = 0; p < 2; p++) {
                    plane[p][0][MOST + x] = s[p].axis.x, plane[p][1][MOST + x] = s[p].axis.y,
                                       plane[p][2][MOST + x] = s[p].axis.z;
                    plane[p][3][MOST + x] = s[p].width;
                }
                wanted[x] = bilateral_sg_tap(exponent, s[0], s[1], beta);
            } else if (form == 1) {
                bilateral_sg_part s[2][LOBES];
                float product = 0;
                int l, m;
                for (l = 0; l < LOBES; l++) /* of wide lobes, what rounding leaves where they are opposed */
                    if (i[l].sharpness < 1 && lobe_dot(i[l].axis, j[l].axis) < -0.99f)
                        allowed[x] = beta * (float)opposed.limit;
                bilateral_sg_mixture_prepare(i, LOBES, s[0]);
                bilateral_sg_mixture_prepare(j, LOBES, s[1]);
                for (p = 0; p < 2; p++) {
                    for (l = 0; l < LOBES; l++) {
                        float(*to)[2 * MOST] = plane[p] + PART_PLANES * l;
                        to[0][MOST + x] = s[p][l].axis.x, to[1][MOST + x] = s[p][l].axis.y,
                                     to[2][MOST + x] = s[p][l].axis.z;
                        to[3][MOST + x] = s[p][l].sharpness, to[4][MOST + x] = s[p][l].amplitude,
                                     to[5][MOST + x] = s[p][l].tail;
                    }
                }
                for (l = 0; l < LOBES; l++)
                    for (m = 0; m < LOBES; m++) product += bilateral_sg_pair(s[0][l], s[1][m]);
                wanted[x] = bilateral_sg_mixture_tap(exponent, product, beta);
            } else {
                bilateral_asg s[2];
                for (p = 0; p < 2; p++) {
                    asg_lobe a;
                    bilateral_asg prepared;
                    a.z = p ? j[0].axis : i[0].axis;
                    lobe_frame(a.z, &a.x, &a.y);
                    a.sharpness_x = p ? j[0].sharpness : i[0].sharpness;
                    a.sharpness_y = p ? j[1].sharpness : i[1].sharpness;
                    a.log_amplitude = 0;
                    prepared = s[p] = bilateral_asg_prepare(a);
                    plane[p][0][MOST + x] = prepared.x.x, plane[p][1][MOST + x] = prepared.x.y,
                                       plane[p][2][MOST + x] = prepared.x.z;
                    plane[p][3][MOST + x] = prepared.y.x, plane[p][4][MOST + x] = prepared.y.y,
                                       plane[p][5][MOST + x] = prepared.y.z;
                    plane[p][6][MOST + x] = prepared.z.x, plane[p][7][MOST + x] = prepared.z.y,
                                       plane[p][8][MOST + x] = prepared.z.z;
                    plane[p][9][MOST + x] = prepared.sharpness_x, plane[p][10][MOST + x] = prepared.sharpness_y;
                    plane[p][11][MOST + x] = prepared.own_exponent, plane[p][12][MOST + x] = prepared.own_scale;
                }
                wanted[x] = bilateral_asg_tap(exponent, s[0], s[1], beta);
            }
        }
        if (form == 0) bilateral_sg_taps(count, planes[0], planes[1], beta, weight + 1);
        if (form == 1) bilateral_sg_mixture_taps(count, LOBES, planes[0], planes[1], beta, weight + 1);
        if (form == 2) bilateral_asg_taps(count, planes[0], planes[1], beta, weight + 1);
        for (x = 0; x < count; x++) {
            double inputs[5];
            inputs[0] = form, inputs[1] = count, inputs[2] = x;
            inputs[3] = (double)weight[1 + x], inputs[4] = (double)wanted[x];
            test_that(fabs(inputs[3] - inputs[4]) <= (double)allowed[x] * test_slack, "a row's weight is its tap's",
                      inputs, 5);
        }
        test_that(weight[0] == 42.0f && weight[count + 1] == 42.0f, "nothing beside the row", NULL, 0);
    }
}

static float any_float(double limit) {
    unsigned bits;
    float value;
    do {
        bits = (unsigned)(uniform() * 4294967296.0);
        memcpy(&value, &bits, sizeof value);
    } while (!test_is_finite(value) || !(fabs((double)value) <= limit));
    return value;
}

/* Any bits that are finite: unit axes, anything else */
static void finite_everywhere(void) {
    const sg_lobe nowhere = {{0, 0, 0}, 10, 0};
    bilateral_sg_part instead;
    int k;
    bilateral_sg_mixture_prepare(&nowhere, 1, &instead);
    test_that(instead.axis.z > 0.999f && instead.axis.z < 1, "an axis of no length counts as z", NULL, 0);
    for (k = 0; k < test_draws(300000); k++) {
        float beta = fabsf(any_float(1e3)), weights[4], inverse, footprint[4];
        sg_lobe i = random_lobe(1, 1), j = other_lobe(i, 1, 1, 1), merged, two[2];
        bilateral_sg a, b;
        bilateral_sg_part parts[2];
        double inputs[9];
        int left, top, half = pick(16), n;
        i.sharpness = any_float(1e38), j.sharpness = any_float(1e38);
        i.log_amplitude = any_float(1e30), j.log_amplitude = any_float(1e30);
        two[0] = i, two[1] = j;
        inputs_of(i, j, (double)beta, inputs);
        a = bilateral_sg_prepare(i, beta);
        b = bilateral_sg_prepare(j, beta);
        weights[0] = bilateral_sg_weight(i, j, beta);
        weights[1] = bilateral_sg_tap(0, a, b, beta);
        weights[2] = bilateral_sg_tap_power(0, a, b, half);
        weights[3] = bilateral_gaussian_weight(any_float(1e18), i.sharpness, any_float(1e18), j.sharpness, beta);
        for (n = 0; n < 4; n++) test_that(weights[n] >= 0 && weights[n] <= 1, "a weight of any lobes", inputs, 9);
        weights[0] = bilateral_sg_mixture_weight(two, 2, &j, 1, beta);
        bilateral_sg_mixture_prepare(two, 2, parts);
        weights[1] = bilateral_sg_mixture_tap(0, bilateral_sg_pair(parts[0], parts[1]), beta);
        weights[2] = bilateral_depth_weight(any_float(1e18), any_float(1e18), i.sharpness);
        weights[3] = bilateral_normal_weight(i.axis, j.axis, i.sharpness);
        for (n = 0; n < 4; n++) test_that(weights[n] >= 0 && weights[n] <= 1, "a weight of any pixels", inputs, 9);
        inverse = bilateral_history_share(any_float(1), any_float(1e30), any_float(1e6));
        test_that(inverse >= 0 && inverse < 1, "a share of any history", inputs, 9);
        bilateral_footprint(any_float(1e38), any_float(1e38), 640, 480, &left, &top, footprint);
        for (n = 0; n < 4; n++) test_that(footprint[n] >= 0 && footprint[n] <= 1, "taps of any place", inputs, 9);
        test_that(left >= -1 && left <= 640 && top >= -1 && top <= 480, "pixels of any place", inputs, 9);
        inverse = bilateral_footprint_weights(footprint, weights, weights);
        for (n = 0; n < 4; n++) test_that(weights[n] >= 0 && weights[n] <= 1.000001f, "weights of any taps", inputs, 9);
        merged = bilateral_merge(two, 2);
        test_that(test_is_finite(merged.sharpness) && test_is_finite(merged.axis.x) && test_is_finite(merged.axis.y) &&
                      test_is_finite(merged.axis.z) && test_is_finite(merged.log_amplitude),
                  "any lobes merge", inputs, 9);
    }
}

/* ---- the smoothing kernel ---- */

static void kernel_smooths(void) {
    test_bound smooth = bound_of("bilateral_sg_weight", "similarity");
    int k;
    smooth.limit += 8; /* what the sharpnesses' own rounding, 2e-7 each, adds */
    for (k = 0; k < 20000; k++) {
        double li = log_uniform(1e-2, 1e5), kappa = log_uniform(1, 1e5), wanted, inputs[2];
        sg_lobe i = random_lobe(1e-2, 1e5), j = other_lobe(i, 1e-2, 1e5, 20), smooth_i, smooth_j;
        const float none[2] = {1e30f, HUGE_VALF};
        inputs[0] = li, inputs[1] = kappa;
        /* Eq. 10 */
        smooth_i = sg_convolve(i, (float)kappa);
        smooth_j = sg_convolve(j, (float)kappa);
        i.sharpness = (float)((double)i.sharpness * kappa / ((double)i.sharpness + kappa));
        j.sharpness = (float)((double)j.sharpness * kappa / ((double)j.sharpness + kappa));
        wanted = exact_sg_log_weight(i, j, 20);
        test_within(&smooth, (double)bilateral_sg_weight(smooth_i, smooth_j, 20), exp(wanted),
                    similarity(wanted, 20, fmin((double)i.sharpness, (double)j.sharpness)), inputs, 2);
        test_that(fabs((double)bilateral_sg_weight(sg_convolve(i, none[k % 2]), sg_convolve(j, none[k % 2]), 20) -
                       (double)bilateral_sg_weight(i, j, 20)) < 1e-5,
                  "a kernel without width changes nothing", inputs, 2);
    }
    test_report(&smooth);
}

/* ---- several lobes as one ---- */

static void merged_lobes_match(void) {
    test_bound sharpness = bound_of("bilateral_merge", "sharpness"), axis = bound_of("bilateral_merge", "axis");
    test_bound integral = bound_of("bilateral_merge", "integral"), model = bound_of("bilateral_merge", "model");
    int k;
    for (k = 0; k < test_draws(40000); k++) {
        double inputs[2 * MOST_LOBES], lengths[MOST_LOBES], whole = 0, lost = 0, sum = 0, sharpest = 0, wanted;
        double low = k % 2 ? model.low : sharpness.low, high = k % 2 ? model.high : sharpness.high;
        vec direction = random_direction(), mean = combine(0, direction, 0, direction), exact_mean = mean;
        double width = log_uniform(1e-5, 1);
        mixture m = random_mixture(direction, low, high);
        sg_lobe got;
        int l, n;
        for (l = 0; l < m.count; l++) {
            double angle = width * uniform();
            m.lobe[l].axis = narrow(turned(direction, angle));
            if (k % 3 == 0) m.lobe[l].axis = m.lobe[0].axis;
        }
        got = bilateral_merge(m.lobe, m.count);
        for (l = 0; l < m.count; l++) {
            double size = (double)m.lobe[l].sharpness;
            double w = exp((double)m.lobe[l].log_amplitude) * exact_integral(size);
            lengths[l] = w * size / (size + 1);
            sharpest = fmax(sharpest, size);
            sum += lengths[l];
            mean = combine(1, mean, lengths[l], unit(wide(m.lobe[l].axis)));
            exact_mean = combine(1, exact_mean, w * (1 / tanh(size) - 1 / size), unit(wide(m.lobe[l].axis)));
            whole += w;
            lost += w / (size + 1);
        }
        /* (sum of lengths)^2 - |mean|^2 = sum of their products times chords^2 */
        for (l = 0; l < m.count; l++) {
            for (n = 0; n < l; n++) {
                double chord = distance(unit(wide(m.lobe[l].axis)), unit(wide(m.lobe[n].axis)));
                lost += lengths[l] * lengths[n] * chord * chord / (sum + length(mean));
            }
        }
        wanted = length(mean) / lost;
        mixture_inputs(&m, &m, inputs);
        test_within(&sharpness, (double)got.sharpness, wanted, wanted * (32 + sqrt(sharpest)) * TEST_EPSILON, inputs,
                    2 * MOST_LOBES);
        test_within(&axis, distance(wide(got.axis), unit(mean)), 0, 1, inputs, 2 * MOST_LOBES);
        test_within(&integral, exp((double)got.log_amplitude) * exact_integral((double)got.sharpness), whole, whole,
                    inputs, 2 * MOST_LOBES);
        if (k % 2) {
            double size = (double)got.sharpness;
            test_within(&model, 1 / tanh(size) - 1 / size, length(exact_mean) / whole, 1, inputs, 2 * MOST_LOBES);
        }
    }
    for (k = 0; k < 3; k++) { /* whichever is by far the brightest */
        mixture m = random_mixture(random_direction(), 10, 1e3);
        sg_lobe got;
        m.count = 3;
        m.lobe[1] = m.lobe[2] = m.lobe[0];
        m.lobe[k].axis = narrow(random_direction());
        m.lobe[k].log_amplitude += 300;
        got = bilateral_merge(m.lobe, 3);
        test_that(distance(wide(got.axis), wide(m.lobe[k].axis)) < 1e-6 &&
                      fabs((double)(got.log_amplitude - m.lobe[k].log_amplitude)) < 1e-4,
                  "the brightest lobe alone", NULL, 0);
    }
    test_report(&sharpness);
    test_report(&axis);
    test_report(&integral);
    test_report(&model);
}

/* ---- both pixels of a pair ---- */

static void pairs_reach_both(void) {
    enum { COUNT = 37, CHANNELS = 2 };
    test_bound bound = bound_of("bilateral_pairs_add", "rel");
    float weight[COUNT + 1], colour[CHANNELS][COUNT + 2], sum[CHANNELS + 1][COUNT + 2];
    const float *first[CHANNELS], *second[CHANNELS];
    float *first_sum[CHANNELS + 1], *second_sum[CHANNELS + 1];
    double wanted[CHANNELS + 1][COUNT + 2] = {{0}};
    int x, c;
    for (c = 0; c <= CHANNELS; c++) {
        for (x = 0; x <= COUNT + 1; x++) {
            sum[c][x] = (float)uniform();
            wanted[c][x] = (double)sum[c][x];
            if (c < CHANNELS) colour[c][x] = (float)uniform();
        }
        first_sum[c] = sum[c];
        second_sum[c] = sum[c] + 1; /* a pixel and its neighbour to the right */
    }
    for (c = 0; c < CHANNELS; c++) {
        first[c] = colour[c];
        second[c] = colour[c] + 1;
    }
    for (x = 0; x <= COUNT; x++) weight[x] = (float)(1 + uniform()); /* the last counts nowhere */
    bilateral_pairs_add(COUNT, weight, CHANNELS, first, second, first_sum, second_sum);
    for (x = 0; x < COUNT; x++) {
        double w = (double)weight[x];
        for (c = 0; c < CHANNELS; c++) {
            wanted[c][x] += w * (double)colour[c][x + 1];
            wanted[c][x + 1] += w * (double)colour[c][x];
        }
        wanted[CHANNELS][x] += w;
        wanted[CHANNELS][x + 1] += w;
    }
    for (c = 0; c <= CHANNELS; c++) {
        for (x = 0; x <= COUNT + 1; x++) {
            double input = x;
            test_within(&bound, (double)sum[c][x], wanted[c][x], wanted[c][x], &input, 1);
        }
    }
    test_report(&bound);
}

/* ---- upsampling and reprojection ---- */

static void footprints_are_bilinear(void) {
    test_bound bound = bound_of("bilateral_footprint", "abs"), sum = bound_of("bilateral_footprint_weights", "sum");
    enum { WIDTH = 12, HEIGHT = 7 };
    int k, n;
    for (k = 0; k < test_draws(200000); k++) {
        double inputs[2], wanted[4], total, fx, fy;
        float footprint[4], similar[4], weight[4], one[4] = {1, 1, 1, 1};
        int left, top;
        inputs[0] = (double)(float)(-2 + (WIDTH + 3) * uniform());
        inputs[1] = (double)(float)(-2 + (HEIGHT + 3) * uniform());
        if (k % 5 == 0) inputs[0] = pick(WIDTH);
        if (k % 7 == 0) inputs[1] = pick(HEIGHT) - 1e-7;
        bilateral_footprint((float)inputs[0], (float)inputs[1], WIDTH, HEIGHT, &left, &top, footprint);
        inputs[1] = (double)(float)inputs[1];
        for (n = 0; n < 4; n++) {
            int x = left + n % 2, y = top + n / 2;
            fx = fmax(0, 1 - fabs(inputs[0] - x));
            fy = fmax(0, 1 - fabs(inputs[1] - y));
            wanted[n] = x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT ? fx * fy : 0;
            test_within(&bound, (double)footprint[n], wanted[n], 1, inputs, 2);
            similar[n] = (float)(pick(4) ? uniform() : 0);
        }
        if (inputs[0] >= 0 && inputs[0] <= WIDTH - 1 && inputs[1] >= 0 && inputs[1] <= HEIGHT - 1) {
            total = (double)bilateral_footprint_weights(footprint, one, weight);
            test_within(&sum, total, 1, 1, inputs, 2);
            for (n = 0; n < 4; n++) test_within(&sum, (double)weight[n], (double)footprint[n], 1, inputs, 2);
        }
        total = (double)bilateral_footprint_weights(footprint, similar, weight);
        if (total > 1e-20) {
            test_within(&sum, (double)weight[0] + (double)weight[1] + (double)weight[2] + (double)weight[3], 1, 1,
                        inputs, 2);
            for (n = 0; n < 4; n++) {
                test_within(&sum, (double)weight[n] * total, (double)footprint[n] * (double)similar[n], 1, inputs, 2);
            }
        }
        for (n = 0; n < 4; n++) similar[n] = 0;
        test_that(bilateral_footprint_weights(footprint, similar, weight) == 0 && weight[0] == 0 && weight[3] == 0,
                  "nothing similar, no weight", inputs, 2);
    }
    test_report(&bound);
    test_report(&sum);
}

static void history_adds_up(void) {
    test_bound bound = bound_of("bilateral_history_share", "ulp");
    double mean = 0, count = 0;
    int k;
    for (k = 0; k < test_draws(20000); k++) {
        double inputs[3], old, wanted;
        inputs[0] = (double)(float)uniform(), inputs[1] = (double)(float)log_uniform(1e-3, 1e3);
        inputs[2] = (double)(float)log_uniform(1e-3, 1e3);
        old = inputs[0] * fmin(inputs[1], inputs[2]);
        wanted = old / (1 + old);
        test_within(&bound, (double)bilateral_history_share((float)inputs[0], (float)inputs[1], (float)inputs[2]),
                    wanted, test_ulp(wanted), inputs, 3);
    }
    for (k = 1; k <= 50; k++) { /* the mean of 1 .. k, and k samples */
        double share = (double)bilateral_history_share(1, (float)count, 1e6f);
        mean = share * mean + (1 - share) * k;
        count = 1 / (1 - share);
        test_that(fabs(count - k) < 1e-3 && fabs(mean - 0.5 * (k + 1)) < 1e-3, "the mean of all samples", &mean, 1);
    }
    test_that(bilateral_history_share(0, 100, 100) == 0, "no history where nothing is similar", NULL, 0);
    test_report(&bound);
}

const test_case bilateral_tests[] = {
    {"bilateral_logarithm", logarithm_matches},
    {"bilateral_guides", guides_match},
    {"bilateral_gaussian_weight", gaussians_match},
    {"bilateral_gaussian_weight_quadrature", gaussian_is_a_product_integral},
    {"bilateral_sg_weight", sg_weights_match},
    {"bilateral_sg_weight_model", sg_weight_is_near_the_integral},
    {"bilateral_sg_mixture_weight", mixtures_match},
    {"bilateral_sg_mixture_opposed", opposed_lobes_match},
    {"bilateral_sg_mixture_quadrature", mixtures_match_quadrature},
    {"bilateral_weights", weights_are_weights},
    {"bilateral_rows", rows_are_taps},
    {"bilateral_finite", finite_everywhere},
    {"bilateral_kernel", kernel_smooths},
    {"bilateral_merge", merged_lobes_match},
    {"bilateral_pairs_add", pairs_reach_both},
    {"bilateral_footprint", footprints_are_bilinear},
    {"bilateral_history_share", history_adds_up},
    {0, 0},
};
