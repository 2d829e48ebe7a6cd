/* bilateral.c - the rows for bilateral.h; a filter's are in filter.c. */
#include "asg_columns.h"
#include "../exact_asg.h"

static void put(float *in, const double v[3]) {
    int k;
    for (k = 0; k < 3; k++) in[k] = (float)v[k];
}

/* Two lobes whose weight is not next to nothing, and beta */
static void draw_pair(float *in) {
    double axis[3], other[3], l = test_log_uniform(&test_random, 1, 1e5),
                              m = l * test_log_uniform(&test_random, 0.5, 2);
    double beta = test_log_uniform(&test_random, 1, 50);
    test_direction(&test_random, axis);
    direction_near(&test_random, axis, fmin(3 * test_uniform(&test_random) / sqrt(l * beta), 3), other);
    put(in + LOBE_A, axis);
    put(in + LOBE_B, other);
    in[LOBE_A + 3] = (float)l;
    in[LOBE_B + 3] = (float)m;
    in[UNIFORM_U] = (float)beta;
}

static void draw_asgs(float *in) {
    double axis[3], other[3], l = test_log_uniform(&test_random, 10, 1e3),
                              ratio = test_log_uniform(&test_random, 1, 100);
    asg_lobe lobes[2];
    int k;
    test_direction(&test_random, axis);
    direction_near(&test_random, axis, 0.5 * test_uniform(&test_random) / sqrt(l), other);
    lobes[0] = lobe_around(axis, 7 * test_uniform(&test_random), l, l * ratio);
    lobes[1] = lobe_around(other, 7 * test_uniform(&test_random), l, l * ratio);
    for (k = 0; k < 2; k++) {
        float *to = in + (k ? ASG_B : ASG_A);
        const lobe_vec3 v[3] = {lobes[k].x, lobes[k].y, lobes[k].z};
        int n;
        for (n = 0; n < 3; n++) {
            to[3 * n] = v[n].x;
            to[3 * n + 1] = v[n].y;
            to[3 * n + 2] = v[n].z;
        }
        to[9] = lobes[k].sharpness_x;
        to[10] = lobes[k].sharpness_y;
        to[11] = 0;
    }
}

static double squared_between(const float *in) {
    double a[3], b[3], sum = 0;
    int k;
    widen(vector_in(in, 1, LOBE_A), a);
    widen(vector_in(in, 1, LOBE_B), b);
    normalize(a);
    normalize(b);
    for (k = 0; k < 3; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

static void exact_depth(const float *in, double *wanted) {
    double d = (double)in[LOBE_A] - (double)in[LOBE_B];
    wanted[0] = exp(-d * d / (2 * (double)in[UNIFORM_U]));
}

static void exact_normal(const float *in, double *wanted) {
    wanted[0] = exp(-0.5 * squared_between(in) * (double)in[LOBE_A + 3]);
}

static void exact_gaussian(const float *in, double *wanted) {
    double d = (double)in[LOBE_A] - (double)in[LOBE_B], vi = (double)in[LOBE_A + 3], vj = (double)in[LOBE_B + 3];
    double beta = (double)in[UNIFORM_U], sum = vi + vj;
    wanted[0] = pow(4 * vi * vj / (sum * sum), 0.25 * beta) * exp(-0.5 * beta * d * d / sum);
}

static void exact_sg(const float *in, double *wanted) {
    double li = (double)in[LOBE_A + 3], lj = (double)in[LOBE_B + 3], beta = (double)in[UNIFORM_U], sum = li + lj;
    wanted[0] = pow(4 * li * lj / (sum * sum), 0.5 * beta) * exp(-0.5 * beta * squared_between(in) * li * lj / sum);
}

static void exact_asgs(const float *in, double *wanted) {
    asg_lobe a = asg_in(in, 1, ASG_A), b = asg_in(in, 1, ASG_B);
    wanted[0] =
        pow(reference_product(a, &b, NULL) / sqrt(reference_product(a, &a, NULL) * reference_product(b, &b, NULL)), 20);
}

static double absolute(const double *wanted, const float *out) {
    return (double)out[0] - wanted[0];
}

BENCH_DECLARE(our_depth_weight);
BENCH_DECLARE(our_normal_weight);
BENCH_DECLARE(our_gaussian_weight);
BENCH_DECLARE(our_sg_weight);
BENCH_DECLARE(our_sg_tap);
BENCH_DECLARE(our_asg_weight);
BENCH_DECLARE(printed_sg_weight);
BENCH_DECLARE(printed_normal_weight);

const bench_row bilateral_bench[] = {
    {"bilateral_depth_weight",
     "variance 1 .. 50",
     "1",
     4,
     draw_pair,
     exact_depth,
     absolute,
     {BENCH_FORM("bilateral_depth_weight", our_depth_weight)}},
    {"bilateral_normal_weight",
     "variance 1e-5 .. 1",
     "1",
     4,
     draw_pair,
     exact_normal,
     absolute,
     {
         BENCH_FORM("bilateral_normal_weight", our_normal_weight),
         BENCH_FORM("as printed, libm", printed_normal_weight),
     }},
    {"bilateral_gaussian_weight",
     "variances 1 .. 1e5, beta 1 .. 50",
     "1",
     4,
     draw_pair,
     exact_gaussian,
     absolute,
     {BENCH_FORM("bilateral_gaussian_weight", our_gaussian_weight)}},
    {"bilateral_sg_weight",
     "sharpness 1 .. 1e5, beta 1 .. 50",
     "1",
     4,
     draw_pair,
     exact_sg,
     absolute,
     {
         BENCH_FORM("bilateral_sg_weight", our_sg_weight),
         BENCH_FORM("bilateral_sg_tap, and prepared", our_sg_tap),
         BENCH_FORM("as printed, libm", printed_sg_weight),
     }},
    {"bilateral_asg_weight",
     "sharpness 10 .. 1e5, beta 20",
     "1",
     1,
     draw_asgs,
     exact_asgs,
     absolute,
     {BENCH_FORM("bilateral_asg_weight", our_asg_weight)}},
    {0},
};
