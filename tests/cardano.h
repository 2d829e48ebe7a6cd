/* cardano.h - the product of two ASGs as the papers did it: eigenvalues of the summed quadratic form by Cardano's
   formula, its lowest eigenvector as the longest cross product of two rows */
#ifndef CARDANO_H
#define CARDANO_H

#include "../asg.h"

/* acos on [-1, 1] after Abramowitz and Stegun 4.4.46, to 7e-8 */
static inline float poly_acos(float x) {
    float a = fabsf(x), root = sqrtf(lobe_at_least(1 - a, 0));
    float p = 0.0308918810f + a * (-0.0170881256f + a * (0.0066700901f - 0.0012624911f * a));
    p = root * (1.5707963050f + a * (-0.2145988016f + a * (0.0889789874f + a * (-0.0501743046f + a * p))));
    return lobe_select(x < 0, LOBE_PI - p, p);
}

/* cos and sin on [0, pi / 3] */
static inline float poly_cos(float t2) {
    return 1 + t2 * (-0.5f + t2 * (0.0416666418f + t2 * (-0.00138873162f + t2 * 2.44331568e-5f)));
}

static inline float poly_sin(float t, float t2) {
    return t * (1 + t2 * (-0.166666657f + t2 * (0.00833301712f - t2 * 0.000195152830f)));
}

#define CARDANO(name, real, ACOS_COS_SIN, SQRT, EXP, SELECT)                                                           \
    static inline float name(asg_lobe a, asg_lobe b) {                                                                 \
        const real l1 = a.sharpness_x, l2 = a.sharpness_y, l3 = b.sharpness_x, l4 = b.sharpness_y;                     \
        const real ax = a.x.x, ay = a.x.y, az = a.x.z, bx = a.y.x, by = a.y.y, bz = a.y.z;                             \
        const real cx = b.x.x, cy = b.x.y, cz = b.x.z, dx = b.y.x, dy = b.y.y, dz = b.y.z;                             \
        const real third = (real)1 / 3;                                                                                \
        real xx = l1 * ax * ax + l2 * bx * bx + l3 * cx * cx + l4 * dx * dx;                                           \
        real yy = l1 * ay * ay + l2 * by * by + l3 * cy * cy + l4 * dy * dy;                                           \
        real zz = l1 * az * az + l2 * bz * bz + l3 * cz * cz + l4 * dz * dz;                                           \
        real xy = l1 * ax * ay + l2 * bx * by + l3 * cx * cy + l4 * dx * dy;                                           \
        real xz = l1 * ax * az + l2 * bx * bz + l3 * cx * cz + l4 * dx * dz;                                           \
        real yz = l1 * ay * az + l2 * by * bz + l3 * cy * cz + l4 * dy * dz;                                           \
        real m = (xx + yy + zz) * third, u = xx - m, v = yy - m, w = zz - m;                                           \
        real xy2 = xy * xy, xz2 = xz * xz, yz2 = yz * yz, c, s, e1, e2, e3, d0, d1, d2, px, py, pz, za, zb;            \
        real p = (u * u + v * v + w * w + 2 * (xy2 + xz2 + yz2)) * (third / 2), root = SQRT(p);                        \
        real q = (u * (v * w - yz2) - xy * (xy * w - yz * xz) + xz * (xy * yz - v * xz)) / 2;                          \
        real r = q / (p * root + (real)1e-30), r0x, r0y, r0z, r1x, r1y, r1z, r2x, r2y, r2z;                            \
        r = SELECT(r < 1, r, 1);                                                                                       \
        r = SELECT(r > -1, r, -1);                                                                                     \
        ACOS_COS_SIN(r, c, s)                                                                                          \
        e1 = m + 2 * root * c;                                                                                         \
        e3 = m - root * (c + (real)1.7320508075688772 * s);                                                            \
        e2 = 3 * m - e1 - e3;                                                                                          \
        u = xx - e3;                                                                                                   \
        v = yy - e3;                                                                                                   \
        w = zz - e3;                                                                                                   \
        r0x = xy * yz - xz * v, r0y = xz * xy - u * yz, r0z = u * v - xy2;                                             \
        r1x = xy * w - xz * yz, r1y = xz2 - u * w, r1z = u * yz - xy * xz;                                             \
        r2x = v * w - yz2, r2y = yz * xz - xy * w, r2z = xy * yz - v * xz;                                             \
        d0 = r0x * r0x + r0y * r0y + r0z * r0z;                                                                        \
        d1 = r1x * r1x + r1y * r1y + r1z * r1z;                                                                        \
        d2 = r2x * r2x + r2y * r2y + r2z * r2z;                                                                        \
        px = SELECT(d1 > d0, r1x, r0x), py = SELECT(d1 > d0, r1y, r0y), pz = SELECT(d1 > d0, r1z, r0z);                \
        d0 = SELECT(d1 > d0, d1, d0);                                                                                  \
        px = SELECT(d2 > d0, r2x, px), py = SELECT(d2 > d0, r2y, py), pz = SELECT(d2 > d0, r2z, pz);                   \
        d0 = SELECT(d2 > d0, d2, d0);                                                                                  \
        za = px * a.z.x + py * a.z.y + pz * a.z.z;                                                                     \
        zb = px * b.z.x + py * b.z.y + pz * b.z.z;                                                                     \
        za *= zb;                                                                                                      \
        za = SELECT(za > 0, za, 0);                                                                                    \
        return (float)((real)LOBE_PI * EXP(a.log_amplitude + b.log_amplitude - e3) * za /                              \
                       (d0 * SQRT((e1 - e3) * (e2 - e3))));                                                            \
    }

#define POLYNOMIALS(r, c, s)                                                                                           \
    {                                                                                                                  \
        float t = poly_acos(r) * 0.333333333f, t2 = t * t;                                                             \
        c = poly_cos(t2);                                                                                              \
        s = poly_sin(t, t2);                                                                                           \
    }

CARDANO(cardano_float, float, POLYNOMIALS, sqrtf, lobe_exp, lobe_select)

#endif
