/*
 asg.h - anisotropic spherical Gaussians and the specular light of virtual SG lights, version 1.0.0

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
   asg_isotropic                         the SG that stands for an ASG
   asg_sg_form                           which of these three an error allowed calls for
   asg_product_integral, _xu             of the product of two ASGs: accurate; Xu 2013
   asg_convolve                          with a normalised SG kernel
   asg_reflection_lobe, _aniso           reflection lobes from the sharpness of a distribution of half vectors
   asg_ggx_lobe, _aniso                  of GGX surfaces; so of others:
   asg_beckmann_lobe, _aniso, asg_ward_lobe, asg_phong_lobe, asg_ashikhmin_lobe
   asg_vsgl_specular                     light of a virtual SG light reflected by a GGX surface

 Papers named in the sources: 000 is Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual
 Spherical Gaussian Lights (supplement); 001 is Tokuyoshi 2015, Virtual Spherical Gaussian Lights for
 Real-Time Glossy Indirect Illumination (supplement); 004 is Tokuyoshi 2015, Specular Lobe-Aware Filtering and
 Upsampling for Interactive Indirect Illumination.
*/
#ifndef LOBE_ASG_H
#define LOBE_ASG_H

#ifndef LOBE_VERSION
#define LOBE_VERSION 10000 /* 10000 major + 100 minor + patch */
#elif LOBE_VERSION != 10000
#error "headers of different versions of Lobe"
#endif

#include "sg.h"

/* Clang leaves a large function that is called twice out of line, and vectorises no loop with a call. */
#ifdef __clang__
#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)
#endif

/* ---- types ---- */

typedef struct asg_lobe {
    lobe_vec3 x, y, z; /* orthonormal; z is the axis */
    float sharpness_x, sharpness_y;
    float log_amplitude; /* natural logarithm of the peak value */
} asg_lobe;

/* ---- private helpers ---- */

/* e^x, at most e^78: the integral of a lobe times it is finite. */
LOBE_API float lobe_asg_exp(float x) {
    return lobe_at_most(lobe_exp(x), 7.5e33f);
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

   Rounding: <= 5.5 directional; near the horizon 5.5 2^-24 of the exponential is added
             [bound asg_eval directional 5.5 over 1e-8 1e10]
   Model:    exact
   Source:   Xu et al. 2013; 000, section 4.2
*/
LOBE_API float asg_eval(asg_lobe a, lobe_vec3 dir) {
    float x = lobe_dot(a.x, dir), y = lobe_dot(a.y, dir);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0);
    return lobe_at_least(lobe_dot(a.z, dir), 0) *
           lobe_exp(a.log_amplitude - (a.sharpness_x * (x * x) + a.sharpness_y * (y * y)));
}

/*
 asg_integral - integral of an ASG over the sphere

   a          sharpness [0, 1e30]
   returns    (0, pi] times the amplitude; pi for sharpness 0

   Rounding: <= 1e-6 relative; 3e-7 for isotropic lobes, where the formula is exact
             [bound asg_integral formula 1e-6 over 1e-2 1e5] [bound asg_integral isotropic 3e-7 over 1e-30 1e30]
   Model:    within 8e-4 relative   [bound asg_integral rel 8e-4 over 1e-2 1e5]
   Source:   fitted for this library: the clamped cosine is the Jacobian of the projection to the disk, where
             the integral of a plane Gaussian is sqrt(phi(lx) phi(ly)), phi(l) = (1 - e^-l) / l, but for a
             factor near 1 in the anisotropy
*/
LOBE_API float asg_integral(asg_lobe a) {
    float l = lobe_at_least(a.sharpness_x, a.sharpness_y), u = lobe_at_most(a.sharpness_x, a.sharpness_y);
    float d = lobe_at_most(l - u, 1e9f); /* both bounded, so that their product is */
    float b = 1 + 0.27323954f * d * d / ((13.62806f + d * (1.851625f + d)) * (1 + 0.145226f * lobe_at_most(u, 1e15f)));
    float narrow = lobe_phi(l), wide = b * lobe_phi(b * u);
    LOBE_ASSERT(u >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude) * (wide * sqrtf(narrow / wide)); /* the product may vanish */
}

/*
 asg_integral_approx - the papers' form of the same integral

   a          each sharpness counts as at least 1e-4
   returns    pi / sqrt(sharpness_x sharpness_y) times the amplitude

   Rounding: below the model's
   Model:    within 5e-5 relative for sharpness of 10 or more; 1.6 times too large at 1, 10 times at 0.1
             [bound asg_integral_approx model 5e-5 over 10 1e5]
   Source:   Xu et al. 2013; 000, section 4.2 with an SG of sharpness 0
*/
LOBE_API float asg_integral_approx(asg_lobe a) {
    float least = lobe_at_least(lobe_at_most(a.sharpness_x, a.sharpness_y), 1e-4f);
    float most = lobe_at_least(lobe_at_least(a.sharpness_x, a.sharpness_y), 1e-4f);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude) / (least * sqrtf(most / least)); /* the product may overflow */
}

