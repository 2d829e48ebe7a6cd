/* Stochastic light culling, by the stages of examples/light_culling.c: against virtual point lights and against pixels. */
#include "growth.h"
#define program_name light_culling_name
#define main light_culling_main
#include "../../examples/light_culling.c"
#undef main
#undef program_name

enum { SIZES = 6, SUBJECTS = 3, TILE = 16, FEWER_PIXELS = 16 };
static const volume shapes[SUBJECTS] = {AT_LIGHT, SPHEROID, ELLIPSOID};
static const char *const shape_names[SUBJECTS] = {"culling by sphere at VPL", "culling by spheroid",
                                                  "culling by ellipsoid"};
static const int rsm_edges[SIZES] = {24, 40, 64, 104, 160, 256};
static const int widths[SIZES] = {64, 104, 160, 256, 400, 640}; /* heights: 3/4 */

#define DELTA 0.1f
#define ALPHA 0.05f

/* Views and RSMs of all sizes, and room for what is made of the largest */
typedef struct {
    buffer views[SIZES];
    view_frame frame;
    tile *tiles[SIZES], *few;
    int tile_counts[SIZES], few_count;
    light_list lists[SIZES][KINDS];
    volume_list volumes[KINDS];
    kept_lights kept[KINDS];
    int view; /* the one that VPLs are counted for */
} context;

static void cull_and_shade(const context *c, int view, int rsm, volume which) {
    const light_list *lists = c->lists[rsm];
    volume_list volumes[KINDS];
    kept_lights kept[KINDS];
    int kind;
    for (kind = 0; kind < KINDS; kind++) {
        volumes[kind] = c->volumes[kind];
        kept[kind] = c->kept[kind];
    }
    for (kind = 0; kind < KINDS; kind++)
        bound_lights(&lists[kind], (light_kind)kind, which, DELTA, &c->frame, &volumes[kind]);
    for (kind = 0; kind < KINDS; kind++)
        cull(c->tiles[view], c->tile_counts[view], &lists[kind], &volumes[kind], 0, &kept[kind]);
    clear_sums(c->tiles[view], c->tile_counts[view]);
    for (kind = 0; kind < KINDS; kind++)
        shade(c->tiles[view], c->tile_counts[view], &lists[kind], (light_kind)kind, &kept[kind], DELTA);
}

static void run_lights(void *of, int subject, int which) {
    const context *c = (context *)of;
    cull_and_shade(c, c->view, which, shapes[subject]);
}

static void run_pixels(void *of, int subject, int which) {
    cull_and_shade((context *)of, which, SIZES - 1, shapes[subject]);
}

static void run_all(void *of, int subject, int which) {
    const context *c = (context *)of;
    (void)subject;
    clear_sums(c->few, c->few_count);
    shade_all(c->few, c->few_count, c->lists[which], "every VPL");
}

/* ---- */

static double pixels_of(const tile *tiles, int count) {
    double pixels = 0;
    int i;
    for (i = 0; i < count; i++) pixels += tiles[i].count;
    return pixels;
}

/* Lights of both kinds that the last run shaded, per pixel */
static double shaded_of(const context *c, int view) {
    double shaded = 0;
    int i, k, kind, begin, end;
    for (i = 0; i < c->tile_counts[view]; i++) {
        for (kind = 0; kind < KINDS; kind++) {
            for (k = 0; k < c->kept[kind].counts[i]; k++) {
                range_of(&c->tiles[view][i], c->kept[kind].entries[(size_t)i * SUBSET_LIGHTS + (size_t)k], &begin,
                         &end);
                shaded += end - begin;
            }
        }
    }
    return shaded / pixels_of(c->tiles[view], c->tile_counts[view]);
}

static void count_all(context *c, growth *g) {
    int i, k;
    for (i = 0; i < SIZES; i++) {
        for (k = 0; k < SUBJECTS; k++) {
            g->run(c, k, i);
            g->shaded[k][i] = shaded_of(c, g->run == run_pixels ? i : c->view);
        }
    }
}

static void prepare(context *c, const scene *world) {
    int kind, i;
    c->frame = view_of(world);
    for (i = 0; i < SIZES; i++) {
        buffer rsm = buffer_rsm(world, rsm_edges[i]);
        make_lights(&rsm, 0, c->lists[i]);
        buffer_free(&rsm);
        c->views[i] = buffer_camera(world, widths[i], 3 * widths[i] / 4);
        c->tiles[i] = make_tiles(&c->views[i], &c->frame, TILE, &c->tile_counts[i]);
    }
    for (kind = 0; kind < KINDS; kind++) {
        c->volumes[kind] = allocate_volumes(c->lists[SIZES - 1][kind].first[SUBSETS]);
        c->kept[kind].counts = (int *)allocate("tiles", (size_t)c->tile_counts[SIZES - 1], sizeof(int));
        c->kept[kind].entries =
            (int *)allocate("tiles", (size_t)c->tile_counts[SIZES - 1] * SUBSET_LIGHTS, sizeof(int));
    }
    c->few = make_reference_tiles(&c->views[1], &c->few_count);
}

static void release(context *c) {
    int kind, i;
    for (i = 0; i < SIZES; i++) {
        buffer_free(&c->views[i]);
        free(c->tiles[i]);
        for (kind = 0; kind < KINDS; kind++) free(c->lists[i][kind].lights);
    }
    for (kind = 0; kind < KINDS; kind++) {
        free_volumes(&c->volumes[kind]);
        free(c->kept[kind].counts);
        free(c->kept[kind].entries);
    }
    free(c->few);
}

void growth_culling(growth_report *to) {
    const scene world = scene_ring(ALPHA);
    context c;
    growth lights = growth_of("VPLs", run_lights, &c), pixels = growth_of("pixels", run_pixels, &c);
    growth all = growth_of("VPLs", run_all, &c);
    int i;
    prepare(&c, &world);
    c.view = to->quick ? SIZES - 3 : SIZES - 1;
    for (i = 0; i < SUBJECTS; i++) lights.subjects[i] = pixels.subjects[i] = shape_names[i];
    all.subjects[0] = "every VPL at every pixel";
    for (i = 0; i < SIZES; i++) {
        lights.sizes[i] = all.sizes[i] = rsm_edges[i] * rsm_edges[i];
        pixels.sizes[i] = widths[i] * (3 * widths[i] / 4);
    }
    snprintf(lights.fixed, sizeof lights.fixed, "Light culling: %.0f pixels; alpha %g; delta %g", pixels.sizes[c.view],
             (double)ALPHA, (double)DELTA);
    snprintf(pixels.fixed, sizeof pixels.fixed, "Light culling: %.0f VPLs; alpha %g; delta %g", lights.sizes[SIZES - 1],
             (double)ALPHA, (double)DELTA);
    snprintf(all.fixed, sizeof all.fixed, "No light culling: %.0f pixels", pixels_of(c.few, c.few_count));
    count_all(&c, &lights);
    count_all(&c, &pixels);
    growth_measure(to, &lights);
    growth_measure(to, &all);
    growth_measure(to, &pixels);
    release(&c);
}
