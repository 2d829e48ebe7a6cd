/*
 ggx_bound.h - GGX reflection, and the volumes that bound its light in stochastic light culling, version 1.0.0

   #include "ggx_bound.h"

   lobe_vec3 position = {0, 0, 0}, normal = {0, 0, 1}, wi = {0, -0.6f, 0.8f}, point = {0, 3, 4};
   float flux = 1, alpha = 0.1f, delta = 0.001f, xi = ggx_xi(2463534242u);
   ggx_ellipsoid volume = ggx_bound_ellipsoid(position, normal, wi, alpha, flux, 1, delta, xi);
   // cull with volume; inside of it, per shaded point:
   float intensity = flux * ggx_brdf_cos(normal, wi, lobe_scale(point, 0.2f), alpha);
   float radiance = ggx_estimate(intensity, 25, delta, xi); // 0 outside of volume; the mean over xi is intensity / 25

 Configuration: as sg.h, which this includes.

 Conventions: directions, alpha, colour and units as in sg.h; alpha below 1e-4 counts as 1e-4, above 1 as 1, in the
 BRDF and in the bounds alike. A virtual point light (VPL) lies at a position on a surface with a normal; flux is the
 power that arrived there from wi, in one channel or as the largest channel; delta is the radiance below which lights
 are left out at random, xi the light's one random number in (0, 1). Light goes out where both cosines are positive.
 Fresnel factors are the caller's: the BRDF here has none, the bounds take the largest, fresnel_max. A frame of a
 camera has x/z and y/z across the image and z > 0 the depth.

 Errors: as in sg.h. "angular" is relative, in (1 + 1 / alpha) 2^-24: what rounding of unit vectors costs a lobe of that
 width. Lengths up to 1e5, powers up to 1e18, delta at least 1e-18; then out of finite input comes no NaN and no
 infinity. Ranges above 1e12 count as 1e12.

 How the bounds come about. Let u be the mirror direction of wi, c and s the cosine and sine of wi and the normal, a =
 alpha, and p the offset of a lit point from the light. Fresnel's factor and G2 are at most fresnel_max and G1(wi), so
 that light is accepted only where

   |p| <= r sqrt(pi D(h)),   r^2 = flux fresnel_max / (2 pi delta xi (c + sqrt(a^2 s^2 + c^2)))

 (no 0/0 at grazing angles). With e = (1 - a^2) / (1 + a^2), components p = (u, v, w), w across the plane of incidence,
 and y = 2 a r / (1 + a^2) + e u, the half vector's cosine obeys (1 + u)(1 + wi.p) - (normal.(wi + p))^2 = s^2 w^2 for
 unit p, and the region is exactly

   y - |p| >= e s^2 w^2 / (|p| + wi.p).

 The spheroid of the paper is y >= |p|: it drops the right side. Multiply instead by |p| - eta u >= 0 for any eta in
 [0, 1), where |p| - eta u >= lam (|p| + wi.p) for lam = (1 - eta^2) / (2 (1 + eta cos 2 theta)), since |eta u + lam
 wi| = 1 - lam. In (y - |p|)(|p| - eta u) >= lam e s^2 w^2, |p| (y + eta u) is at most (1 + eta) p^2 / 2 + (y + eta
 u)^2 / (2 + 2 eta), with equality at the tip u = r / a. What remains is quadratic in p: an ellipsoid that touches the
 region at its tip, whatever eta, and eta = 0 has the spheroid's center, u and v.

 Rounding of positions and frames is covered by growing each ellipsoid by t = 2^-21 (max |position| + extent) on all
 sides: |x| <= 1 in its stretched space grows to radii^2 = (1 + t / m)(radius^2 + m t), any m > 0, since sqrt(A) + t has
 a square of at most A + t^2 + A t / m + m t.

 Functions:

   ggx_ndf, _aniso                  distribution of half vectors
   ggx_smith_g1, _aniso             masking
   ggx_smith_g2, _separable         masking and shadowing: height-correlated; product of both
   ggx_brdf_cos, _separable, _aniso the BRDF times the outgoing cosine, without Fresnel's factor
   ggx_cos_half, ggx_fresnel, ggx_fresnel_max   Schlick's; the largest for a direction of incidence
   ggx_xi                           a light's random number from random bits
   ggx_accept_probability           of a light at a point
   ggx_accept_weight                what a light counts there: 1 / probability or 0
   ggx_estimate                     the unbiased radiance
   ggx_range                        how far a light is accepted in a direction
   ggx_bound_spheroid               the paper's volume
   ggx_bound_ellipsoid, _aniso      a tighter one; for an anisotropic NDF
   ggx_bound_sphere, _enclosing     spheres for comparison: at the light; around an ellipsoid
   ggx_bound_diffuse, _ellipsoid    for a Lambert surface: the paper's sphere; the smallest ellipsoid
   ggx_ellipsoid_of_sphere, ggx_ellipsoid_transform, ggx_ellipsoid_reach
   ggx_ellipsoid_hits_half_space, ggx_ellipsoid_hits_box
   ggx_stretch_ellipsoid            the stretched and rotated space in which an ellipsoid is a unit sphere
   ggx_stretched_hits_tile, _hits_clusters   the paper's test of an ellipsoid with a tile's frustum
   ggx_stretched_hits_frustum, ggx_ellipsoid_hits_sides   closer tests of the same
   ggx_tile_above                   whether part of a tile is above the light's horizon

 Papers named in the sources: 003 is Tokuyoshi and Harada 2017, Stochastic Light Culling for VPLs on GGX Microsurfaces.
*/
#ifndef LOBE_GGX_BOUND_H
#define LOBE_GGX_BOUND_H

#ifndef LOBE_VERSION
#define LOBE_VERSION 10000 /* 10000 major + 100 minor + patch */
#elif LOBE_VERSION != 10000
#error "headers of different versions of Lobe"
#endif

#include "sg.h"

/* ---- types ---- */

typedef struct ggx_ellipsoid {
    lobe_vec3 center;
    lobe_vec3 axis[3]; /* orthonormal, right-handed; the first is the light's mirror direction, or near it */
    float radius[3];   /* along each, positive */
} ggx_ellipsoid;

typedef struct ggx_sphere {
    lobe_vec3 center;
    float radius;
} ggx_sphere;

/* The space of section 5.2: row[0..2] is the paper's B S, center its B S c, where c is the ellipsoid's center. Either x
   or y of the camera's frame becomes the first axis; z is the only one that reaches the third. */
typedef struct ggx_stretched {
    float xx, xy, xz, yy, yz, zz; /* first, second and third row, upper triangular */
    lobe_vec3 center;
    float size;  /* how large the terms of the center are: for rounding */
    int swapped; /* 1: rows and columns are in the order y, x, z */
} ggx_stretched;

/* A tile of the image: limits of x/z and y/z */
typedef struct ggx_tile {
    float left, right, bottom, top;
} ggx_tile;

/* ---- private helpers ---- */

LOBE_API float lobe_ggx_alpha(float alpha) {
    return lobe_at_most(lobe_at_least(alpha, 1e-4f), 1);
}

/* max |component| */
LOBE_API float lobe_ggx_extent(lobe_vec3 v) {
    return lobe_at_least(lobe_at_least(fabsf(v.x), fabsf(v.y)), fabsf(v.z));
}

/* |m|^2 / (a^2 (m.n)^2 + |n x m|^2), at most 1 / a^2: the GGX distribution is pi (a this)^-2. |n x m|^2 does not cancel
   near the normal, where 1 - (m.n)^2 does. */
LOBE_API float lobe_ggx_lobe(lobe_vec3 m, lobe_vec3 normal, float alpha) {
    lobe_vec3 across = lobe_cross(normal, m);
    float along = alpha * lobe_dot(m, normal), base = along * along + lobe_dot(across, across);
    return lobe_dot(m, m) / lobe_at_least(base, LOBE_TINY);
}

/* The two tangents of a surface: the given one made perpendicular to the normal, twice since the first leaves what was
   rounded, any if it is nearly the normal; and normal x tangent */
LOBE_API void lobe_ggx_tangents(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 *x, lobe_vec3 *y) {
    lobe_vec3 any, other, rest = lobe_sub(tangent, lobe_scale(normal, lobe_dot(tangent, normal)));
    int usable = lobe_dot(rest, rest) > 1e-6f;
    lobe_frame(normal, &any, &other);
    rest = lobe_sub(rest, lobe_scale(normal, lobe_dot(rest, normal)));
    rest.x = lobe_select(usable, rest.x, any.x);
    rest.y = lobe_select(usable, rest.y, any.y);
    rest.z = lobe_select(usable, rest.z, any.z);
    *x = lobe_normalize_or(rest, any);
    *y = lobe_cross(normal, *x);
}

