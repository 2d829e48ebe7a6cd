/*
 light_culling.c - one-bounce glossy caustics from 65,536 virtual point lights, culled at random without bias

 The pipeline of Tokuyoshi and Harada 2017, Stochastic Light Culling for VPLs on GGX Microsurfaces: a reflective shadow
 map, a virtual point light (VPL) from each texel, diffuse and glossy; a random range for each and a volume around it;
 8 x 8 interleaved sampling; tiles of 16 x 16 pixels with two depth clusters, for which lights are culled; shading; a
 cross bilateral filter. The paper's volume and the library's tighter one are compared with two bounding spheres, and
 all with the sum over all lights. As in the paper lights have no shadows, which would hide what culling costs.
*/
#include "../ggx_bound.h"
#include "common/brdf.h"
#include "common/buffers.h"
#include "common/csv.h"
#include "common/fail.h"
#include "common/hash.h"
#include "common/image.h"
#include "common/options.h"
#include "common/output.h"
#include "common/parallel.h"
#include "common/progress.h"
#include <stdio.h>
#include <stdlib.h>

enum {
    RSM_SIZE = 256,
    INTERLEAVE = 8,
    SUBSETS = INTERLEAVE * INTERLEAVE,
    SUBSET_LIGHTS = RSM_SIZE * RSM_SIZE / SUBSETS,
    TILE_PIXELS = 16 * 16, /* of the largest tile */
    REFERENCE_STEP = 7,    /* the sum over all lights is taken at every 7th pixel of every 7th row: of all subsets */
    FILTER_RADIUS = 8,
    REPEATS = 5,   /* of timings, at most, */
    LIMIT_MS = 500 /* in so much time */
};

const char *const program_name = "light_culling";

/* No light is nearer than this to what it shines on, in metres: else its square would make single pixels glare. */
#define EXTENT 0.03f

typedef enum { DIFFUSE, GLOSSY, KINDS } light_kind;
typedef enum { AT_LIGHT, ENCLOSING, SPHEROID, ELLIPSOID, SPHEROID_CLOSE, ELLIPSOID_CLOSE, VOLUMES } volume;
static const char *const volume_names[VOLUMES] = {"sphere at the VPL", "enclosing sphere", "spheroid",
                                                  "ellipsoid",         "spheroid, closer", "ellipsoid, closer"};
enum { ALPHAS = 4, SCENES = 2 };
static const float alphas[ALPHAS] = {0.4f, 0.2f, 0.1f, 0.05f};
static const char *const scene_names[SCENES] = {"ring", "colonnade"};
static const char *const scene_choices[] = {"all", "ring", "colonnade", NULL};

/* ---- virtual point lights ---- */

/* One component of a VPL. Its radiant intensity is flux times ggx_brdf_cos, or times max(cos, 0) / pi. */
typedef struct {
    vec3 position, normal, wi;
    vec3 colour; /* of the largest channel 1 */
    float flux, alpha, xi;
} vpl;

/* The lights of each subset, one after the other; only those that shine. */
typedef struct {
    vpl *lights;
    int first[SUBSETS + 1];
} light_list;

static unsigned hash(unsigned x, unsigned seed) {
    return hash_mix(x * 0x9E3779B1u + seed * 0xC2B2AE3Du);
}

static void add_light(light_list *list, int *count, const texel *t, vec3 reflectance, unsigned bits) {
    vpl *light = &list->lights[*count];
    vec3 flux = lobe_scale(vec3_multiply(t->flux, reflectance), (float)SUBSETS); /* one stands for one in each subset */
    light->flux = lobe_max(flux.x, lobe_max(flux.y, flux.z));
    if (!(light->flux > 0)) return;
    light->position = t->hit.position;
    light->normal = t->hit.normal;
    light->wi = t->view;
    light->colour = lobe_scale(flux, 1 / light->flux);
    light->alpha = t->hit.look.alpha;
    light->xi = ggx_xi(bits);
    ++*count;
}

/* Every 8th texel of every 8th row makes a subset. The edges of the RSM are multiples of 8, RSM_SIZE at most. */
static void make_lights(const buffer *rsm, unsigned seed, light_list lists[KINDS]) {
    const int side = rsm->width / INTERLEAVE;
    int kind, subset, i;
    for (kind = 0; kind < KINDS; kind++) {
        light_list *list = &lists[kind];
        int count = 0;
        list->lights = (vpl *)allocate("scene", (size_t)(rsm->width * rsm->height), sizeof *list->lights);
        for (subset = 0; subset < SUBSETS; subset++) {
            list->first[subset] = count;
            for (i = 0; i < side * side; i++) {
                int row = i / side * INTERLEAVE + subset / INTERLEAVE;
                int column = i % side * INTERLEAVE + subset % INTERLEAVE, index = row * rsm->width + column;
                const texel *t = &rsm->texels[index];
                if (t->valid)
                    add_light(list, &count, t, kind == DIFFUSE ? t->hit.look.diffuse : t->hit.look.specular,
                              hash((unsigned)(2 * index + kind), seed));
            }
        }
        list->first[SUBSETS] = count;
    }
}

/* ---- tiles ---- */

/* Pixels of one subset in a square, the nearer depth cluster first. Planes of numbers: the loops become vector code. */
typedef struct {
    int pixel[TILE_PIXELS], count, split, subset;
    float position[3][TILE_PIXELS], normal[3][TILE_PIXELS];
    float sum[3][TILE_PIXELS];                                             /* irradiance */
    float shaded[TILE_PIXELS], inside[TILE_PIXELS], accepted[TILE_PIXELS]; /* glossy lights */
    ggx_tile frustum;
    float near_depth[2], far_depth[2];
    vec3 box_low[2], box_high[2]; /* of each cluster's pixels, in the scene's axes */
} tile;

