/*
 vsgl.c - one-bounce glossy indirect light from virtual spherical Gaussian lights

 The pipeline of Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual Spherical Gaussian Lights: a
 reflective shadow map, its moments and PDF as pyramids, filtered importance sampling of clusters, a virtual SG light
 for each, a small shadow map for each, and closed-form shading. Krivanek and Colbert's mip level (density) and the
 paper's (bisection) are compared with path tracing.
*/
#include "../asg.h"
#include "../fis.h"
#include "common/brdf.h"
#include "common/buffers.h"
#include "common/fail.h"
#include "common/file.h"
#include "common/image.h"
#include "common/options.h"
#include "common/parallel.h"
#include "common/path_trace.h"
#include "common/progress.h"
#include "common/shadow_map.h"
#include <stdio.h>
#include <stdlib.h>

enum { RSM_SIZE = 512, CHANNELS = sizeof(vsgl_moments) / sizeof(float), BISECTIONS = 12, REPEATS = 5 };

const char *const program_name = "vsgl";

typedef enum { RULE_DENSITY, RULE_BISECTION, RULES } level_rule;
static const char *const rule_names[RULES] = {"density", "bisection"};

/* ---- the stages, in the paper's order ---- */

/* The moments of each RSM texel, one virtual point light, and the PDF: reflected flux. */
static void find_moments(const scene *world, const buffer *rsm, vsgl_moments *moments, float *density) {
    int row;
    PARALLEL_FOR
    for (row = 0; row < rsm->height; row++) {
        int column;
        for (column = 0; column < rsm->width; column++) {
            const int i = row * rsm->width + column;
            const texel *t = &rsm->texels[i];
            vec3 none = {0, 0, 0}, diffuse, specular;
            diffuse = t->valid ? vec3_multiply(t->flux, t->hit.look.diffuse) : none;
            specular = t->valid ? vec3_multiply(t->flux, t->hit.look.specular) : none;
            density[i] = lobe_mean(diffuse) + lobe_mean(specular);
            if (density[i] > 0)
                moments[i] = vsgl_moments_from_vpl(lobe_sub(t->hit.position, world->center), t->hit.normal, t->view,
                                                   diffuse, specular, t->hit.look.alpha);
            else
                memset(&moments[i], 0, sizeof moments[i]);
        }
    }
}

/* One light for each filtered sample. */
static void sample_lights(const scene *world, const fis_pyramid *moments, const fis_pyramid *pdf, level_rule rule,
                          int count, unsigned seed, vsgl *lights) {
    const float shift_u = (float)(seed * 0x9E3779B1u >> 8) / 16777216.0f;
    const float shift_v = (float)(seed * 0x85EBCA77u >> 8) / 16777216.0f;
    int i;
    for (i = 0; i < count; i++) {
        fis_point point = fis_lattice(i, count);
        fis_sample where;
        vsgl_moments cluster;
        float level, scale;
        point.u = point.u + shift_u < 1 ? point.u + shift_u : point.u + shift_u - 1;
        point.v = point.v + shift_v < 1 ? point.v + shift_v : point.v + shift_v - 1;
        where = fis_warp(pdf, point);
        if (rule == RULE_DENSITY) {
            level = fis_level_density(pdf, &where, count, 1);
            scale = fis_scale_density(pdf, &where, count);
        } else {
            level = fis_level_bisect(pdf, &where, count, 1, BISECTIONS);
            scale = fis_scale(pdf, &where, level, count);
        }
        fis_fetch(moments, where.u, where.v, level, (float *)&cluster);
        lights[i] = vsgl_from_moments(vsgl_moments_scale(cluster, scale), world->center);
    }
}

/* A shadow map at the mean of each light. Its own extent does not shade it. */
static void find_visibility(const scene *world, const vsgl *lights, int count, shadow_map *maps) {
    progress line = progress_begin("shadow maps", count);
    int i;
    PARALLEL_FOR
    for (i = 0; i < count; i++) {
        shadow_map_render(&maps[i], world, lights[i].position, 0.01f + sqrtf(lights[i].variance));
        progress_step(&line);
    }
    progress_end(&line);
}

