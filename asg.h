/*
 asg.h - anisotropic spherical Gaussians and the specular light of virtual SG lights, version 0.1.0

   #include "asg.h"

   lobe_vec3 normal = {0, 0, 1}, viewer = {0, 0.8f, 0.6f}, sun = {0, -0.7f, 0.714142842f};
   sg_lobe light = {sun, 1000, 0};
   asg_lobe reflection = asg_ggx_lobe(normal, viewer, 0.1f);   // peak 1, stretched as highlights are
   float at_sun = asg_eval(reflection, sun);
   float seen = asg_sg_integral(reflection, light);            // the light, weighted by the reflection lobe

 Configuration: as sg.h, which this includes.

 Conventions: an ASG is max(w.z, 0) exp(log_amplitude - sharpness_x (w.x)^2 - sharpness_y (w.y)^2), with x, y,
 z orthonormal to 1e-6. Near its axis an SG is an ASG of half its sharpness. The clamped cosine belongs to the
 lobe. Directions, alpha, colour and units as in sg.h.

 Errors: as in sg.h. "directional" is relative, in (1 + |e| + sqrt(l |e|) + 2^-24 l) 2^-24 for an exponent e
 (of the value over its peak) and the larger sharpness l: what rounding of unit vectors alone costs, for
 cosines of order 1. In integrals amplitudes saturate at e^78. Out of finite input (unit vectors) comes no NaN
 and no infinity.

 Functions:

   asg_eval                              value in a direction
   asg_integral, _approx                 over the sphere; the papers' form
   asg_sg_integral, _xu                  of the product with an SG: accurate; Xu 2013
   asg_product_integral, _xu             of the product of two ASGs: accurate; Xu 2013
   asg_convolve                          with a normalised SG kernel
   asg_ggx_lobe, asg_ggx_lobe_aniso      reflection lobes of GGX surfaces
   asg_vsgl_specular                     light of a virtual SG light reflected by a GGX surface

 Papers named in the sources: 000 is Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual
 Spherical Gaussian Lights (supplement); 001 is Tokuyoshi 2015, Virtual Spherical Gaussian Lights for
 Real-Time Glossy Indirect Illumination (supplement); 004 is Tokuyoshi 2015, Specular Lobe-Aware Filtering and
 Upsampling for Interactive Indirect Illumination.
*/
#ifndef LOBE_ASG_H
#define LOBE_ASG_H

#include "sg.h"

/* ---- types ---- */

typedef struct asg_lobe {
    lobe_vec3 x, y, z; /* orthonormal; z is the axis */
    float sharpness_x, sharpness_y;
    float log_amplitude; /* natural logarithm of the peak value */
} asg_lobe;

/* ---- private helpers ---- */

/* e^x, at most e^78: the integral of a lobe times it is finite. */
LOBE_API float lobe_asg_exp(float x) {
    return lobe_min(lobe_exp(x), 7.5e33f); /* in this order gcc vectorises it */
}

/* 1 / sqrt(x), at most 100 */
LOBE_API float lobe_asg_rsqrt(float x) {
    return 1 / sqrtf(lobe_max(x, 1e-4f));
}

LOBE_API float lobe_asg_square(float x) {
    return x * x;
}

/* ---- evaluate and integrate ---- */

/*
 asg_eval - value of an ASG in a direction

   a, dir     sharpness [0, 1e30]
   returns    max(dir.z, 0) exp(log_amplitude - sharpness_x (dir.x)^2 - sharpness_y (dir.y)^2), components
              along the lobe's axes; 0 from the horizon down and below 2^-126, saturates at 2^122

   Rounding: <= 4.5 directional; near the horizon 4.5 2^-24 of the exponential is added
             [bound asg_eval directional 4.5 over 1e-8 1e10]
   Model:    exact
   Source:   Xu et al. 2013; 000, section 4.2
*/
LOBE_API float asg_eval(asg_lobe a, lobe_vec3 dir) {
    float x = lobe_dot(a.x, dir), y = lobe_dot(a.y, dir);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0);
    return lobe_max(lobe_dot(a.z, dir), 0) *
           lobe_exp(a.log_amplitude - (a.sharpness_x * (x * x) + a.sharpness_y * (y * y)));
}

