/* Stochastic light culling on the GPU against the stages of examples/light_culling.c. */
#include "../../../examples/common/fail.h"
#include "../../../examples/common/gpu_cull.h"
#include "pipelines.h"
#define program_name light_culling_name
#define main light_culling_main
#include "../../../examples/light_culling.c"
#undef main
#undef program_name

enum { WIDTH = 157, HEIGHT = 115, EDGE = 7, ROOM = KINDS * SUBSET_LIGHTS, FEW = 16 };

#define DELTA 0.1f
#define BORDERLINE 1e-4 /* share of kept lights that rounding may decide otherwise */

/* The lists of both kinds in one, for the GPU: a subset's diffuse lights, then its glossy ones */
typedef struct {
    gpu_cull_light *lights;
    int first[SUBSETS + 1];
} joined_list;

static int joined_index(const light_list lists[KINDS], int kind, int subset, int k) {
    return k + (kind == DIFFUSE ? lists[GLOSSY].first[subset] : lists[DIFFUSE].first[subset + 1]);
}

static joined_list join_lists(const light_list lists[KINDS]) {
    joined_list joined;
    int subset, kind, k;
    for (subset = 0; subset <= SUBSETS; subset++)
        joined.first[subset] = lists[DIFFUSE].first[subset] + lists[GLOSSY].first[subset];
    joined.lights = (gpu_cull_light *)allocate("lights", (size_t)joined.first[SUBSETS], sizeof *joined.lights);
    for (kind = 0; kind < KINDS; kind++) {
        for (subset = 0; subset < SUBSETS; subset++) {
            for (k = lists[kind].first[subset]; k < lists[kind].first[subset + 1]; k++) {
                const vpl *from = &lists[kind].lights[k];
                gpu_cull_light *to = &joined.lights[joined_index(lists, kind, subset, k)];
                to->position = from->position;
                to->normal = from->normal;
                to->wi = from->wi;
                to->colour = from->colour;
                to->flux = from->flux;
                to->alpha = from->alpha;
                to->xi = from->xi;
                to->glossy = kind == GLOSSY;
            }
        }
    }
    return joined;
}

/* Everything of one scene on the CPU: its kept lights, and the irradiance */
static renderer render_scene(const scene *world, const buffer *view, const buffer *rsm, image *wanted) {
    renderer r;
    int kind;
    r.world = world;
    r.view = view;
    r.frame = view_of(world);
    r.tiles = make_tiles(view, &r.frame, EDGE, &r.tile_count);
    make_lights(rsm, 0, r.lists);
    for (kind = 0; kind < KINDS; kind++) {
        r.volumes[kind] = allocate_volumes(r.lists[kind].first[SUBSETS]);
        r.kept[kind].counts = (int *)allocate("tiles", (size_t)r.tile_count, sizeof(int));
        r.kept[kind].entries = (int *)allocate("tiles", (size_t)r.tile_count * SUBSET_LIGHTS, sizeof(int));
    }
    render(&r, ELLIPSOID, DELTA, 0);
    gather(r.tiles, r.tile_count, 1, wanted);
    return r;
}

static void free_renderer(renderer *r) {
    int kind;
    for (kind = 0; kind < KINDS; kind++) {
        free_volumes(&r->volumes[kind]);
        free(r->kept[kind].counts);
        free(r->kept[kind].entries);
        free(r->lists[kind].lights);
    }
    free(r->tiles);
}

/* The clusters of a tile by which each light is kept, on the CPU */
static void mark_kept(const renderer *r, int i, unsigned char *marks) {
    int kind, k;
    for (kind = 0; kind < KINDS; kind++) {
        for (k = 0; k < r->kept[kind].counts[i]; k++) {
            const int entry = r->kept[kind].entries[(size_t)i * SUBSET_LIGHTS + (size_t)k];
            marks[joined_index(r->lists, kind, r->tiles[i].subset, entry >> 2)] = (unsigned char)(entry & 3);
        }
    }
}

/* Kept lights on the CPU, and those that the GPU keeps otherwise; with short lists only what is in them is compared. */
typedef struct {
    long tests, kept, otherwise, overflowing;
} comparison;