/* |m|^2 / (a_x a_y (m_x^2 / a_x^2 + m_y^2 / a_y^2 + m_n^2)): the same for two widths */
LOBE_API float lobe_ggx_lobe_aniso(lobe_vec3 m, lobe_vec3 normal, lobe_vec3 tangent, float alpha_x, float alpha_y) {
    float x, y, along = lobe_dot(m, normal), ratio = alpha_x / alpha_y, base;
    lobe_vec3 tx, ty;
    lobe_ggx_tangents(normal, tangent, &tx, &ty);
    x = lobe_dot(m, tx);
    y = lobe_dot(m, ty);
    base = x * x / ratio + y * y * ratio + alpha_x * alpha_y * along * along;
    return lobe_dot(m, m) / lobe_at_least(base, LOBE_TINY);
}

/* sqrt(cos^2 + a^2 sin^2), all of it of positive terms */
LOBE_API float lobe_ggx_slope(float cos_theta, float alpha) {
    float a2 = alpha * alpha;
    return sqrtf(a2 + (1 - alpha) * (1 + alpha) * cos_theta * cos_theta);
}

/* The same for a direction and two widths */
LOBE_API float lobe_ggx_slope_aniso(lobe_vec3 dir, lobe_vec3 normal, lobe_vec3 tangent, float alpha_x, float alpha_y) {
    float x, y, z = lobe_dot(dir, normal);
    lobe_vec3 tx, ty;
    lobe_ggx_tangents(normal, tangent, &tx, &ty);
    x = alpha_x * lobe_dot(dir, tx);
    y = alpha_y * lobe_dot(dir, ty);
    return sqrtf(x * x + y * y + z * z);
}

/* What the cosines and the slopes of both directions make of D / pi = (a lobe)^2 */
LOBE_API float lobe_ggx_reflected(float density, float cos_i, float cos_o, float divisor) {
    float value = 0.5f / LOBE_PI * density * cos_o / lobe_at_least(divisor, LOBE_TINY);
    return lobe_select((cos_i >= 0) & (cos_o > 0), value, 0);
}

/* ---- the BRDF ---- */

/*
 ggx_ndf - the GGX distribution of half vectors

   h, normal  unit
   alpha      [1e-4, 1], clamped to it
   returns    density per solid angle; 0 where dot(h, normal) <= 0; its integral with the cosine is 1

   Rounding: <= 13 angular   [bound ggx_ndf angular 13 over 1e-4 1]
   Model:    exact
   Source:   003, Eq. 7, with sin^2 as |normal x h|^2: as 1 - cos^2 it is up to 1.4 times wrong at alpha 1e-4
*/
LOBE_API float ggx_ndf(lobe_vec3 h, lobe_vec3 normal, float alpha) {
    float a = lobe_ggx_alpha(alpha), peak = a * lobe_ggx_lobe(h, normal, a);
    return lobe_select(lobe_dot(h, normal) > 0, 1 / LOBE_PI * peak * peak, 0);
}

/*
 ggx_ndf_aniso - the same with two widths

   tangent           along which alpha_x counts, made perpendicular to the normal (within .001 of it: any); alpha_y
                     counts along normal x tangent
   alpha_x, alpha_y  [1e-4, 1], clamped to it

   Rounding: <= 24 angular, of the smaller alpha   [bound ggx_ndf_aniso angular 24 over 1e-4 1]
   Model:    exact
   Source:   Heitz 2014, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs
*/
LOBE_API float ggx_ndf_aniso(lobe_vec3 h, lobe_vec3 normal, lobe_vec3 tangent, float alpha_x, float alpha_y) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y);
    float lobe = lobe_ggx_lobe_aniso(h, normal, tangent, ax, ay);
    return lobe_select(lobe_dot(h, normal) > 0, ax * ay * (1 / LOBE_PI) * lobe * lobe, 0);
}

/*
 ggx_smith_g1 - the share of facets that a direction sees

   cos_theta  of the direction and the normal
   returns    [0, 1]; 0 from the horizon down

   Rounding: <= 4 ulp   [bound ggx_smith_g1 ulp 4 over 1e-6 1]
   Model:    exact for Smith's profile
   Source:   003, Eq. 8
*/
LOBE_API float ggx_smith_g1(float cos_theta, float alpha) {
    float c = lobe_at_most(lobe_at_least(cos_theta, 0), 1);
    return lobe_at_most(2 * c / (c + lobe_ggx_slope(c, lobe_ggx_alpha(alpha))), 1);
}

/*
 ggx_smith_g1_aniso - the same with two widths

   dir        unit; others as in ggx_ndf_aniso

   Rounding: <= 4 2^-24 (1 + 1 / cosine) relative   [bound ggx_smith_g1_aniso grazing 4 over 1e-4 1]
   Model:    exact for Smith's profile
   Source:   Heitz 2014
*/
LOBE_API float ggx_smith_g1_aniso(lobe_vec3 dir, lobe_vec3 normal, lobe_vec3 tangent, float alpha_x, float alpha_y) {
    float c = lobe_at_least(lobe_dot(dir, normal), 0);
    float slope = lobe_ggx_slope_aniso(dir, normal, tangent, lobe_ggx_alpha(alpha_x), lobe_ggx_alpha(alpha_y));
    return lobe_at_most(2 * c / lobe_at_least(c + slope, LOBE_TINY), 1);
}

/*
 ggx_smith_g2, ggx_smith_g2_separable - the share of facets that two directions see

   cos_i, cos_o  of the directions and the normal
   returns       [0, 1], at most ggx_smith_g1 of either; 0 where one is at the horizon or below

   Rounding: <= 8 ulp   [bound ggx_smith_g2 ulp 8 over 1e-6 1]
   Model:    exact for Smith's profile with heights correlated; with independent heights
   Source:   Heitz 2014; 003, section 4.1
*/
LOBE_API float ggx_smith_g2(float cos_i, float cos_o, float alpha) {
    float a = lobe_ggx_alpha(alpha), ci = lobe_at_most(lobe_at_least(cos_i, 0), 1);
    float co = lobe_at_most(lobe_at_least(cos_o, 0), 1);
    return lobe_at_most(2 * ci * co / lobe_at_least(co * lobe_ggx_slope(ci, a) + ci * lobe_ggx_slope(co, a), LOBE_TINY),
                        1);
}

LOBE_API float ggx_smith_g2_separable(float cos_i, float cos_o, float alpha) {
    return ggx_smith_g1(cos_i, alpha) * ggx_smith_g1(cos_o, alpha);
}

/*
 ggx_brdf_cos - the GGX BRDF times dot(wo, normal), height-correlated, without Fresnel's factor

   normal, wi, wo  unit
   returns         per steradian; 0 for wo at the horizon or below, wi below; for wi at the horizon the limit

   Rounding: a factor of at most exp(+-8 (angular / cos_half + 2^-24 (1 / max(cos_i, alpha) + 1 / cos_o))), cosines at
             least 1e-6, cos_half as in ggx_cos_half: of nearly opposed directions even their lengths' rounding turns
             the half vector by more than alpha   [bound ggx_brdf_cos angular 8 over 1e-4 1]
   Model:    exact
   Source:   003, Eqs. 4 and 6; with G2 / cos_i as one quotient, which is finite at grazing angles
*/
LOBE_API float ggx_brdf_cos(lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 wo, float alpha) {
    float a = lobe_ggx_alpha(alpha), cos_i = lobe_dot(wi, normal), cos_o = lobe_dot(wo, normal);
    float peak = a * lobe_ggx_lobe(lobe_add(wi, wo), normal, a);
    float divisor = cos_o * lobe_ggx_slope(cos_i, a) + cos_i * lobe_ggx_slope(cos_o, a);
    return lobe_ggx_reflected(peak * peak, cos_i, cos_o, divisor);
}

/* ggx_brdf_cos_separable - the same with the separable G2; errors as in ggx_brdf_cos
   [bound ggx_brdf_cos_separable angular 8 over 1e-4 1] */