/*
 asg_integral - integral of an ASG over the sphere

   a          sharpness [0, 1e30]
   returns    (0, pi] times the amplitude; pi for sharpness 0

   Rounding: <= 3e-7 relative for isotropic lobes, where the formula is exact
             [bound asg_integral isotropic 3e-7 over 1e-30 1e30]
   Model:    within 8e-4 relative   [bound asg_integral rel 8e-4 over 1e-2 1e5]
   Source:   fitted for this library: the clamped cosine is the Jacobian of the projection to the disk, where
             the integral of a plane Gaussian is sqrt(phi(lx) phi(ly)), phi(l) = (1 - e^-l) / l, but for a
             factor near 1 in the anisotropy
*/
LOBE_API float asg_integral(asg_lobe a) {
    float l = lobe_max(a.sharpness_x, a.sharpness_y), u = lobe_min(a.sharpness_x, a.sharpness_y);
    float d = lobe_min(l - u, 1e9f); /* both bounded, so that their product is */
    float b = 1 + 0.27323954f * d * d / ((13.62806f + d * (1.851625f + d)) * (1 + 0.145226f * lobe_min(u, 1e15f)));
    float narrow = lobe_phi(l), wide = b * lobe_phi(b * u);
    LOBE_ASSERT(u >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude) * (narrow * sqrtf(wide / narrow)); /* the product may vanish */
}

/*
 asg_integral_approx - the papers' form of the same integral

   a          each sharpness counts as at least 1e-4
   returns    pi / sqrt(sharpness_x sharpness_y) times the amplitude

   Rounding: below the model's
   Model:    within 4e-5 relative for sharpness of 10 or more; 1.6 times too large at 1, 10 times at 0.1
             [bound asg_integral_approx model 4e-5 over 10 1e5]
   Source:   Xu et al. 2013; 000, section 4.2 with an SG of sharpness 0
*/
LOBE_API float asg_integral_approx(asg_lobe a) {
    float x = lobe_max(a.sharpness_x, 1e-4f), y = lobe_max(a.sharpness_y, 1e-4f);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude) / (x * sqrtf(y / x)); /* x y may overflow */
}

/*
 asg_sg_integral_xu - Xu's integral of the product of an ASG and an SG

   a, g       sharpness [0, 1e30]; sums of the ASG's and half the SG's count as at least 1e-4
   returns    with nu = g.sharpness / 2, the ASG of sharpness l nu / (l + nu) at the SG's axis, times
              pi / sqrt((sharpness_x + nu) (sharpness_y + nu)); 0 for an SG from the horizon down

   Rounding: <= 9 directional   [bound asg_sg_integral_xu directional 9 over 1e12 1e20]
   Model:    within .035 of the value for aligned axes if all sharpnesses are 10 or more, relative RMS .07
             where the value is above 1 % of that; several times too large for sharpness below 1
             [bound asg_sg_integral_xu aligned .035 over 10 1e6]
             [bound asg_sg_integral_xu rms .07 over 10 1e6]
   Source:   Xu et al. 2013; 000, section 4.2; 001, Eq. 2
*/
LOBE_API float asg_sg_integral_xu(asg_lobe a, sg_lobe g) {
    float nu = 0.5f * g.sharpness;
    float ix = lobe_asg_rsqrt(a.sharpness_x + nu), iy = lobe_asg_rsqrt(a.sharpness_y + nu);
    float x = lobe_dot(a.x, g.axis), y = lobe_dot(a.y, g.axis);
    float loss = a.sharpness_x * (nu * ix * ix) * (x * x) + a.sharpness_y * (nu * iy * iy) * (y * y);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && g.sharpness >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude + g.log_amplitude - loss) * (ix * iy) *
           lobe_max(lobe_dot(a.z, g.axis), 0);
}

/* What the saddlepoint of an ASG times an SG needs, at tau: reciprocals of the three eigenvalues, the first
   two relative to the third, the shares of the SG's pull, and the second cumulant over t. */
typedef struct lobe_asg_saddle {
    float p, q, t;    /* 1 / (lx + tau), 1 / (ly + tau), 1 / tau */
    float rp, rq;     /* p / t, q / t */
    float ux, uy, uz; /* (nu x p)^2, (nu y q)^2, (nu z t)^2 */
    float k2;
} lobe_asg_saddle;