/*
 asg_sg_integral_xu - Xu's integral of the product of an ASG and an SG

   a, g       sharpness [0, 1e30]; the ASG's and half the SG's above 1e12 count as 1e12, their sums as at least 1e-4
   returns    with nu = g.sharpness / 2, the ASG of sharpness l nu / (l + nu) at the SG's axis, times
              pi / sqrt((sharpness_x + nu) (sharpness_y + nu)); 0 for an SG from the horizon down

   Rounding: <= 9 directional   [bound asg_sg_integral_xu directional 9 over 1e12 2e12]
   Model:    within .042 of the value for aligned axes if all sharpnesses are 10 or more; where the value is above 1 %
             of that, relative RMS .04, of 500 draws <= .15; several times too large for sharpness below 1; asg_sg_form
             tells more
             [bound asg_sg_integral_xu aligned .042 over 10 1e6] [bound asg_sg_integral_xu rms .15 over 10 1e6]
   Source:   Xu et al. 2013; 000, section 4.2; 001, Eq. 2
*/
LOBE_API float asg_sg_integral_xu(asg_lobe a, sg_lobe g) {
    float nu = lobe_at_most(0.5f * g.sharpness, 1e12f);
    float lx = lobe_at_most(a.sharpness_x, 1e12f), ly = lobe_at_most(a.sharpness_y, 1e12f);
    float x = lobe_dot(a.x, g.axis), y = lobe_dot(a.y, g.axis);
    float sx = lobe_at_least(lx + nu, 1e-4f), sy = lobe_at_least(ly + nu, 1e-4f), inverse = 1 / (sx * sy);
    float loss = nu * inverse * (lx * sy * (x * x) + ly * sx * (y * y));
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && g.sharpness >= 0);
    return LOBE_PI * lobe_asg_exp(a.log_amplitude + g.log_amplitude - loss) * sqrtf(inverse) *
           lobe_at_least(lobe_dot(a.z, g.axis), 0);
}

/*
 asg_sg_integral - integral of the product of an ASG and an SG over the sphere

   a, g       sharpness [0, 1e30]; the ASG's above 1e12 counts as 1e12
   returns    (0, pi] times both amplitudes, but for the error of the model; also for an SG below the lobe's horizon

   Rounding: <= 9 directional against the limit of a point   [bound asg_sg_integral directional 9 over 1e12 1e20]
             and 28 against the formula in double   [bound asg_sg_integral formula 28 over 1e-2 1e8]
   Model:    within .042 of the value for aligned axes, relative RMS .022 where the value is above 1 % of that; within
             7e-5 if all sharpnesses are 100 or more
             [bound asg_sg_integral aligned .042 over 1e-2 1e6] [bound asg_sg_integral rms .022 over 1e-2 1e6]
             [bound asg_sg_integral sharp 7e-5 over 100 1e6]
             For sharpness below 1e3 that RMS is about 1/25 of that of Xu's form, of 400 draws <= .06
             [bound asg_sg_integral ratio .06 over .1 1e3]
   Source:   derived for this library: a saddlepoint tau of the Fisher-Bingham normaliser (after Kume and Wood 2005),
             in closed form and not quite where its equation F = 1 has it, which a term in F - 1 makes good, and a
             logistic split of the mean |z| between the two sides of the horizon; 13 constants fitted. Xu's form is the
             one with tau frozen at nu.
*/
LOBE_API float asg_sg_integral(asg_lobe a, sg_lobe g) {
    float nu = lobe_at_most(0.5f * g.sharpness, 1e15f);
    float lx = lobe_at_most(a.sharpness_x, 1e12f), ly = lobe_at_most(a.sharpness_y, 1e12f);
    float x = nu * lobe_dot(a.x, g.axis), y = nu * lobe_dot(a.y, g.axis), z = nu * lobe_dot(a.z, g.axis);
    /* tau, from the same equation with l + tau as (l + nu) tau / nu: quadratic. Its distance from nu without a
       difference of the two */
    float nu1 = nu + 0.9009611f, sx = lx + nu1, sy = ly + nu1, both = 1 / (sx * sy), wx = sy * both, wy = sx * both;
    float rx = nu1 * wx, ry = nu1 * wy, d = 0.25f + 0.25f * (rx + ry);
    float radius = sqrtf(d * d + (rx * x * (rx * x) + ry * y * (ry * y) + z * z)), tau = d + radius;
    float reach = radius + nu, inverse = 1 / (tau * reach), t = reach * inverse;
    float away = lx * wx * (1 + rx) * (x * x) + ly * wy * (1 + ry) * (y * y),
          shift = d + (d * d - away) * (tau * inverse);
    /* 1 / (l + tau) along x, y, z, the means there and their squares; F is the mean square length */
    float ax = lx + tau, ay = ly + tau, axy = 1 / (ax * ay), p = ay * axy, q = ax * axy;
    float mx = x * p, my = y * q, mz = z * t, mx2 = mx * mx, my2 = my * my, mz2 = mz * mz;
    float sum = 0.5f * (p + q + t), excess = sum + (mx2 + my2) + (mz2 - 1);
    float k2 = tau * ((0.5f * p + 2 * mx2) * p + (0.5f * q + 2 * my2) * q) + (0.5f * t + 2 * mz2); /* over t */
    float exponent =
        shift * shift * t - (lx * mx * x + ly * my * y) * t +
        excess * lobe_at_most(tau, 1e6f) * (1 - 0.41055794f * k2) * (0.8921123f * sum - 0.592386f * excess);
    /* mean |z| of a normal deviate of mean side over its deviation, and what part of it lies above the horizon */
    float root = t * sqrtf(tau), side = 1.41421356f * z * root, beside = fabsf(side);
    float close = lobe_at_least(1 - 0.259302f * beside, 0), close2 = close * close;
    float tail = close2 * close2 * (0.8032341f - 0.239188f * beside);
    float mean = (1 + 0.03304771f * t * k2) * (1.41421356f * fabsf(mz) + root * tail);
    float split = side * (2.554556f + (mz2 + 0.598075f * t) * (-0.826906f + 1.124705f * beside));
    LOBE_ASSERT(lx >= 0 && ly >= 0 && g.sharpness >= 0);
    exponent -= lobe_at_least(-split, 0); /* 1 / (1 + e^-split) = e^min(split, 0) / (1 + e^-|split|) */
    return LOBE_PI * lobe_asg_exp(a.log_amplitude + g.log_amplitude + exponent) * (mean * sqrtf(axy / k2)) /
           ((1 + lobe_exp(-fabsf(split))) * lobe_at_least(5e-16f * g.sharpness, 1));
}

