/* glossy.h - microfacet BRDFs of one or more lobes, and directions drawn in proportion to BRDF times cosine. */
#ifndef GLOSSY_H
#define GLOSSY_H

#include "scene.h"

/* Distributions of half vectors. Those of alpha have Cook and Torrance's V-cavities for shadows, Phong's powers (of
   Ashikhmin and Shirley, where two exponents differ) Kelemen's quotient. No Fresnel term. */
typedef enum { GLOSSY_GGX, GLOSSY_BECKMANN, GLOSSY_PHONG } glossy_model;

typedef struct {
    glossy_model model;
    float along, across; /* the tangent: alpha, or exponent */
    float share;         /* of the reflected light */
} glossy_lobe;

enum { GLOSSY_LOBES = 3 };

typedef struct {
    glossy_lobe lobes[GLOSSY_LOBES];
    int count;
    vec3 tangent; /* perpendicular to the normal */
} glossy;

/* Sharpness of the distribution as an SG of the half vector: its curvature at the peak */
static inline float glossy_sharpness(glossy_model model, float parameter) {
    return model == GLOSSY_PHONG ? parameter : 2 / (parameter * parameter);
}

/* A half vector by the distribution times its cosine, in the frame of tangent, bitangent and normal */
static inline vec3 glossy_half_vector(const glossy_lobe *lobe, float u, float v) {
    float x = cosf(2 * LOBE_PI * v), y = sinf(2 * LOBE_PI * v), slope;
    if (lobe->model == GLOSSY_PHONG) { /* cos^(e + 2) is uniform, e + 2 that in the azimuth of (x, y) */
        float power;
        x /= sqrtf(lobe->along + 2);
        y /= sqrtf(lobe->across + 2);
        power = 1 / (x * x + y * y);
        slope = sqrtf(lobe_max(powf(1 - u, -2 / power) - 1, 0) * power);
    } else {
        slope = sqrtf(lobe->model == GLOSSY_GGX ? u / (1 - u) : -logf(1 - u));
        x *= lobe->along;
        y *= lobe->across;
    }
    return vec3_normalize(lobe_vector(slope * x, slope * y, 1));
}

/* Draws a direction wi. Those for which this returns 1 are distributed as BRDF times cosine over its integral, so that
   a plain mean of the radiance from there is the reflected radiance over the reflectance. u: four uniform numbers below
   1. */
static inline int glossy_draw(const glossy *look, vec3 normal, vec3 wo, const float u[4], vec3 *wi) {
    const glossy_lobe *lobe = look->lobes;
    vec3 local, h;
    float passed = lobe->share, nh, oh, ni, no = lobe_dot(normal, wo), weight;
    while (u[3] >= passed && lobe < look->lobes + look->count - 1) passed += (++lobe)->share;
    local = glossy_half_vector(lobe, u[0], u[1]);
    h = lobe_add(lobe_add(lobe_scale(look->tangent, local.x), lobe_scale(lobe_cross(normal, look->tangent), local.y)),
                 lobe_scale(normal, local.z));
    nh = local.z;
    oh = lobe_dot(wo, h);
    *wi = lobe_sub(lobe_scale(h, 2 * oh), wo);
    ni = lobe_dot(normal, *wi);
    if (!(oh > 0 && ni > 0 && no > 0)) return 0;
    /* BRDF times cosine over the density of wi is at most 2 */
    if (lobe->model == GLOSSY_PHONG)
        weight = ni / (oh * nh);
    else
        weight = lobe_min(oh / (no * nh), lobe_min(2, 2 * ni / no));
    return 2 * u[2] < weight;
}

#endif