typedef struct {
    vec3 eye, rows[3]; /* right, up, forward */
} view_frame;

static view_frame view_of(const scene *world) {
    view_frame f;
    f.eye = world->eye.position;
    f.rows[2] = vec3_normalize(lobe_sub(world->eye.target, world->eye.position));
    scene_frame(f.rows[2], &f.rows[0], &f.rows[1]);
    return f;
}

static vec3 to_view(const view_frame *f, vec3 p) {
    vec3 d = lobe_sub(p, f->eye);
    return lobe_vector(lobe_dot(f->rows[0], d), lobe_dot(f->rows[1], d), lobe_dot(f->rows[2], d));
}

static void put_pixel(tile *t, const buffer *view, int index) {
    const surface *hit = &view->texels[index].hit;
    const int i = t->count++;
    t->pixel[i] = index;
    t->position[0][i] = hit->position.x;
    t->position[1][i] = hit->position.y;
    t->position[2][i] = hit->position.z;
    t->normal[0][i] = hit->normal.x;
    t->normal[1][i] = hit->normal.y;
    t->normal[2][i] = hit->normal.z;
}

static vec3 lower(vec3 a, vec3 b) {
    return lobe_vector(lobe_min(a.x, b.x), lobe_min(a.y, b.y), lobe_min(a.z, b.z));
}

static vec3 higher(vec3 a, vec3 b) {
    return lobe_vector(lobe_max(a.x, b.x), lobe_max(a.y, b.y), lobe_max(a.z, b.z));
}

/* Puts the pixels of a square of a subset into a tile: first those before the middle of its depths, then the rest. */
static void fill_tile(tile *t, const buffer *view, const view_frame *frame, int subset, int left, int top, int edge) {
    float low = SCENE_FAR, high = 0, middle;
    int pass, x, y;
    t->subset = subset;
    t->near_depth[0] = t->far_depth[0] = SCENE_FAR;
    t->box_low[0] = t->box_low[1] = lobe_vector(SCENE_FAR, SCENE_FAR, SCENE_FAR);
    t->box_high[0] = t->box_high[1] = lobe_vector(-SCENE_FAR, -SCENE_FAR, -SCENE_FAR);
    t->frustum.left = t->frustum.bottom = SCENE_FAR;
    t->frustum.right = t->frustum.top = -SCENE_FAR;
    for (pass = 0; pass < 3; pass++) {
        middle = 0.5f * (low + high);
        for (y = top; y < top + edge; y++) {
            for (x = left; x < left + edge; x++) {
                int column = x * INTERLEAVE + subset % INTERLEAVE, row = y * INTERLEAVE + subset / INTERLEAVE;
                const texel *pixel = &view->texels[row * view->width + column];
                vec3 p;
                float *depth;
                if (column >= view->width || row >= view->height || !pixel->valid) continue;
                p = to_view(frame, pixel->hit.position);
                if (pass == 0) { /* what the tile spans */
                    low = lobe_min(low, p.z);
                    high = lobe_max(high, p.z);
                    t->frustum.left = lobe_min(t->frustum.left, p.x / p.z - 1e-6f);
                    t->frustum.right = lobe_max(t->frustum.right, p.x / p.z + 1e-6f);
                    t->frustum.bottom = lobe_min(t->frustum.bottom, p.y / p.z - 1e-6f);
                    t->frustum.top = lobe_max(t->frustum.top, p.y / p.z + 1e-6f);
                } else if ((p.z > middle) == (pass == 2)) {
                    depth = pass == 1 ? t->near_depth : t->far_depth;
                    depth[0] = lobe_min(depth[0], p.z * 0.999999f);
                    depth[1] = lobe_max(depth[1], p.z * 1.000001f);
                    t->box_low[pass - 1] = lower(t->box_low[pass - 1], pixel->hit.position);
                    t->box_high[pass - 1] = higher(t->box_high[pass - 1], pixel->hit.position);
                    put_pixel(t, view, row * view->width + column);
                }
            }
        }
        if (pass == 1) t->split = t->count;
    }
}

static tile *make_tiles(const buffer *view, const view_frame *frame, int edge, int *count) {
    const int columns = (view->width + INTERLEAVE * edge - 1) / (INTERLEAVE * edge);
    const int rows = (view->height + INTERLEAVE * edge - 1) / (INTERLEAVE * edge), each = columns * rows;
    tile *tiles;
    int i;
    *count = SUBSETS * each;
    tiles = (tile *)allocate("scene", (size_t)*count, sizeof *tiles);
    PARALLEL_FOR
    for (i = 0; i < *count; i++)
        fill_tile(&tiles[i], view, frame, i / each, i % each % columns * edge, i % each / columns * edge, edge);
    return tiles;
}

/* Pixels at which the sum over all lights is wanted, as tiles too */
static tile *make_reference_tiles(const buffer *view, int *count) {
    const int columns = (view->width + REFERENCE_STEP - 1) / REFERENCE_STEP;
    const int rows = (view->height + REFERENCE_STEP - 1) / REFERENCE_STEP;
    tile *tiles, *t;
    int i;
    *count = (columns * rows + TILE_PIXELS - 1) / TILE_PIXELS;
    tiles = (tile *)allocate("scene", (size_t)*count, sizeof *tiles);
    for (i = 0; i < columns * rows; i++) {
        int index = i / columns * REFERENCE_STEP * view->width + i % columns * REFERENCE_STEP;
        t = &tiles[i / TILE_PIXELS];
        if (view->texels[index].valid) put_pixel(t, view, index);
    }
    return tiles;
}

