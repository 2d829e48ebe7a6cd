/* Virtual SG lights from an RSM or a G-buffer: against texels and against lights. */
#include "growth.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/vsgl_generate.h"
#include <stdio.h>
#include <stdlib.h>

enum { SUBJECTS = 3, TEXEL_SIZES = 5, LIGHT_SIZES = 7, RSM_SIZE = 512, LIGHTS = 64 };
static const method methods[SUBJECTS] = {METHOD_FAST, METHOD_SPLIT, METHOD_KMEANS_2D};
static const char *const names[SUBJECTS + 1] = {"filtered sampling", "cells of equal mass", "k-means", NULL};
static const int edges[TEXEL_SIZES] = {128, 224, 400, 720, 1280};
static const int light_counts[LIGHT_SIZES] = {10, 30, 100, 300, 1000, 3000, 10000};

/* A map with its PDF, and room for lights of it */
typedef struct {
    vpl_map map;
    float *pdf;
    generator g;
    light_set set;
} source;

static source source_of(buffer *seen, vec3 center, int most) {
    source s;
    int i;
    s.map = vpl_map_create(seen, center);
    s.pdf = (float *)allocate("PDF", (size_t)(seen->width * seen->height), sizeof *s.pdf);
    s.g = generator_create(seen->width, seen->height, most);
    s.set = light_set_create(most);
    for (i = 0; i < seen->width * seen->height; i++) s.pdf[i] = vpl_weight(&s.map.texels[i]);
    buffer_free(seen);
    return s;
}

static void free_source(source *s) {
    free(s->map.texels);
    free(s->pdf);
    generator_free(&s->g);
    light_set_free(&s->set);
}

static void generate(const source *from, int subject, int count) {
    source s = *from;
    s.set.count = count;
    vsgl_generate(&s.g, &s.map, s.pdf, methods[subject], 1, 0, &s.set);
}

static void run_texels(void *of, int subject, int which) {
    generate((source *)of + which, subject, LIGHTS);
}

static void run_lights(void *of, int subject, int which) {
    generate((source *)of, subject, light_counts[which]);
}

static void measure_texels(growth_report *to, const scene *world) {
    source sources[TEXEL_SIZES];
    growth g = growth_of("VSGL generation", "texels", run_texels, sources);
    int i;
    for (i = 0; i < SUBJECTS; i++) g.subjects[i] = names[i];
    for (i = 0; i < TEXEL_SIZES; i++) {
        buffer seen = buffer_rsm(world, edges[i]);
        sources[i] = source_of(&seen, world->center, LIGHTS);
        g.sizes[i] = edges[i] * edges[i];
    }
    snprintf(g.fixed, sizeof g.fixed, "%d VSGLs", LIGHTS);
    growth_measure(to, &g);
    for (i = 0; i < TEXEL_SIZES; i++) free_source(&sources[i]);
}

/* The straight line through the times, by least squares of relative departures, and the lights at which it is 10 % above
   its value at the fewest */
static void print_independence(const growth *g, int subject) {
    double weight = 0, x = 0, y = 0, xx = 0, xy = 0, each, fixed;
    int i;
    for (i = 0; g->sizes[i] > 0; i++) {
        const double t = g->times[subject][i].median, w = 1 / (t * t);
        weight += w;
        x += w * g->sizes[i];
        y += w * t;
        xx += w * g->sizes[i] * g->sizes[i];
        xy += w * g->sizes[i] * t;
    }
    each = (weight * xy - x * y) / (weight * xx - x * x);
    fixed = (y - each * x) / weight;
    printf("%s: %.3g ms and %.3g us a light; at most 10 %% more than for %.0f lights up to %.2g\n",
           g->subjects[subject], fixed, 1e3 * each, g->sizes[0], 1.1 * g->sizes[0] + 0.1 * fixed / each);
    fflush(stdout);
}

static void measure_lights(growth_report *to, buffer *seen, vec3 center, const char *const *subjects) {
    const int width = seen->width, height = seen->height;
    source s = source_of(seen, center, light_counts[LIGHT_SIZES - 1]);
    growth g = growth_of("VSGL generation", "lights", run_lights, &s);
    int i;
    for (i = 0; subjects[i]; i++) g.subjects[i] = subjects[i];
    for (i = 0; i < LIGHT_SIZES; i++) g.sizes[i] = light_counts[i];
    snprintf(g.fixed, sizeof g.fixed, "%dx%d texels", width, height);
    growth_measure(to, &g);
    print_independence(&g, 0);
    free_source(&s);
}

void growth_generation(growth_report *to) {
    static const char *const of_view[] = {"filtered sampling (G-buffer)", NULL};
    const scene world = scene_room();
    const int part = to->quick ? 2 : 1;
    buffer seen = buffer_rsm(&world, RSM_SIZE / part);
    measure_lights(to, &seen, world.center, names);
    seen = buffer_camera(&world, 1920 / part, 1088 / part); /* the paper's */
    measure_lights(to, &seen, world.center, of_view);
    measure_texels(to, &world);
}