LOBE_API lobe_asg_saddle lobe_asg_saddle_at(float tau, float lx, float ly, float nu, float x2, float y2, float z2) {
    lobe_asg_saddle s;
    tau = lobe_max(tau, 0.5f); /* it is, but for rounding */
    s.p = 1 / (lx + tau);
    s.q = 1 / (ly + tau);
    s.t = 1 / tau;
    s.rp = tau * s.p;
    s.rq = tau * s.q;
    s.ux = x2 * lobe_asg_square(nu * s.p);
    s.uy = y2 * lobe_asg_square(nu * s.q);
    s.uz = z2 * lobe_asg_square(nu * s.t);
    s.k2 = 0.5f * s.t * (s.rp * s.rp + s.rq * s.rq + 1) + 2 * (s.ux * s.rp + s.uy * s.rq + s.uz);
    return s;
}

/* (1 + sqrt(1 + 16 nu^2 c2)) / 4 - nu for c2 + rest = 1: the root of the saddle equation of one axis alone,
   less nu. */
LOBE_API float lobe_asg_saddle_floor(float nu, float c2, float rest) {
    float root = sqrtf(1 + 16 * nu * nu * c2);
    return 0.25f * (1 + (1 - 16 * nu * nu * rest) / (root + 4 * nu));
}

/*
 asg_sg_integral - integral of the product of an ASG and an SG over the sphere

   a, g       sharpness [0, 1e30]; the ASG's above 1e12 counts as 1e12
   returns    (0, pi] times both amplitudes, also for an SG below the lobe's horizon

   Rounding: <= 9 directional   [bound asg_sg_integral directional 9 over 1e12 1e20]
   Model:    within .07 of the value for aligned axes, relative RMS .033 where the value is above 1 % of that;
             within 6e-5 if all sharpnesses are 100 or more
             [bound asg_sg_integral aligned .07 over 1e-2 1e6] [bound asg_sg_integral rms .033 over 1e-2 1e6]
             [bound asg_sg_integral sharp 6e-5 over 100 1e6]
   Source:   derived for this library: saddlepoint of the Fisher-Bingham normaliser (after Kume and Wood
             2005), with the clamped cosine taken against the marginal along z. Xu's form is the one with tau
             frozen at nu.
*/
LOBE_API float asg_sg_integral(asg_lobe a, sg_lobe g) {
    float nu = lobe_min(0.5f * g.sharpness, 1e15f);
    float lx = lobe_min(a.sharpness_x, 1e12f), ly = lobe_min(a.sharpness_y, 1e12f);
    float x = lobe_dot(a.x, g.axis), y = lobe_dot(a.y, g.axis), z = lobe_dot(a.z, g.axis);
    float x2 = x * x, y2 = y * y, z2 = z * z;
    float ix = 1 / (lx + nu + 1), iy = 1 / (ly + nu + 1), ra = (nu + 1) * ix, rb = (nu + 1) * iy;
    float d = 1 + ra + rb, away = x2 * (lx * ix) * (1 + ra) + y2 * (ly * iy) * (1 + rb);
    float root = sqrtf(d * d + 16 * nu * nu * (ra * ra * x2 + rb * rb * y2 + z2));
    float delta = 0.25f * (d + (d * d - 16 * nu * nu * away) / (root + 4 * nu)); /* tau - nu */
    float low = lobe_asg_saddle_floor(nu, z2, x2 + y2);
    float excess, ratio, k3, k4, skew, kurtosis, exponent, correction, spread, width, side, tail, mean, gauss, logistic,
        mass;
    lobe_asg_saddle s;
    LOBE_ASSERT(lx >= 0 && ly >= 0 && g.sharpness >= 0);
    low = lobe_max(low, lobe_asg_saddle_floor(nu, x2, y2 + z2) - lx);
    low = lobe_max(low, lobe_asg_saddle_floor(nu, y2, x2 + z2) - ly);
    delta = lobe_max(delta, low);
    /* one Newton step for F = 1, where F - 1 is formed without the ones */
    s = lobe_asg_saddle_at(nu + delta, lx, ly, nu, x2, y2, z2);
    excess =
        0.5f * (s.p + s.q + s.t) - (x2 * ((lx + delta) * s.p) * (1 + nu * s.p) +
                                    y2 * ((ly + delta) * s.q) * (1 + nu * s.q) + z2 * (delta * s.t) * (1 + nu * s.t));
    ratio = sqrtf(lobe_max(1 + excess, 0));
    delta += 2 * excess * ratio * (ratio / ((ratio + 1) * (s.t * s.k2)));
    delta = lobe_max(delta, low);
    s = lobe_asg_saddle_at(nu + delta, lx, ly, nu, x2, y2, z2);
    /* third and fourth cumulants and what they correct */
    k3 = s.t * (s.rp * s.rp * s.rp + s.rq * s.rq * s.rq + 1) + 6 * (s.ux * s.rp * s.rp + s.uy * s.rq * s.rq + s.uz);
    k4 = 3 * s.t * (lobe_asg_square(s.rp * s.rp) + lobe_asg_square(s.rq * s.rq) + 1) +
         24 * (s.ux * s.rp * s.rp * s.rp + s.uy * s.rq * s.rq * s.rq + s.uz);
    skew = s.t / s.k2 * lobe_asg_square(k3 / s.k2);
    kurtosis = s.t / s.k2 * (k4 / s.k2);
    exponent = delta * (delta * (z2 * s.t + x2 * s.p + y2 * s.q)) + (delta - nu) * (x2 * (lx * s.p) + y2 * (ly * s.q));
    exponent = lobe_min(exponent, 1.5f) + 0.125f * (kurtosis - 1.5f * skew);
    correction = 1 + 0.25f * skew * (0.166666667f + 0.25f * skew / (56.4f + 12.225f * skew));
    /* the clamped cosine: mean of a clamped normal deviate of mean side and variance 1, and a logistic one */
    spread = s.t * s.k2;
    width = sqrtf(0.5f * s.t * (1 + spread * (0.25f + spread * (0.03125f - 0.0068f * spread))));
    side = 1.41421356f * (nu * sqrtf(s.t)) * z;
    tail = fabsf(side);
    tail = lobe_exp(-0.5f * tail * tail) * (0.797884561f + 0.124702197f * tail) /
           (1 + tail * (1.40979419f + tail * (0.764714719f + 0.183666575f * tail)));
    mean = width * (fabsf(side) + tail);
    gauss = width * (lobe_max(side, 0) + 0.5f * tail);
    logistic = mean / (1 + lobe_exp(-4 * nu * z * mean));
    mass = lobe_max(gauss + (s.uz + 0.5f * s.t) * (logistic - gauss), 0);
    mass *= s.p * sqrtf(s.rq / s.rp / (s.k2 * correction)); /* sqrt(p q / (k2 correction)), where p q may vanish */
    return 1.41421356f * LOBE_PI * lobe_asg_exp(a.log_amplitude + g.log_amplitude + exponent) * mass *
           lobe_min(1, 2e15f / lobe_max(g.sharpness, 1));
}