/* ---- ranges, and the volumes around them ---- */

/* The volumes of a list's lights in the camera's frame, and their stretched spaces as planes */
typedef struct {
    ggx_ellipsoid *ellipsoids, *in_scene; /* the latter in the scene's frame */
    vec3 *positions, *normals;
    float *plane[10];
    int *swapped;
} volume_list;

enum { PLANES = 10 };

static volume_list allocate_volumes(int count) {
    volume_list v;
    int k;
    v.ellipsoids = (ggx_ellipsoid *)allocate("scene", (size_t)count, sizeof *v.ellipsoids);
    v.in_scene = (ggx_ellipsoid *)allocate("scene", (size_t)count, sizeof *v.in_scene);
    v.positions = (vec3 *)allocate("scene", (size_t)count, sizeof *v.positions);
    v.normals = (vec3 *)allocate("scene", (size_t)count, sizeof *v.normals);
    v.swapped = (int *)allocate("scene", (size_t)count, sizeof *v.swapped);
    for (k = 0; k < PLANES; k++) v.plane[k] = (float *)allocate("scene", (size_t)count, sizeof(float));
    return v;
}

static void free_volumes(volume_list *v) {
    int k;
    free(v->ellipsoids);
    free(v->in_scene);
    free(v->positions);
    free(v->normals);
    free(v->swapped);
    for (k = 0; k < PLANES; k++) free(v->plane[k]);
}

static ggx_ellipsoid bound(const vpl *l, light_kind kind, volume which, float delta) {
    if (kind == DIFFUSE)
        return ggx_ellipsoid_of_sphere(ggx_bound_diffuse(l->position, l->normal, l->flux, 1, delta, l->xi));
    switch (which) {
    case AT_LIGHT:
        return ggx_ellipsoid_of_sphere(
            ggx_bound_sphere(l->position, l->normal, l->wi, l->alpha, l->flux, 1, delta, l->xi));
    case ENCLOSING:
        return ggx_ellipsoid_of_sphere(
            ggx_bound_enclosing(ggx_bound_spheroid(l->position, l->normal, l->wi, l->alpha, l->flux, 1, delta, l->xi)));
    case SPHEROID_CLOSE:
    case SPHEROID:
        return ggx_bound_spheroid(l->position, l->normal, l->wi, l->alpha, l->flux, 1, delta, l->xi);
    case ELLIPSOID:
    case ELLIPSOID_CLOSE:
    case VOLUMES:
        break;
    }
    return ggx_bound_ellipsoid(l->position, l->normal, l->wi, l->alpha, l->flux, 1, delta, l->xi);
}

static void bound_lights(const light_list *list, light_kind kind, volume which, float delta, const view_frame *frame,
                         volume_list *v) {
    int subset;
    PARALLEL_FOR
    for (subset = 0; subset < SUBSETS; subset++) {
        int i;
        for (i = list->first[subset]; i < list->first[subset + 1]; i++) {
            const vpl *l = &list->lights[i];
            const vec3 none = {0, 0, 0};
            view_frame turn = *frame;
            ggx_ellipsoid in_scene = bound(l, kind, which, delta);
            ggx_ellipsoid e = ggx_ellipsoid_transform(in_scene, frame->rows, frame->eye);
            ggx_stretched s = ggx_stretch_ellipsoid(e);
            v->ellipsoids[i] = e;
            v->in_scene[i] = in_scene;
            v->positions[i] = to_view(frame, l->position);
            turn.eye = none;
            v->normals[i] = to_view(&turn, l->normal);
            v->plane[0][i] = s.xx;
            v->plane[1][i] = s.xy;
            v->plane[2][i] = s.xz;
            v->plane[3][i] = s.yy;
            v->plane[4][i] = s.yz;
            v->plane[5][i] = s.zz;
            v->plane[6][i] = s.center.x;
            v->plane[7][i] = s.center.y;
            v->plane[8][i] = s.center.z;
            v->plane[9][i] = s.size;
            v->swapped[i] = s.swapped;
        }
    }
}

/* ---- culling ---- */

/* The lights that each tile's clusters keep: index times 4, plus 1 for the nearer cluster, 2 for the farther */
typedef struct {
    int *entries, *counts; /* SUBSET_LIGHTS for each tile, and how many of them are used */
} kept_lights;

static inline ggx_stretched stretched_of(const volume_list *v, int k) {
    ggx_stretched s;
    s.xx = v->plane[0][k];
    s.xy = v->plane[1][k];
    s.xz = v->plane[2][k];
    s.yy = v->plane[3][k];
    s.yz = v->plane[4][k];
    s.zz = v->plane[5][k];
    s.center.x = v->plane[6][k];
    s.center.y = v->plane[7][k];
    s.center.z = v->plane[8][k];
    s.size = v->plane[9][k];
    s.swapped = v->swapped[k];
    return s;
}

/* Whether an ellipsoid meets the box around a cluster's pixels: on floors and walls it is flat. */
static int hits_pixels(const ggx_ellipsoid *e, const tile *t, int cluster) {
    const vec3 low = t->box_low[cluster], high = t->box_high[cluster];
    return ggx_ellipsoid_hits_box(*e, lobe_scale(lobe_add(low, high), 0.5f),
                                  lobe_scale(lobe_sub(high, low), 0.500001f));
}

