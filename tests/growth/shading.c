/* Shading by virtual SG lights, without shadows: against lights and against pixels. */
#include "growth.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/vsgl_generate.h"
#include "../../examples/common/vsgl_shade.h"
#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 5, RSM_SIZE = 512 };
static const int light_counts[SIZES] = {64, 200, 640, 2000, 6400};
static const int edges[SIZES] = {16, 32, 48, 96, 160}; /* their squares are whole blocks of texels */

typedef struct {
    light_set sets[SIZES];
    vpl_map views[SIZES];
    vec3 *radiance;
    int view; /* the one that lights are counted for */
} context;

static void run_lights(void *of, int subject, int which) {
    const context *c = (context *)of;
    (void)subject;
    vsgl_shade(&c->views[c->view], c->sets[which].lights, NULL, c->sets[which].count, c->radiance, "shading");
}

static void run_pixels(void *of, int subject, int which) {
    const context *c = (context *)of;
    (void)subject;
    vsgl_shade(&c->views[which], c->sets[0].lights, NULL, c->sets[0].count, c->radiance, "shading");
}

static void prepare(context *c) {
    const scene world = scene_room();
    buffer seen = buffer_rsm(&world, RSM_SIZE);
    vpl_map rsm = vpl_map_create(&seen, world.center);
    float *pdf = (float *)allocate("PDF", RSM_SIZE * RSM_SIZE, sizeof *pdf);
    int i;
    buffer_free(&seen);
    for (i = 0; i < RSM_SIZE * RSM_SIZE; i++) pdf[i] = vpl_weight(&rsm.texels[i]);
    for (i = 0; i < SIZES; i++) {
        generator g = generator_create(RSM_SIZE, RSM_SIZE, light_counts[i]);
        c->sets[i] = light_set_create(light_counts[i]);
        vsgl_generate(&g, &rsm, pdf, METHOD_FAST, 1, 0, &c->sets[i]);
        generator_free(&g);
        seen = buffer_camera(&world, edges[i], edges[i]);
        c->views[i] = vpl_map_create(&seen, world.center);
        buffer_free(&seen);
    }
    c->radiance = (vec3 *)allocate("images", (size_t)(edges[SIZES - 1] * edges[SIZES - 1]), sizeof *c->radiance);
    free(pdf);
    free(rsm.texels);
}

void growth_shading(growth_report *to) {
    context c;
    growth lights = growth_of("VSGL shading", "lights", run_lights, &c),
           pixels = growth_of("VSGL shading", "pixels", run_pixels, &c);
    int i;
    prepare(&c);
    c.view = to->quick ? 0 : 1;
    lights.subjects[0] = pixels.subjects[0] = "VSGL shading";
    for (i = 0; i < SIZES; i++) {
        lights.sizes[i] = light_counts[i];
        pixels.sizes[i] = edges[i] * edges[i];
    }
    snprintf(lights.fixed, sizeof lights.fixed, "%.0f pixels; no shadows", pixels.sizes[c.view]);
    snprintf(pixels.fixed, sizeof pixels.fixed, "%d VSGLs; no shadows", light_counts[0]);
    growth_measure(to, &lights);
    growth_measure(to, &pixels);
    for (i = 0; i < SIZES; i++) {
        light_set_free(&c.sets[i]);
        free(c.views[i].texels);
    }
    free(c.radiance);
}