/* Coefficients of det(Q + tau I) = ((tau + trace) tau + m2) tau + det for the summed quadratic forms Q of two
   lobes, all of them sums of positive terms, and three quotients of its adjugate. */
typedef struct lobe_asg_pair {
    float trace, m2, det;
    float quad_a, quad_b;                 /* za' Q za, zb' Q zb */
    float adj_aa, adj_bb, adj_ab, cosine; /* za' adj(Q) za ..., za.zb */
} lobe_asg_pair;

LOBE_API lobe_asg_pair lobe_asg_pair_of(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k;
    float l1 = lobe_min(a.sharpness_x, 1e9f), l2 = lobe_min(a.sharpness_y, 1e9f);
    float l3 = lobe_min(b.sharpness_x, 1e9f), l4 = lobe_min(b.sharpness_y, 1e9f);
    float xx = lobe_dot(a.x, b.x), xy = lobe_dot(a.x, b.y), xz = lobe_dot(a.x, b.z);
    float yx = lobe_dot(a.y, b.x), yy = lobe_dot(a.y, b.y), yz = lobe_dot(a.y, b.z);
    float zx = lobe_dot(a.z, b.x), zy = lobe_dot(a.z, b.y), zz = lobe_dot(a.z, b.z);
    float xx2 = xx * xx, xy2 = xy * xy, xz2 = xz * xz, yx2 = yx * yx, yy2 = yy * yy, yz2 = yz * yz;
    float zx2 = zx * zx, zy2 = zy * zy, zz2 = zz * zz, sine = xy2 + yx2, cosine = xx2 + yy2;
    float l12 = l1 * l2, l34 = l3 * l4, l13 = l1 * l3, l24 = l2 * l4, l14 = l1 * l4, l23 = l2 * l3;
    k.trace = l1 + l2 + l3 + l4;
    k.quad_a = l3 * zx2 + l4 * zy2;
    k.quad_b = l1 * xz2 + l2 * yz2;
    k.det = l12 * k.quad_a + l34 * k.quad_b;
    k.m2 = l12 + l34 +
           0.5f * (l13 * (sine + zx2 + xz2) + l24 * (sine + zy2 + yz2) + l14 * (cosine + zy2 + xz2) +
                   l23 * (cosine + zx2 + yz2));
    k.adj_aa = l12 + l34 * zz2 + l13 * yx2 + l24 * xy2 + l14 * yy2 + l23 * xx2;
    k.adj_bb = l34 + l12 * zz2 + l13 * xy2 + l24 * yx2 + l14 * xx2 + l23 * yy2;
    k.adj_ab = k.m2 * zz + l13 * (zx * xz * xx) + l24 * (zy * yz * yy) + l23 * (zx * yz * yx) + l14 * (zy * xz * xy);
    k.cosine = zz;
    return k;
}

