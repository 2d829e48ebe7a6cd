#include "path_trace.h"
#include "brdf.h"
#include "hash.h"
#include "parallel.h"
#include "progress.h"
#include <stdlib.h>

/* A coarse RSM's texels by reflected flux: running sums for sampling. It guides the light's rays, no more. */
enum { GUIDE_SIZE = 128 };
typedef struct {
    double *sums;
    buffer rsm;
} guide;

static double reflected_flux(const texel *t) {
    return t->valid
               ? (double)lobe_mean(t->flux) * (double)lobe_mean(lobe_add(t->hit.look.diffuse, t->hit.look.specular))
               : 0;
}

static void guide_free(guide *g) {
    free(g->sums);
    buffer_free(&g->rsm);
}

/* Null sums when memory is short. */
static guide guide_build(const scene *world) {
    guide g;
    int i;
    double sum = 0;
    g.rsm = buffer_rsm(world, GUIDE_SIZE);
    g.sums = (double *)malloc(GUIDE_SIZE * GUIDE_SIZE * sizeof *g.sums);
    if (!g.rsm.texels || !g.sums) {
        guide_free(&g);
        g.sums = NULL;
    } else {
        for (i = 0; i < GUIDE_SIZE * GUIDE_SIZE; i++) g.sums[i] = sum += reflected_flux(&g.rsm.texels[i]);
    }
    return g;
}

