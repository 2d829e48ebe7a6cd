/* brdf.h - the exact BRDF of a finish, its sampling, and the light it reflects: what the references are made of. */
#ifndef BRDF_H
#define BRDF_H

#include "scene.h"

/* The GGX distribution of half vectors (Walter et al. 2007) */
static inline float brdf_distribution(float alpha, float cos_h) {
    float a2 = alpha * alpha, base = a2 * cos_h * cos_h + (1 - cos_h) * (1 + cos_h);
    return a2 / (LOBE_PI * base * base);
}

/* BRDF value per component: diffuse / pi, and GGX with Smith's height-correlated G2. */
static inline vec3 brdf_value(const finish *look, vec3 normal, vec3 wi, vec3 wo) {
    float cos_i = lobe_dot(normal, wi), cos_o = lobe_dot(normal, wo), a2 = look->alpha * look->alpha;
    float distribution, visibility;
    if (cos_i <= 0 || cos_o <= 0) return lobe_vector(0, 0, 0);
    distribution = brdf_distribution(look->alpha, lobe_dot(normal, vec3_normalize(lobe_add(wi, wo))));
    visibility = 0.5f / (cos_o * sqrtf(a2 + (1 - a2) * cos_i * cos_i) + cos_i * sqrtf(a2 + (1 - a2) * cos_o * cos_o));
    return lobe_add(lobe_scale(look->diffuse, 1 / LOBE_PI), lobe_scale(look->specular, distribution * visibility));
}

/* Chance of sampling the specular part. */
static inline float brdf_specular_chance(const finish *look) {
    float d = lobe_mean(look->diffuse), s = lobe_mean(look->specular);
    return d + s > 0 ? s / (d + s) : 0;
}

/* Probability density, per solid angle, that brdf_sample gives wi. */
static inline float brdf_density(const finish *look, vec3 normal, vec3 wo, vec3 wi) {
    float cos_i = lobe_dot(normal, wi), chance = brdf_specular_chance(look), cos_h;
    vec3 h;
    if (cos_i <= 0 || lobe_dot(normal, wo) <= 0) return 0;
    h = vec3_normalize(lobe_add(wi, wo));
    cos_h = lobe_dot(normal, h);
    return (1 - chance) * cos_i / LOBE_PI +
           chance * brdf_distribution(look->alpha, cos_h) * cos_h / (4 * lobe_dot(wo, h));
}

/* A direction towards light, proportional to the cosine or by a half vector from the GGX distribution. u: uniform. */
static inline vec3 brdf_sample(const finish *look, vec3 normal, vec3 wo, const float u[3]) {
    float a2 = look->alpha * look->alpha, cos2, sin_h, phi = 2 * LOBE_PI * u[1];
    int specular = u[2] < brdf_specular_chance(look);
    vec3 right, up, dir;
    scene_frame(normal, &right, &up);
    cos2 = specular ? (1 - u[0]) / (1 + (a2 - 1) * u[0]) : 1 - u[0];
    sin_h = sqrtf(lobe_max(1 - cos2, 0));
    dir = lobe_add(lobe_scale(normal, sqrtf(cos2)),
                   lobe_add(lobe_scale(right, sin_h * cosf(phi)), lobe_scale(up, sin_h * sinf(phi))));
    return specular ? lobe_sub(lobe_scale(dir, 2 * lobe_dot(wo, dir)), wo) : dir;
}

/* Radiance that the spot light alone makes a surface send towards wo. */
static inline vec3 brdf_lit_by_spot(const scene *world, const surface *hit, vec3 wo) {
    vec3 offset = lobe_sub(world->spot.position, hit->position), wi, light;
    float distance2 = lobe_dot(offset, offset), cos_i;
    wi = lobe_scale(offset, 1 / sqrtf(distance2));
    cos_i = lobe_dot(wi, hit->normal);
    light = spot_intensity(&world->spot, lobe_scale(wi, -1));
    if (cos_i <= 0 || lobe_mean(light) <= 0) return lobe_vector(0, 0, 0);
    if (!scene_visible(world, hit->position, hit->normal, world->spot.position, lobe_vector(0, 0, 0)))
        return lobe_vector(0, 0, 0);
    return lobe_scale(vec3_multiply(light, brdf_value(&hit->look, hit->normal, wi, wo)), cos_i / distance2);
}

#endif