/* The product integral as factor and exponent: a filter may keep its own lobe's and subtract exponents.
   Sharpness above 1e9 counts as 1e9. The exponent solves its equation to .1, against 1:
   [bound asg_product_integral saddle .1 over 1e-2 1e3] */
LOBE_API float lobe_asg_product(asg_lobe a, asg_lobe b, float *exponent) {
    lobe_asg_pair k = lobe_asg_pair_of(a, b);
    float trace = k.trace, low, tau, d, e2, e3, u, v, g0, g1, g2, g, h, lift, c, ca, cb, whole, cross;
    int step;
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && b.sharpness_x >= 0 && b.sharpness_y >= 0);
    /* tau is the largest root of 2 P - P', P = det(Q + tau I): two Laguerre steps from an upper bound */
    low = k.det / (k.m2 + LOBE_TINY);
    low = k.det / (k.m2 - low * (trace - low) + LOBE_TINY);
    tau = 1.5f - low;
    for (step = 0; step < 2; step++) {
        float p = ((tau + trace - 1.5f) * tau + k.m2 - trace) * tau + k.det - 0.5f * k.m2;
        float p1 = (3 * tau + 2 * (trace - 1.5f)) * tau + k.m2 - trace, p2 = 3 * tau + trace - 1.5f;
        tau -= 3 * p / lobe_max(p1 + 2 * sqrtf(lobe_max(p1 * p1 - 3 * p * p2, 0)), 1);
        tau = lobe_max(tau, 0.5f - 0.333333333f * trace);
    }
    /* Second and fourth moments of the Bingham density, as polynomials of the symmetric functions e2, e3 of
       its variances. The bounds of tau, d, e2 and c hold but for rounding near equal eigenvalues, where the
       value is 0. */
    d = lobe_max(0.5f * ((3 * tau + 2 * trace) * tau + k.m2), 3.375f);
    e3 = 0.125f / d;
    e2 = lobe_max(lobe_min(2 * e3 * (trace + 3 * tau), 0.333333333f), 0);
    u = 3 * e2;
    v = 27 * e3;
    g0 = v * (-0.2982644f + 0.298506f * u);
    g1 = 0.5684417f + u * (3.375156f - 2.985045f * u) + v * (1.160877f - 0.7304986f * u);
    g2 = 0.2893222f + u * (-3.337644f + 2.14187f * u) + v * (-0.8864377f + 0.4955553f * u);
    g = 0.5f * (g1 + g2) / d;
    h = g0 + g2 * (2 * tau * e3 - e2);
    lift = 2 * g2 * e3;
    v = tau * (trace + tau);
    c = h * k.cosine + g * (k.adj_ab + v * k.cosine);
    ca = h + lift * k.quad_a + g * (k.adj_aa + (v - tau * k.quad_a));
    cb = h + lift * k.quad_b + g * (k.adj_bb + (v - tau * k.quad_b));
    /* E max(za.w, 0) max(zb.w, 0) by the arc-cosine kernel, without the arc cosine */
    whole = sqrtf(lobe_max(ca * cb, 1e-30f));
    cross = sqrtf(lobe_max((whole - c) * (whole + c), 0));
    c = 0.5f * lobe_max(c, 0) +
        0.5f / LOBE_PI * cross *
            (cross * cross / (whole * whole + fabsf(c) * (1.5707963f * whole + 0.4292037f * fabsf(c))));
    *exponent = a.log_amplitude + b.log_amplitude + tau;
    return LOBE_PI * lobe_min(c, 2) / sqrtf(d * (1 - 2 * e2));
}