static void cull_tile(const tile *t, const light_list *list, const volume_list *v, int closer, int *entries,
                      int *count) {
    const ggx_tile frustum = t->frustum;
    const int first = list->first[t->subset], lights = list->first[t->subset + 1] - first;
    const float near0 = t->near_depth[0], near1 = t->near_depth[1], far0 = t->far_depth[0], far1 = t->far_depth[1];
    int hits[SUBSET_LIGHTS], i;
    *count = 0;
    if (t->count == 0) return;
    for (i = 0; i < lights; i++) {
        const int k = first + i;
        float near_depth[2], far_depth[2];
        near_depth[0] = near0;
        near_depth[1] = near1;
        far_depth[0] = far0;
        far_depth[1] = far1;
        hits[i] = ggx_stretched_hits_clusters(stretched_of(v, k), frustum, near_depth, far_depth);
    }
    for (i = 0; i < lights; i++) {
        const int k = first + i;
        int hit = hits[i];
        if (hit && closer) {
            const vec3 q = v->positions[k], n = v->normals[k];
            const ggx_stretched st = stretched_of(v, k);
            if (!ggx_ellipsoid_hits_sides(v->ellipsoids[k], frustum)) continue;
            if ((hit & 1) && !(ggx_tile_above(q, n, frustum, near0, near1) && hits_pixels(&v->in_scene[k], t, 0) &&
                               ggx_stretched_hits_frustum(st, frustum, near0, near1)))
                hit &= 2;
            if ((hit & 2) && !(ggx_tile_above(q, n, frustum, far0, far1) && hits_pixels(&v->in_scene[k], t, 1) &&
                               ggx_stretched_hits_frustum(st, frustum, far0, far1)))
                hit &= 1;
        }
        if (hit) entries[(*count)++] = 4 * k + hit;
    }
}

static void cull(const tile *tiles, int tile_count, const light_list *list, const volume_list *v, int closer,
                 kept_lights *kept) {
    int i;
    PARALLEL_FOR
    for (i = 0; i < tile_count; i++)
        cull_tile(&tiles[i], list, v, closer, kept->entries + (size_t)i * SUBSET_LIGHTS, &kept->counts[i]);
}

/* ---- shading ---- */

/* Irradiance of one light at a pixel, per unit of its colour: delta > 0: by chance, as the light is accepted; 0: all of
   it. Returns the radiance that it sends there, without the pixel's cosine, in *radiance. */
static inline float irradiance(const vpl *l, light_kind kind, vec3 position, vec3 normal, float delta,
                               float *radiance) {
    vec3 offset = lobe_sub(position, l->position), wo;
    float squared = lobe_dot(offset, offset), inverse = 1 / sqrtf(lobe_at_least(squared, LOBE_TINY)), value;
    wo = lobe_scale(offset, inverse);
    value = kind == GLOSSY ? ggx_brdf_cos(l->normal, l->wi, wo, l->alpha)
                           : 1 / LOBE_PI * lobe_at_least(lobe_dot(wo, l->normal), 0);
    squared += EXTENT * EXTENT;
    *radiance = delta > 0 ? ggx_estimate(l->flux * value, squared, delta, l->xi) : l->flux * value / squared;
    return *radiance * lobe_at_least(-lobe_dot(wo, normal), 0);
}

static void shade_pixels(tile *t, int begin, int end, const vpl *light, light_kind kind, float delta) {
    const vpl l = *light;
    int i;
    for (i = begin; i < end; i++) {
        vec3 position = lobe_vector(t->position[0][i], t->position[1][i], t->position[2][i]);
        vec3 normal = lobe_vector(t->normal[0][i], t->normal[1][i], t->normal[2][i]);
        float radiance, lit = irradiance(&l, kind, position, normal, delta, &radiance);
        t->sum[0][i] += lit * l.colour.x;
        t->sum[1][i] += lit * l.colour.y;
        t->sum[2][i] += lit * l.colour.z;
    }
}

/* The pixels of the clusters that an entry names */
static void range_of(const tile *t, int entry, int *begin, int *end) {
    *begin = entry & 1 ? 0 : t->split;
    *end = entry & 2 ? t->count : t->split;
}

static void shade(tile *tiles, int tile_count, const light_list *list, light_kind kind, const kept_lights *kept,
                  float delta) {
    int i;
    PARALLEL_FOR
    for (i = 0; i < tile_count; i++) {
        const int *entries = kept->entries + (size_t)i * SUBSET_LIGHTS;
        int k, begin, end;
        for (k = 0; k < kept->counts[i]; k++) {
            range_of(&tiles[i], entries[k], &begin, &end);
            if (kind == GLOSSY)
                shade_pixels(&tiles[i], begin, end, &list->lights[entries[k] >> 2], GLOSSY, delta);
            else
                shade_pixels(&tiles[i], begin, end, &list->lights[entries[k] >> 2], DIFFUSE, delta);
        }
    }
}

static void shade_all(tile *tiles, int tile_count, const light_list lists[KINDS], const char *label) {
    progress line = progress_begin(label, tile_count);
    int i;
    PARALLEL_FOR
    for (i = 0; i < tile_count; i++) {
        int k;
        for (k = 0; k < lists[DIFFUSE].first[SUBSETS]; k++)
            shade_pixels(&tiles[i], 0, tiles[i].count, &lists[DIFFUSE].lights[k], DIFFUSE, 0);
        for (k = 0; k < lists[GLOSSY].first[SUBSETS]; k++)
            shade_pixels(&tiles[i], 0, tiles[i].count, &lists[GLOSSY].lights[k], GLOSSY, 0);
        progress_step(&line);
    }
    progress_end(&line);
}

