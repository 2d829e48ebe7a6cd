/*
 exact.h - what sg.h computes, in double from unit-normalised axes: closed forms, which test_closed_forms holds to
 quadrature, and the quadrature of the clamped cosine

 Include sg.h first.
*/
#ifndef EXACT_H
#define EXACT_H

#include "reference.h"
#include "test.h"
#include <float.h>

typedef struct {
    double x, y, z;
} vec;

static inline vec wide(lobe_vec3 v) {
    vec w;
    w.x = (double)v.x;
    w.y = (double)v.y;
    w.z = (double)v.z;
    return w;
}

/* Rounded, and surely so: gcc 12 makes (double)(float)x into x where it vectorises. */
static inline lobe_vec3 narrow(vec v) {
    volatile float x = (float)v.x, y = (float)v.y, z = (float)v.z;
    return lobe_vector(x, y, z);
}

static inline double dot(vec a, vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline double length(vec v) {
    return sqrt(dot(v, v));
}

static inline vec combine(double s, vec a, double t, vec b) {
    vec v;
    v.x = s * a.x + t * b.x;
    v.y = s * a.y + t * b.y;
    v.z = s * a.z + t * b.z;
    return v;
}

static inline vec unit(vec v) {
    return combine(1 / length(v), v, 0, v);
}

static inline double distance(vec a, vec b) {
    return length(combine(1, a, -1, b));
}

static inline vec vec_of(const double w[3]) {
    vec v;
    v.x = w[0];
    v.y = w[1];
    v.z = w[2];
    return v;
}

static inline vec random_direction(void) {
    double d[3];
    test_direction(&test_random, d);
    return vec_of(d);
}

/* A direction at an angle from another, anywhere around it */
static inline vec turned(vec a, double angle) {
    vec t = random_direction();
    t = unit(combine(1, t, -dot(t, a), a));
    return combine(cos(angle), a, sin(angle), t);
}

static inline double exact_phi(double x) {
    return x < 1e-9 ? 1 - x / 2 : -expm1(-x) / x;
}

static inline double exact_integral(double sharpness) {
    return 4 * REFERENCE_PI * exact_phi(2 * sharpness);
}

static inline double exact_log_eval(sg_lobe g, vec dir) { /* without the amplitude */
    double chord = distance(unit(wide(g.axis)), dir);
    return -0.5 * (double)g.sharpness * chord * chord;
}

typedef struct {
    double sum;       /* of the factors' sharpnesses */
    double sharpness; /* of the product */
    double log_loss;  /* what the misalignment costs */
    vec axis;
} exact_product;

static inline exact_product multiply(double la, vec a, double lb, vec b) {
    exact_product p;
    double chord = distance(a, b);
    vec m = combine(la, a, lb, b);
    p.sum = la + lb;
    p.sharpness = length(m);
    p.log_loss = p.sum > 0 ? -la * chord * chord * (lb / (p.sharpness + p.sum)) : 0;
    p.axis = p.sharpness > 0 ? unit(m) : a;
    return p;
}

static inline exact_product multiply_lobes(sg_lobe a, sg_lobe b) {
    return multiply((double)a.sharpness, unit(wide(a.axis)), (double)b.sharpness, unit(wide(b.axis)));
}

/* The unit of a value aligned * exp(log_loss) whose exponent has terms of the given size. Results below 2^-122, or
   below 2^-122 of aligned, may be flushed: -ffast-math multiplies in any order. */
static inline double conditioned(double aligned, double log_loss, double size) {
    return aligned * (exp(log_loss) * (1 + size) * TEST_EPSILON + 2 * (double)FLT_MIN) + 2 * (double)FLT_MIN;
}

/* Integral over the circle at angle theta around an axis whose cosine with the normal is c, of max(cos, 0). */
static inline double clamped_cosine_ring(double theta, double c) {
    double a = cos(theta) * c, b = sin(theta) * sqrt(1 - c * c), half;
    if (a >= b) return 2 * REFERENCE_PI * a;
    if (a <= -b) return 0;
    half = acos(-a / b);
    return 2 * (a * half + b * sin(half));
}

/* Integral of a unit SG times the clamped cosine, over the SG's integral, to 1e-13. Panels end where the ring has
   kinks, which are roots: theta goes from end to end like a cosine, in which they are smooth. */
static inline double exact_cosine(double sharpness, double cosine) {
    static reference_gauss rule;
    double c = fmin(1, fmax(-1, cosine)), kink = fabs(asin(c)), ends[4] = {0, 0, 0, REFERENCE_PI}, whole = 0;
    double last = 2 * asin(sqrt(fmin(1, 25 / (sharpness + 1e-9)))), width = 1.5 / sqrt(1 + sharpness);
    int segment, i;
    if (rule.weight[0] == 0) rule = reference_gauss_rule();
    ends[1] = kink;
    ends[2] = REFERENCE_PI - kink;
    for (segment = 0; segment < 3; segment++) {
        double from = ends[segment], end = fmin(ends[segment + 1], last), to;
        for (; from < end; from = to) {
            to = fmin(from + width, end);
            for (i = 0; i < REFERENCE_GAUSS_COUNT; i++) {
                double turn = REFERENCE_PI / 2 * (1 + rule.node[i]);
                double theta = 0.5 * ((from + to) - (to - from) * cos(turn)), s = sin(theta / 2);
                whole += REFERENCE_PI / 4 * (to - from) * sin(turn) * rule.weight[i] * exp(-2 * sharpness * s * s) *
                         sin(theta) * clamped_cosine_ring(theta, c);
            }
        }
    }
    return whole / exact_integral(sharpness);
}

#endif
