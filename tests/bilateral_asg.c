/* Unit tests of the weights of anisotropic lobes in bilateral.h, against quadrature. */
#include "../bilateral.h"
#include "cardano.h"
#include "exact_asg.h"

/* ---- Eq. 13 ---- */

static void weights_match(void) {
    test_bound bound = test_bound_of("bilateral.h", "bilateral_asg_weight", "model");
    test_bound rms = test_bound_of("bilateral.h", "bilateral_asg_weight", "rms");
    test_rng rng = {126 + test_seed};
    double squares = 0;
    const int count = test_few(800);
    int i, k;
    for (i = 0; i < count; i++) {
        double z[3], other[3], inputs[5], got, wanted, smallest = test_log_uniform(&rng, bound.low, 0.1 * bound.high);
        asg_lobe a, b;
        for (k = 0; k < 4; k++) inputs[k] = fmin(smallest * test_log_uniform(&rng, 1, 1e3), bound.high);
        inputs[i & 3] = smallest;
        inputs[4] = i % 3 ? fmin(3 * test_uniform(&rng) / sqrt(smallest + 0.3), 3.1) : acos(1 - 2 * test_uniform(&rng));
        if (i % 20 == 1) inputs[4] = REFERENCE_PI;
        test_direction(&rng, z);
        a = lobe_around(z, 7 * test_uniform(&rng), inputs[0], inputs[1]);
        direction_near(&rng, z, inputs[4], other);
        b = lobe_around(other, 7 * test_uniform(&rng), inputs[2], inputs[3]);
        got = (double)bilateral_asg_weight(a, b, 1);
        wanted = reference_product(a, &b, NULL) / sqrt(reference_product(a, &a, NULL) * reference_product(b, &b, NULL));
        test_within(&bound, got, wanted, 1, inputs, 5);
        squares += pow(got - wanted, 2);
    }
    test_within(&rms, sqrt(squares / count), 0, 1, NULL, 0);
    test_report(&bound);
    test_report(&rms);
}

/* One lobe turns past another: the weight must fall and rise without jumps. */
static void weights_turn_smoothly(void) {
    test_bound smooth = test_bound_of("bilateral.h", "bilateral_asg_weight", "monotone");
    const double sharpness[6][2] = {{2, 9}, {50, 3000}, {1000, 1000}, {1e4, 4e6}, {10, 1e6}, {1e4, 1e6}};
    const double up[3] = {0, 0, 1};
    int i, step;
    for (i = 0; i < 6; i++) {
        const int steps = 4000;
        asg_lobe a = lobe_around(up, 0, sharpness[i][0], sharpness[i][1]);
        double last = 2;
        for (step = 0; step <= steps; step++) {
            double angle = REFERENCE_PI / 2 * step / steps, w, inputs[2];
            asg_lobe b = lobe_around(up, angle, sharpness[i][0], sharpness[i][1]);
            w = (double)bilateral_asg_weight(a, b, 1);
            inputs[0] = i;
            inputs[1] = angle;
            test_that(w <= last + smooth.limit, "the weight falls as the lobe turns", inputs, 2);
            last = w;
        }
        test_that(sharpness[i][0] == sharpness[i][1] ? fabs(last - 1) < 1e-5 : last < 0.99,
                  "a quarter turn changes anisotropic lobes only", &sharpness[i][0], 2);
        last = 2;
        for (step = 0; step <= steps; step++) {
            double angle = 4 / sqrt(sharpness[i][0]) * step / steps, z[3], w, inputs[2];
            asg_lobe b;
            angle = fmin(angle, REFERENCE_PI);
            z[0] = sin(angle);
            z[1] = 0;
            z[2] = cos(angle);
            b = a;
            b.z = narrow(z);
            b.x = lobe_vector(b.z.z, 0, -b.z.x);
            b.y = lobe_vector(0, 1, 0);
            a.x = lobe_vector(1, 0, 0);
            a.y = lobe_vector(0, 1, 0);
            w = (double)bilateral_asg_weight(a, b, 1);
            inputs[0] = i;
            inputs[1] = angle;
            test_that(w <= last + smooth.limit, "the weight falls as the axes part", inputs, 2);
            last = w;
        }
    }
}

/* ---- what it cures ---- */

/* The largest step up of a weight as one of two equal lobes turns away about its axis */
static double largest_rise(const double axis[3], double lx, double ly, float (*product)(asg_lobe a, asg_lobe b)) {
    asg_lobe a = lobe_around(axis, 0, lx, ly);
    double last = 2, rise = 0;
    int step;
    for (step = 0; step <= 4000; step++) {
        asg_lobe b = lobe_around(axis, REFERENCE_PI / 2 * step / 4000, lx, ly);
        double w = (double)(product(a, b) / sqrtf(product(a, a) * product(b, b)));
        w = w >= 0 ? fmin(w, 1) : 0; /* NaN: black */
        rise = fmax(rise, w - last);
        last = w;
    }
    return rise;
}

static float weight_itself(asg_lobe a, asg_lobe b) {
    return bilateral_asg_weight(a, b, 1);
}