enum { BLOCK = 256 };

/* A run of pixels as planes: the loops over them then become vector code. */
typedef struct {
    float position[3][BLOCK], normal[3][BLOCK], view[3][BLOCK], alpha[BLOCK];
    float x[3][BLOCK], y[3][BLOCK], z[3][BLOCK], sharpness_x[BLOCK], sharpness_y[BLOCK]; /* reflection lobe */
    int texel[BLOCK];
    float depth[BLOCK], visible[BLOCK];          /* of a light's shadow map */
    float diffuse[3][BLOCK], specular[3][BLOCK]; /* sums over lights, per unit of reflectance */
} pixel_block;

static void store(float plane[3][BLOCK], int i, vec3 v) {
    plane[0][i] = v.x;
    plane[1][i] = v.y;
    plane[2][i] = v.z;
}

static inline vec3 load(float plane[3][BLOCK], int i) {
    return lobe_vector(plane[0][i], plane[1][i], plane[2][i]);
}

static void fill_block(pixel_block *b, const texel *pixels, int count) {
    int i;
    memset(b, 0, sizeof *b);
    for (i = 0; i < count; i++) {
        const surface *hit = &pixels[i].hit;
        asg_lobe reflection = asg_ggx_lobe(hit->normal, pixels[i].view, hit->look.alpha);
        if (!pixels[i].valid) continue;
        store(b->position, i, hit->position);
        store(b->normal, i, hit->normal);
        store(b->view, i, pixels[i].view);
        b->alpha[i] = hit->look.alpha;
        store(b->x, i, reflection.x);
        store(b->y, i, reflection.y);
        store(b->z, i, reflection.z);
        b->sharpness_x[i] = reflection.sharpness_x;
        b->sharpness_y[i] = reflection.sharpness_y;
    }
}

/* Whether each pixel sees the light; what vectorises in a loop of its own. */
static void look_up(pixel_block *b, const shadow_map *map) {
    const vec3 light = map->position;
    int i;
    for (i = 0; i < BLOCK; i++)
        b->texel[i] = shadow_map_probe(light, load(b->position, i), load(b->normal, i), &b->depth[i]);
    for (i = 0; i < BLOCK; i++) b->visible[i] = b->depth[i] <= map->distances[b->texel[i]] ? 1.0f : 0.0f;
}

/* Adds one component of one light to every pixel of a block. */
static void shade_component(pixel_block *b, const vsgl *light, int k) {
    const vsgl v = *light;
    const vec3 intensity = v.intensity[k];
    int i;
    for (i = 0; i < BLOCK; i++) {
        vec3 position = load(b->position, i), normal = load(b->normal, i);
        asg_lobe reflection;
        float diffuse, specular;
        reflection.x = load(b->x, i);
        reflection.y = load(b->y, i);
        reflection.z = load(b->z, i);
        reflection.sharpness_x = b->sharpness_x[i];
        reflection.sharpness_y = b->sharpness_y[i];
        reflection.log_amplitude = 0;
        diffuse = b->visible[i] * vsgl_diffuse(v, k, position, normal);
        specular = b->visible[i] * asg_vsgl_specular(v, k, position, normal, load(b->view, i), b->alpha[i], reflection);
        b->diffuse[0][i] += diffuse * intensity.x;
        b->diffuse[1][i] += diffuse * intensity.y;
        b->diffuse[2][i] += diffuse * intensity.z;
        b->specular[0][i] += specular * intensity.x;
        b->specular[1][i] += specular * intensity.y;
        b->specular[2][i] += specular * intensity.z;
    }
}