LOBE_API float ggx_brdf_cos_separable(lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 wo, float alpha) {
    float a = lobe_ggx_alpha(alpha), cos_i = lobe_dot(wi, normal), cos_o = lobe_dot(wo, normal);
    float peak = a * lobe_ggx_lobe(lobe_add(wi, wo), normal, a);
    float divisor = 0.5f * (cos_i + lobe_ggx_slope(cos_i, a)) * (cos_o + lobe_ggx_slope(cos_o, a));
    return lobe_ggx_reflected(peak * peak, cos_i, cos_o, divisor);
}

/* ggx_brdf_cos_aniso - the same height-correlated with two widths, as in ggx_ndf_aniso; errors as in ggx_brdf_cos for
   the smaller alpha, with 10 for 8 and 1 / cos_i   [bound ggx_brdf_cos_aniso angular 10 over 1e-4 1] */
LOBE_API float ggx_brdf_cos_aniso(lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi, lobe_vec3 wo, float alpha_x,
                                  float alpha_y) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y);
    float cos_i = lobe_dot(wi, normal), cos_o = lobe_dot(wo, normal);
    float lobe = lobe_ggx_lobe_aniso(lobe_add(wi, wo), normal, tangent, ax, ay);
    float divisor = cos_o * lobe_ggx_slope_aniso(wi, normal, tangent, ax, ay) +
                    cos_i * lobe_ggx_slope_aniso(wo, normal, tangent, ax, ay);
    return lobe_ggx_reflected(ax * ay * lobe * lobe, cos_i, cos_o, divisor);
}

/* ggx_cos_half - of a direction and the half vector of both: half their sum's length, which holds where they are nearly
   opposed and the half vector is mostly rounding; <= 4 2^-24   [bound ggx_cos_half abs 0x1p-22] */
LOBE_API float ggx_cos_half(lobe_vec3 wi, lobe_vec3 wo) {
    lobe_vec3 m = lobe_add(wi, wo);
    return 0.5f * sqrtf(lobe_dot(m, m));
}

/*
 ggx_fresnel - Schlick's Fresnel factor

   f0         [0, 1], reflectance at normal incidence
   cos_half   of a direction and the half vector, clamped to [0, 1]
   returns    [f0, 1], falling in cos_half

   Rounding: <= 9 ulp   [bound ggx_fresnel ulp 9]
   Model:    Schlick's fit of Fresnel's equations
   Source:   Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering
*/
LOBE_API float ggx_fresnel(float f0, float cos_half) {
    float c = 1 - lobe_at_most(lobe_at_least(cos_half, 0), 1), c2 = c * c;
    LOBE_ASSERT(f0 >= 0 && f0 <= 1);
    return f0 + (1 - f0) * (c2 * c2 * c);
}

/*
 ggx_fresnel_max - the largest Schlick factor over all outgoing directions above the horizon: 003's F_max(wi)

   f0         [0, 1]
   cos_theta  of wi and the normal
   returns    at least ggx_fresnel of any ggx_cos_half, also as rounded; less than 2e-5 above their supremum, at most 1
              [bound ggx_fresnel_max abs 2e-5]

   Rounding: as stated
   Model:    exact for Schlick's factor
   Source:   wo at most 90 degrees beyond the normal makes half the angle at most 45 degrees + theta / 2, the cosine of
             which is sqrt((1 - sin theta) / 2) = cos theta / sqrt(2 + 2 sin theta)
*/
LOBE_API float ggx_fresnel_max(float f0, float cos_theta) {
    float c = lobe_at_most(lobe_at_least(cos_theta - 5e-7f, 0), 1), s = sqrtf((1 - c) * (1 + c)); /* rounded down */
    return lobe_at_most(ggx_fresnel(f0, c / sqrtf(2 + 2 * s)) + 1e-6f, 1);
}

/* ---- stochastic culling ---- */

/* ggx_xi - a light's random number, (k + 1/2) 2^-23, from the upper 23 of 32 random bits: never 0, where every range is
   infinite, and never 1, where the nearest light is left out; exact. */
LOBE_API float ggx_xi(unsigned bits) {
    return ((float)((bits >> 9) & 0x7FFFFFu) + 0.5f) * 1.1920929e-7f;
}

/* The least random number */
#define LOBE_GGX_XI_MIN 5.9604645e-8f

/*
 ggx_accept_probability - of a light at a point

   radiant_intensity  towards the point; in several channels the largest
   distance_squared   between them
   delta              radiance below which the probability falls under 1
   returns            [0, 1]: 1 at distance 0, but 0 for intensity 0

   Rounding: <= 4 ulp   [bound ggx_accept_probability ulp 4]
   Model:    exact
   Source:   003, Eq. 2
*/
LOBE_API float ggx_accept_probability(float radiant_intensity, float distance_squared, float delta) {
    LOBE_ASSERT(radiant_intensity >= 0 && distance_squared >= 0 && delta > 0);
    return lobe_at_most(radiant_intensity / lobe_at_least(delta * distance_squared, LOBE_TINY), 1);
}

/*
 ggx_accept_weight - what an accepted light counts

   xi         the light's random number, at least 2^-24 (counts as that)
   returns    1 / probability where that is above xi, else 0: times the light's radiance, unbiased over ggx_xi for
              probabilities that are multiples of 2^-23; else off by at most 2^-24 / probability
              [bound ggx_accept_weight bias 0x1p-24]

   Rounding: <= 1 ulp   [bound ggx_accept_weight ulp 1]
   Model:    exact
   Source:   003, Eq. 3
*/
LOBE_API float ggx_accept_weight(float probability, float xi) {
    float least = lobe_at_least(xi, LOBE_GGX_XI_MIN), weight = 1 / lobe_at_least(probability, LOBE_GGX_XI_MIN);
    return lobe_select(probability > least, weight, 0);
}

/*
 ggx_estimate - radiance of a light at a point, or 0 where it is left out: unbiased over xi

   others     as above
   returns    max(radiant_intensity / distance_squared, delta) if accepted: that is radiance / probability, with no
              small divisor

   Rounding: <= 2 ulp   [bound ggx_estimate ulp 2]
   Model:    as ggx_accept_weight; at distance 0 at most 1e30
   Source:   003, Eqs. 1 to 3
*/
LOBE_API float ggx_estimate(float radiant_intensity, float distance_squared, float delta, float xi) {
    float radiance = lobe_at_most(radiant_intensity / lobe_at_least(distance_squared, LOBE_TINY), LOBE_HUGE);
    float probability = ggx_accept_probability(radiant_intensity, distance_squared, delta);
    return lobe_select(probability > lobe_at_least(xi, LOBE_GGX_XI_MIN), lobe_at_least(radiance, delta), 0);
}

/*
 ggx_range - the distance within which a light is accepted

   returns    sqrt(radiant_intensity / (delta xi)), [0, 1e12]; the direction's length in the volumes below

   Rounding: <= 4 ulp   [bound ggx_range ulp 4]
   Model:    exact
   Source:   003, Eq. 5
*/
LOBE_API float ggx_range(float radiant_intensity, float delta, float xi) {
    float divisor = lobe_at_least(delta, 1e-18f) * lobe_at_least(xi, LOBE_GGX_XI_MIN);
    LOBE_ASSERT(radiant_intensity >= 0 && delta > 0);
    return sqrtf(lobe_at_most(radiant_intensity / divisor, 1e24f));
}

/* ---- bounding volumes ---- */

/* Cosine and sine of incidence, each as it does not cancel */
LOBE_API float lobe_ggx_cosine(lobe_vec3 normal, lobe_vec3 wi) {
    return lobe_at_most(lobe_at_least(lobe_dot(normal, wi), 0), 1);
}

LOBE_API float lobe_ggx_sine(lobe_vec3 normal, lobe_vec3 wi) {
    lobe_vec3 across = lobe_cross(normal, wi);
    return lobe_at_most(sqrtf(lobe_dot(across, across)), 1);
}

/* The mirror direction u */
LOBE_API lobe_vec3 lobe_ggx_mirror(lobe_vec3 normal, lobe_vec3 wi) {
    return lobe_normalize_or(lobe_sub(lobe_scale(normal, 2 * lobe_dot(normal, wi)), wi), normal);
}

/* w: across the plane of incidence, or any perpendicular to u where normal x wi is mostly rounding. What rounding
   leaves along u is removed twice, since u's long axis would make it a large error. */
LOBE_API lobe_vec3 lobe_ggx_across(lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 u) {
    lobe_vec3 across = lobe_cross(normal, wi), any, other;
    int oblique = lobe_dot(across, across) > 1e-10f;
    lobe_frame(u, &any, &other);
    across = lobe_vector(lobe_select(oblique, across.x, any.x), lobe_select(oblique, across.y, any.y),
                         lobe_select(oblique, across.z, any.z));
    across = lobe_sub(across, lobe_scale(u, lobe_dot(across, u)));
    across = lobe_sub(across, lobe_scale(u, lobe_dot(across, u)));
    return lobe_normalize_or(across, any);
}