/*
 asg_product_integral - integral of the product of two ASGs over the sphere

   a, b       sharpness [0, 1e30]; above 1e9 it counts as 1e9
   returns    [0, pi] times both amplitudes

   Rounding: <= 5 directional for sharpness ratios up to 100
             [bound asg_product_integral directional 5 over 1e6 1e8]
             The weight, the integral over the geometric mean of the lobes' integrals with themselves, is
             exactly 1 for a lobe and itself; of lobes of any sharpness up to 1e9 it is symmetric to 1.5e-6
             and at most 1 + 1.5e-6
             [bound asg_product_integral symmetric 1.5e-6] [bound asg_product_integral excess 1.5e-6]
   Model:    within .0125 of that mean, relative RMS .045 where the value is above 1 % of it, the weight
             within .017; for sharpness of 10 or more within .005 relative where it is above 1 % of the mean
             [bound asg_product_integral aligned .0125 over 1e-2 1e5]
             [bound asg_product_integral rms .045 over 1e-2 1e5]
             [bound asg_product_integral weight .017 over 1e-2 1e5]
             [bound asg_product_integral sharp .005 over 10 1e5]
   Source:   derived for this library: saddlepoint of the Bingham normaliser, fitted moments, and the
             arc-cosine kernel for both clamped cosines. No eigenvectors: the coefficients of the
             characteristic polynomial are sums of positive terms, where Cardano's formula cancels (004,
             "Errors of ASGs"). 004, Eq. 13 is the weight.
*/
LOBE_API float asg_product_integral(asg_lobe a, asg_lobe b) {
    float exponent, factor = lobe_asg_product(a, b, &exponent);
    return factor * lobe_asg_exp(exponent);
}

/*
 asg_product_integral_xu - Xu's integral of the product of two ASGs, without eigenvectors

   a, b       sharpness [0, 1e30]; above 1e9 it counts as 1e9
   returns    at least 0, finite, times both amplitudes; 0 for axes more than about a right angle apart

   Rounding: <= 5 directional for sharpness ratios up to 100, and within 4e-5 relative of
             the form with eigenvectors
             [bound asg_product_integral_xu directional 5 over 1e6 1e8]
             [bound asg_product_integral_xu eigenvectors 4e-5 over 10 1e4]
   Model:    for sharpness of 10 or more within .005 of the geometric mean of the lobes' integrals with
             themselves, relative RMS .004 where the value is above 1 % of that, the weight within .004; below
             1 useless
             [bound asg_product_integral_xu aligned .005 over 10 1e5]
             [bound asg_product_integral_xu rms .004 over 10 1e5]
             [bound asg_product_integral_xu weight .004 over 10 1e5]
   Source:   Xu et al. 2013; 004, section 4.2. The smallest eigenvalue by Laguerre's method
*/
LOBE_API float asg_product_integral_xu(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k = lobe_asg_pair_of(a, b);
    float low = 0, gap;
    int step;
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && b.sharpness_x >= 0 && b.sharpness_y >= 0);
    /* the smallest eigenvalue, from 0 by Laguerre's steps: p = det(Q - low I), p1 = -p', p2 = p'' / 2 */
    for (step = 0; step < 2; step++) {
        float p = ((k.trace - low) * low - k.m2) * low + k.det;
        float p1 = k.m2 - (2 * k.trace - 3 * low) * low, p2 = k.trace - 3 * low;
        low = lobe_max(low + 3 * p / (p1 + 2 * sqrtf(lobe_max(p1 * p1 - 3 * p * p2, 0)) + LOBE_TINY), 0);
    }
    gap = lobe_max(k.m2 - (2 * k.trace - 3 * low) * low, 1e-8f); /* product of the other two, less low each */
    return LOBE_PI * lobe_asg_exp(a.log_amplitude + b.log_amplitude - low) / sqrtf(gap) *
           lobe_max(lobe_min((k.adj_ab - low * (k.trace - low) * k.cosine) / gap, 1), 0);
}