static comparison compare_kept(const renderer *r, gpu_cull *c, const joined_list *joined, int most) {
    comparison found = {0, 0, 0, 0};
    int *counts = (int *)allocate("tiles", (size_t)r->tile_count, sizeof *counts);
    unsigned *entries = (unsigned *)allocate("tiles", (size_t)r->tile_count * (size_t)most, sizeof *entries);
    unsigned char *marks = (unsigned char *)allocate("lights", (size_t)joined->first[SUBSETS], 1);
    int i, k;
    gpu_cull_kept(c, counts, entries);
    for (i = 0; i < r->tile_count; i++) {
        const int subset = r->tiles[i].subset, kept = r->kept[DIFFUSE].counts[i] + r->kept[GLOSSY].counts[i];
        const int first = joined->first[subset], end = joined->first[subset + 1];
        found.tests += end - first;
        found.kept += kept;
        found.overflowing += counts[i] > most;
        memset(marks + first, 0, (size_t)(end - first));
        mark_kept(r, i, marks);
        for (k = 0; k < counts[i] && k < most; k++) {
            const unsigned entry = entries[(size_t)i * (size_t)most + (size_t)k], light = entry >> 2;
            if (light < (unsigned)first || light >= (unsigned)end || marks[light] != (entry & 3))
                found.otherwise++;
            else
                marks[light] = 0;
        }
        if (counts[i] > most)
            found.otherwise += abs(counts[i] - kept);
        else
            for (k = first; k < end; k++) found.otherwise += marks[k] != 0;
    }
    free(counts);
    free(entries);
    free(marks);
    return found;
}

static gpu_cull_settings settings_of(const view_frame *frame, int most) {
    gpu_cull_settings s;
    s.eye = frame->eye;
    s.right = frame->rows[0];
    s.up = frame->rows[1];
    s.forward = frame->rows[2];
    s.delta = DELTA;
    s.extent = EXTENT;
    s.interleave = INTERLEAVE;
    s.edge = EDGE;
    s.most = most;
    return s;
}

static void compare_scene(gpu *device, const char *folder, const scene *world, const char *name) {
    static const char *const stages[2] = {"compute", "fragment"};
    buffer view = buffer_camera(world, WIDTH, HEIGHT), rsm = buffer_rsm(world, RSM_SIZE);
    image wanted = image_create(WIDTH, HEIGHT), got = image_create(WIDTH, HEIGHT);
    renderer r = render_scene(world, &view, &rsm, &wanted);
    joined_list joined = join_lists(r.lists);
    gpu_cull_settings wished = settings_of(&r.frame, ROOM);
    gpu_cull *c = gpu_cull_create(device, folder, &wished, &view, joined.lights, joined.first);
    comparison found;
    char what[256];
    int stage;
    gpu_cull_run(c);
    found = compare_kept(&r, c, &joined, ROOM);
    snprintf(what, sizeof what,
             "light culling, %s: %ld of %ld lights are kept in %d tiles, %ld otherwise than on the CPU", name,
             found.kept, found.tests, r.tile_count, found.otherwise);
    pipeline_check(what, gpu_cull_tiles(c) == r.tile_count && found.kept > 0 && found.kept < found.tests / 2 &&
                             (double)found.otherwise <= BORDERLINE * (double)found.kept && !found.overflowing);
    for (stage = 0; stage < 2; stage++) {
        gpu_cull_shade(c, (gpu_stage)stage, &got);
        snprintf(what, sizeof what, "light culling, %s, %s", name, stages[stage]);
        pipeline_picture(what, &got, &wanted, 1 / LOBE_PI);
    }
    gpu_cull_free(c);
    wished.most = FEW;
    c = gpu_cull_create(device, folder, &wished, &view, joined.lights, joined.first);
    gpu_cull_run(c);
    found = compare_kept(&r, c, &joined, FEW);
    snprintf(what, sizeof what, "light culling, %s: %ld lists overflow, which their counts tell", name,
             found.overflowing);
    pipeline_check(what, found.overflowing > 0 && (double)found.otherwise <= BORDERLINE * (double)found.kept);
    gpu_cull_free(c);
    free(joined.lights);
    free_renderer(&r);
    image_free(&wanted);
    image_free(&got);
    buffer_free(&view);
    buffer_free(&rsm);
}

void pipeline_cull(gpu *device, const char *folder) {
    const scene ring = scene_ring(0.1f), colonnade = scene_colonnade(0.05f);
    compare_scene(device, folder, &ring, "ring");
    compare_scene(device, folder, &colonnade, "colonnade");
}