static int is_inside(const ggx_ellipsoid *e, vec3 p) {
    vec3 d = lobe_sub(p, e->center);
    float x = lobe_dot(e->axis[0], d) / e->radius[0], y = lobe_dot(e->axis[1], d) / e->radius[1];
    float z = lobe_dot(e->axis[2], d) / e->radius[2];
    return x * x + y * y + z * z <= 1;
}

/* Counts, per pixel, glossy lights that are shaded, those of them in whose volume the pixel is, and those accepted. */
static void count_lights(tile *tiles, int tile_count, const light_list *list, const volume_list *v,
                         const kept_lights *kept, const view_frame *frame, float delta) {
    int i;
    PARALLEL_FOR
    for (i = 0; i < tile_count; i++) {
        tile *t = &tiles[i];
        int k, pixel, begin, end;
        memset(t->shaded, 0, sizeof t->shaded);
        memset(t->inside, 0, sizeof t->inside);
        memset(t->accepted, 0, sizeof t->accepted);
        for (k = 0; k < kept->counts[i]; k++) {
            const int entry = kept->entries[(size_t)i * SUBSET_LIGHTS + (size_t)k];
            range_of(t, entry, &begin, &end);
            for (pixel = begin; pixel < end; pixel++) {
                vec3 position = lobe_vector(t->position[0][pixel], t->position[1][pixel], t->position[2][pixel]);
                float radiance;
                irradiance(&list->lights[entry >> 2], GLOSSY, position, position, delta, &radiance);
                t->shaded[pixel] += 1;
                t->inside[pixel] += is_inside(&v->ellipsoids[entry >> 2], to_view(frame, position)) ? 1.0f : 0.0f;
                t->accepted[pixel] += radiance > 0 ? 1.0f : 0.0f;
            }
        }
    }
}

static void clear_sums(tile *tiles, int tile_count) {
    int i;
    for (i = 0; i < tile_count; i++) memset(tiles[i].sum, 0, sizeof tiles[i].sum);
}

/* Puts the tiles' sums where their pixels are; those of the reference stand for one in each subset already. */
static void gather(const tile *tiles, int tile_count, float scale, image *result) {
    int i, k;
    for (i = 0; i < tile_count; i++) {
        const tile *t = &tiles[i];
        for (k = 0; k < t->count; k++)
            result->pixels[t->pixel[k]] = lobe_scale(lobe_vector(t->sum[0][k], t->sum[1][k], t->sum[2][k]), scale);
    }
}

/* ---- denoising ---- */

/* Mean of irradiance over a square, of what has a like normal and lies in the same plane */
static void denoise(const buffer *view, const image *noisy, image *smooth) {
    int row;
    PARALLEL_FOR
    for (row = 0; row < view->height; row++) {
        int column, x, y;
        for (column = 0; column < view->width; column++) {
            const texel *t = &view->texels[row * view->width + column];
            const float scale = 1 / (0.02f * lobe_max(t->valid ? t->hit.distance : 1, 0.01f));
            vec3 sum = {0, 0, 0};
            float weight = 0;
            if (!t->valid) continue;
            for (y = row - FILTER_RADIUS; y <= row + FILTER_RADIUS; y++) {
                for (x = column - FILTER_RADIUS; x <= column + FILTER_RADIUS; x++) {
                    const texel *other;
                    float off, alike, w;
                    if (x < 0 || y < 0 || x >= view->width || y >= view->height) continue;
                    other = &view->texels[y * view->width + x];
                    if (!other->valid) continue;
                    off = scale * lobe_dot(lobe_sub(other->hit.position, t->hit.position), t->hit.normal);
                    alike = lobe_max(lobe_dot(other->hit.normal, t->hit.normal), 0);
                    w = alike * alike * alike * alike * lobe_exp(-off * off);
                    sum = lobe_add(sum, lobe_scale(noisy->pixels[y * view->width + x], w));
                    weight += w;
                }
            }
            smooth->pixels[row * view->width + column] = lobe_scale(sum, 1 / weight);
        }
    }
}

/* ---- measuring ---- */

/* Root mean square difference of reflected radiance where the reference was taken */
static double error_of(const buffer *view, const tile *tiles, int tile_count, const image *got, const image *wanted) {
    double sum = 0;
    long count = 0;
    int i, k;
    for (i = 0; i < tile_count; i++) {
        for (k = 0; k < tiles[i].count; k++) {
            const int p = tiles[i].pixel[k];
            vec3 d = lobe_sub(got->pixels[p], wanted->pixels[p]);
            d = lobe_scale(vec3_multiply(d, view->texels[p].hit.look.diffuse), 1 / LOBE_PI);
            sum += (double)lobe_dot(d, d);
            count += 3;
        }
    }
    return count ? sqrt(sum / (double)count) : 0;
}

/* Light at the reference's pixels over what it should be there */
static double mean_of(const tile *tiles, int tile_count, const image *got, const image *wanted) {
    double sum = 0, wanted_sum = 0;
    int i, k;
    for (i = 0; i < tile_count; i++) {
        for (k = 0; k < tiles[i].count; k++) {
            sum += (double)lobe_mean(got->pixels[tiles[i].pixel[k]]);
            wanted_sum += (double)lobe_mean(wanted->pixels[tiles[i].pixel[k]]);
        }
    }
    return wanted_sum > 0 ? sum / wanted_sum : 0;
}

