#include "../../../examples/common/fail.h"
#include "../../../examples/common/glossy_frame.h"
#include "../../../examples/common/gpu_filter.h"
#include "pipelines.h"
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 156, HEIGHT = 116, SAMPLES = 4 }; /* whole cells, but no multiples of a workgroup's 8 */

static const char *const stages[2] = {"compute", "fragment"};

typedef struct {
    subject what;
    filter_method method;
    const char *weight;
    float parameter;
} setting;

static void run_both(gpu_filter *f, const char *what, const setting *s, const image *wanted) {
    image got = image_create(WIDTH, HEIGHT);
    int stage;
    for (stage = 0; stage < 2; stage++) {
        char line[128];
        gpu_filter_run(f, (gpu_stage)stage, got.pixels);
        snprintf(line, sizeof line, "%s of the %s by %s, %s", what, s->what.name, s->weight, stages[stage]);
        pipeline_picture(line, &got, wanted, 1);
    }
    gpu_filter_free(f);
    image_free(&got);
}

static void compare_filters(gpu *device, const char *folder) {
    static const setting settings[] = {
        {{"tiles", scene_gallery, look_tiles, 0}, FILTER_NORMAL, "normals", 0.01f},
        {{"tiles", scene_gallery, look_tiles, 0}, FILTER_EQ12, "SGs", 2},
        {{"layers", scene_gallery, look_layers, 0}, FILTER_EQ11, "SG mixtures", 2},
        {{"brushed metal", scene_gallery, look_brushed, 0}, FILTER_EQ13, "ASGs", 2},
    };
    int i;
    for (i = 0; i < (int)(sizeof settings / sizeof *settings); i++) {
        const setting *s = &settings[i];
        const scene world = s->what.build();
        frame f = frame_of(&world, &s->what, WIDTH, HEIGHT);
        image noisy = shade_frame(&f, SAMPLES, 1, 0, s->what.name), wanted = image_create(WIDTH, HEIGHT);
        filter_planes *room =
            filter_planes_create(WIDTH, HEIGHT, FILTER_RADIUS, filter_most_parts(f.guides, WIDTH * HEIGHT));
        filter_fill_colours(room, &noisy);
        filter_frame(room, f.guides, s->method, &s->parameter, filter_depth_variance, &wanted);
        pipeline_check("the filter changes the picture", image_psnr(&noisy, &wanted, 1) < 40);
        run_both(gpu_filter_create(device, folder, &noisy, f.guides, s->method, s->parameter, filter_depth_variance),
                 "filter", s, &wanted);
        filter_planes_free(room);
        image_free(&noisy);
        image_free(&wanted);
        frame_free(&f);
    }
}

static void compare_upsampling(gpu *device, const char *folder) {
    static const setting settings[] = {
        {{"tiles", scene_gallery, look_tiles, 0}, FILTER_NORMAL, "normals", 0.01f},
        {{"tiles", scene_gallery, look_tiles, 0}, FILTER_EQ12, "SGs", 20},
        {{"brushed metal", scene_gallery, look_brushed, 0}, FILTER_EQ13, "ASGs", 2},
    };
    int i, x, y;
    for (i = 0; i < (int)(sizeof settings / sizeof *settings); i++) {
        const setting *s = &settings[i];
        const scene world = s->what.build();
        frame f = frame_of(&world, &s->what, WIDTH, HEIGHT);
        image wanted = image_create(WIDTH, HEIGHT);
        coarse low;
        low.width = WIDTH / UPSAMPLE_CELL;
        low.height = HEIGHT / UPSAMPLE_CELL;
        low.column = 1;
        low.row = 2;
        low.colours = (vec3 *)allocate("images", (size_t)(low.width * low.height), sizeof *low.colours);
        for (y = 0; y < low.height; y++) {
            for (x = 0; x < low.width; x++)
                low.colours[y * low.width + x] = shade_pixel(
                    &f, (y * UPSAMPLE_CELL + low.row) * WIDTH + x * UPSAMPLE_CELL + low.column, 2 * SAMPLES, 1, 1);
        }
        for (y = 0; y < HEIGHT; y++) {
            for (x = 0; x < WIDTH; x++) {
                vec3 *to = &wanted.pixels[y * WIDTH + x];
                if (f.guides[y * WIDTH + x].valid)
                    upsample_pixel(s->method, s->parameter, f.guides, WIDTH, &low, x, y, to);
            }
        }
        run_both(gpu_upsample_create(device, folder, &low, WIDTH, HEIGHT, f.guides, s->method, s->parameter),
                 "upsampling", s, &wanted);
        free(low.colours);
        image_free(&wanted);
        frame_free(&f);
    }
}

void pipeline_filter(gpu *device, const char *folder) {
    compare_filters(device, folder);
    compare_upsampling(device, folder);
}