/*
 asg_convolve - an ASG blurred by a normalised SG kernel

   a          sharpness [0, 1e30]
   kappa      sharpness of the kernel, (0, infinity], counts as at least 1e-8; infinity leaves a as it is
   returns    the same axes, each sharpness l as l / (1 + 2 l / kappa), the amplitude scaled by
              1 / sqrt((1 + 2 lx / kappa) (1 + 2 ly / kappa))

   Rounding: <= 2e-7 relative in sharpness and in 1 + |log_amplitude|
             [bound asg_convolve rel 2e-7 over 1e-8 1e10]
   Model:    Xu's product integral: values within .03 of the blurred peak, if all sharpnesses are 10 or more
             [bound asg_convolve model .03 over 10 1e5]
   Source:   004, section 4.2, times kappa / (2 pi)
*/
LOBE_API asg_lobe asg_convolve(asg_lobe a, float kappa) {
    float scale = 2 / lobe_max(kappa, 1e-8f), rx = a.sharpness_x * scale, ry = a.sharpness_y * scale;
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && kappa > 0);
    a.sharpness_x /= 1 + rx;
    a.sharpness_y /= 1 + ry;
    a.log_amplitude -= 0.5f * (lobe_log(1 + rx) + lobe_log(1 + ry));
    return a;
}

/* ---- reflection lobes ---- */

/* x and y perpendicular to the axis, y also to the normal, x on the normal's side. Any frame is as good where
   axis and normal agree. */
LOBE_API void lobe_asg_frame(lobe_vec3 normal, asg_lobe *lobe) {
    lobe_vec3 u, v;
    float c, d, size, inverse;
    lobe_frame(lobe->z, &u, &v);
    c = lobe_dot(normal, u);
    d = lobe_dot(normal, v);
    size = sqrtf(c * c + d * d);
    inverse = 1 / lobe_max(size, 1e-15f);
    c = size > 1e-15f ? c * inverse : 1.0f;
    d *= inverse;
    lobe->x = lobe_add(lobe_scale(u, c), lobe_scale(v, d));
    lobe->y = lobe_sub(lobe_scale(v, c), lobe_scale(u, d));
}

/*
 asg_ggx_lobe - reflection lobe of an isotropic GGX surface

   normal, wi  wi may lie below the horizon; dot(wi, normal) is taken as at least 1e-4 in size
   alpha       [1e-4, 1], clamped below
   returns     peak 1 around the mirror direction z; x in the plane of incidence, on the normal's side, with
               sharpness 1 / (4 alpha^2); y across it with 1 / (4 alpha^2 cos^2); at normal incidence any x

   Rounding: frame orthonormal to 1.1e-6; sharpness within 9 2^-24 / cos relative, what rounding of the
             directions costs   [bound asg_ggx_lobe orthonormal 1.1e-6] [bound asg_ggx_lobe cosine 9]
   Model:    first-order warp of half vectors, Gaussian for GGX, which has a narrower middle and heavier
             tails: values within .24 of the distribution over its peak, the integral within .11 relative for
             cos >= .4
             [bound asg_ggx_lobe value .24 over .02 .3] [bound asg_ggx_lobe integral .11 over .02 .3]
   Source:   Xu et al. 2013; Wang et al. 2009; 000, section 4.2
*/
LOBE_API asg_lobe asg_ggx_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) {
    asg_lobe a;
    float cos_theta = lobe_dot(wi, normal), scale = 0.5f / lobe_max(alpha, 1e-4f);
    a.z = lobe_normalize_or(lobe_sub(lobe_scale(normal, 2 * cos_theta), wi), normal);
    lobe_asg_frame(normal, &a);
    a.sharpness_x = scale * scale;
    a.sharpness_y = lobe_asg_square(scale / lobe_max(fabsf(cos_theta), 1e-4f));
    a.log_amplitude = 0;
    return a;
}