/*
 asg_isotropic - the SG that stands for an ASG: same axis, same peak, same integral where both are sharp

   a          sharpness [0, 1e30]
   returns    sharpness 2 sqrt(sharpness_x sharpness_y); 0 where one is below 1e-37 of the other

   Rounding: <= 3.5 ulp   [bound asg_isotropic ulp 3.5 over 1e-6 1e30]
   Model:    the anisotropy is lost: asg_sg_form tells when that matters
   Source:   an ASG of equal sharpness l is near its axis an SG of sharpness 2 l
*/
LOBE_API sg_lobe asg_isotropic(asg_lobe a) {
    sg_lobe g;
    float most = lobe_at_least(lobe_at_least(a.sharpness_x, a.sharpness_y), LOBE_TINY);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0);
    g.axis = a.z;
    g.sharpness = 2 * most * sqrtf(lobe_at_most(a.sharpness_x, a.sharpness_y) / most); /* the product may overflow */
    g.log_amplitude = a.log_amplitude;
    return g;
}

enum { ASG_FORM_SG = 0, ASG_FORM_XU = 1, ASG_FORM_ACCURATE = 2 };

/*
 asg_sg_form - the simplest form of an ASG's integral with an SG that is good enough

   a                lobe, sharpness [0, 1e30]
   light_sharpness  of the SG, [0, 1e30]; a sharper one asks more of the SG form, a wider one more of Xu's
   tolerance        error allowed in any direction of the SG, over the integral for aligned axes
   returns          ASG_FORM_SG: sg_product_integral of asg_isotropic(a); ASG_FORM_XU: asg_sg_integral_xu;
                    ASG_FORM_ACCURATE: asg_sg_integral, also where its own error, within .042, exceeds the tolerance

   Rounding: decides at a limit only
   Model:    the form named never loses more than the tolerance, if that is 1e-4 or more; at the limit it loses about
             half of it, at most 96 %   [bound asg_sg_form loss 1 over 1e-4 .5]
             With l the smaller sharpness, nu half the SG's: an SG is enough for lobes nearly round, when sqrt(ratio of
             sharpnesses) is within 1 + 2.5 tolerance, and of l at least .16 / tolerance, more anisotropic ones if nu is
             well below l; Xu's form is for nu of at least .6 / tolerance, and wide lobes (l below 5) of at least
             (.3 / tolerance)^2, for what they lose at the horizon
   Source:   bounds of what width and curvature cost, and of the limits of wide lights and wide lobes, fitted to
             quadrature for this library
*/
LOBE_API int asg_sg_form(asg_lobe a, float light_sharpness, float tolerance) {
    float least = lobe_at_least(lobe_at_most(lobe_at_most(a.sharpness_x, a.sharpness_y), 1e12f), 1e-6f);
    float most = lobe_at_least(lobe_at_most(lobe_at_least(a.sharpness_x, a.sharpness_y), 1e12f), 1e-6f);
    float nu = lobe_at_least(lobe_at_most(0.5f * light_sharpness, 1e12f), 1e-6f), mean = sqrtf(least) * sqrtf(most);
    float inverse = 1 / (mean + nu), wide = (least + nu) * inverse, peak = sqrtf(wide * ((most + nu) * inverse)) - 1;
    float ratio = sqrtf(most / least) * wide - 1, share = nu / (least + nu), back = lobe_exp(-least);
    float curved =
        lobe_at_least(0.65f * share * (1 - share), 0.14f * share) / least + 1.05f * back * (1 + back * (1 + back));
    float sg = lobe_at_least(peak, 0) + lobe_at_least(ratio / (ratio + 2.5f), 0) + curved;
    float xu = (0.24f + 0.36f * share + 0.4f * back) / nu + 0.32f * back / sqrtf(nu);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && light_sharpness >= 0);
    return (sg > tolerance) + (lobe_at_most(sg, xu) > tolerance);
}