/* r for a slope sqrt(c^2 + a^2 s^2); a wi below the horizon, by more than rounding, sends no light out. What rounding
   of directions adds to c and the slope, which at grazing angles are as small as alpha, is taken off: in all at most
   1e-6   [bound lobe_ggx_range taken 1e-6] */
LOBE_API float lobe_ggx_range(lobe_vec3 normal, lobe_vec3 wi, float slope, float flux, float fresnel_max, float delta,
                              float xi) {
    float c = lobe_dot(normal, wi), divisor = 2 * LOBE_PI * (lobe_at_least(c, 0) + slope - 8e-7f);
    float power = lobe_select(c > -1e-6f, flux * fresnel_max, 0);
    LOBE_ASSERT(flux >= 0 && fresnel_max >= 0 && delta > 0 && xi >= 0);
    return ggx_range(power / divisor, delta, xi);
}

/* Grows an ellipsoid on all sides by what rounding may take, 8 2^-24 of the extent: how far the position is from 0, and
   the ellipsoid from it; its least radius by no more than 11.4   [bound lobe_ggx_pad growth 11.4] */
LOBE_API void lobe_ggx_pad(ggx_ellipsoid *e, float extent) {
    float t = 4.76837158e-7f * extent + 1e-12f, *r = e->radius;
    float m = lobe_at_least(lobe_at_most(lobe_at_most(r[0], r[1]), r[2]), t), factor = 1 + t / m, more = m * t;
    r[0] = sqrtf(factor * (r[0] * r[0] + more));
    r[1] = sqrtf(factor * (r[1] * r[1] + more));
    r[2] = sqrtf(factor * (r[2] * r[2] + more));
}

/* The ellipsoid with its center on the mirror direction u, at `along` from the position; its third axis is w. */
LOBE_API ggx_ellipsoid lobe_ggx_ellipsoid_of(lobe_vec3 position, lobe_vec3 u, lobe_vec3 w, float along, float ru,
                                             float rv, float rw) {
    ggx_ellipsoid e;
    e.center = lobe_add(position, lobe_scale(u, along));
    e.axis[0] = u;
    e.axis[1] = lobe_cross(w, u);
    e.axis[2] = w;
    e.radius[0] = ru;
    e.radius[1] = rv;
    e.radius[2] = rw;
    lobe_ggx_pad(&e, lobe_ggx_extent(position) + ru + fabsf(along));
    return e;
}

/*
 ggx_bound_spheroid - the paper's bound of the region where a light's GGX reflection is accepted

   position     of the light, at most 1e5 from 0 along each axis
   normal, wi   unit; wi below the horizon sends no light out
   alpha        [1e-4, 1], clamped to it
   flux         [0, 1e18]; 0 gives an ellipsoid about as small as the rounding of the position
   fresnel_max  the largest Fresnel factor, see ggx_fresnel_max; 1 always does
   delta, xi    as in ggx_range: xi = 0 counts as 2^-24, here as in ggx_accept_weight
   returns      an ellipsoid that contains each point where ggx_accept_probability of flux times Fresnel's factor times
                ggx_brdf_cos, or _separable, is above xi

   Rounding: covered: the region is inside, also as floats are rounded, of directions of length 1 to 1e-7
   Model:    a bound, exact but for masking and the horizon in the plane of incidence, loose across it at grazing angles
   Source:   003, Eqs. 12 to 15
*/
LOBE_API ggx_ellipsoid ggx_bound_spheroid(lobe_vec3 position, lobe_vec3 normal, lobe_vec3 wi, float alpha, float flux,
                                          float fresnel_max, float delta, float xi) {
    float a = lobe_ggx_alpha(alpha), inverse = 0.5f / a, c = lobe_ggx_cosine(normal, wi);
    float r = lobe_ggx_range(normal, wi, lobe_ggx_slope(c, a), flux, fresnel_max, delta, xi);
    lobe_vec3 u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u);
    return lobe_ggx_ellipsoid_of(position, u, w, (1 - a) * (1 + a) * inverse * r, (1 + a * a) * inverse * r, r, r);
}

/* d = 1 - eta^2 in (eps / 2, 1] for which the ellipsoid is about smallest, eps = 1 - e: within .1 % in the mean and .4 %
   of the best, a fit. Any d in that interval gives a bound; this one is at least eps.
   [bound lobe_ggx_tightness mean .001] [bound lobe_ggx_tightness worst .004] */
LOBE_API float lobe_ggx_tightness(float eps, float c2, float s) {
    float t = 4.5f * eps * s, root = sqrtf(t * t + 120 * eps * c2);
    float q = 4 * (1 - eps * eps * eps) * s / lobe_at_least(t + root, LOBE_TINY), q2 = q * q;
    return 1 / sqrtf(sqrtf(1 + q2 * q2));
}

/*
 ggx_bound_ellipsoid - a tighter bound of the same region

   all           as in ggx_bound_spheroid, which it follows in all but its size
   returns       an ellipsoid with the spheroid's tip

   Rounding: covered, as in ggx_bound_spheroid
   Model:    a bound. Volume over that of the spheroid at most, for incidence at 30, 60, 85 degrees:
             .879, .539, .145 at alpha .05; .897, .646, .360 at alpha .2
             [bound ggx_bound_ellipsoid volume_05_30 .879] [bound ggx_bound_ellipsoid volume_05_60 .539]
             [bound ggx_bound_ellipsoid volume_05_85 .145] [bound ggx_bound_ellipsoid volume_20_30 .897]
             [bound ggx_bound_ellipsoid volume_20_60 .646] [bound ggx_bound_ellipsoid volume_20_85 .360]
   Source:   derived for this library, see the top: with d = 1 - eta^2, eps = 1 - e, g = d (2 - eps) / (2 d - eps),
             K = 1 + e s^2 (1 + eta) / (1 + eta cos 2 theta), where 1 + eta cos 2 theta = d / (1 + eta) + 2 eta c^2:
             radii (a + 1 / a) g r / 2, sqrt(g) r, sqrt(g / K) r, center at r / a less the first
*/
LOBE_API ggx_ellipsoid ggx_bound_ellipsoid(lobe_vec3 position, lobe_vec3 normal, lobe_vec3 wi, float alpha, float flux,
                                           float fresnel_max, float delta, float xi) {
    float a = lobe_ggx_alpha(alpha), a2 = a * a, eps = 2 * a2 / (1 + a2), e = (1 - a) * (1 + a) / (1 + a2);
    float c = lobe_ggx_cosine(normal, wi), s = lobe_ggx_sine(normal, wi), c2 = c * c, h = e * (s * s);
    float r = lobe_ggx_range(normal, wi, lobe_ggx_slope(c, a), flux, fresnel_max, delta, xi);
    float d = lobe_ggx_tightness(eps, c2, s), eta, g, k, ru, side;
    lobe_vec3 u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u);
    eta = sqrtf(1 - d);
    k = 1 + h * (1 + eta) / (d / (1 + eta) + 2 * eta * c2);
    g = 2 * d / ((2 * d - eps) * (1 + a2));
    ru = 0.5f * (a + 1 / a) * g * r;
    side = sqrtf(g) * r;
    return lobe_ggx_ellipsoid_of(position, u, w, r / a - ru, ru, side, side / sqrtf(k));
}

/* Entries of the quadratic form uu U^2 + 2 ub U b + bb b^2 + (third axis)^2 <= 2 eps R U that bounds an anisotropic
   region, for one d; det = uu bb - ub^2. */
typedef struct lobe_ggx_form {
    float uu, ub, bb, det;
} lobe_ggx_form;

LOBE_API lobe_ggx_form lobe_ggx_form_of(float d, float eps, float c2, float s, float c1, float l2) {
    lobe_ggx_form q;
    float eta = sqrtf(lobe_at_least(1 - d, 0)), om = d / (1 + eta);
    float t = 0.5f * eps * (1 + eta) / (om + 2 * eta * c2), k = t * om * c1 * s, sg = d + k * om * c1 * s;
    q.uu = eps * (2 - eps / sg);
    q.ub = eps * (k / sg) * sqrtf(l2);
    q.bb = 1 + t * (d / sg) * l2;
    q.det = q.uu + l2 * (eps * (t / sg)) * (2 * d - eps);
    return q;
}