/* The texel where the running sum passes the share u of the total. */
static int guide_find(const guide *g, double u) {
    int low = 0, high = GUIDE_SIZE * GUIDE_SIZE - 1;
    double wanted = u * g->sums[high];
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (g->sums[middle] > wanted)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* Density per unit image area, the image being the unit square. */
static double guide_density(const guide *g, int index) {
    const int count = GUIDE_SIZE * GUIDE_SIZE;
    return reflected_flux(&g->rsm.texels[index]) / g->sums[count - 1] * count;
}

/* Points of a low-discrepancy sequence in five dimensions (Roberts 2018), shifted by a random amount per pixel. */
enum { DIMENSIONS = 5 };
static const double steps[DIMENSIONS] = {0.8812714616335696, 0.7766393890897682, 0.6844301295853426, 0.6031687406857282,
                                         0.5315553977157913};

static double hash(unsigned pixel, unsigned dimension, unsigned seed) {
    return (double)hash_mix(pixel * 0x9E3779B1u + dimension * 0x85EBCA77u + seed * 0xC2B2AE3Du) / 4294967296.0;
}

/* Solid angle at the light over solid angle at the pixel, for a small patch around a hit that wi points to. */
static double light_spread(const scene *world, const surface *point, const surface *hit, vec3 wi) {
    vec3 to_light = lobe_sub(world->spot.position, hit->position), offset = lobe_sub(hit->position, point->position);
    float distance2 = lobe_dot(to_light, to_light), cos_light = lobe_dot(to_light, hit->normal) / sqrtf(distance2);
    float cos_point = -lobe_dot(wi, hit->normal);
    if (cos_light <= 0 || cos_point <= 0) return 0;
    return (double)(cos_light / distance2) * (double)(lobe_dot(offset, offset) / cos_point);
}

/* Density, per solid angle at the light, of the light's ray to a point. */
static double light_density(const scene *world, const guide *g, vec3 position) {
    vec3 dir = vec3_normalize(lobe_sub(position, world->spot.position));
    float solid_angle, u, v;
    if (!spot_project(&world->spot, dir, &u, &v)) return 0;
    spot_direction(&world->spot, u, v, &solid_angle);
    return guide_density(g, (int)(v * GUIDE_SIZE) * GUIDE_SIZE + (int)(u * GUIDE_SIZE)) / (double)solid_angle;
}

/* A ray from the pixel, chosen by its BRDF. */
static vec3 sample_brdf(const scene *world, const guide *g, const texel *pixel, const float u[3]) {
    const surface *point = &pixel->hit;
    vec3 wi = brdf_sample(&point->look, point->normal, pixel->view, u), radiance, none = {0, 0, 0};
    float cos_i = lobe_dot(wi, point->normal);
    double density;
    surface hit;
    if (cos_i <= 0) return none;
    if (!scene_trace(world, lobe_add(point->position, lobe_scale(point->normal, 1e-4f)), wi, &hit)) return none;
    radiance = brdf_lit_by_spot(world, &hit, lobe_scale(wi, -1));
    if (lobe_mean(radiance) <= 0) return none;
    density = (double)brdf_density(&point->look, point->normal, pixel->view, wi) +
              light_density(world, g, hit.position) * light_spread(world, point, &hit, wi);
    return lobe_scale(vec3_multiply(radiance, brdf_value(&point->look, point->normal, wi, pixel->view)),
                      (float)((double)cos_i / density));
}

/* A ray from the light, joined to the pixel. */
static vec3 sample_light(const scene *world, const guide *g, const texel *pixel, double u, float jitter_x,
                         float jitter_y) {
    const surface *point = &pixel->hit;
    const int index = guide_find(g, u);
    vec3 dir, offset, wi, power, none = {0, 0, 0};
    float solid_angle, distance2, cos_point, cos_hit;
    double density, spread;
    surface hit;
    dir = spot_direction(&world->spot, ((float)(index % GUIDE_SIZE) + jitter_x) / GUIDE_SIZE,
                         ((float)(index / GUIDE_SIZE) + jitter_y) / GUIDE_SIZE, &solid_angle);
    if (!scene_trace(world, world->spot.position, dir, &hit)) return none;
    offset = lobe_sub(hit.position, point->position);
    distance2 = lobe_dot(offset, offset);
    wi = lobe_scale(offset, 1 / sqrtf(lobe_max(distance2, LOBE_TINY)));
    cos_point = lobe_dot(wi, point->normal);
    cos_hit = -lobe_dot(wi, hit.normal);
    if (cos_point <= 0 || cos_hit <= 0) return none;
    if (!scene_visible(world, point->position, point->normal, hit.position, hit.normal)) return none;
    power = vec3_multiply(spot_intensity(&world->spot, dir),
                          brdf_value(&hit.look, hit.normal, lobe_scale(dir, -1), lobe_scale(wi, -1)));
    power = vec3_multiply(power, brdf_value(&point->look, point->normal, wi, pixel->view));
    /* The balance heuristic in the light's measure: the other density is brought there by the ratio of the measures. */
    spread = light_spread(world, point, &hit, wi);
    density = (double)brdf_density(&point->look, point->normal, pixel->view, wi) +
              guide_density(g, index) / (double)solid_angle * spread;
    return lobe_scale(power, (float)((double)(cos_point * cos_hit / distance2) * spread / density));
}

int path_trace_indirect(const scene *world, const buffer *view, int samples, unsigned seed, vec3 *image,
                        const char *label) {
    guide g = guide_build(world);
    progress line = progress_begin(label, view->height);
    int row;
    if (!g.sums) return 0;
    PARALLEL_FOR
    for (row = 0; row < view->height; row++) {
        int column, i, k;
        for (column = 0; column < view->width; column++) {
            const int index = row * view->width + column;
            const texel *pixel = &view->texels[index];
            vec3 sum = {0, 0, 0};
            double shift[DIMENSIONS];
            if (pixel->valid) {
                for (k = 0; k < DIMENSIONS; k++) shift[k] = hash((unsigned)index, (unsigned)k, seed);
                for (i = 0; i < samples; i++) {
                    double u[DIMENSIONS];
                    float v[3];
                    for (k = 0; k < DIMENSIONS; k++) {
                        u[k] = shift[k] + i * steps[k];
                        u[k] -= floor(u[k]);
                    }
                    for (k = 0; k < 3; k++) v[k] = (float)u[k];
                    sum = lobe_add(sum, sample_brdf(world, &g, pixel, v));
                    sum = lobe_add(sum, sample_light(world, &g, pixel, u[3], (float)u[4], (float)u[0]));
                }
            }
            image[index] = lobe_scale(sum, 1 / (float)samples);
        }
        progress_step(&line);
    }
    progress_end(&line);
    guide_free(&g);
    return 1;
}