/* Coefficients of det(Q + tau I) = ((tau + trace) tau + m2) tau + det for the summed quadratic forms Q of two
   lobes, all of them sums of positive terms, and three quotients of its adjugate. */
typedef struct lobe_asg_pair {
    float trace, m2, det;
    float quad_a, quad_b;                 /* za' Q za, zb' Q zb */
    float adj_aa, adj_bb, adj_ab, cosine; /* za' adj(Q) za ..., za.zb */
} lobe_asg_pair;

/* In an order of sums that exchanging the lobes does not change: then the integral is symmetric to the last bit, if the
   compiler does not contract them. */
LOBE_INLINE lobe_asg_pair lobe_asg_pair_of(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k;
    float l1 = lobe_at_most(a.sharpness_x, 1e9f), l2 = lobe_at_most(a.sharpness_y, 1e9f);
    float l3 = lobe_at_most(b.sharpness_x, 1e9f), l4 = lobe_at_most(b.sharpness_y, 1e9f);
    float xx = lobe_dot(a.x, b.x), xy = lobe_dot(a.x, b.y), xz = lobe_dot(a.x, b.z);
    float yx = lobe_dot(a.y, b.x), yy = lobe_dot(a.y, b.y), yz = lobe_dot(a.y, b.z);
    float zx = lobe_dot(a.z, b.x), zy = lobe_dot(a.z, b.y), zz = lobe_dot(a.z, b.z);
    float xx2 = xx * xx, xy2 = xy * xy, xz2 = xz * xz, yx2 = yx * yx, yy2 = yy * yy, yz2 = yz * yz;
    float zx2 = zx * zx, zy2 = zy * zy, zz2 = zz * zz, sine = xy2 + yx2, cosine = xx2 + yy2;
    float l12 = l1 * l2, l34 = l3 * l4, l13 = l1 * l3, l24 = l2 * l4, l14 = l1 * l4, l23 = l2 * l3;
    k.trace = (l1 + l2) + (l3 + l4);
    k.quad_a = l3 * zx2 + l4 * zy2;
    k.quad_b = l1 * xz2 + l2 * yz2;
    k.det = l12 * k.quad_a + l34 * k.quad_b;
    k.m2 = (l12 + l34) + 0.5f * ((l13 * (sine + (zx2 + xz2)) + l24 * (sine + (zy2 + yz2))) +
                                 (l14 * (cosine + (zy2 + xz2)) + l23 * (cosine + (zx2 + yz2))));
    k.adj_aa = ((l12 + l34 * zz2) + (l13 * yx2 + l24 * xy2)) + (l14 * yy2 + l23 * xx2);
    k.adj_bb = ((l34 + l12 * zz2) + (l13 * xy2 + l24 * yx2)) + (l14 * xx2 + l23 * yy2);
    k.adj_ab =
        k.m2 * zz + ((l13 * (zx * xz * xx) + l24 * (zy * yz * yy)) + (l23 * (zx * yz * yx) + l14 * (zy * xz * xy)));
    k.cosine = zz;
    return k;
}

/* Of the product as a density: tau, and the means of za.w zb.w, (za.w)^2 and (zb.w)^2, which are over root2 pi e^tau /
   sqrt(scale) that of a Gaussian. */
typedef struct lobe_asg_means {
    float tau, ab, aa, bb, scale;
} lobe_asg_means;

LOBE_INLINE lobe_asg_means lobe_asg_means_of(lobe_asg_pair k) {
    lobe_asg_means m;
    float trace = k.trace, rest = k.m2 - trace, tau, value, slope, bend, d, e2, e3, u, v, g0, g1, g2, g, inverse;
    /* tau is near the largest root of 2 P - P', P = det(Q + tau I): one step of Halley's from near the smallest
       eigenvalue's lower bound det / m2, with everything over m2, so that squares do not overflow */
    inverse = 1 / (k.m2 + 1);
    tau = 1.321882f - k.det * inverse;
    bend = tau + (trace - 1.5f);
    value = inverse * ((bend * tau + rest) * tau + (k.det - 0.5f * k.m2));
    slope = inverse * ((tau + 2 * bend) * tau + rest);
    bend = inverse * (2 * tau + bend);
    tau -= value * slope / (slope * slope - value * bend); /* positive: all roots are real */
    /* Second and fourth moments of the Bingham density, as polynomials of the symmetric functions e2, e3 of its
       variances. The bounds of d and c hold but for rounding near equal eigenvalues, where the value is 0; that of e2
       belongs to the fit: tau is rough for sharpness below 1. */
    d = lobe_at_least((1.5f * tau + trace) * tau + 0.5f * k.m2, 0.1f + 1e-5f * k.m2);
    e3 = 0.125f / d;
    e2 = lobe_at_least(lobe_at_most(2 * e3 * (trace + 3 * tau), 0.333333333f), 0);
    g0 = e3 * (-5.7050055f + 20.2053852f * e2);
    g1 = (0.6530841f + e3 * 24.4494396f) + e2 * (8.625987f - 21.598515f * e2 - e3 * 72.7179849f);
    g2 = (0.2046798f - e3 * 23.1662322f) + e2 * (-8.492826f + 13.444353f * e2 + e3 * 88.421949f);
    g = 4 * e3 * (g1 + g2);
    u = g2 * e3;
    v = tau * (trace + tau) * g + (g0 + (2 * tau * u - g2 * e2));
    u = 2 * u - tau * g;
    m.tau = tau;
    m.ab = v * k.cosine + g * k.adj_ab;
    m.aa = v + (u * k.quad_a + g * k.adj_aa);
    m.bb = v + (u * k.quad_b + g * k.adj_bb);
    m.scale = d - 2 * d * e2;
    return m;
}