/* Falls with the ellipsoid's volume, which is proportional to (bb^(3/4) / det)^2 */
LOBE_API float lobe_ggx_form_merit(lobe_ggx_form q) {
    float root = sqrtf(q.bb);
    return q.det / (root * sqrtf(root));
}

/*
 ggx_bound_ellipsoid_aniso - the same for an anisotropic NDF

   tangent, alpha_x, alpha_y  as in ggx_ndf_aniso; others as in ggx_bound_spheroid
   returns      an ellipsoid that contains each point where ggx_accept_probability of flux times Fresnel's factor times
                ggx_brdf_cos_aniso is above xi

   Rounding: covered, as in ggx_bound_spheroid
   Model:    a bound; that of ggx_bound_ellipsoid for alpha_x = alpha_y. Volume, in the geometric mean over incidence
             and alphas of .02 to 1, at most .262 of that of the larger alpha's spheroid moved to where it is a bound
             [bound ggx_bound_ellipsoid_aniso volume .262 over .02 1]
             Over the least that some d gives: 1 % in the mean, .7 at most
             [bound ggx_bound_ellipsoid_aniso mean .01] [bound ggx_bound_ellipsoid_aniso worst .7]
   Source:   derived for this library. D of the larger alpha is no bound, since its peak is lower. With R = r /
             sqrt(a_x a_y), X = diag(1 / a_x^2 - 1, 1 / a_y^2 - 1) turned into the tangential frame (in the plane of
             incidence, w), m = |p| wi + p and l = |p| + wi.p, the region is |p| + m.X m / (2 l) <= R, where m_t^2 + c^2
             m_w^2 = (|p| - u) l. Take the largest kappa with X >= kappa diag(1, c^2): X = kappa diag(1, c^2) +
             (c1, c2)(c1, c2)', kappa makes a spheroid of alpha 1 / sqrt(1 + kappa), and the rest is kept as s^2 w^2 is
             at the top: with l = c1 c v + c2 w, U = R - u, eps = 2 / (2 + kappa), T = eps (1 + eta) / (2 (1 + eta cos 2
             theta)), k = T (1 - eta) c1 s, S = d + T ((1 - eta) c1 s)^2,
             v^2 + w^2 + T l^2 + 2 eps U^2 - (eps U - k l)^2 / S <= 2 eps R U. The best of three d is taken.
*/
LOBE_API ggx_ellipsoid ggx_bound_ellipsoid_aniso(lobe_vec3 position, lobe_vec3 normal, lobe_vec3 tangent, lobe_vec3 wi,
                                                 float alpha_x, float alpha_y, float flux, float fresnel_max,
                                                 float delta, float xi) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y), xx, xy, cosine, sine, x11, x22, x12, det;
    float c2, b, difference, kappa, c1, c2_rest, l2, eps, d, least, r, level, apart, root, turn, turn_cos, merit;
    float first, second, along, aside, size, ev, ew;
    int better;
    lobe_ggx_form q, other;
    lobe_vec3 tx, ty, beside, u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u), v = lobe_cross(w, u);
    float c = lobe_ggx_cosine(normal, wi), s = lobe_ggx_sine(normal, wi);
    ggx_ellipsoid e;
    r = lobe_ggx_range(normal, wi, lobe_ggx_slope_aniso(wi, normal, tangent, ax, ay), flux, fresnel_max, delta, xi) /
        sqrtf(ax * ay);
    c2 = c * c;
    /* X in the frame of the plane of incidence */
    lobe_ggx_tangents(normal, tangent, &tx, &ty);
    cosine = lobe_dot(w, ty);
    sine = -lobe_dot(w, tx);
    xx = (1 - ax) * (1 + ax) / (ax * ax);
    xy = (1 - ay) * (1 + ay) / (ay * ay);
    x11 = xx * cosine * cosine + xy * sine * sine;
    x22 = xx * sine * sine + xy * cosine * cosine;
    x12 = (xy - xx) * sine * cosine;
    det = xx * xy;
    /* the spheroid that it contains, and the rest, the smaller part of which would cancel, and is no larger: of nearly
       equal alphas both are rounding */
    b = x11 * c2 + x22;
    difference = x11 * c2 - x22;
    kappa = 2 * det / lobe_at_least(b + sqrtf(difference * difference + 4 * c2 * x12 * x12), LOBE_TINY);
    c1 = sqrtf(lobe_at_least(x11 - kappa, 0));
    c2_rest = sqrtf(lobe_at_least(x22 - kappa * c2, 0));
    better = c1 > c2_rest;
    first = lobe_at_least(c1, c2_rest);
    second = lobe_at_most(fabsf(x12), first * first) / lobe_at_least(first, LOBE_TINY);
    second = lobe_select(x12 < 0, -second, second);
    c1 = lobe_select(better, first, second);
    c2_rest = lobe_select(better, second, first);
    /* the quadratic form in U and along (c1 c, c2), for the best of three d */
    eps = 2 / (2 + kappa);
    ev = c1 * c;
    l2 = ev * ev + c2_rest * c2_rest;
    d = lobe_ggx_tightness(eps, c2, s);
    least = lobe_at_most(1.25f * eps, d);
    q = lobe_ggx_form_of(d, eps, c2, s, c1, l2);
    merit = lobe_ggx_form_merit(q);
    other = lobe_ggx_form_of(lobe_at_least(0.8f * d, least), eps, c2, s, c1, l2);
    better = lobe_ggx_form_merit(other) > merit;
    merit = lobe_select(better, lobe_ggx_form_merit(other), merit);
    q.uu = lobe_select(better, other.uu, q.uu);
    q.ub = lobe_select(better, other.ub, q.ub);
    q.bb = lobe_select(better, other.bb, q.bb);
    q.det = lobe_select(better, other.det, q.det);
    other = lobe_ggx_form_of(lobe_at_least(0.5f * d, least), eps, c2, s, c1, l2);
    better = lobe_ggx_form_merit(other) > merit;
    q.uu = lobe_select(better, other.uu, q.uu);
    q.ub = lobe_select(better, other.ub, q.ub);
    q.bb = lobe_select(better, other.bb, q.bb);
    q.det = lobe_select(better, other.det, q.det);
    /* its center and level, and its axes by one Jacobi rotation; the smaller eigenvalue as a quotient */
    along = r - eps * r * (q.bb / q.det);
    aside = -eps * r * (q.ub / q.det);
    level = eps * r * sqrtf(q.bb / q.det);
    apart = 0.5f * (q.bb - q.uu);
    root = sqrtf(apart * apart + q.ub * q.ub);
    turn = q.ub / lobe_at_least(fabsf(apart) + root, LOBE_TINY);
    better = apart >= 0;
    turn = lobe_select(better, turn, -turn);
    first = 0.5f * (q.uu + q.bb) + root;
    second = q.det / first;
    turn_cos = 1 / sqrtf(1 + turn * turn);
    turn *= turn_cos;
    size = 1 / sqrtf(lobe_at_least(l2, LOBE_TINY));
    ew = lobe_select(l2 > 1e-20f, c2_rest * size, 0);
    ev = lobe_select(l2 > 1e-20f, ev * size, 1);
    beside = lobe_add(lobe_scale(v, ev), lobe_scale(w, ew));
    e.center = lobe_add(position, lobe_add(lobe_scale(u, along), lobe_scale(beside, aside)));
    e.axis[0] = lobe_add(lobe_scale(u, turn_cos), lobe_scale(beside, turn));
    e.axis[1] = lobe_sub(lobe_scale(beside, turn_cos), lobe_scale(u, turn));
    e.axis[2] = lobe_sub(lobe_scale(w, ev), lobe_scale(v, ew));
    e.radius[0] = level / sqrtf(lobe_select(better, second, first));
    e.radius[1] = level / sqrtf(lobe_select(better, first, second));
    e.radius[2] = level;
    lobe_ggx_pad(&e, lobe_ggx_extent(position) + e.radius[0] + e.radius[1] + fabsf(along) + fabsf(aside));
    return e;
}

