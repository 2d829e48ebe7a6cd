/* The cross bilateral filter by SGs: against pixels and against taps. */
#include "growth.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/glossy_frame.h"
#include <stdio.h>

enum { SIZES = 5 };
static const int widths[SIZES] = {64, 112, 200, 360, 640}; /* heights: 3/4 */

typedef struct {
    frame frames[SIZES];
    filter_planes *planes[SIZES];
    image smooth[SIZES];
} context;

static void run_pixels(void *of, int method, int which) {
    context c = *(context *)of;
    const float beta = 2;
    (void)method;
    filter_frame(c.planes[which], c.frames[which].guides, FILTER_EQ12, &beta, filter_depth_variance, &c.smooth[which]);
}

static void prepare(context *c) {
    const subject tiles = {"tiles", scene_gallery, look_tiles, 0};
    const scene world = scene_gallery();
    int i;
    for (i = 0; i < SIZES; i++) {
        const int width = widths[i], height = 3 * widths[i] / 4;
        image noisy;
        c->frames[i] = frame_of(&world, &tiles, width, height);
        c->planes[i] = filter_planes_create(width, height, 1);
        c->smooth[i] = image_create(width, height);
        noisy = shade_frame(&c->frames[i], 1, 0, 0, "noisy light");
        filter_fill_colours(c->planes[i], &noisy);
        image_free(&noisy);
    }
}

void growth_filter(growth_report *to) {
    context c;
    growth pixels = growth_of("Cross bilateral filter", "pixels", run_pixels, &c);
    int i;
    prepare(&c);
    pixels.subjects[0] = "filter by Eq. 12";
    for (i = 0; i < SIZES; i++) pixels.sizes[i] = widths[i] * (3 * widths[i] / 4);
    snprintf(pixels.fixed, sizeof pixels.fixed, "%d taps", FILTER_TAPS);
    growth_measure(to, &pixels);
    for (i = 0; i < SIZES; i++) {
        frame_free(&c.frames[i]);
        filter_planes_free(c.planes[i]);
        image_free(&c.smooth[i]);
    }
}