/* The mean of max(za.w, 0) max(zb.w, 0) by the arc-cosine kernel, without the arc cosine, and what it is to be
   multiplied by: the product integral of lobes of peak 1 is pi mean sqrt(square) e^tau. */
LOBE_INLINE float lobe_asg_clamped_mean(lobe_asg_means m, float *square) {
    float c = m.ab, size = fabsf(c), whole = lobe_at_least(m.aa * m.bb, 1e-30f), area = sqrtf(whole);
    float cross = lobe_at_least((area - c) * (area + c), 0), inverse;
    area = whole + size * (1.5707963f * area + 0.4292037f * size);
    inverse = 1 / (area * m.scale); /* one division for both quotients */
    *square = area * inverse;
    return lobe_at_most(0.5f * lobe_at_least(c, 0) + 0.5f / LOBE_PI * (cross * sqrtf(cross)) * (m.scale * inverse), 2);
}

/*
 asg_product_integral - integral of the product of two ASGs over the sphere

   a, b       sharpness [0, 1e30]; above 1e9 it counts as 1e9
   returns    [0, pi] times both amplitudes

   Rounding: <= 5 directional for sharpness ratios up to 100
             [bound asg_product_integral directional 5 over 1e6 1e8]
             and 16 against the formula in double where above 1 % of the mean below
             [bound asg_product_integral formula 16 over 1e-2 1e6]
             Over the geometric mean of the lobes' integrals with themselves it is at most 1 + 3e-4; of lobes of any
             sharpness up to 1e9 it is symmetric to 1.5e-6 of that, and to the last bit where sums are not contracted
             [bound asg_product_integral symmetric 1.5e-6] [bound asg_product_integral excess 3e-4]
   Model:    within .0125 of that mean, relative RMS .03 where the value is above 1 % of it, of 400 draws <= .06; for
             sharpness of 10 or more within .007 relative where it is above 1 % of the mean
             [bound asg_product_integral aligned .0125 over 1e-2 1e5]
             [bound asg_product_integral rms .06 over 1e-2 1e5] [bound asg_product_integral sharp .007 over 10 1e5]
   Source:   derived for this library: saddlepoint of the Bingham normaliser, fitted moments, and the arc-cosine kernel
             for both clamped cosines. No eigenvectors: the coefficients of the characteristic polynomial are sums of
             positive terms, where Cardano's formula cancels (004, "Errors of ASGs").
*/
LOBE_API float asg_product_integral(asg_lobe a, asg_lobe b) {
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(a, b));
    float square, mean = lobe_asg_clamped_mean(m, &square);
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && b.sharpness_x >= 0 && b.sharpness_y >= 0);
    return LOBE_PI * mean * sqrtf(square) * lobe_asg_exp((a.log_amplitude + b.log_amplitude) + m.tau);
}

/*
 asg_product_integral_xu - Xu's integral of the product of two ASGs, without eigenvectors

   a, b       sharpness [0, 1e30]; above 1e9 it counts as 1e9
   returns    at least 0, finite, times both amplitudes; 0 for axes more than about a right angle apart

   Rounding: <= 5 directional for sharpness ratios up to 100, and within 4e-5 relative of
             the form with eigenvectors
             [bound asg_product_integral_xu directional 5 over 1e6 1e8]
             [bound asg_product_integral_xu eigenvectors 4e-5 over 10 1e4]
   Model:    for sharpness of 10 or more within .027 of the geometric mean of the lobes' integrals with themselves,
             relative RMS .004 where the value is above 1 % of that, the weight within .006; below 1 useless
             [bound asg_product_integral_xu aligned .027 over 10 1e5]
             [bound asg_product_integral_xu rms .004 over 10 1e5]
             [bound asg_product_integral_xu weight .006 over 10 1e5]
   Source:   Xu et al. 2013; 004, section 4.2. The smallest eigenvalue by Laguerre's method
*/
LOBE_API float asg_product_integral_xu(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k = lobe_asg_pair_of(a, b);
    float low = 0, gap, inverse = 1 / (k.m2 + 1);
    int step;
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && b.sharpness_x >= 0 && b.sharpness_y >= 0);
    /* the smallest eigenvalue, from 0 by Laguerre's steps: p = det(Q - low I), p1 = -p', p2 = p'' / 2, all over m2, so
       that squares do not overflow */
    for (step = 0; step < 2; step++) {
        float p = inverse * (((k.trace - low) * low - k.m2) * low + k.det);
        float p1 = inverse * (k.m2 - (2 * k.trace - 3 * low) * low), p2 = inverse * (k.trace - 3 * low);
        low += 3 * p / (p1 + 2 * sqrtf(lobe_at_least(p1 * p1 - 3 * p * p2, 0)) + LOBE_TINY);
        low = lobe_at_most(lobe_at_least(low, 0), 0.333333333f * k.trace); /* it is, but for rounding of equal ones */
    }
    gap = lobe_at_least(k.m2 - (2 * k.trace - 3 * low) * low, 1e-8f); /* product of the other two, less low each */
    return LOBE_PI * lobe_asg_exp(a.log_amplitude + b.log_amplitude - low) / sqrtf(gap) *
           lobe_at_least(lobe_at_most((k.adj_ab - low * (k.trace - low) * k.cosine) / gap, 1), 0);
}