/*
 ggx_bound_sphere - the sphere around the light with which the paper compares

   all          as in ggx_bound_spheroid
   returns      radius r / alpha, the reach at the NDF's peak

   Rounding: covered
   Model:    a bound
   Source:   003, section 7, after Tokuyoshi and Harada 2016, Stochastic Light Culling
*/
LOBE_API ggx_sphere ggx_bound_sphere(lobe_vec3 position, lobe_vec3 normal, lobe_vec3 wi, float alpha, float flux,
                                     float fresnel_max, float delta, float xi) {
    ggx_sphere s;
    float a = lobe_ggx_alpha(alpha), c = lobe_ggx_cosine(normal, wi);
    s.center = position;
    s.radius = lobe_ggx_range(normal, wi, lobe_ggx_slope(c, a), flux, fresnel_max, delta, xi) / a;
    s.radius += 4.76837158e-7f * (lobe_ggx_extent(position) + s.radius) + 1e-12f;
    return s;
}

/* ggx_bound_enclosing - the sphere around an ellipsoid, with the same center: of the spheroid it is the paper's second
   comparison (003, section 7) */
LOBE_API ggx_sphere ggx_bound_enclosing(ggx_ellipsoid e) {
    ggx_sphere s;
    float r = lobe_at_least(lobe_at_least(e.radius[0], e.radius[1]), e.radius[2]);
    s.center = e.center;
    s.radius = r * 1.000001f;
    return s;
}

/* sqrt(flux albedo / (pi delta xi)): the range of a Lambert surface along its normal */
LOBE_API float lobe_ggx_diffuse_range(float flux, float albedo, float delta, float xi) {
    LOBE_ASSERT(flux >= 0 && albedo >= 0);
    return ggx_range(flux * albedo * (1 / LOBE_PI), delta, xi);
}

/*
 ggx_bound_diffuse - the paper's bound of the region where a light's Lambert reflection is accepted

   albedo       [0, 1]; others as in ggx_bound_spheroid
   returns      the smallest sphere that contains each point where ggx_accept_probability of the intensity flux albedo /
                pi max(cos, 0) is above xi

   Rounding: covered, as in ggx_bound_spheroid
   Model:    a bound; no smaller sphere is
   Source:   003, section 6: the region is |p| = R sqrt(cos), R the range along the normal; the distance to R 3^(-3/4)
             on the normal is largest, R (4/27)^(1/4), for |p|^4 = R^4 / 3, where the region is widest
*/
LOBE_API ggx_sphere ggx_bound_diffuse(lobe_vec3 position, lobe_vec3 normal, float flux, float albedo, float delta,
                                      float xi) {
    ggx_sphere s;
    float r = lobe_ggx_diffuse_range(flux, albedo, delta, xi);
    s.center = lobe_add(position, lobe_scale(normal, 0.438691338f * r));
    s.radius = 0.620403239f * r + 4.76837158e-7f * (lobe_ggx_extent(position) + 2 * r) + 1e-12f;
    return s;
}

/*
 ggx_bound_diffuse_ellipsoid - the smallest ellipsoid of revolution around the same region

   all          as in ggx_bound_diffuse
   returns      axis[0] is the normal; .8896 of the sphere's volume   [bound ggx_bound_diffuse_ellipsoid volume .8897]

   Rounding: covered
   Model:    a bound; touches the region at its tip and along a circle
   Source:   derived for this library: with p_n = |p|^3 / R^2 on the region's surface, the widest of (1 - (p_n - c)^2 /
             (1 - c)^2) is found in |p| alone; volume is least at c = .455626
*/
LOBE_API ggx_ellipsoid ggx_bound_diffuse_ellipsoid(lobe_vec3 position, lobe_vec3 normal, float flux, float albedo,
                                                   float delta, float xi) {
    float r = lobe_ggx_diffuse_range(flux, albedo, delta, xi);
    lobe_vec3 x, y;
    lobe_frame(normal, &x, &y);
    return lobe_ggx_ellipsoid_of(position, normal, lobe_cross(normal, x), 0.4556264f * r, 0.5443738f * r,
                                 0.6246771f * r, 0.6246771f * r);
}

/* ---- tests against boxes and tiles ---- */

/* ggx_ellipsoid_of_sphere - a sphere for the functions below */
LOBE_API ggx_ellipsoid ggx_ellipsoid_of_sphere(ggx_sphere s) {
    ggx_ellipsoid e;
    e.center = s.center;
    e.axis[0] = lobe_vector(1, 0, 0);
    e.axis[1] = lobe_vector(0, 1, 0);
    e.axis[2] = lobe_vector(0, 0, 1);
    e.radius[0] = s.radius;
    e.radius[1] = s.radius;
    e.radius[2] = s.radius;
    return e;
}

/* M p for a matrix of three rows */
LOBE_API lobe_vec3 lobe_ggx_turn(const lobe_vec3 *rows, lobe_vec3 p) {
    return lobe_vector(lobe_dot(rows[0], p), lobe_dot(rows[1], p), lobe_dot(rows[2], p));
}

/*
 ggx_ellipsoid_transform - an ellipsoid seen from a camera

   view       rows of the rotation V, orthonormal to 1e-7: the camera's right, up and forward
   eye        the camera's position
   returns    center V (c - eye), axes V axis

   Rounding: covered: the result contains V (p - eye) for p in the ellipsoid, also as rounded
   Model:    exact
   Source:   003, section 5.1
*/
LOBE_API ggx_ellipsoid ggx_ellipsoid_transform(ggx_ellipsoid e, const lobe_vec3 view[3], lobe_vec3 eye) {
    ggx_ellipsoid t;
    t.center = lobe_ggx_turn(view, lobe_sub(e.center, eye));
    t.axis[0] = lobe_ggx_turn(view, e.axis[0]);
    t.axis[1] = lobe_ggx_turn(view, e.axis[1]);
    t.axis[2] = lobe_ggx_turn(view, e.axis[2]);
    t.radius[0] = e.radius[0];
    t.radius[1] = e.radius[1];
    t.radius[2] = e.radius[2];
    lobe_ggx_pad(&t, lobe_ggx_extent(t.center) + lobe_ggx_extent(e.center) + ggx_bound_enclosing(e).radius);
    return t;
}

/* ggx_ellipsoid_reach - how far an ellipsoid extends from its center along a direction, times the direction's length;
   <= 8 2^-24 of the largest radius   [bound ggx_ellipsoid_reach extent 8] */
LOBE_API float ggx_ellipsoid_reach(ggx_ellipsoid e, lobe_vec3 direction) {
    float x = e.radius[0] * lobe_dot(e.axis[0], direction), y = e.radius[1] * lobe_dot(e.axis[1], direction);
    float z = e.radius[2] * lobe_dot(e.axis[2], direction);
    return sqrtf(x * x + y * y + z * z);
}

/*
 ggx_ellipsoid_hits_half_space - whether an ellipsoid has points with dot(p, normal) >= offset

   normal     of any length up to 1e3
   returns    1, or 0: surely not

   Rounding: covered; 1 also within 32 2^-24 (|center| + largest radius) |normal| of touching
             [bound ggx_ellipsoid_hits_half_space slack 32] [bound ggx_ellipsoid_hits_half_space growth 11]
   Model:    exact
   Source:   the support function of an ellipsoid
*/
LOBE_API int ggx_ellipsoid_hits_half_space(ggx_ellipsoid e, lobe_vec3 normal, float offset) {
    float size = lobe_ggx_extent(e.center) + ggx_bound_enclosing(e).radius;
    float slack = 4.76837158e-7f * (size * (fabsf(normal.x) + fabsf(normal.y) + fabsf(normal.z)) + fabsf(offset));
    return lobe_dot(e.center, normal) + ggx_ellipsoid_reach(e, normal) + slack >= offset;
}

/* Whether the plane across a direction surely parts an ellipsoid and a box at an offset from its center */
LOBE_API int lobe_ggx_parted(ggx_ellipsoid e, lobe_vec3 direction, lobe_vec3 offset, lobe_vec3 half_size, float slack) {
    float size = fabsf(direction.x) + fabsf(direction.y) + fabsf(direction.z);
    float box = fabsf(direction.x) * half_size.x + fabsf(direction.y) * half_size.y + fabsf(direction.z) * half_size.z;
    return fabsf(lobe_dot(direction, offset)) > box + ggx_ellipsoid_reach(e, direction) + slack * size;
}

/* Entries of sum axis axis' (least radius / radius)^2: what the gradient of the stretched distance is made of */
typedef struct lobe_ggx_metric {
    float xx, yy, zz, xy, xz, yz;
} lobe_ggx_metric;