enum { TIME_BOUNDS, TIME_CULLING, TIME_SHADING, TIMES };

typedef struct {
    double shaded, inside, accepted; /* glossy lights per pixel */
    double ms[TIMES];
} outcome;

/* Renders once with one volume: irradiance into the tiles' sums. */
typedef struct {
    const scene *world;
    const buffer *view;
    view_frame frame;
    tile *tiles;
    int tile_count;
    light_list lists[KINDS];
    volume_list volumes[KINDS];
    kept_lights kept[KINDS];
} renderer;

static outcome render(renderer *r, volume which, float delta, int count_too) {
    outcome o = {0, 0, 0, {0, 0, 0}};
    int kind, i, k;
    double started = progress_clock();
    for (kind = 0; kind < KINDS; kind++)
        bound_lights(&r->lists[kind], (light_kind)kind, which, delta, &r->frame, &r->volumes[kind]);
    o.ms[TIME_BOUNDS] = progress_clock() - started;
    started = progress_clock();
    for (kind = 0; kind < KINDS; kind++)
        cull(r->tiles, r->tile_count, &r->lists[kind], &r->volumes[kind], which >= SPHEROID_CLOSE, &r->kept[kind]);
    o.ms[TIME_CULLING] = progress_clock() - started;
    clear_sums(r->tiles, r->tile_count);
    started = progress_clock();
    for (kind = 0; kind < KINDS; kind++)
        shade(r->tiles, r->tile_count, &r->lists[kind], (light_kind)kind, &r->kept[kind], delta);
    o.ms[TIME_SHADING] = progress_clock() - started;
    if (count_too) {
        double pixels = 0;
        count_lights(r->tiles, r->tile_count, &r->lists[GLOSSY], &r->volumes[GLOSSY], &r->kept[GLOSSY], &r->frame,
                     delta);
        for (i = 0; i < r->tile_count; i++) {
            pixels += r->tiles[i].count;
            for (k = 0; k < r->tiles[i].count; k++) {
                o.shaded += (double)r->tiles[i].shaded[k];
                o.inside += (double)r->tiles[i].inside[k];
                o.accepted += (double)r->tiles[i].accepted[k];
            }
        }
        o.shaded /= pixels;
        o.inside /= pixels;
        o.accepted /= pixels;
    }
    return o;
}

/* ---- pictures ---- */

/* Brightness: glossy lights at a pixel, white at 256; hue: the share of them in vain, from green to red */
static void draw_heat(const tile *tiles, int tile_count, image *heat) {
    int i, k;
    for (i = 0; i < tile_count; i++) {
        const tile *t = &tiles[i];
        for (k = 0; k < t->count; k++) {
            float n = lobe_min(t->shaded[k] / 256, 1), vain = 1 - t->accepted[k] / lobe_max(t->shaded[k], 1);
            vec3 hue = lobe_vector(lobe_min(2 * vain, 1), lobe_min(2 - 2 * vain, 1), 0);
            heat->pixels[t->pixel[k]] = lobe_scale(hue, 2 * n);
        }
    }
}

/* Half the size: means of four pixels */
static image halved(const image *whole) {
    image half = image_create(whole->width / 2, whole->height / 2);
    int x, y;
    for (y = 0; y < half.height; y++) {
        for (x = 0; x < half.width; x++) {
            const vec3 *p = &whole->pixels[2 * y * whole->width + 2 * x], *q = p + whole->width;
            half.pixels[y * half.width + x] = lobe_scale(lobe_add(lobe_add(p[0], p[1]), lobe_add(q[0], q[1])), 0.25f);
        }
    }
    return half;
}

static void paste_half(image *sheet, const image *picture, int column, int row) {
    image half = halved(picture);
    image_paste(sheet, &half, column * half.width, row * half.height);
    image_free(&half);
}

/* Direct light and the indirect irradiance's reflection */
static void compose(const scene *world, const buffer *view, const image *indirect, image *result) {
    int row;
    PARALLEL_FOR
    for (row = 0; row < view->height; row++) {
        int i;
        for (i = row * view->width; i < (row + 1) * view->width; i++) {
            const texel *t = &view->texels[i];
            if (!t->valid) continue;
            result->pixels[i] =
                lobe_add(brdf_lit_by_spot(world, &t->hit, t->view),
                         lobe_scale(vec3_multiply(indirect->pixels[i], t->hit.look.diffuse), 1 / LOBE_PI));
        }
    }
}

static const char *const picture_names[2] = {"", "-false-positives"};

static void name_picture(char rest[64], int which, int picture) {
    snprintf(rest, 64, "-%s%s.png", scene_names[which], picture_names[picture]);
}

typedef struct {
    option_size size;
    int scene, seed, tile; /* edge of the squares of pixels for which lights are culled */
    float delta;           /* radiance below which lights are left out at random */
    option_reals deltas;
    const char *out;
} settings;

static int is_shown(const settings *o, int which) {
    return o->scene == 0 || o->scene == 1 + which;
}

static void check_paths(const settings *o) {
    char rest[64];
    int which, picture;
    for (which = 0; which < SCENES; which++) {
        for (picture = 0; picture < 2 && is_shown(o, which); picture++) {
            name_picture(rest, which, picture);
            output_check(o->out, rest);
        }
    }
    output_check(o->out, ".csv");
}

/* ---- one scene ---- */

typedef struct {
    image noisy, smooth, wanted, heat, composed, results, heats;
} pictures;

/* What one volume lets through, how long it takes, and how well the light does. The error is the same with each. */
typedef struct {
    volume which;
    float alpha, delta;
    outcome found;
    timing taken[TIMES], whole;
    double noisy, smooth, mean;
} row;