/*
 asg_convolve - an ASG blurred by a normalised SG kernel

   a          sharpness [0, 1e30]
   kappa      sharpness of the kernel, (0, infinity], counts as at least 1e-8; infinity leaves a as it is
   returns    the same axes, each sharpness l as l / (1 + 2 l / kappa), the amplitude scaled by
              1 / sqrt((1 + 2 lx / kappa) (1 + 2 ly / kappa))

   Rounding: <= 3e-7 relative in sharpness and in 1 + |log_amplitude|
             [bound asg_convolve rel 3e-7 over 1e-8 1e10]
   Model:    Xu's product integral: values within .042 of the blurred peak, if all sharpnesses are 10 or more
             [bound asg_convolve model .042 over 10 1e5]
   Source:   004, section 4.2, times kappa / (2 pi)
*/
LOBE_API asg_lobe asg_convolve(asg_lobe a, float kappa) {
    float scale = 2 / lobe_at_least(kappa, 1e-8f), rx = a.sharpness_x * scale, ry = a.sharpness_y * scale;
    LOBE_ASSERT(a.sharpness_x >= 0 && a.sharpness_y >= 0 && kappa > 0);
    a.sharpness_x /= 1 + rx;
    a.sharpness_y /= 1 + ry;
    a.log_amplitude -= 0.5f * (lobe_log(1 + rx) + lobe_log(1 + ry));
    return a;
}

/* ---- reflection lobes ---- */

/* The frame of a reflection lobe: z the mirror direction, y perpendicular to it and to the normal, x on the normal's
   side. Any x and y are as good where z and normal agree. Sharpness and log amplitude 0. */
LOBE_API asg_lobe lobe_asg_mirror(lobe_vec3 normal, lobe_vec3 wi, float cos_theta) {
    asg_lobe a;
    lobe_vec3 u, v;
    float c, d, size, inverse;
    a.z = lobe_normalize_or(lobe_sub(lobe_scale(normal, 2 * cos_theta), wi), normal);
    lobe_frame(a.z, &u, &v);
    c = lobe_dot(normal, u);
    d = lobe_dot(normal, v);
    size = sqrtf(c * c + d * d);
    inverse = 1 / lobe_at_least(size, 1e-15f);
    c = lobe_select(size > 1e-15f, c * inverse, 1);
    d = lobe_select(size > 1e-15f, d * inverse, 0);
    a.x = lobe_add(lobe_scale(u, c), lobe_scale(v, d));
    a.y = lobe_sub(lobe_scale(v, c), lobe_scale(u, d));
    a.sharpness_x = 0;
    a.sharpness_y = 0;
    a.log_amplitude = 0;
    return a;
}

/* 1 / alpha^2 of a roughness */
LOBE_API float lobe_asg_half_sharpness(float alpha) {
    return lobe_asg_square(1 / lobe_at_least(alpha, 1e-4f));
}

/*
 asg_reflection_lobe - reflection lobe of an isotropic microfacet BRDF from the sharpness of its normal distribution

   normal, wi      wi may lie below the horizon; dot(wi, normal) is taken as at least 1e-4 in size
   half_sharpness  h of a distribution like exp(-h sin^2) about the normal, as an ASG has it: half that of an SG of the
                   half vector; [0, 1e9]
   returns         peak 1 around the mirror direction z; x in the plane of incidence, on the normal's side, with
                   sharpness h / 4; y across it with h / (4 cos^2); at normal incidence any x

   Rounding: frame orthonormal to 1.2e-6; sharpness within 12 2^-24 / cos relative, as rounded directions cost
             [bound asg_reflection_lobe orthonormal 1.2e-6] [bound asg_reflection_lobe cosine 12]
   Model:    first-order warp of half vectors with its Jacobian at the mirror direction: exact in the limit of sharp
             lobes; what the shape of a distribution adds is told with each
   Source:   Xu et al. 2013; Wang et al. 2009; 000, section 4.2
*/
LOBE_API asg_lobe asg_reflection_lobe(lobe_vec3 normal, lobe_vec3 wi, float half_sharpness) {
    float cos_theta = lobe_dot(wi, normal), across = 1 / lobe_at_least(fabsf(cos_theta), 1e-4f);
    asg_lobe a = lobe_asg_mirror(normal, wi, cos_theta);
    LOBE_ASSERT(half_sharpness >= 0);
    a.sharpness_x = 0.25f * half_sharpness;
    a.sharpness_y = a.sharpness_x * across * across;
    return a;
}

