#include "vsgl_shade.h"
#include "../../asg.h"
#include "fail.h"
#include "hash.h"
#include "parallel.h"
#include "progress.h"
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 256 };

/* A run of texels as planes: the loops over them then become vector code. */
typedef struct {
    float position[3][BLOCK], normal[3][BLOCK], view[3][BLOCK], alpha[BLOCK];
    float x[3][BLOCK], y[3][BLOCK], z[3][BLOCK], sharpness_x[BLOCK], sharpness_y[BLOCK]; /* reflection lobe */
    int texel[BLOCK];
    float depth[BLOCK], visible[BLOCK];          /* of a light's shadow map */
    float diffuse[3][BLOCK], specular[3][BLOCK]; /* sums over lights, per unit of reflectance */
} texel_block;

static void store(float plane[3][BLOCK], int i, vec3 v) {
    plane[0][i] = v.x;
    plane[1][i] = v.y;
    plane[2][i] = v.z;
}

static inline vec3 load(float plane[3][BLOCK], int i) {
    return lobe_vector(plane[0][i], plane[1][i], plane[2][i]);
}

static void fill_block(texel_block *b, const vpl *texels, int count) {
    int i;
    memset(b, 0, sizeof *b);
    for (i = 0; i < BLOCK; i++) b->visible[i] = 1;
    for (i = 0; i < count; i++) {
        const vpl *t = &texels[i];
        asg_lobe reflection;
        if (!(vpl_weight(t) > 0)) continue;
        reflection = asg_ggx_lobe(t->normal, t->view, t->alpha);
        store(b->position, i, t->position);
        store(b->normal, i, t->normal);
        store(b->view, i, t->view);
        b->alpha[i] = t->alpha;
        store(b->x, i, reflection.x);
        store(b->y, i, reflection.y);
        store(b->z, i, reflection.z);
        b->sharpness_x[i] = reflection.sharpness_x;
        b->sharpness_y[i] = reflection.sharpness_y;
    }
}

/* Whether each texel sees the light; what vectorises in a loop of its own. */
static void look_up(texel_block *b, const shadow_map *map) {
    const vec3 light = map->position;
    int i;
    for (i = 0; i < BLOCK; i++)
        b->texel[i] = shadow_map_probe(light, load(b->position, i), load(b->normal, i), &b->depth[i]);
    for (i = 0; i < BLOCK; i++) b->visible[i] = b->depth[i] <= map->distances[b->texel[i]] ? 1.0f : 0.0f;
}

/* Adds one component of one light to every texel of a block. */
static void shade_component(texel_block *b, const vsgl *light, int k) {
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

static void shade_block(const vpl *texels, int count, const vsgl *lights, const shadow_map *maps, int light_count,
                        vec3 *radiance) {
    texel_block block, *b = &block;
    int i, k, light;
    fill_block(b, texels, count);
    for (light = 0; light < light_count; light++) {
        if (maps) look_up(b, &maps[light]);
        for (k = 0; k < 2; k++) {
            if (lobe_mean(lights[light].intensity[k]) > 0) shade_component(b, &lights[light], k);
        }
    }
    for (i = 0; i < count; i++) {
        vec3 none = {0, 0, 0};
        radiance[i] = vpl_weight(&texels[i]) > 0 ? lobe_add(vec3_multiply(load(b->diffuse, i), texels[i].diffuse),
                                                            vec3_multiply(load(b->specular, i), texels[i].specular))
                                                 : none;
    }
}

void vsgl_shadow_maps(const scene *world, const vsgl *lights, int count, shadow_map *maps) {
    progress line = progress_begin("shadow maps", count);
    int i;
    PARALLEL_FOR
    for (i = 0; i < count; i++) {
        shadow_map_render(&maps[i], world, lights[i].position, 0.01f + sqrtf(lights[i].variance));
        progress_step(&line);
    }
    progress_end(&line);
}

void vsgl_shade(const vpl_map *map, const vsgl *lights, const shadow_map *maps, int light_count, vec3 *radiance,
                const char *label) {
    const int texels = map->width * map->height, blocks = (texels + BLOCK - 1) / BLOCK;
    progress line = progress_begin(label, blocks);
    int block;
    PARALLEL_FOR
    for (block = 0; block < blocks; block++) {
        int first = block * BLOCK, count = texels - first < BLOCK ? texels - first : BLOCK;
        shade_block(map->texels + first, count, lights, maps, light_count, radiance + first);
        progress_step(&line);
    }
    progress_end(&line);
}

static unsigned hash(unsigned which, unsigned seed) {
    return hash_mix(which * 0x9E3779B1u + seed * 0x85EBCA77u);
}

/* 0 .. count - 1 in an order that the seed draws */
static void shuffle(int *order, int count, unsigned seed) {
    int i;
    for (i = 0; i < count; i++) {
        const int other = (int)(hash((unsigned)i, seed) % (unsigned)(i + 1));
        order[i] = order[other];
        order[other] = i;
    }
}

void vsgl_shade_interleaved(const vpl_map *map, const vsgl *lights, int light_count, int side, unsigned seed,
                            vec3 *radiance, const char *label) {
    const int subsets = side * side, width = (map->width + side - 1) / side, height = (map->height + side - 1) / side;
    const size_t texels = (size_t)width * (size_t)height;
    vec3 *shaded = (vec3 *)allocate("interleaved texels", texels, sizeof *shaded);
    vsgl *subset = (vsgl *)allocate("interleaved lights", (size_t)light_count, sizeof *subset);
    int *order = (int *)allocate("interleaved lights", (size_t)subsets, sizeof *order);
    vpl_map part = *map;
    int which, i, x, y;
    part.texels = (vpl *)allocate("interleaved texels", texels, sizeof *part.texels);
    shuffle(order, subsets, seed);
    for (which = 0; which < subsets; which++) {
        const int left = which % side, top = which / side;
        int count = 0;
        for (i = order[which]; i < light_count; i += subsets) subset[count++] = lights[i];
        part.width = (map->width - left + side - 1) / side;
        part.height = (map->height - top + side - 1) / side;
        for (y = 0; y < part.height; y++) {
            const vpl *row = map->texels + (y * side + top) * map->width + left;
            for (x = 0; x < part.width; x++) part.texels[y * part.width + x] = row[x * side];
        }
        vsgl_shade(&part, subset, NULL, count, shaded, label);
        for (y = 0; y < part.height; y++) {
            vec3 *row = radiance + (y * side + top) * map->width + left;
            for (x = 0; x < part.width; x++)
                row[x * side] = lobe_scale(shaded[y * part.width + x], (float)light_count / (float)(count ? count : 1));
        }
    }
    free(part.texels);
    free(shaded);
    free(subset);
    free(order);
}
