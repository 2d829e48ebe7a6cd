/*
 exact_asg.h - ASGs in double and their integrals by nested Gauss-Legendre quadrature, for the unit tests and the bench

   double both = reference_product(a, &b, NULL);     // of two ASGs; of an ASG and an SG: reference_product(a, NULL, &g)
   double whole = reference_integral(lx, ly);        // of one, by one integral

 To 1e-9 for sharpness up to 1e8 and any anisotropy.
*/
#ifndef EXACT_ASG_H
#define EXACT_ASG_H

#include "../asg.h"
#include "reference.h"
#include "test.h"
#include <stddef.h>

/* ---- vectors and lobes in double ---- */

typedef struct {
    double x[3], y[3], z[3], lx, ly, log_amplitude;
} exact_asg;

static inline double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void normalize(double v[3]) {
    double size = sqrt(dot(v, v));
    int k;
    for (k = 0; k < 3; k++) v[k] /= size;
}

static inline void widen(lobe_vec3 v, double out[3]) {
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

static inline lobe_vec3 narrow(const double v[3]) {
    return lobe_vector((float)v[0], (float)v[1], (float)v[2]);
}

/* The lobe that a float lobe stands for: its frame made orthonormal. */
static inline exact_asg exact_of(asg_lobe a) {
    exact_asg e;
    double d;
    int k;
    widen(a.x, e.x);
    widen(a.z, e.z);
    normalize(e.z);
    d = dot(e.x, e.z);
    for (k = 0; k < 3; k++) e.x[k] -= d * e.z[k];
    normalize(e.x);
    cross(e.z, e.x, e.y);
    e.lx = (double)a.sharpness_x;
    e.ly = (double)a.sharpness_y;
    e.log_amplitude = (double)a.log_amplitude;
    return e;
}

static inline double exact_eval(const exact_asg *a, const double w[3]) {
    double x = dot(w, a->x), y = dot(w, a->y);
    return fmax(dot(w, a->z), 0) * exp(a->log_amplitude - a->lx * x * x - a->ly * y * y);
}

/* Eq. 7 of 000, the product of a light's extent and its emission: axis, and logarithm of the peak but for the factor
   inverse_variance / (2 pi); returns the sharpness. The offset is the light's from the point. */
static inline double exact_incoming(const double offset[3], const double emission[3], double sharpness,
                                    double inverse_variance, double axis[3], double *log_peak) {
    double away[3], lobe[3], extent = dot(offset, offset) * inverse_variance, size, chord = 0;
    int k;
    for (k = 0; k < 3; k++) {
        away[k] = offset[k];
        lobe[k] = emission[k];
    }
    normalize(away);
    normalize(lobe);
    for (k = 0; k < 3; k++) {
        axis[k] = extent * away[k] - sharpness * lobe[k];
        chord += pow(away[k] + lobe[k], 2);
    }
    size = sqrt(dot(axis, axis));
    *log_peak = -extent * sharpness * chord / (size + extent + sharpness);
    normalize(axis);
    return size;
}

/* A lobe around a direction, its x axis turned by an angle. */
static inline asg_lobe lobe_around(const double z[3], double turn, double lx, double ly) {
    asg_lobe a;
    double u[3], v[3], x[3], y[3];
    int k;
    reference_frame(z, u, v);
    for (k = 0; k < 3; k++) {
        x[k] = cos(turn) * u[k] + sin(turn) * v[k];
        y[k] = cos(turn) * v[k] - sin(turn) * u[k];
    }
    a.x = narrow(x);
    a.y = narrow(y);
    a.z = narrow(z);
    a.sharpness_x = (float)lx;
    a.sharpness_y = (float)ly;
    a.log_amplitude = 0;
    return a;
}

/* A direction at an angle from another, in a random azimuth. */
static inline void direction_near(test_rng *rng, const double axis[3], double angle, double out[3]) {
    double u[3], v[3], phi = 2 * REFERENCE_PI * test_uniform(rng);
    int k;
    reference_frame(axis, u, v);
    for (k = 0; k < 3; k++) {
        out[k] = cos(angle) * axis[k] + sin(angle) * (cos(phi) * u[k] + sin(phi) * v[k]);
    }
}

/* Two lobes of sharpness 1e-3 to `high`, by turns at random, near each other, and near with the second turned or sharper.
   Writes both sharpnesses of each, and the angle between them. */
static inline void draw_near_asgs(test_rng *rng, int i, double high, double inputs[5], asg_lobe *a, asg_lobe *b) {
    double z[3], other[3], turn = 7 * test_uniform(rng), turned, width;
    int k;
    test_direction(rng, z);
    for (k = 0; k < 4; k++) inputs[k] = test_log_uniform(rng, 1e-3, high);
    inputs[4] = acos(1 - 2 * test_uniform(rng));
    turned = 7 * test_uniform(rng);
    if (i % 4) { /* near each other */
        width = test_log_uniform(rng, 1e-4, 1) / sqrt(1 + fmax(inputs[0], inputs[1]));
        inputs[2] = inputs[0] * (1 + (i % 4 - 1) * test_uniform(rng));
        inputs[3] = inputs[1] * (1 + (i % 4 - 1) * test_uniform(rng));
        inputs[4] = width;
        turned = turn + (i % 4 == 2 ? width : 0);
    }
    *a = lobe_around(z, turn, inputs[0], inputs[1]);
    direction_near(rng, z, inputs[4], other);
    *b = lobe_around(other, turned, inputs[2], inputs[3]);
}

static inline sg_lobe sg_around(const double axis[3], double sharpness) {
    sg_lobe g;
    g.axis = narrow(axis);
    g.sharpness = (float)sharpness;
    g.log_amplitude = 0;
    return g;
}

/* ---- quadrature ----

 The integral of exp(pull.w - w'form w) max(w.z0, 0) max(w.z1, 0) over the sphere. In the frame whose x axis
 is perpendicular to z0 and z1, with z0 as z, w = (sin a, cos a sin b, cos a cos b): the two planes bound b
 alone, and the integrand is smooth between. The exponent on a ring of constant a is a trigonometric
 polynomial of b, which gives the peak; meshes are graded from there. */
typedef struct {
    double form[3][3], pull[3], second[3], low, high, top;
    int axes;
    reference_gauss rule;
} lune;

typedef struct {
    double constant, cosine, sine, square, mixed; /* of 1, cos b, sin b, cos^2 b, cos b sin b */
} ring;

static inline ring ring_at(const lune *l, double a) {
    double s = sin(a), c = cos(a);
    ring r;
    r.constant = l->pull[0] * s - l->form[0][0] * s * s - l->form[1][1] * c * c;
    r.cosine = c * (l->pull[2] - 2 * l->form[0][2] * s);
    r.sine = c * (l->pull[1] - 2 * l->form[0][1] * s);
    r.square = c * c * (l->form[1][1] - l->form[2][2]);
    r.mixed = -2 * c * c * l->form[1][2];
    return r;
}

static inline double ring_exponent(const ring *r, double c, double s) {
    return r->constant + c * (r->cosine + r->square * c + r->mixed * s) + r->sine * s;
}

static inline double ring_slope(const ring *r, double b, double *curvature) {
    double c = cos(b), s = sin(b), c2 = c * c - s * s, s2 = 2 * s * c;
    *curvature = -r->cosine * c - r->sine * s - 2 * r->square * c2 - 2 * r->mixed * s2;
    return -r->cosine * s + r->sine * c - r->square * s2 + r->mixed * c2;
}

static inline double ring_peak(const lune *l, const ring *r) {
    const int count = 16;
    double step = (l->high - l->low) / count, best = 0, at = 0, curvature;
    double c = cos(l->low), s = sin(l->low), cs = cos(step), ss = sin(step), from, to;
    int i;
    for (i = 0; i <= count; i++) {
        double e = ring_exponent(r, c, s), turned = c * cs - s * ss;
        if (i == 0 || e > best) {
            best = e;
            at = l->low + i * step;
        }
        s = s * cs + c * ss;
        c = turned;
    }
    from = fmax(at - step, l->low);
    to = fmin(at + step, l->high);
    for (i = 0; i < 8; i++) {
        at = 0.5 * (from + to);
        if (ring_slope(r, at, &curvature) > 0)
            from = at;
        else
            to = at;
    }
    for (i = 0; i < 3; i++) {
        double slope = ring_slope(r, at, &curvature);
        if (curvature < 0) at = fmin(fmax(at - slope / curvature, from), to);
    }
    return at;
}

/* Edges graded from `at`, where the first panels have the given width, to low and high. */
static inline int graded_mesh(double low, double high, double at, double width, double *edges) {
    const double growth = 2.5, widest = 0.5;
    double below[128], w, e;
    int count = 0, lower = 0;
    for (w = width, e = at - w; e > low && lower < 60; w = fmin(w * growth, widest), e -= w) below[lower++] = e;
    edges[count++] = low;
    while (lower > 0) edges[count++] = below[--lower];
    if (at > low) edges[count++] = at;
    for (w = width, e = at + w; e < high && count < 120; w = fmin(w * growth, widest), e += w) edges[count++] = e;
    if (edges[count - 1] < high) edges[count++] = high;
    return count;
}

static inline double ring_integral(const lune *l, double a) {
    const ring r = ring_at(l, a);
    const double across = cos(a), peak = ring_peak(l, &r);
    double edges[128], curvature, slope, width, sum = 0;
    int count, i, k;
    if (ring_exponent(&r, cos(peak), sin(peak)) < l->top - 40) return 0;
    slope = ring_slope(&r, peak, &curvature);
    width = 1 / (1 + sqrt(fabs(curvature)) + fabs(slope));
    count = graded_mesh(l->low, l->high, peak, width, edges);
    for (i = 0; i + 1 < count; i++) {
        double half = 0.5 * (edges[i + 1] - edges[i]), middle = 0.5 * (edges[i + 1] + edges[i]);
        for (k = 0; k < REFERENCE_GAUSS_COUNT; k++) {
            double b = middle + half * l->rule.node[k], c = cos(b), s = sin(b);
            double e = ring_exponent(&r, c, s) - l->top, value = across * c;
            if (e < -40) continue;
            if (l->axes == 2) value *= across * (s * l->second[1] + c * l->second[2]);
            sum += half * l->rule.weight[k] * value * exp(e);
        }
    }
    return sum * across;
}

static inline double profile(const lune *l, double a) {
    const ring r = ring_at(l, a);
    double b = ring_peak(l, &r);
    return ring_exponent(&r, cos(b), sin(b));
}

/* Of one or two ASGs and an SG (or none). */
static inline double reference_product(asg_lobe first, const asg_lobe *second, const sg_lobe *g) {
    exact_asg lobe[2];
    double frame[3][3], edges[128], axis[3], step, at = 0, from, to, width, sum = 0, log_amplitude;
    lune l;
    int n, i, j, k, m, count, aligned;
    l.axes = second ? 2 : 1;
    l.rule = reference_gauss_rule();
    lobe[0] = exact_of(first);
    lobe[1] = exact_of(second ? *second : first);
    cross(lobe[0].z, lobe[1].z, frame[0]);
    aligned = dot(frame[0], frame[0]) < 1e-20; /* then the narrower axis goes across the rings */
    for (k = 0; k < 3; k++) {
        if (aligned) frame[0][k] = lobe[0].lx > lobe[0].ly ? lobe[0].x[k] : lobe[0].y[k];
        frame[2][k] = lobe[0].z[k];
    }
    normalize(frame[0]);
    cross(frame[2], frame[0], frame[1]);
    log_amplitude = lobe[0].log_amplitude + (second ? lobe[1].log_amplitude : 0);
    if (g) {
        widen(g->axis, axis);
        normalize(axis);
        log_amplitude += (double)g->log_amplitude - (double)g->sharpness;
    }
    for (i = 0; i < 3; i++) {
        l.pull[i] = g ? (double)g->sharpness * dot(axis, frame[i]) : 0;
        l.second[i] = dot(lobe[1].z, frame[i]);
        for (j = 0; j < 3; j++) {
            l.form[i][j] = 0;
            for (n = 0; n < l.axes; n++) {
                l.form[i][j] += lobe[n].lx * dot(lobe[n].x, frame[i]) * dot(lobe[n].x, frame[j]) +
                                lobe[n].ly * dot(lobe[n].y, frame[i]) * dot(lobe[n].y, frame[j]);
            }
        }
    }
    l.low = -REFERENCE_PI / 2;
    l.high = REFERENCE_PI / 2;
    if (l.axes == 2) {
        double b = atan2(l.second[1], l.second[2]);
        if (b > 0)
            l.low += b;
        else
            l.high += b;
        if (l.high - l.low < 1e-9) return 0;
    }
    from = -REFERENCE_PI / 2;
    step = REFERENCE_PI / 24;
    l.top = -HUGE_VAL;
    for (i = 0; i <= 24; i++) {
        double top = profile(&l, from + i * step);
        if (top > l.top) {
            l.top = top;
            at = from + i * step;
        }
    }
    from = fmax(at - step, -REFERENCE_PI / 2);
    to = fmin(at + step, REFERENCE_PI / 2);
    for (m = 0; m < 36; m++) {
        double lower = from + 0.381966 * (to - from), upper = from + 0.618034 * (to - from);
        if (profile(&l, lower) < profile(&l, upper))
            from = lower;
        else
            to = upper;
    }
    at = 0.5 * (from + to);
    l.top = profile(&l, at);
    for (width = 1e-7; width < 1; width *= 1.6) {
        double lower = at - width > -REFERENCE_PI / 2 ? profile(&l, at - width) : -HUGE_VAL;
        double upper = at + width < REFERENCE_PI / 2 ? profile(&l, at + width) : -HUGE_VAL;
        if (fmax(lower, upper) < l.top - 0.5) break;
    }
    count = graded_mesh(-REFERENCE_PI / 2, REFERENCE_PI / 2, at, width, edges);
    for (i = 0; i + 1 < count; i++) {
        double half = 0.5 * (edges[i + 1] - edges[i]), middle = 0.5 * (edges[i + 1] + edges[i]);
        for (k = 0; k < REFERENCE_GAUSS_COUNT; k++) {
            sum += half * l.rule.weight[k] * ring_integral(&l, middle + half * l.rule.node[k]);
        }
    }
    return l.top + log_amplitude > -600 ? sum * exp(l.top + log_amplitude) : 0;
}

/* The same for one ASG, by one integral over the azimuth of the projected disk. */
static inline double reference_integral(double lx, double ly) {
    const reference_gauss rule = reference_gauss_rule();
    double u = fmin(lx, ly), d = fmax(lx, ly) - u, edges[128], sum = 0;
    int count = graded_mesh(0, REFERENCE_PI / 2, 0, sqrt((1 + u) / (1 + u + d)), edges), i, k;
    for (i = 0; i + 1 < count; i++) {
        double half = 0.5 * (edges[i + 1] - edges[i]), middle = 0.5 * (edges[i + 1] + edges[i]);
        for (k = 0; k < REFERENCE_GAUSS_COUNT; k++) {
            double s = sin(middle + half * rule.node[k]), l = u + d * s * s;
            sum += half * rule.weight[k] * (l > 1e-12 ? -expm1(-l) / l : 1);
        }
    }
    return 2 * sum;
}

#endif
