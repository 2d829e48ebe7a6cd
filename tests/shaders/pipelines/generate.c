/* Pyramids, and lights of an RSM. */
#include "../../../examples/common/fail.h"
#include "../../../examples/common/gpu_generate.h"
#include "../../../examples/common/gpu_halve.h"
#include "../../../examples/common/hash.h"
#include "../../../examples/common/vsgl_shade.h"
#include "pipelines.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- pyramids ---- */

typedef enum { KIND_IMAGE, KIND_PDF, KIND_DARK } pyramid_kind;

/* Texels of either sign, some of them bad; in the last kind all are nothing to a PDF */
static void fill_texels(float *texels, int count, pyramid_kind kind) {
    static const float bad[] = {INFINITY, -INFINITY, NAN, 0x1p96f, 0x1.fffffep95f, 0x1p-96f, 0x1.fffffep-97f, -2};
    static const float dark[] = {0, -3, NAN, 0x1p-97f, INFINITY};
    int i;
    for (i = 0; i < count; i++) {
        const float random = (float)(hash_mix((unsigned)i) >> 8) * 0x1p-24f;
        texels[i] = kind == KIND_PDF ? random * random : 2 * random - 1;
        if (i % 41 == 7 && count > 100) texels[i] = bad[i / 41 % 8];
        if (i % 41 == 7 && texels[i] > 0x1p90f && i / 41 % 16 < 8) texels[i] = 0; /* it outweighs the others */
        if (kind == KIND_DARK) texels[i] = dark[i % 5];
    }
}

/* Largest error of a level's texel over the texels' magnitude that it is made of */
static double compare_pyramids(const float *got, const float *wanted, const float *magnitudes, size_t count) {
    double worst = 0;
    size_t i;
    for (i = 0; i < count; i++) {
        const double error = fabs((double)got[i] - (double)wanted[i]);
        worst = fmax(worst, magnitudes[i] > 0 ? error / (double)magnitudes[i] : error > 0 ? 1 : 0);
        if (got[i] != got[i]) worst = 1;
    }
    return worst;
}

/* Largest difference between what the fragment shader draws and the compute shader wrote */
static double compare_drawn(gpu_halve *h, gpu_buffer *texels, const fis_pyramid *p, const float *built) {
    float *pixels = (float *)allocate("pixels", 4 * (size_t)p->width * (size_t)p->height, sizeof *pixels);
    double worst = 0;
    int level, plane, i, c;
    for (level = 1; level < p->levels; level++) {
        const int count = p->offset[level + 1 < p->levels ? level + 1 : level] - p->offset[level];
        for (plane = 0; 4 * plane < p->channels; plane++) {
            gpu_halve_draw(h, texels, p->width, p->height, p->channels, level, plane, pixels);
            for (i = 0; i < (count ? count : 1); i++)
                for (c = 0; c < 4 && 4 * plane + c < p->channels; c++)
                    worst = fmax(worst, fabs((double)pixels[4 * i + c] -
                                             (double)built[(p->offset[level] + i) * p->channels + 4 * plane + c]));
        }
    }
    free(pixels);
    return worst;
}

static void compare_halved(gpu *device, gpu_halve *h, int width, int height, int channels, pyramid_kind kind) {
    static const char *const names[] = {"an image", "a PDF", "a PDF without mass"};
    const size_t size = fis_pyramid_size(width, height, channels);
    const int texels = width * height * channels, is_pdf = kind != KIND_IMAGE;
    float *wanted = (float *)allocate("pyramid", size, sizeof *wanted);
    float *magnitudes = (float *)allocate("pyramid", size, sizeof *magnitudes);
    float *got = (float *)allocate("pyramid", size, sizeof *got);
    gpu_buffer *on_device = gpu_buffer_create(device, GPU_STORAGE, size * sizeof *got);
    char line[128];
    fis_pyramid p;
    double error, drawn;
    int i;
    memset(got, 0xFF, size * sizeof *got); /* NaN, where nothing is written */
    fill_texels(got, texels, kind);
    p = is_pdf ? fis_build_pdf(wanted, got, width, height) : fis_build(wanted, got, width, height, channels);
    for (i = 0; i < texels; i++) magnitudes[i] = fabsf(wanted[i]);
    fis_build(magnitudes, magnitudes, width, height, channels);
    gpu_buffer_write(on_device, got);
    gpu_halve_build(h, on_device, width, height, channels, is_pdf);
    gpu_buffer_read(on_device, got);
    error = compare_pyramids(got, wanted, magnitudes, size);
    drawn = compare_drawn(h, on_device, &p, got);
    snprintf(line, sizeof line, "pyramid of %s, %dx%d texels of %d: error %.2g, drawn %.2g", names[kind], width, height,
             channels, error, drawn);
    pipeline_check(line, error <= 1e-6 && drawn <= 1e-6);
    gpu_buffer_free(on_device);
    free(wanted);
    free(magnitudes);
    free(got);
}

static void compare_all_halved(gpu *device, const char *folder) {
    static const int sizes[][2] = {{1, 1}, {5, 1}, {1, 97}, {64, 64}, {128, 32}, {200, 255}};
    gpu_halve *h = gpu_halve_create(device, folder);
    size_t i;
    for (i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        compare_halved(device, h, sizes[i][0], sizes[i][1], 3, KIND_IMAGE);
        compare_halved(device, h, sizes[i][0], sizes[i][1], 1, KIND_PDF);
        compare_halved(device, h, sizes[i][0], sizes[i][1], 1, KIND_DARK);
    }
    compare_halved(device, h, 37, 53, 16, KIND_IMAGE);
    gpu_halve_free(h);
}