LOBE_API lobe_ggx_metric lobe_ggx_metric_of(ggx_ellipsoid e) {
    lobe_ggx_metric m;
    float least = lobe_at_most(lobe_at_most(e.radius[0], e.radius[1]), e.radius[2]);
    float i0 = least / e.radius[0], i1 = least / e.radius[1], i2 = least / e.radius[2];
    lobe_vec3 a = lobe_scale(e.axis[0], i0), b = lobe_scale(e.axis[1], i1), c = lobe_scale(e.axis[2], i2);
    m.xx = a.x * a.x + b.x * b.x + c.x * c.x;
    m.yy = a.y * a.y + b.y * b.y + c.y * c.y;
    m.zz = a.z * a.z + b.z * b.z + c.z * c.z;
    m.xy = a.x * a.y + b.x * b.y + c.x * c.y;
    m.xz = a.x * a.z + b.x * b.z + c.x * c.z;
    m.yz = a.y * a.z + b.y * b.z + c.y * c.z;
    return m;
}

LOBE_API lobe_vec3 lobe_ggx_gradient(lobe_ggx_metric m, lobe_vec3 p) {
    return lobe_vector(m.xx * p.x + m.xy * p.y + m.xz * p.z, m.xy * p.x + m.yy * p.y + m.yz * p.z,
                       m.xz * p.x + m.yz * p.y + m.zz * p.z);
}

LOBE_API float lobe_ggx_clamp(float x, float middle, float half_size) {
    return lobe_min(lobe_max(x, middle - half_size), middle + half_size);
}

/* Lowers the stretched distance of a box's point along each coordinate in turn, as far as the box allows */
LOBE_API lobe_vec3 lobe_ggx_descend(lobe_ggx_metric m, lobe_vec3 p, lobe_vec3 middle, lobe_vec3 half_size) {
    p.x = lobe_ggx_clamp(-(m.xy * p.y + m.xz * p.z) / lobe_at_least(m.xx, LOBE_TINY), middle.x, half_size.x);
    p.y = lobe_ggx_clamp(-(m.xy * p.x + m.yz * p.z) / lobe_at_least(m.yy, LOBE_TINY), middle.y, half_size.y);
    p.z = lobe_ggx_clamp(-(m.xz * p.x + m.yz * p.y) / lobe_at_least(m.zz, LOBE_TINY), middle.z, half_size.z);
    return p;
}

/*
 ggx_ellipsoid_hits_box - whether an ellipsoid meets a box along the coordinate axes

   box_center, half_size  half_size >= 0
   returns    1, or 0: surely not

   Rounding: covered: the box is grown by 2^-20 of the sum of its distance, its size and the largest radius
             [bound ggx_ellipsoid_hits_box growth 19]
   Model:    of boxes that are hit by the ellipsoid's own bounding box, but not by it, at most .5 % are not told
             [bound ggx_ellipsoid_hits_box false_hits .005]
   Source:   derived for this library, for 003's stretched sphere: the planes across the coordinate axes, and across the
             ellipsoid's gradient where three rounds of coordinate descent find the box nearest
*/
LOBE_API int ggx_ellipsoid_hits_box(ggx_ellipsoid e, lobe_vec3 box_center, lobe_vec3 half_size) {
    lobe_vec3 offset = lobe_sub(box_center, e.center), p;
    lobe_ggx_metric m = lobe_ggx_metric_of(e);
    float size = lobe_ggx_extent(offset) + lobe_ggx_extent(half_size) + ggx_bound_enclosing(e).radius;
    float slack = 9.53674316e-7f * size;
    p = lobe_vector(lobe_ggx_clamp(0, offset.x, half_size.x), lobe_ggx_clamp(0, offset.y, half_size.y),
                    lobe_ggx_clamp(0, offset.z, half_size.z));
    p = lobe_ggx_descend(m, lobe_ggx_descend(m, lobe_ggx_descend(m, p, offset, half_size), offset, half_size), offset,
                         half_size);
    return !(lobe_ggx_parted(e, lobe_vector(1, 0, 0), offset, half_size, slack) |
             lobe_ggx_parted(e, lobe_vector(0, 1, 0), offset, half_size, slack) |
             lobe_ggx_parted(e, lobe_vector(0, 0, 1), offset, half_size, slack) |
             lobe_ggx_parted(e, lobe_ggx_gradient(m, p), offset, half_size, slack));
}

/*
 ggx_stretch_ellipsoid - the space of an ellipsoid in which it is a unit sphere and the camera's depth planes stay
 perpendicular to the third axis

   e          in the camera's frame, see ggx_ellipsoid_transform

   Rounding: covered by the tests below
   Model:    exact
   Source:   003, Eqs. 16 and 17: B S is the triangular factor of a QR decomposition of diag(1 / radius) (axes)', whose
             left rotation does not matter, found by Gram and Schmidt's method with the longer of the stretched x and y
             first
*/
LOBE_API ggx_stretched ggx_stretch_ellipsoid(ggx_ellipsoid e) {
    ggx_stretched s;
    float i0 = 1 / e.radius[0], i1 = 1 / e.radius[1], i2 = 1 / e.radius[2], twice;
    lobe_vec3 x = lobe_vector(i0 * e.axis[0].x, i1 * e.axis[1].x, i2 * e.axis[2].x), any, other;
    lobe_vec3 y = lobe_vector(i0 * e.axis[0].y, i1 * e.axis[1].y, i2 * e.axis[2].y), p, q;
    lobe_vec3 z = lobe_vector(i0 * e.axis[0].z, i1 * e.axis[1].z, i2 * e.axis[2].z);
    lobe_vec3 c = e.center;
    s.swapped = lobe_dot(x, x) <= lobe_dot(y, y);
    p = lobe_vector(lobe_select(s.swapped, y.x, x.x), lobe_select(s.swapped, y.y, x.y),
                    lobe_select(s.swapped, y.z, x.z));
    q = lobe_vector(lobe_select(s.swapped, x.x, y.x), lobe_select(s.swapped, x.y, y.y),
                    lobe_select(s.swapped, x.z, y.z));
    c.x = lobe_select(s.swapped, e.center.y, e.center.x);
    c.y = lobe_select(s.swapped, e.center.x, e.center.y);
    s.xx = sqrtf(lobe_dot(p, p));
    p = lobe_scale(p, 1 / s.xx);
    s.xy = lobe_dot(p, q);
    q = lobe_sub(q, lobe_scale(p, s.xy));
    twice = lobe_dot(p, q);
    s.xy += twice;
    q = lobe_sub(q, lobe_scale(p, twice));
    s.yy = sqrtf(lobe_dot(q, q));
    lobe_frame(p, &any, &other);
    q = lobe_normalize_or(q, any);
    s.xz = lobe_dot(p, z);
    s.yz = lobe_dot(q, z);
    s.zz = fabsf(lobe_dot(lobe_cross(p, q), z));
    s.center.x = s.xx * c.x + s.xy * c.y + s.xz * c.z;
    s.center.y = s.yy * c.y + s.yz * c.z;
    s.center.z = s.zz * c.z;
    s.size = s.xx * fabsf(c.x) + (fabsf(s.xy) + s.yy) * fabsf(c.y) + (fabsf(s.xz) + fabsf(s.yz) + s.zz) * fabsf(c.z);
    return s;
}

/* Where a ray of the camera, of x/z and y/z in the stretched space's order, is at depth 1 there */
LOBE_API lobe_vec3 lobe_ggx_ray(ggx_stretched s, float x, float y) {
    return lobe_vector(s.xx * x + s.xy * y + s.xz, s.yy * y + s.yz, s.zz);
}

/* A tile with its sides in the stretched space's order */
LOBE_API ggx_tile lobe_ggx_swap(ggx_stretched s, ggx_tile tile) {
    ggx_tile t;
    t.left = lobe_select(s.swapped, tile.bottom, tile.left);
    t.right = lobe_select(s.swapped, tile.top, tile.right);
    t.bottom = lobe_select(s.swapped, tile.left, tile.bottom);
    t.top = lobe_select(s.swapped, tile.right, tile.top);
    return t;
}

/* The sphere's radius: 1.00001 and 2^-19 of the sum of the terms that make coordinates of its center and of a frustum
   to that depth   [bound lobe_ggx_stretched_radius growth 32.1]
   The tile as lobe_ggx_swap has it */
LOBE_API float lobe_ggx_stretched_radius(ggx_stretched s, ggx_tile t, float depth) {
    float wide = lobe_max(fabsf(t.left), fabsf(t.right)), high = lobe_max(fabsf(t.bottom), fabsf(t.top));
    float terms = s.xx * wide + (fabsf(s.xy) + s.yy) * high + fabsf(s.xz) + fabsf(s.yz) + s.zz;
    return 1.00001f + 1.90734863e-6f * (s.size + depth * terms);
}

