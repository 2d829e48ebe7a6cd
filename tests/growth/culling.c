/* Stochastic light culling, by the stages of examples/light_culling.c: against virtual point lights and against pixels. */
#include "growth.h"
#define program_name light_culling_name
#define main light_culling_main
#include "../../examples/light_culling.c"
#undef main
#undef program_name

enum { SIZES = 6, VOLUMES_TIMED = 3, UNSHADED = VOLUMES_TIMED, SUBJECTS, TILE = 16 };
static const volume shapes[VOLUMES_TIMED] = {AT_LIGHT, SPHEROID, ELLIPSOID};
static const char *const names[SUBJECTS] = {"culling by sphere at VPL", "culling by spheroid", "culling by ellipsoid",
                                            "by ellipsoid; unshaded"};
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
    int view, rsm; /* what is fixed */
} context;

static void bound_and_cull(context *c, int view, int rsm, volume which) {
    const light_list *lists = c->lists[rsm];
    int kind;
    for (kind = 0; kind < KINDS; kind++)
        bound_lights(&lists[kind], (light_kind)kind, which, DELTA, &c->frame, &c->volumes[kind]);
    for (kind = 0; kind < KINDS; kind++)
        cull(c->tiles[view], c->tile_counts[view], &lists[kind], &c->volumes[kind], 0, &c->kept[kind]);
}

static void run(context *c, int view, int rsm, int subject) {
    int kind;
    bound_and_cull(c, view, rsm, subject == UNSHADED ? ELLIPSOID : shapes[subject]);
    if (subject == UNSHADED) return;
    clear_sums(c->tiles[view], c->tile_counts[view]);
    for (kind = 0; kind < KINDS; kind++)
        shade(c->tiles[view], c->tile_counts[view], &c->lists[rsm][kind], (light_kind)kind, &c->kept[kind], DELTA);
}

static void run_lights(void *of, int subject, int which) {
    context *c = (context *)of;
    run(c, c->view, which, subject);
}

static void run_pixels(void *of, int subject, int which) {
    context *c = (context *)of;
    run(c, which, c->rsm, subject);
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
        for (k = 0; k < VOLUMES_TIMED; k++) {
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

/* With the most VPLs */
static void compare_per_pixel(const context *c, const growth *culled, const growth *all) {
    const int last = SIZES - 1, by = 2;
    const double each = culled->times[by][last].median / pixels_of(c->tiles[c->view], c->tile_counts[c->view]);
    const double every = all->times[0][last].median / pixels_of(c->few, c->few_count);
    printf("%.0f VPLs take %.3g us a pixel, %.3g %s: %.0f times less\n", all->sizes[last], 1e3 * every, 1e3 * each,
           culled->subjects[by], every / each);
    fflush(stdout);
}

void growth_culling(growth_report *to) {
    const scene world = scene_ring(ALPHA);
    context c;
    growth lights = growth_of("Light culling", "VPLs", run_lights, &c),
           pixels = growth_of("Light culling", "pixels", run_pixels, &c);
    growth all = growth_of("Every VPL at every pixel", "VPLs", run_all, &c);
    int i;
    prepare(&c, &world);
    c.view = c.rsm = to->quick ? SIZES - 3 : SIZES - 1;
    for (i = 0; i < SUBJECTS; i++) lights.subjects[i] = pixels.subjects[i] = names[i];
    all.subjects[0] = "all VPLs";
    for (i = 0; i < SIZES; i++) {
        lights.sizes[i] = all.sizes[i] = rsm_edges[i] * rsm_edges[i];
        pixels.sizes[i] = widths[i] * (3 * widths[i] / 4);
    }
    snprintf(lights.fixed, sizeof lights.fixed, "%.0f pixels; alpha %g; delta %g", pixels.sizes[c.view], (double)ALPHA,
             (double)DELTA);
    snprintf(pixels.fixed, sizeof pixels.fixed, "%.0f VPLs; alpha %g; delta %g", lights.sizes[c.rsm], (double)ALPHA,
             (double)DELTA);
    snprintf(all.fixed, sizeof all.fixed, "%.0f pixels", pixels_of(c.few, c.few_count));
    count_all(&c, &lights);
    count_all(&c, &pixels);
    growth_measure(to, &lights);
    growth_measure(to, &all);
    compare_per_pixel(&c, &lights, &all);
    growth_measure(to, &pixels);
    release(&c);
}