/* ---- lights ---- */

enum { WIDTH = 48, HEIGHT = 36 };

typedef struct {
    double position, variance, axis, sharpness, intensity;
} errors;

static double distance(vec3 a, vec3 b) {
    return (double)vec3_length(lobe_sub(a, b));
}

static double worst_of(const errors *e) {
    return fmax(fmax(fmax(e->position, e->variance), fmax(e->axis, e->sharpness)), e->intensity);
}

/* Position in metres, variance in their squares. Sharpness and intensity are relative, by what cancels when sharpness is
   told from a mean direction. */
static errors compare_lights(const vsgl *a, const vsgl *b) {
    errors e = {0, 0, 0, 0, 0};
    int k;
    e.position = distance(a->position, b->position);
    e.variance = fabs((double)(a->variance - b->variance));
    for (k = 0; k < 2; k++) {
        const double sharpness = (double)b->emission[k].sharpness, size = (double)vec3_length(b->intensity[k]);
        const double apart = distance(a->intensity[k], b->intensity[k]);
        if (size <= 0) {
            e.intensity = fmax(e.intensity, apart);
            continue;
        }
        e.axis = fmax(e.axis, distance(a->emission[k].axis, b->emission[k].axis));
        e.sharpness =
            fmax(e.sharpness, fabs((double)a->emission[k].sharpness - sharpness) / (1 + sharpness) / (1 + sharpness));
        e.intensity = fmax(e.intensity, apart / size / (1 + sharpness));
    }
    return e;
}

/* Where rounding decides between two texels or two sizes, a light is another one: that may be so in one of 200. */
static void check_lights(const char *what, const vsgl *got, const vsgl *wanted, int count) {
    errors most = {0, 0, 0, 0, 0};
    char line[256];
    int i, others = 0;
    for (i = 0; i < count; i++) {
        const errors e = compare_lights(&got[i], &wanted[i]);
        if (!(worst_of(&e) < 1e-3)) {
            others++;
            continue;
        }
        most.position = fmax(most.position, e.position);
        most.variance = fmax(most.variance, e.variance);
        most.axis = fmax(most.axis, e.axis);
        most.sharpness = fmax(most.sharpness, e.sharpness);
        most.intensity = fmax(most.intensity, e.intensity);
    }
    snprintf(line, sizeof line,
             "%s: position %.1g, variance %.1g, axis %.1g, sharpness %.1g, intensity %.1g; %d of %d lights are others",
             what, most.position, most.variance, most.axis, most.sharpness, most.intensity, others, count);
    pipeline_check(line, others * 200 <= count);
}

typedef struct {
    const char *name;
    int rsm_size, count;
    float k;
    int own_pdf; /* unlike the flux */
} light_case;

static void compare_case(gpu *device, const char *folder, const scene *world, const vpl_map *view,
                         const light_case *c) {
    buffer seen = buffer_rsm(world, c->rsm_size);
    vpl_map rsm = vpl_map_create(&seen, world->center);
    const int texels = rsm.width * rsm.height;
    float *pdf = (float *)allocate("PDF", (size_t)texels, sizeof *pdf);
    generator g = generator_create(rsm.width, rsm.height, c->count);
    light_set set = light_set_create(c->count);
    gpu_generate *on_device = gpu_generate_create(device, folder, &rsm, world->spot.position, c->count);
    vsgl *lights = (vsgl *)allocate("lights", (size_t)c->count, sizeof *lights);
    image wanted = image_create(view->width, view->height), got = image_create(view->width, view->height);
    int how, i;
    for (i = 0; i < texels; i++) {
        const float random = (float)(hash_mix((unsigned)i) >> 8) * 0x1p-24f;
        pdf[i] = vpl_weight(&rsm.texels[i]) * (c->own_pdf ? random * random : 1);
    }
    for (how = METHOD_NEAREST; how <= METHOD_FAST; how++) {
        char what[128];
        vsgl_generate(&g, &rsm, pdf, (method)how, c->k, 1, &set);
        gpu_generate_run(on_device, c->own_pdf ? pdf : NULL, (method)how, c->k, 1, c->count);
        gpu_generate_read(on_device, lights, c->count);
        snprintf(what, sizeof what, "lights %s, %s", c->name, method_names[how]);
        check_lights(what, lights, set.lights, c->count);
        vsgl_shade(view, set.lights, NULL, c->count, wanted.pixels, "CPU");
        vsgl_shade(view, lights, NULL, c->count, got.pixels, "GPU's lights");
        pipeline_picture(what, &got, &wanted, 2.2f);
    }
    image_free(&wanted);
    image_free(&got);
    free(lights);
    gpu_generate_free(on_device);
    light_set_free(&set);
    generator_free(&g);
    free(pdf);
    free(rsm.texels);
    buffer_free(&seen);
}

void pipeline_generate(gpu *device, const char *folder) {
    static const light_case cases[] = {{"of an RSM", 128, 400, 1, 0},
                                       {"of an odd RSM, by a noisy PDF, large kernels", 127, 300, 4, 1},
                                       {"below a texel", 33, 600, 0.25f, 0},
                                       {"of one texel", 1, 3, 1, 0}};
    const scene room = scene_room();
    buffer seen = buffer_camera(&room, WIDTH, HEIGHT);
    vpl_map view = vpl_map_create(&seen, room.center);
    size_t i;
    compare_all_halved(device, folder);
    for (i = 0; i < sizeof cases / sizeof *cases; i++) compare_case(device, folder, &room, &view, &cases[i]);
    free(view.texels);
    buffer_free(&seen);
}