/*
 asg_ggx_lobe_aniso - reflection lobe of an anisotropic GGX surface

   tangent           perpendicular to normal, the direction of alpha_x; alpha_y: cross(normal, tangent)
   alpha_x, alpha_y  [1e-4, 1], clamped below
   returns           as asg_ggx_lobe, with x the wider axis and y the narrower one

   Rounding: as asg_ggx_lobe; of equal alphas sharpness within 22 2^-24 / cos relative
             [bound asg_ggx_lobe_aniso cosine 22]
   Model:    as asg_ggx_lobe; against the distribution's the exponent near the axis is within .02
             [bound asg_ggx_lobe_aniso curvature .02]
   Source:   as asg_ggx_lobe: the form diag(1 / alpha^2) through the warp's Jacobian, its 2x2 matrix
             diagonalised
*/
LOBE_API asg_lobe asg_ggx_lobe_aniso(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float alpha_x, float alpha_y) {
    asg_lobe a, turned;
    lobe_vec3 along, bitangent;
    float cos_theta = lobe_dot(wi, normal), stretch = 1 / lobe_max(fabsf(cos_theta), 1e-4f);
    float gx = 0.5f / lobe_max(alpha_x, 1e-4f), gy = 0.5f / lobe_max(alpha_y, 1e-4f);
    float px, py, qx, qy, middle, spread, radius, c, s, size, largest, area = gx * stretch * gy;
    a.z = lobe_normalize_or(lobe_sub(lobe_scale(normal, 2 * cos_theta), wi), normal);
    lobe_asg_frame(normal, &a);
    along = lobe_cross(a.y, normal);
    bitangent = lobe_cross(normal, tangent);
    px = gx * lobe_dot(along, tangent);
    py = gx * lobe_dot(a.y, tangent) * stretch;
    qx = gy * lobe_dot(along, bitangent);
    qy = gy * lobe_dot(a.y, bitangent) * stretch;
    middle = 0.5f * (px * px + qx * qx + py * py + qy * qy);
    spread = 0.5f * ((px - py) * (px + py) + (qx - qy) * (qx + qy));
    c = px * py + qx * qy;
    radius = sqrtf(spread * spread + c * c);
    largest = middle + radius;
    s = spread > 0 ? radius + spread : c;
    c = spread > 0 ? c : radius - spread;
    size = sqrtf(s * s + c * c);
    s = size > LOBE_TINY ? s / size : 0.0f;
    c = size > LOBE_TINY ? c / size : 1.0f;
    turned = a;
    turned.y = lobe_add(lobe_scale(a.x, s), lobe_scale(a.y, c));
    turned.x = lobe_sub(lobe_scale(a.x, c), lobe_scale(a.y, s));
    turned.sharpness_y = largest;
    turned.sharpness_x = area * (area / lobe_max(largest, area)); /* the determinant is area^2 */
    turned.log_amplitude = 0;
    return turned;
}

/* ---- virtual spherical Gaussian lights ---- */

/*
 asg_vsgl_specular - light of one component of a virtual SG light reflected by a GGX surface

   v, component  variance [0, 1e10]; intensity is left to the caller
   point         at most 1e5 from the light
   wi            towards the viewer
   alpha         [1e-4, 1], clamped below
   reflection    asg_ggx_lobe(normal, wi, alpha) or any other of log_amplitude at most 10: once for all lights
   returns       reflected radiance per unit of v.intensity[component] and Fresnel reflectance

   Rounding: <= 17 directional   [bound asg_vsgl_specular directional 17]
             A variance of 0, or below 1e-9 of the squared distance, gives the point light to 8e-6
             [bound asg_vsgl_specular rel 8e-6]
   Model:    against the integral of incoming lobe, reflection and C: within .05 for lights of a standard
             deviation up to a tenth of their distance and within alpha of the mirror direction, above grazing
             incidence
             [bound asg_vsgl_specular model .05 over .1 .5]
   Source:   000, section 4.2, with the inverse variance gathered with nu, so that neither overflows. C is the
             peak 1 / (pi alpha^2) times Smith's height-correlated visibility (Heitz 2014) times the cosine,
             constant over the incoming lobe.
*/
LOBE_API float asg_vsgl_specular(vsgl v, int component, lobe_vec3 point, lobe_vec3 normal, lobe_vec3 wi, float alpha,
                                 asg_lobe reflection) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, point, &inverse_variance);
    float lx = reflection.sharpness_x, ly = reflection.sharpness_y, nu = 0.5f * g.sharpness;
    float ix = 1 / sqrtf(lobe_max(lx + nu, 0.1f)), iy = 1 / sqrtf(lobe_max(ly + nu, 0.1f));
    float x = lobe_dot(reflection.x, g.axis), y = lobe_dot(reflection.y, g.axis);
    float loss = lx * (nu * ix * ix) * (x * x) + ly * (nu * iy * iy) * (y * y);
    float value = lobe_min(lobe_exp(g.log_amplitude + reflection.log_amplitude - loss), 2.2e4f);
    float a2 = lobe_asg_square(lobe_max(alpha, 1e-4f));
    float ci = lobe_max(lobe_dot(wi, normal), 0), co = lobe_max(lobe_dot(g.axis, normal), 0);
    float smith = co * sqrtf(a2 + (1 - a2) * ci * ci) + ci * sqrtf(a2 + (1 - a2) * co * co);
    return value * (0.25f / LOBE_PI * inverse_variance * ix * iy) * lobe_max(lobe_dot(reflection.z, g.axis), 0) * co /
           (a2 * lobe_max(smith, 1e-20f));
}

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
