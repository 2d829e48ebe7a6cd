/* The cross bilateral filter by SGs, guides and all: against pixels and against taps. */
#include "growth.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/glossy_frame.h"
#include <stdio.h>

enum { SIZES = 5, VIEW = 2 /* that taps are counted for */ };
static const int widths[SIZES] = {64, 112, 200, 360, 640}; /* heights: 3/4 */
static const int radii[SIZES] = {1, 2, 4, FILTER_RADIUS, 15};

/* A picture, and planes of it with a radius */
typedef struct {
    frame seen;
    filter_planes *planes;
    image smooth;
} picture;

static void run(void *of, int which_filter, int which) {
    const picture *p = (const picture *)of + which;
    const float beta = 2;
    image smooth = p->smooth;
    (void)which_filter;
    filter_frame(p->planes, p->seen.guides, FILTER_EQ12, &beta, filter_depth_variance, &smooth);
}

static picture picture_of(int width, int radius) {
    const subject tiles = {"tiles", scene_gallery, look_tiles, 0};
    const scene world = scene_gallery();
    const int height = 3 * width / 4;
    picture p;
    image noisy;
    p.seen = frame_of(&world, &tiles, width, height);
    p.planes = filter_planes_create(width, height, radius, 1);
    p.smooth = image_create(width, height);
    noisy = shade_frame(&p.seen, 1, 0, 0, "noisy light");
    filter_fill_colours(p.planes, &noisy);
    image_free(&noisy);
    return p;
}

static void free_pictures(picture pictures[SIZES]) {
    int i;
    for (i = 0; i < SIZES; i++) {
        frame_free(&pictures[i].seen);
        filter_planes_free(pictures[i].planes);
        image_free(&pictures[i].smooth);
    }
}

static int pixels_of(int width) {
    return width * (3 * width / 4);
}

void growth_filter(growth_report *to) {
    picture pictures[SIZES];
    growth pixels = growth_of("Cross bilateral filter", "pixels", run, pictures);
    growth taps = growth_of("Cross bilateral filter", "taps", run, pictures);
    int i;
    pixels.subjects[0] = taps.subjects[0] = "filter by Eq. 12";
    for (i = 0; i < SIZES; i++) {
        pixels.sizes[i] = pixels_of(widths[i]);
        taps.sizes[i] = filter_taps(radii[i]);
    }
    snprintf(pixels.fixed, sizeof pixels.fixed, "%d taps", filter_taps(FILTER_RADIUS));
    snprintf(taps.fixed, sizeof taps.fixed, "%d pixels", pixels_of(widths[VIEW]));
    for (i = 0; i < SIZES; i++) pictures[i] = picture_of(widths[i], FILTER_RADIUS);
    growth_measure(to, &pixels);
    free_pictures(pictures);
    for (i = 0; i < SIZES; i++) pictures[i] = picture_of(widths[VIEW], radii[i]);
    growth_measure(to, &taps);
    free_pictures(pictures);
}