/* How far a number is outside of [low, high] */
LOBE_API float lobe_ggx_outside(float low, float high, float x) {
    return lobe_at_least(lobe_at_least(low - x, x - high), 0);
}

/*
 ggx_stretched_hits_tile - whether an ellipsoid meets the part of a tile's frustum between two depths

   s             from ggx_stretch_ellipsoid
   depth0, 1     0 <= depth0 <= depth1
   returns       1, or 0: surely not

   Rounding: covered: the sphere is grown by 2^-19 of the sum of the terms that make coordinates
   Model:    a sphere against the bounds of the stretched frustum, as in the paper: of what passes among frustums near
             the ellipsoid, at most 39.5 % does not meet it   [bound ggx_stretched_hits_tile false_hits .395]
   Source:   003, section 5.2
*/
LOBE_API int ggx_stretched_hits_tile(ggx_stretched s, ggx_tile tile, float depth0, float depth1) {
    ggx_tile t = lobe_ggx_swap(s, tile);
    float x0 = s.xx * t.left + lobe_min(s.xy * t.bottom, s.xy * t.top) + s.xz;
    float x1 = s.xx * t.right + lobe_max(s.xy * t.bottom, s.xy * t.top) + s.xz;
    float y0 = s.yy * t.bottom + s.yz, y1 = s.yy * t.top + s.yz;
    float x = lobe_ggx_outside(lobe_min(x0 * depth0, x0 * depth1), lobe_max(x1 * depth0, x1 * depth1), s.center.x);
    float y = lobe_ggx_outside(lobe_min(y0 * depth0, y0 * depth1), lobe_max(y1 * depth0, y1 * depth1), s.center.y);
    float z = lobe_ggx_outside(s.zz * depth0, s.zz * depth1, s.center.z);
    float radius = lobe_ggx_stretched_radius(s, t, depth1);
    LOBE_ASSERT(depth0 >= 0 && depth1 >= depth0);
    return x * x + y * y + z * z <= radius * radius;
}

/*
 ggx_ellipsoid_hits_sides - whether an ellipsoid reaches inside of each of the four sides of a tile's frustum

   e          in the camera's frame
   returns    1, or 0: surely not

   Rounding: covered
   Model:    with ggx_stretched_hits_tile: of what passes both, among frustums near the ellipsoid, at most 14 % does not
             meet it   [bound ggx_ellipsoid_hits_sides false_hits .14]
   Source:   the support function of an ellipsoid: what the sheared bounds of the stretched frustum miss
*/
LOBE_API int ggx_ellipsoid_hits_sides(ggx_ellipsoid e, ggx_tile tile) {
    return ggx_ellipsoid_hits_half_space(e, lobe_vector(1, 0, -tile.left), 0) &
           ggx_ellipsoid_hits_half_space(e, lobe_vector(-1, 0, tile.right), 0) &
           ggx_ellipsoid_hits_half_space(e, lobe_vector(0, 1, -tile.bottom), 0) &
           ggx_ellipsoid_hits_half_space(e, lobe_vector(0, -1, tile.top), 0);
}

/* The point of a tile's frustum that is lowest along a direction of the stretched space, relative to the ellipsoid; the
   tile as lobe_ggx_swap has it */
LOBE_API lobe_vec3 lobe_ggx_support(ggx_stretched s, ggx_tile t, float depth0, float depth1, lobe_vec3 q) {
    float gx = s.xx * q.x, gy = s.xy * q.x + s.yy * q.y, gz = s.xz * q.x + s.yz * q.y + s.zz * q.z;
    float x = lobe_select(gx > 0, t.left, t.right), y = lobe_select(gy > 0, t.bottom, t.top);
    float z = lobe_select(gx * x + gy * y + gz > 0, depth0, depth1);
    return lobe_sub(lobe_scale(lobe_ggx_ray(s, x, y), z), s.center);
}

/* Moves a point of the frustum towards another, to where the line is nearest to the ellipsoid's center */
LOBE_API lobe_vec3 lobe_ggx_nearer(lobe_vec3 q, lobe_vec3 other) {
    lobe_vec3 step = lobe_sub(other, q);
    float t = lobe_at_least(-lobe_dot(q, step), 0) / lobe_at_least(lobe_dot(step, step), LOBE_TINY);
    return lobe_add(q, lobe_scale(step, lobe_at_most(t, 1)));
}

/*
 ggx_stretched_hits_frustum - the same test of an ellipsoid and a tile, closer: for what ggx_stretched_hits_tile and
 ggx_ellipsoid_hits_sides let through

   others     as in ggx_stretched_hits_tile
   returns    1, or 0: surely not

   Rounding: covered as there
   Model:    of what passes all three, among frustums near the ellipsoid, at most 4 % does not meet it
             [bound ggx_stretched_hits_frustum false_hits .04]
   Source:   Gilbert 1966, An Iterative Procedure for Computing the Minimum of a Quadratic Form on a Convex Set: each
             step looks for a plane between the sphere and the frustum, across the line to the nearest point known, and
             moves this towards the frustum's lowest point there
*/
LOBE_API int ggx_stretched_hits_frustum(ggx_stretched s, ggx_tile tile, float depth0, float depth1) {
    ggx_tile t = lobe_ggx_swap(s, tile);
    lobe_vec3 ray = lobe_ggx_ray(s, 0.5f * (t.left + t.right), 0.5f * (t.bottom + t.top)), lowest;
    lobe_vec3 q = lobe_sub(lobe_scale(ray, 0.5f * (depth0 + depth1)), s.center);
    float radius = lobe_ggx_stretched_radius(s, t, depth1);
    int parted;
    lowest = lobe_ggx_support(s, t, depth0, depth1, q);
    parted = lobe_dot(q, lowest) > radius * sqrtf(lobe_dot(q, q));
    q = lobe_ggx_nearer(q, lowest);
    lowest = lobe_ggx_support(s, t, depth0, depth1, q);
    parted |= lobe_dot(q, lowest) > radius * sqrtf(lobe_dot(q, q));
    q = lobe_ggx_nearer(q, lowest);
    lowest = lobe_ggx_support(s, t, depth0, depth1, q);
    parted |= lobe_dot(q, lowest) > radius * sqrtf(lobe_dot(q, q));
    return !parted;
}

/*
 ggx_stretched_hits_clusters - the same for a tile of two depth clusters, each with its own least and largest depth

   near_depth, far_depth   [0], [1]: the least and the largest depth of the cluster's pixels; least above largest: empty
   returns       1 for the first, 2 for the second, 3 for both, 0 for neither

   Rounding: covered
   Model:    as ggx_stretched_hits_tile
   Source:   003, section 5.1: Stewart 2015, Compute-Based Tiled Culling, Modified HalfZ
*/
LOBE_API int ggx_stretched_hits_clusters(ggx_stretched s, ggx_tile tile, const float near_depth[2],
                                         const float far_depth[2]) {
    int first = (near_depth[0] <= near_depth[1]) & ggx_stretched_hits_tile(s, tile, near_depth[0], near_depth[1]);
    int second = (far_depth[0] <= far_depth[1]) & ggx_stretched_hits_tile(s, tile, far_depth[0], far_depth[1]);
    return first + 2 * second;
}

/*
 ggx_tile_above - whether part of a tile's frustum between two depths is above a light's horizon, where alone it shines

   position, normal  of the light, in the camera's frame
   returns           1, or 0: surely not

   Rounding: covered; 1 also within 2^-20 of the sum of the terms of both heights above the horizon
             [bound ggx_tile_above slack 32] [bound ggx_tile_above growth 20]
   Model:    exact
   Source:   derived for this library: a plane and the frustum's corners
*/
LOBE_API int ggx_tile_above(lobe_vec3 position, lobe_vec3 normal, ggx_tile tile, float depth0, float depth1) {
    float x = lobe_max(normal.x * tile.left, normal.x * tile.right);
    float y = lobe_max(normal.y * tile.bottom, normal.y * tile.top), slope = x + y + normal.z;
    float slack = 9.53674316e-7f * (fabsf(position.x) + fabsf(position.y) + fabsf(position.z) +
                                    depth1 * (fabsf(x) + fabsf(y) + fabsf(normal.z)));
    return lobe_max(slope * depth0, slope * depth1) + slack >= lobe_dot(position, normal);
}

#endif
/*
 Lobe is in the public domain (Unlicense, unlicense.org), or MIT licensed, as you like: see LICENSE.
*/