/* Fig. 19 of 004: eigenvalues by Cardano's formula in floats make bands. */
static void no_bands(void) {
    test_rng rng = {140 + test_seed};
    double ours = 0, theirs = 0;
    int i;
    for (i = 0; i < 8; i++) {
        double axis[3];
        test_direction(&rng, axis);
        ours = fmax(ours, largest_rise(axis, 1e3, 1e6, weight_itself));
        theirs = fmax(theirs, largest_rise(axis, 1e3, 1e6, cardano_float));
    }
    test_that(ours <= 1e-5, "the weight falls as the lobe turns", &ours, 1);
    test_that(theirs > 0.1, "where Cardano's formula jumps", &theirs, 1);
}

/* ---- what a weight is ---- */

static void put_planes(const bilateral_asg *p, const float *planes[13]) {
    planes[0] = &p->x.x, planes[1] = &p->x.y, planes[2] = &p->x.z;
    planes[3] = &p->y.x, planes[4] = &p->y.y, planes[5] = &p->y.z;
    planes[6] = &p->z.x, planes[7] = &p->z.y, planes[8] = &p->z.z;
    planes[9] = &p->sharpness_x, planes[10] = &p->sharpness_y;
    planes[11] = &p->own_exponent, planes[12] = &p->own_scale;
}

static void weights_are_weights(void) {
    test_bound symmetric = test_bound_of("bilateral.h", "bilateral_asg_weight", "symmetric");
    test_bound rows = test_bound_of("bilateral.h", "bilateral_asg_taps", "rel");
    test_rng rng = {108 + test_seed};
    int i;
    for (i = 0; i < test_few(100000); i++) {
        double inputs[6];
        float beta, w, back, row = -1.5f;
        bilateral_asg first, second;
        const float *planes[2][13];
        asg_lobe a, b;
        draw_near_asgs(&rng, i, i % 8 < 4 ? 1e9 : rows.high, inputs, &a, &b);
        inputs[5] = test_log_uniform(&rng, 1e-3, 1e3);
        beta = (float)inputs[5];
        w = bilateral_asg_weight(a, b, beta);
        test_that(test_is_finite(w) && w >= 0 && w <= 1, "a weight is in [0, 1]", inputs, 6);
        test_that(bilateral_asg_weight(a, a, beta) == 1, "a lobe's weight with itself is 1", inputs, 6);
        w = bilateral_asg_weight(a, b, 1);
        back = bilateral_asg_weight(b, a, 1);
        test_within(&symmetric, (double)w, (double)back, 1, inputs, 6);
        first = bilateral_asg_prepare(a);
        second = bilateral_asg_prepare(b);
        test_within(&rows, (double)bilateral_asg_tap(0, first, second, 1), (double)w, 1, inputs, 6);
        put_planes(&first, planes[0]);
        put_planes(&second, planes[1]);
        bilateral_asg_taps(1, planes[0], planes[1], 1, &row);
        if (i % 8 >= 4) test_within(&rows, (double)row * exp2(1.5), (double)w, 1, inputs, 6);
        row = -1;
        put_planes(&first, planes[1]);
        bilateral_asg_taps(1, planes[0], planes[1], beta, &row);
        test_that(row == 0.5f, "nor does a row change a lobe's weight with itself", inputs, 6);
    }
    test_report(&symmetric);
    test_report(&rows);
}

/* A million pairs out of a few hundred lobes, equal and opposed ones and sharpness 0 among them */
static void weights_stay_numbers(void) {
    enum { POOL = 600 };
    static asg_lobe pool[POOL];
    test_rng rng = {127 + test_seed};
    int i, k, wrong = 0;
    for (i = 0; i < POOL; i++) {
        double z[3], inputs[2];
        for (k = 0; k < 2; k++) inputs[k] = test_uniform(&rng) < 0.05 ? 0 : test_log_uniform(&rng, 1e-30, 1e30);
        test_direction(&rng, z);
        if (i % 4 == 0) z[0] = z[1] = 0, z[2] = i & 4 ? 1 : -1;
        if (i % 4 == 1) inputs[1] = inputs[0];
        if (i % 3) inputs[0] = fmin(inputs[0], 1e6), inputs[1] = fmin(inputs[1], 1e8);
        pool[i] = lobe_around(z, i % 5 ? 7 * test_uniform(&rng) : 0, inputs[0], inputs[1]);
    }
    for (i = 0; i < test_few(1000000); i++) {
        const asg_lobe a = pool[(int)(POOL * test_uniform(&rng))], b = pool[(int)(POOL * test_uniform(&rng))];
        float w = bilateral_asg_weight(a, b, i % 2 ? 20.f : 1e-3f);
        wrong += !test_is_finite(w) || !(w >= 0) || !(w <= 1);
    }
    test_that(wrong == 0, "weights stay numbers", NULL, 0);
}

const test_case bilateral_asg_tests[] = {
    {"bilateral_asg_weight", weights_match},        {"bilateral_asg_weight_turns", weights_turn_smoothly},
    {"bilateral_asg_no_bands", no_bands},           {"bilateral_asg_weights", weights_are_weights},
    {"bilateral_asg_finite", weights_stay_numbers}, {0, 0},
};
