/*
 reference.h - quadrature in double for the unit tests, independent of the code under test

   reference_gauss rule = reference_gauss_rule();         // 16 nodes and weights on [-1, 1]
   double whole = reference_sphere(f, context, axis, sharpness);

 Integrands take a unit direction and a context pointer of the caller's.
*/
#ifndef REFERENCE_H
#define REFERENCE_H

#include <math.h>

#define REFERENCE_PI 3.14159265358979323846
#define REFERENCE_GAUSS_COUNT 16
#define REFERENCE_PANELS 64

/* Gauss-Legendre nodes and weights on [-1, 1]. */
typedef struct {
    double node[REFERENCE_GAUSS_COUNT], weight[REFERENCE_GAUSS_COUNT];
} reference_gauss;

/* By Newton's method on the Legendre polynomial; 1e-15. */
static inline reference_gauss reference_gauss_rule(void) {
    reference_gauss rule;
    int i, k, step;
    const int n = REFERENCE_GAUSS_COUNT;
    for (i = 0; i < n; i++) {
        double x = cos(REFERENCE_PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (step = 0; step < 10; step++) {
            double p = 1, previous = 0;
            for (k = 0; k < n; k++) {
                double next = ((2 * k + 1) * x * p - k * previous) / (k + 1);
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            x -= p / slope;
        }
        rule.node[i] = x;
        rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

/* Two unit vectors that complete a unit axis to a right-handed frame. */
static inline void reference_frame(const double axis[3], double u[3], double v[3]) {
    double size;
    int least = fabs(axis[0]) < fabs(axis[1]) ? 0 : 1, k;
    if (fabs(axis[2]) < fabs(axis[least])) least = 2;
    for (k = 0; k < 3; k++) u[k] = (k == least) - axis[least] * axis[k];
    size = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (k = 0; k < 3; k++) u[k] /= size;
    v[0] = axis[1] * u[2] - axis[2] * u[1];
    v[1] = axis[2] * u[0] - axis[0] * u[2];
    v[2] = axis[0] * u[1] - axis[1] * u[0];
}

/*
 reference_sphere_azimuth - integral of f over the sphere

   axis       where f has its peak, unit length
   sharpness  [0, 1e9]: f falls off about it like an SG of that sharpness, or more slowly
   azimuths   points of the trapezoid rule on each circle: exact for harmonics below it

   Smooth integrands to 1e-12 once the azimuth is resolved. A kink in azimuth costs up to 2 / azimuths^2, one
   in the polar angle up to 1e-5.
*/
static inline double reference_sphere_azimuth(double (*f)(const double w[3], const void *context), const void *context,
                                              const double axis[3], double sharpness, int azimuths) {
    const reference_gauss rule = reference_gauss_rule();
    const double peak = 1 / sqrt(1 + sharpness), growth = 1.5;
    double u[3], v[3], from = 0, to = peak < 0.4 ? peak : 0.4, sum = 0;
    int panel, i, j, k;
    reference_frame(axis, u, v);
    for (panel = 0; panel < REFERENCE_PANELS && from < REFERENCE_PI; panel++) {
        for (i = 0; i < REFERENCE_GAUSS_COUNT; i++) {
            double theta = from + (to - from) * 0.5 * (1 + rule.node[i]), ring = 0;
            for (j = 0; j < azimuths; j++) {
                double phi = 2 * REFERENCE_PI * (j + 0.5) / azimuths, w[3];
                double c = sin(theta) * cos(phi), s = sin(theta) * sin(phi);
                for (k = 0; k < 3; k++) w[k] = cos(theta) * axis[k] + c * u[k] + s * v[k];
                ring += f(w, context);
            }
            sum += rule.weight[i] * (to - from) * 0.5 * sin(theta) * ring * (2 * REFERENCE_PI / azimuths);
        }
        from = to;
        to = to * growth;
        if (to - from > 0.4) to = from + 0.4;
        if (to > REFERENCE_PI) to = REFERENCE_PI;
    }
    return sum;
}

/* The same with 64 azimuths: 1e-12 for SGs up to 1e8, also where the peak is a few widths off the axis. */
static inline double reference_sphere(double (*f)(const double w[3], const void *context), const void *context,
                                      const double axis[3], double sharpness) {
    return reference_sphere_azimuth(f, context, axis, sharpness, 64);
}

#endif