static void judge(const renderer *r, const tile *reference, int reference_count, pictures *p, row *result) {
    gather(r->tiles, r->tile_count, 1, &p->noisy);
    if (result->which == AT_LIGHT) denoise(r->view, &p->noisy, &p->smooth);
    result->noisy = error_of(r->view, reference, reference_count, &p->noisy, &p->wanted);
    result->smooth = error_of(r->view, reference, reference_count, &p->smooth, &p->wanted);
    result->mean = mean_of(reference, reference_count, &p->noisy, &p->wanted);
}

/* All volumes, turn by turn. A heat map of each of the first four goes into a row of that sheet, if there is one. */
static void compare_volumes(renderer *r, float alpha, float delta, const tile *reference, int reference_count,
                            pictures *p, int heat_row, row rows[VOLUMES]) {
    int turn, k, i;
    memset(rows, 0, VOLUMES * sizeof *rows);
    for (turn = 0; turn < REPEATS; turn++) {
        for (k = 0; k < VOLUMES; k++) {
            outcome found;
            if (!timing_goes_on(&rows[k].whole, 1, REPEATS, LIMIT_MS)) continue;
            found = render(r, (volume)k, delta, turn == 0);
            for (i = 0; i < TIMES; i++) timing_add(&rows[k].taken[i], found.ms[i]);
            timing_add(&rows[k].whole, found.ms[TIME_BOUNDS] + found.ms[TIME_CULLING] + found.ms[TIME_SHADING]);
            if (turn > 0) continue;
            rows[k].which = (volume)k;
            rows[k].alpha = alpha;
            rows[k].delta = delta;
            rows[k].found = found;
            judge(r, reference, reference_count, p, &rows[k]);
            if (heat_row < 0 || k >= SPHEROID_CLOSE) continue;
            draw_heat(r->tiles, r->tile_count, &p->heat);
            paste_half(&p->heats, &p->heat, k, heat_row);
        }
    }
}

static void print_row(const row *r) {
    const outcome *o = &r->found;
    int i;
    printf("%5g  %-18s%9.2f%9.2f%9.2f", (double)r->alpha, volume_names[r->which], o->shaded, o->shaded - o->accepted,
           o->inside - o->accepted);
    for (i = 0; i < TIMES; i++) printf("%9.2f", timing_quartiles(&r->taken[i]).median);
    printf("%9.2f  %.5f  %.5f %.4f\n", timing_quartiles(&r->whole).median, r->noisy, r->smooth, r->mean);
    fflush(stdout);
}

static const char row_columns[] =
    "scene,alpha,delta,volume,lights,false_positives,in_volume,bounds_ms,bounds_ms_low,bounds_ms_high,culling_ms,"
    "culling_ms_low,culling_ms_high,shading_ms,shading_ms_low,shading_ms_high,total_ms,total_ms_low,total_ms_high,"
    "rmse,denoised,mean";

static void add_row(csv *table, const char *name, const row *r) {
    int i;
    csv_text(table, name);
    csv_number(table, (double)r->alpha);
    csv_number(table, (double)r->delta);
    csv_text(table, volume_names[r->which]);
    csv_error(table, r->found.shaded);
    csv_error(table, r->found.shaded - r->found.accepted);
    csv_error(table, r->found.inside - r->found.accepted);
    for (i = 0; i < TIMES; i++) csv_quartiles(table, timing_quartiles(&r->taken[i]));
    csv_quartiles(table, timing_quartiles(&r->whole));
    csv_error(table, r->noisy);
    csv_error(table, r->smooth);
    csv_error(table, r->mean);
    csv_row(table);
}

/* The error against time as delta varies. What was measured already is not measured again. */
static void vary_delta(renderer *r, const char *name, const settings *o, const row known[VOLUMES],
                       const tile *reference, int reference_count, pictures *p, csv *table) {
    int i, k;
    printf("\nat alpha %g as delta varies: milliseconds for bounds, culling and shading, the latter two with further\n"
           "tests of tiles last\n",
           (double)known->alpha);
    printf("%9s%10s%11s%10s%11s%10s%11s%9s  %-8s %-8s %s\n", "delta", "sphere", "enclosing", "spheroid", "ellipsoid",
           "spheroid", "ellipsoid", "VPLs/px", "RMSE", "denoised", "mean");
    for (i = 0; i < o->deltas.count; i++) {
        const float delta = o->deltas.value[i];
        const int is_new = delta < known->delta || delta > known->delta;
        row measured[VOLUMES];
        const row *rows = is_new ? measured : known;
        if (is_new) compare_volumes(r, known->alpha, delta, reference, reference_count, p, -1, measured);
        printf("%9g", (double)delta);
        for (k = 0; k < VOLUMES; k++) printf("%*.2f", k % 2 ? 11 : 10, timing_quartiles(&rows[k].whole).median);
        printf("%9.2f  %.5f  %.5f %.4f\n", rows[ELLIPSOID].found.shaded, rows->noisy, rows->smooth, rows->mean);
        fflush(stdout);
        for (k = 0; k < VOLUMES && is_new; k++) add_row(table, name, &rows[k]);
    }
}