static void shade_block(const texel *pixels, int count, const vsgl *lights, const shadow_map *maps, int light_count,
                        vec3 *radiance) {
    pixel_block block, *b = &block;
    int i, k, light;
    fill_block(b, pixels, count);
    for (light = 0; light < light_count; light++) {
        look_up(b, &maps[light]);
        for (k = 0; k < 2; k++) {
            if (lobe_mean(lights[light].intensity[k]) > 0) shade_component(b, &lights[light], k);
        }
    }
    for (i = 0; i < count; i++) {
        const finish *look = &pixels[i].hit.look;
        vec3 none = {0, 0, 0};
        radiance[i] = pixels[i].valid ? lobe_add(vec3_multiply(load(b->diffuse, i), look->diffuse),
                                                 vec3_multiply(load(b->specular, i), look->specular))
                                      : none;
    }
}

/* Indirect radiance of every camera pixel. */
static void shade(const buffer *view, const vsgl *lights, const shadow_map *maps, int light_count, image *indirect,
                  const char *label) {
    const int pixels = view->width * view->height, blocks = (pixels + BLOCK - 1) / BLOCK;
    progress line = progress_begin(label, blocks);
    int block;
    PARALLEL_FOR
    for (block = 0; block < blocks; block++) {
        int first = block * BLOCK, count = pixels - first < BLOCK ? pixels - first : BLOCK;
        shade_block(view->texels + first, count, lights, maps, light_count, indirect->pixels + first);
        progress_step(&line);
    }
    progress_end(&line);
}

/* ---- what surrounds the pipeline ---- */

static void light_directly(const scene *world, const buffer *view, image *direct) {
    progress line = progress_begin("direct light", view->height);
    int row;
    PARALLEL_FOR
    for (row = 0; row < view->height; row++) {
        int i;
        for (i = row * view->width; i < (row + 1) * view->width; i++) {
            const texel *t = &view->texels[i];
            if (t->valid) direct->pixels[i] = brdf_lit_by_spot(world, &t->hit, t->view);
        }
        progress_step(&line);
    }
    progress_end(&line);
}

static double total_flux(const vsgl *lights, int count) {
    double sum = 0;
    int i, k;
    for (i = 0; i < count; i++) {
        for (k = 0; k < 2; k++)
            sum += (double)lobe_mean(lights[i].intensity[k]) * (double)sg_integral(lights[i].emission[k].sharpness);
    }
    return sum;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *times) {
    qsort(times, REPEATS, sizeof *times, ascending);
    return times[REPEATS / 2];
}

enum { PICTURE_DIRECT, PICTURE_RESULT, PICTURE_REFERENCE, PICTURE_DIFFERENCE, PICTURE_ALL, PICTURES };
static const char *const picture_names[PICTURES] = {"-direct.png", "-result.png", "-reference.png", "-difference.png",
                                                    ".png"};

static void check_paths(const char *prefix) {
    char path[1024];
    int i;
    for (i = 0; i < PICTURES; i++) {
        const char *wrong = "name too long";
        if (snprintf(path, sizeof path, "%s%s", prefix, picture_names[i]) < (int)sizeof path) wrong = file_check(path);
        if (wrong) give_up(path, wrong);
    }
}

static void write_pictures(const char *prefix, const image *direct, const image *indirect, const image *reference) {
    const float exposure = 2.2f;
    const int width = direct->width, height = direct->height, count = width * height;
    progress line = progress_begin("pictures", PICTURES);
    image pictures[PICTURES];
    char path[1024];
    int i;
    for (i = 0; i < PICTURE_ALL; i++) pictures[i] = image_create(width, height);
    pictures[PICTURE_ALL] = image_create(2 * width, 2 * height);
    for (i = 0; i < PICTURES; i++) {
        if (!pictures[i].pixels) give_up("images", "not enough memory");
    }
    for (i = 0; i < count; i++) {
        vec3 result = lobe_add(direct->pixels[i], indirect->pixels[i]);
        vec3 wanted = lobe_add(direct->pixels[i], reference->pixels[i]), d = lobe_sub(result, wanted);
        pictures[PICTURE_DIRECT].pixels[i] = direct->pixels[i];
        pictures[PICTURE_RESULT].pixels[i] = result;
        pictures[PICTURE_REFERENCE].pixels[i] = wanted;
        pictures[PICTURE_DIFFERENCE].pixels[i] = lobe_vector(fabsf(d.x), fabsf(d.y), fabsf(d.z));
    }
    for (i = 0; i < PICTURE_ALL; i++) image_paste(&pictures[PICTURE_ALL], &pictures[i], i % 2 * width, i / 2 * height);
    for (i = 0; i < PICTURES; i++) {
        const char *wrong;
        snprintf(path, sizeof path, "%s%s", prefix, picture_names[i]);
        wrong = image_write_png(path, &pictures[i], exposure);
        if (wrong) give_up(path, wrong);
        image_free(&pictures[i]);
        progress_step(&line);
    }
    progress_end(&line);
    printf("wrote %s.png: direct, direct + indirect, reference, difference; and each alone\n", prefix);
}