/*
 asg_reflection_lobe_aniso - the same of an anisotropic microfacet BRDF

   tangent                             perpendicular to normal, the direction of x; y is cross(normal, tangent)
   half_sharpness_x, half_sharpness_y  of a distribution like exp(-hx (h.x)^2 - hy (h.y)^2); [0, 1e9]
   returns                             as asg_reflection_lobe, with x the wider axis and y the narrower one

   Rounding: as asg_reflection_lobe; of equal sharpnesses within 25 2^-24 / cos relative
             [bound asg_reflection_lobe_aniso cosine 25]
   Model:    as asg_reflection_lobe; against the distribution's the exponent near the axis is within .03
             [bound asg_reflection_lobe_aniso curvature .03]
   Source:   as asg_reflection_lobe: the form diag(hx, hy) through the warp's Jacobian, its 2x2 matrix diagonalised
*/
LOBE_API asg_lobe asg_reflection_lobe_aniso(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float half_sharpness_x,
                                            float half_sharpness_y) {
    float cos_theta = lobe_dot(wi, normal), stretch = 1 / lobe_at_least(fabsf(cos_theta), 1e-4f);
    asg_lobe a = lobe_asg_mirror(normal, wi, cos_theta), turned;
    lobe_vec3 along = lobe_cross(a.y, normal), bitangent = lobe_cross(normal, tangent);
    float gx = 0.5f * sqrtf(half_sharpness_x), gy = 0.5f * sqrtf(half_sharpness_y), area = gx * stretch * gy;
    float px = gx * lobe_dot(along, tangent), py = gx * lobe_dot(a.y, tangent) * stretch;
    float qx = gy * lobe_dot(along, bitangent), qy = gy * lobe_dot(a.y, bitangent) * stretch;
    float middle = 0.5f * ((px * px + qx * qx) + (py * py + qy * qy));
    float spread = 0.5f * ((px - py) * (px + py) + (qx - qy) * (qx + qy)), mixed = px * py + qx * qy;
    float radius = sqrtf(spread * spread + mixed * mixed), largest = middle + radius, c, s, size, inverse;
    LOBE_ASSERT(half_sharpness_x >= 0 && half_sharpness_y >= 0);
    s = lobe_select(spread > 0, radius + spread, mixed);
    c = lobe_select(spread > 0, mixed, radius - spread);
    size = sqrtf(s * s + c * c);
    inverse = 1 / lobe_at_least(size, 1e-15f);
    s = lobe_select(size > 1e-15f, s * inverse, 0);
    c = lobe_select(size > 1e-15f, c * inverse, 1);
    turned.z = a.z;
    turned.y = lobe_add(lobe_scale(a.x, s), lobe_scale(a.y, c));
    turned.x = lobe_sub(lobe_scale(a.x, c), lobe_scale(a.y, s));
    turned.sharpness_y = largest;
    turned.log_amplitude = 0;
    turned.sharpness_x =
        area * (area / lobe_at_least(lobe_at_least(largest, area), LOBE_TINY)); /* determinant: area^2 */
    return turned;
}

/*
 asg_ggx_lobe, asg_ggx_lobe_aniso - reflection lobes of GGX surfaces: asg_reflection_lobe of 1 / alpha^2

   alpha      [1e-4, 1], clamped below
   tangent    the direction of alpha_x

   Rounding: as the function they call
   Model:    for cos >= .4 and alphas at most 10 : 3: GGX has a narrower middle and heavier tails, so that values are
             within .2 of the distribution over its peak for alpha of .002 .. .05, where the warp costs little; within
             .415 and the integral within .12 relative for .02 .. .3
             [bound asg_ggx_lobe sharp .2 over .002 .05]
             [bound asg_ggx_lobe value .415 over .02 .3] [bound asg_ggx_lobe integral .12 over .02 .3]
   Source:   Walter et al. 2007 for the distribution
*/
LOBE_API asg_lobe asg_ggx_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) {
    return asg_reflection_lobe(normal, wi, lobe_asg_half_sharpness(alpha));
}

LOBE_API asg_lobe asg_ggx_lobe_aniso(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float alpha_x, float alpha_y) {
    return asg_reflection_lobe_aniso(normal, tangent, wi, lobe_asg_half_sharpness(alpha_x),
                                     lobe_asg_half_sharpness(alpha_y));
}

/*
 asg_beckmann_lobe, asg_beckmann_lobe_aniso - reflection lobes of Beckmann surfaces, by the same 1 / alpha^2

   Rounding: as the function they call
   Model:    a Gaussian of slopes, so that only the warp's error is left: under the same conditions within .072 for
             alpha of .002 .. .05, within .42 and the integral within .063 for .02 .. .3
             [bound asg_beckmann_lobe sharp .072 over .002 .05]
             [bound asg_beckmann_lobe value .42 over .02 .3] [bound asg_beckmann_lobe integral .063 over .02 .3]
   Source:   Beckmann and Spizzichino 1963
*/
LOBE_API asg_lobe asg_beckmann_lobe(lobe_vec3 normal, lobe_vec3 wi, float alpha) {
    return asg_ggx_lobe(normal, wi, alpha); /* the same curvature at the peak */
}