static void show_scene(int which, const settings *o, csv *table) {
    pictures p;
    char rest[64];
    int i, k, picture;
    p.noisy = image_create(o->size.width, o->size.height);
    p.smooth = image_create(o->size.width, o->size.height);
    p.wanted = image_create(o->size.width, o->size.height);
    p.heat = image_create(o->size.width, o->size.height);
    p.composed = image_create(o->size.width, o->size.height);
    p.results = image_create(2 * o->size.width, 2 * o->size.height);
    p.heats = image_create(SPHEROID_CLOSE * (o->size.width / 2), ALPHAS * (o->size.height / 2));
    printf("\n%s\n\n%26s%9s%9s%9s%9s%9s%9s%9s  %-8s %s\n", scene_names[which], "VPLs", "false", "in its", "bounds",
           "culling", "shading", "total", "RMSE", "denoised", "mean");
    printf("alpha  volume    /px       /px   volume       ms       ms       ms       ms\n");
    for (i = 0; i < ALPHAS; i++) {
        const scene world = which == 0 ? scene_ring(alphas[i]) : scene_colonnade(alphas[i]);
        buffer view = buffer_camera(&world, o->size.width, o->size.height), rsm = buffer_rsm(&world, RSM_SIZE);
        renderer r;
        tile *reference;
        int reference_count, kind;
        row rows[VOLUMES];
        r.world = &world;
        r.view = &view;
        r.frame = view_of(&world);
        r.tiles = make_tiles(&view, &r.frame, o->tile, &r.tile_count);
        make_lights(&rsm, (unsigned)o->seed, r.lists);
        for (kind = 0; kind < KINDS; kind++) {
            r.volumes[kind] = allocate_volumes(r.lists[kind].first[SUBSETS]);
            r.kept[kind].counts = (int *)allocate("scene", (size_t)r.tile_count, sizeof(int));
            r.kept[kind].entries = (int *)allocate("scene", (size_t)r.tile_count * SUBSET_LIGHTS, sizeof(int));
        }
        if (i == 0)
            printf("%d diffuse and %d glossy VPLs, %d tiles\n", r.lists[DIFFUSE].first[SUBSETS],
                   r.lists[GLOSSY].first[SUBSETS], r.tile_count);
        reference = make_reference_tiles(&view, &reference_count);
        shade_all(reference, reference_count, r.lists, "reference");
        gather(reference, reference_count, 1 / (float)SUBSETS, &p.wanted);
        compare_volumes(&r, alphas[i], o->delta, reference, reference_count, &p, i, rows);
        for (k = 0; k < VOLUMES; k++) {
            print_row(&rows[k]);
            add_row(table, scene_names[which], &rows[k]);
        }
        compose(&world, &view, &p.smooth, &p.composed);
        image_paste(&p.results, &p.composed, i % 2 * o->size.width, i / 2 * o->size.height);
        if (i == ALPHAS - 1) vary_delta(&r, scene_names[which], o, rows, reference, reference_count, &p, table);
        for (kind = 0; kind < KINDS; kind++) {
            free_volumes(&r.volumes[kind]);
            free(r.kept[kind].counts);
            free(r.kept[kind].entries);
            free(r.lists[kind].lights);
        }
        free(r.tiles);
        free(reference);
        buffer_free(&view);
        buffer_free(&rsm);
    }
    for (picture = 0; picture < 2; picture++) {
        name_picture(rest, which, picture);
        output_picture(o->out, rest, picture ? &p.heats : &p.results, 1);
        printf("wrote %s%s: %s\n", o->out, rest,
               picture ? "glossy VPLs per pixel (brightness) and false ones (red), by volume and alpha"
                       : "direct and indirect light, alpha .4, .2; .1, .05");
    }
    image_free(&p.noisy);
    image_free(&p.smooth);
    image_free(&p.wanted);
    image_free(&p.heat);
    image_free(&p.composed);
    image_free(&p.results);
    image_free(&p.heats);
}

int main(int argc, char **argv) {
    settings o = {{640, 480}, 0, 0, 16, 0.1f, {6, {25.6f, 6.4f, 1.6f, 0.4f, 0.1f, 0.025f}}, "build/light_culling"};
    const option options[] = {
        {"--scene S", OPTION_CHOICE, &o.scene, 0, 0, "what is lit", scene_choices},
        OPTION_OF_SIZE(&o.size),
        {"--delta X", OPTION_REAL, &o.delta, 1e-9, 1e9, "radiance below which lights are left out at random", 0},
        {"--deltas X,...", OPTION_REALS, &o.deltas, 1e-9, 1e9, "the same, of the table of errors against time", 0},
        {"--tile N", OPTION_WHOLE, &o.tile, 2, 16, "edge of a tile, in pixels of an interleaved image", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    csv table = csv_begin(row_columns);
    int which;
    options_read(
        options, argc, argv,
        "Renders glossy caustics with 65,536 virtual point lights that are culled at random without bias,\n"
        "and prints how many lights each bounding volume lets through, in vain or not, and how long it takes.");
    check_paths(&o);
    printf("%dx%d pixels, tiles of %dx%d, delta %g; times are medians of up to %d runs. The reference is the sum over "
           "all\n",
           o.size.width, o.size.height, o.tile, o.tile, (double)o.delta, REPEATS);
    printf(
        "VPLs at every %dth pixel of every %dth row; mean: of the light there, over the reference's. False: glossy\n",
        REFERENCE_STEP, REFERENCE_STEP);
    printf("VPLs that are shaded where they are not accepted; in its volume: those that were if tiles were single\n"
           "pixels. Closer: with further tests of tiles.\n");
    for (which = 0; which < SCENES; which++) {
        if (is_shown(&o, which)) show_scene(which, &o, &table);
    }
    printf("\n");
    csv_end(&table, o.out, ".csv", "the numbers of all tables");
    return 0;
}