/* What the RSM gives, once for any number of lights, and the milliseconds it took. */
typedef struct {
    float *memory[2];
    fis_pyramid moments, pdf;
    double flux, moments_ms, pyramid_ms;
} lit_scene;

static lit_scene prepare(const scene *world, const buffer *rsm) {
    lit_scene lit;
    vsgl_moments *moments = (vsgl_moments *)allocate("scene", (size_t)RSM_SIZE * RSM_SIZE, sizeof *moments);
    float *density = (float *)allocate("scene", (size_t)RSM_SIZE * RSM_SIZE, sizeof *density);
    double moments_ms[REPEATS], pyramid_ms[REPEATS];
    int i;
    lit.memory[0] = (float *)allocate("scene", fis_pyramid_size(RSM_SIZE, RSM_SIZE, CHANNELS), sizeof(float));
    lit.memory[1] = (float *)allocate("scene", fis_pyramid_size(RSM_SIZE, RSM_SIZE, 1), sizeof(float));
    for (i = 0; i < REPEATS; i++) {
        double started = progress_clock();
        find_moments(world, rsm, moments, density);
        moments_ms[i] = progress_clock() - started;
        started = progress_clock();
        lit.moments = fis_build(lit.memory[0], (const float *)moments, RSM_SIZE, RSM_SIZE, CHANNELS);
        lit.pdf = fis_build_pdf(lit.memory[1], density, RSM_SIZE, RSM_SIZE);
        pyramid_ms[i] = progress_clock() - started;
    }
    lit.moments_ms = median(moments_ms);
    lit.pyramid_ms = median(pyramid_ms);
    lit.flux = 0;
    for (i = 0; i < RSM_SIZE * RSM_SIZE; i++) lit.flux += (double)density[i];
    free(moments);
    free(density);
    return lit;
}

/* Renders with one rule and one number of lights, and prints the row that says how fast and how well. */
static void render(const scene *world, const buffer *view, const lit_scene *lit, level_rule rule, int count,
                   unsigned seed, const image *reference, image *indirect) {
    vsgl *lights = (vsgl *)allocate("scene", (size_t)count, sizeof *lights);
    shadow_map *maps = (shadow_map *)allocate("scene", (size_t)count, sizeof *maps);
    double sampling_ms[REPEATS], sampling, visibility, shading, started;
    char label[64];
    int i;
    for (i = 0; i < REPEATS; i++) {
        started = progress_clock();
        sample_lights(world, &lit->moments, &lit->pdf, rule, count, seed, lights);
        sampling_ms[i] = progress_clock() - started;
    }
    sampling = median(sampling_ms);
    started = progress_clock();
    find_visibility(world, lights, count, maps);
    visibility = progress_clock() - started;
    started = progress_clock();
    snprintf(label, sizeof label, "%d lights, %s", count, rule_names[rule]);
    shade(view, lights, maps, count, indirect, label);
    shading = progress_clock() - started;
    printf("%6d %-9s %7.2f %7.2f %8.3f %10.1f %8.1f %8.1f %8.5f   %6.4f   %.6f\n", count, rule_names[rule],
           lit->moments_ms, lit->pyramid_ms, sampling, visibility, shading,
           lit->moments_ms + lit->pyramid_ms + sampling + visibility + shading, image_rmse(indirect, reference),
           image_relative_error(indirect, reference), total_flux(lights, count) / lit->flux);
    fflush(stdout);
    free(lights);
    free(maps);
}