LOBE_API asg_lobe asg_beckmann_lobe_aniso(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float alpha_x,
                                          float alpha_y) {
    return asg_ggx_lobe_aniso(normal, tangent, wi, alpha_x, alpha_y);
}

/*
 asg_ward_lobe - reflection lobe of Ward's BRDF, whose exponential of slopes has 1 / alpha^2 too

   Rounding: as asg_reflection_lobe_aniso
   Model:    of the exponential alone, without 1 / sqrt(cos cos), which is the caller's constant: within .073 for alpha
             of .002 .. .05, within .43 and the integral within .145 for .02 .. .3
             [bound asg_ward_lobe sharp .073 over .002 .05]
             [bound asg_ward_lobe value .43 over .02 .3] [bound asg_ward_lobe integral .145 over .02 .3]
   Source:   Ward 1992
*/
LOBE_API asg_lobe asg_ward_lobe(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float alpha_x, float alpha_y) {
    return asg_ggx_lobe_aniso(normal, tangent, wi, alpha_x, alpha_y);
}

/*
 asg_phong_lobe, asg_ashikhmin_lobe - reflection lobes of powers of the half vector's cosine: half the exponent

   exponent   of an isotropic cos^exponent, or of Ashikhmin and Shirley's along tangent (x) and across; [0, 1e9]

   Rounding: as the function they call
   Model:    under the same conditions within .029, by Ashikhmin .043, for exponents of 1e3 and more, within .27 and
             .343 and the integral within .067 and .075 for 20 and more
             [bound asg_phong_lobe sharp .029 over 1e3 1e5] [bound asg_ashikhmin_lobe sharp .043 over 1e3 1e5]
             [bound asg_phong_lobe value .27 over 20 1e4] [bound asg_phong_lobe integral .067 over 20 1e4]
             [bound asg_ashikhmin_lobe value .343 over 20 1e4] [bound asg_ashikhmin_lobe integral .075 over 20 1e4]
   Source:   Blinn 1977; Ashikhmin and Shirley 2000
*/
LOBE_API asg_lobe asg_phong_lobe(lobe_vec3 normal, lobe_vec3 wi, float exponent) {
    return asg_reflection_lobe(normal, wi, 0.5f * exponent);
}

LOBE_API asg_lobe asg_ashikhmin_lobe(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, float exponent_x,
                                     float exponent_y) {
    return asg_reflection_lobe_aniso(normal, tangent, wi, 0.5f * exponent_x, 0.5f * exponent_y);
}

/* ---- virtual spherical Gaussian lights ---- */

/*
 asg_vsgl_specular - light of one component of a virtual SG light reflected by a GGX surface

   v, component  variance [0, 1e10]; intensity is left to the caller
   place         at most 1e5 from the light
   wi            towards the viewer
   alpha         [1e-4, 1], clamped below
   reflection    asg_ggx_lobe(normal, wi, alpha) or any other of log_amplitude at most 10: once for all lights
   returns       reflected radiance per unit of v.intensity[component] and Fresnel reflectance

   Rounding: <= 22 directional   [bound asg_vsgl_specular directional 22]
             A variance of 0, or below 1e-9 of the squared distance, gives the point light to as much for alpha of .1
             or more
   Model:    against the integral of incoming lobe, reflection and C: within .125 for lights of a standard
             deviation up to a tenth of their distance, within alpha of the mirror direction, emission of sharpness 50
             or less; above grazing incidence: cosines of .3 for the viewer, .2 for the incoming lobe
             [bound asg_vsgl_specular model .125 over .1 .5]
   Source:   000, section 4.2, with the inverse variance gathered with nu, so that neither overflows. C is the
             peak 1 / (pi alpha^2) times Smith's height-correlated visibility (Heitz 2014) times the cosine,
             constant over the incoming lobe.
*/
LOBE_API float asg_vsgl_specular(vsgl v, int component, lobe_vec3 place, lobe_vec3 normal, lobe_vec3 wi, float alpha,
                                 asg_lobe reflection) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, &inverse_variance);
    float lx = reflection.sharpness_x, ly = reflection.sharpness_y, nu = 0.5f * g.sharpness;
    float ix = 1 / sqrtf(lobe_at_least(lx + nu, 0.1f)), iy = 1 / sqrtf(lobe_at_least(ly + nu, 0.1f));
    float x = lobe_dot(reflection.x, g.axis), y = lobe_dot(reflection.y, g.axis);
    float loss = lx * (nu * ix * ix) * (x * x) + ly * (nu * iy * iy) * (y * y);
    float value = lobe_at_most(lobe_exp(g.log_amplitude + reflection.log_amplitude - loss), 2.2e4f);
    float a2 = lobe_asg_square(lobe_at_least(alpha, 1e-4f));
    float ci = lobe_at_least(lobe_dot(wi, normal), 0), co = lobe_at_least(lobe_dot(g.axis, normal), 0);
    float smith = co * sqrtf(a2 + (1 - a2) * ci * ci) + ci * sqrtf(a2 + (1 - a2) * co * co);
    return value * (0.25f / LOBE_PI * inverse_variance * ix * iy) * lobe_at_least(lobe_dot(reflection.z, g.axis), 0) *
           co / (a2 * lobe_at_least(smith, 1e-20f));
}

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
