/*
 tokuyoshi.h - an SG times a clamped cosine after Tokuyoshi et al. 2024, Hierarchical Light Sampling with Accurate
 Spherical Gaussian Lighting: between the integrals for the two opposed normals by a share that is exact in the sharp
 limit. What ours is measured against, by the tests and by the bench.
*/
#ifndef TOKUYOSHI_H
#define TOKUYOSHI_H

#include "../sg.h" /* first: it tells gcc and clang that sqrtf vectorises */

/* What the published fit makes of the sharpness l */
static inline float tokuyoshi_steepness(float l) {
    return l * sqrtf(0.5f * ((l + 2.73608316113f) * l + 17.0212977787f) /
                     (((l + 4.01008267285f) * l + 15.2191562631f) * l + 76.0878962724f));
}

/* The integral for the cosine c of axis and normal, with the C library; series for small sharpness, as published */
static inline float tokuyoshi_2024(float l, float c) {
    float t = tokuyoshi_steepness(l), tz = t * c, e = expf(-l), upper, lower;
    float share = 0.5f * (c * erfcf(-tz) + erfcf(t)) -
                  0.282094792f * expf(-tz * tz) * expm1f(t * t * (c * c - 1)) / (t > 1e-7f ? t : 1e-7f);
    if (l <= 0.5f) {
        upper = 0.5f + l * (-1.0f / 6 + l * (1.0f / 24 + l * (-1.0f / 120 + l * (1.0f / 720 + l * (-1.0f / 5040)))));
        lower = e * (0.5f + l * (-1.0f / 3 + l * (0.125f + l * (-1.0f / 30 + l * (1.0f / 144 - l / 840)))));
    } else {
        upper = (expm1f(-l) + l) / (l * l);
        lower = e * (-expm1f(-l) - l * e) / (l * l);
    }
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    return 6.28318531f * (lower + (upper - lower) * share);
}

#endif