typedef struct {
    option_size size;
    option_list lights;
    int seed, samples;
    const char *out;
} settings;

/* Indirect light by path tracing, in two halves whose difference tells the noise. */
static void trace_reference(const scene *world, const buffer *view, const settings *o, image *reference, image *half) {
    const double started = progress_clock();
    double noise;
    int i;
    if (!path_trace_indirect(world, view, o->samples / 2, 2 * (unsigned)o->seed, reference->pixels,
                             "reference, first half") ||
        !path_trace_indirect(world, view, o->samples / 2, 2 * (unsigned)o->seed + 1, half->pixels,
                             "reference, second half"))
        give_up("reference", "not enough memory");
    noise = image_rmse(reference, half) / 2;
    for (i = 0; i < view->width * view->height; i++)
        reference->pixels[i] = lobe_scale(lobe_add(reference->pixels[i], half->pixels[i]), 0.5f);
    printf("reference: %d paths a pixel, %.0f ms, its own noise has an RMSE of about %.2g\n", o->samples / 2 * 2,
           progress_clock() - started, noise);
    fflush(stdout);
}

int main(int argc, char **argv) {
    settings o = {{400, 300}, {4, {64, 256, 1024, 4096}}, 0, 512, "build/vsgl"};
    const option options[] = {
        OPTION_OF_SIZE(&o.size),
        {"--lights N,...", OPTION_LIST, &o.lights, 1, 65536, "numbers of lights to try", 0},
        {"--samples N", OPTION_WHOLE, &o.samples, 2, 1000000, "samples per pixel of the reference", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    const scene world = scene_room();
    buffer view, rsm;
    image direct, reference, indirect, best;
    lit_scene lit;
    int i, rule, most = 0;

    options_read(options, argc, argv,
                 "Renders one-bounce glossy indirect light with virtual spherical Gaussian lights\n"
                 "and prints its speed against its error, for two rules of filtered sampling.");
    check_paths(o.out);
    view = buffer_camera(&world, o.size.width, o.size.height);
    rsm = buffer_rsm(&world, RSM_SIZE);
    direct = image_create(o.size.width, o.size.height);
    reference = image_create(o.size.width, o.size.height);
    indirect = image_create(o.size.width, o.size.height);
    best = image_create(o.size.width, o.size.height);
    if (!view.texels || !rsm.texels || !direct.pixels || !reference.pixels || !indirect.pixels || !best.pixels)
        give_up("images", "not enough memory");

    light_directly(&world, &view, &direct);
    trace_reference(&world, &view, &o, &reference, &indirect);
    lit = prepare(&world, &rsm);
    printf("%dx%d pixels, RSM %dx%d that reflects %.3f W, times in ms\n\n", o.size.width, o.size.height, RSM_SIZE,
           RSM_SIZE, lit.flux);
    printf("lights rule      moments pyramid sampling visibility  shading    total     RMSE relative  light/RSM\n");
    for (i = 0; i < o.lights.count; i++) {
        for (rule = 0; rule < RULES; rule++) {
            render(&world, &view, &lit, (level_rule)rule, o.lights.value[i], (unsigned)o.seed, &reference, &indirect);
            if (rule == RULE_BISECTION && o.lights.value[i] >= most) {
                most = o.lights.value[i];
                image_paste(&best, &indirect, 0, 0);
            }
        }
    }
    printf("\n");
    write_pictures(o.out, &direct, &best, &reference);

    free(lit.memory[0]);
    free(lit.memory[1]);
    image_free(&direct);
    image_free(&reference);
    image_free(&indirect);
    image_free(&best);
    buffer_free(&view);
    buffer_free(&rsm);
    return 0;
}
