/*
 gpu.c - the shaders on a Vulkan device beside the same in C on the CPU: pictures, their difference, and times

 Shading with virtual spherical Gaussian lights and their shadow maps (papers 000 and 001, section 4), and the lobe-aware
 cross bilateral filter (004, Eq. 12), by the compute and the fragment shaders of both languages.
*/
#include "../fis.h"
#include "common/buffers.h"
#include "common/fail.h"
#include "common/glossy_frame.h"
#include "common/gpu_filter.h"
#include "common/gpu_shade.h"
#include "common/image.h"
#include "common/options.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/vpl.h"
#include "common/vsgl_generate.h"
#include "common/vsgl_shade.h"
#include <stdio.h>
#include <stdlib.h>

enum {
    RSM_SIZE = 512,
    SAMPLES = 8,
    MOST_RUNS = 15,
    LEAST_RUNS = 3,
    LIMIT_MS = 2000,
    STAGES_OF_SHADERS = 2,
    LANGUAGES = 2,
    DIFFERENCE_SCALE = 100000
};

const char *const program_name = "gpu";

static const char *const languages[LANGUAGES] = {"glsl", "hlsl"};
static const char *const stages[STAGES_OF_SHADERS] = {"compute", "fragment"};

typedef struct {
    option_size size;
    int lights, seed;
    const char *device, *shaders, *out;
} settings;

/* ---- one work, of the CPU and of the device ---- */

enum { PICTURE_CPU, PICTURE_GPU, PICTURE_DIFFERENCE, PICTURES };

typedef struct {
    const char *name;
    const char *endings[PICTURES]; /* of the pictures' names */
    float exposure;
    image wanted, got, worst; /* worst: of the device's that with the lowest PSNR */
    double cpu_ms, lowest;
} work;

static void work_check(const work *w, const settings *o) {
    int i;
    for (i = 0; i < PICTURES; i++) output_check(o->out, w->endings[i]);
}

static void work_begin(work *w, int width, int height) {
    w->wanted = image_create(width, height);
    w->got = image_create(width, height);
    w->worst = image_create(width, height);
    w->lowest = 1e30;
}

/* What a device does; returns the milliseconds that it took. */
typedef double (*device_run)(void *prepared, gpu_stage stage, vec3 *pixels);

/* The picture that is wanted, and how long it takes */
static void measure_cpu(work *w, void (*run)(const void *task, image *picture), const void *task) {
    timing t = {0};
    run(task, &w->wanted); /* touches the memory */
    while (timing_goes_on(&t, LEAST_RUNS, MOST_RUNS, LIMIT_MS)) {
        const double started = progress_clock();
        run(task, &w->wanted);
        timing_add(&t, progress_clock() - started);
    }
    w->cpu_ms = progress_median(t.ms, t.count);
}

/* Once the shaders are there, and nothing wrong with what was asked for */
static void print_head(const settings *o) {
    printf("%dx%d pixels, %d lights; milliseconds are medians of %d to %d runs, for the device with the least and the "
           "most\n\n",
           o->size.width, o->size.height, o->lights, LEAST_RUNS, MOST_RUNS);
    printf("work         language stage       GPU ms     least      most    CPU ms  CPU/GPU    PSNR  device\n");
    fflush(stdout);
}

/* Runs the shaders of a language, and prints a line for each stage. */
static void measure(work *w, const gpu *device, const char *language, device_run run, void *prepared) {
    int stage;
    for (stage = 0; stage < STAGES_OF_SHADERS; stage++) {
        timing t = {0};
        double median, psnr;
        char label[64];
        progress line;
        snprintf(label, sizeof label, "%s, %s %s", w->name, language, stages[stage]);
        line = progress_begin(label, LEAST_RUNS + 1);
        run(prepared, (gpu_stage)stage, w->got.pixels); /* compiles as well */
        progress_step(&line);
        while (timing_goes_on(&t, LEAST_RUNS, MOST_RUNS, LIMIT_MS)) {
            timing_add(&t, run(prepared, (gpu_stage)stage, w->got.pixels));
            if (t.count <= LEAST_RUNS) progress_step(&line);
        }
        progress_end(&line);
        median = progress_median(t.ms, t.count);
        psnr = image_psnr(&w->got, &w->wanted, w->exposure);
        printf("%-12s %-8s %-8s %9.3f %9.3f %9.3f %9.3f %8.2f %7.1f  %s\n", w->name, language, stages[stage], median,
               t.ms[0], t.ms[t.count - 1], w->cpu_ms, w->cpu_ms / median, psnr, gpu_name(device));
        fflush(stdout);
        if (psnr >= w->lowest) continue;
        w->lowest = psnr;
        image_paste(&w->worst, &w->got, 0, 0);
    }
}

static void work_end(work *w, const settings *o) {
    int i;
    for (i = 0; i < w->got.width * w->got.height; i++) {
        vec3 d = lobe_scale(lobe_sub(w->worst.pixels[i], w->wanted.pixels[i]), DIFFERENCE_SCALE);
        w->got.pixels[i] = lobe_vector(fabsf(d.x), fabsf(d.y), fabsf(d.z));
    }
    output_picture(o->out, w->endings[PICTURE_CPU], &w->wanted, w->exposure);
    output_picture(o->out, w->endings[PICTURE_GPU], &w->worst, w->exposure);
    output_picture(o->out, w->endings[PICTURE_DIFFERENCE], &w->got, w->exposure);
    printf("wrote %s%s, %s%s and %s%s: the difference times %d of the pair with the lowest PSNR\n", o->out,
           w->endings[PICTURE_CPU], o->out, w->endings[PICTURE_GPU], o->out, w->endings[PICTURE_DIFFERENCE],
           DIFFERENCE_SCALE);
    image_free(&w->wanted);
    image_free(&w->got);
    image_free(&w->worst);
}

/* ---- shading ---- */

static light_set generate_lights(const scene *world, const settings *o) {
    buffer seen = buffer_rsm(world, RSM_SIZE);
    vpl_map rsm = vpl_map_create(&seen, world->center);
    float *flux = (float *)allocate("PDF", RSM_SIZE * RSM_SIZE, sizeof *flux);
    generator g = generator_create(RSM_SIZE, RSM_SIZE, o->lights);
    light_set set = light_set_create(o->lights);
    int i;
    for (i = 0; i < RSM_SIZE * RSM_SIZE; i++) flux[i] = vpl_weight(&rsm.texels[i]);
    vsgl_generate(&g, &rsm, flux, METHOD_FAST, 1, (unsigned)o->seed, &set);
    generator_free(&g);
    free(flux);
    free(rsm.texels);
    buffer_free(&seen);
    return set;
}

typedef struct {
    const vpl_map *view;
    const light_set *set;
    const shadow_map *maps;
} shade_task;

static void shade_on_cpu(const void *task, image *picture) {
    const shade_task *t = (const shade_task *)task;
    vsgl_shade(t->view, t->set->lights, t->maps, t->set->count, picture->pixels, "VSGL shading, CPU");
}

static double run_shade(void *prepared, gpu_stage stage, vec3 *pixels) {
    return gpu_shade_run((gpu_shade *)prepared, stage, pixels);
}

static void compare_shading(work *w, gpu *device, const settings *o) {
    const scene world = scene_room();
    buffer seen = buffer_camera(&world, o->size.width, o->size.height);
    vpl_map view = vpl_map_create(&seen, world.center);
    light_set set = generate_lights(&world, o);
    shadow_map *maps = (shadow_map *)allocate("shadow maps", (size_t)set.count, sizeof *maps);
    gpu_shade *prepared[LANGUAGES];
    shade_task task;
    char folder[OUTPUT_NAME];
    int i;
    vsgl_shadow_maps(&world, set.lights, set.count, maps);
    for (i = 0; i < LANGUAGES; i++) {
        output_name(folder, o->shaders, i ? "/hlsl" : "/glsl");
        prepared[i] = gpu_shade_create(device, folder, &view, world.eye.position, set.lights, maps, set.count);
    }
    print_head(o);
    work_begin(w, o->size.width, o->size.height);
    task.view = &view;
    task.set = &set;
    task.maps = maps;
    measure_cpu(w, shade_on_cpu, &task);
    for (i = 0; i < LANGUAGES; i++) {
        measure(w, device, languages[i], run_shade, prepared[i]);
        gpu_shade_free(prepared[i]);
    }
    free(maps);
    light_set_free(&set);
    free(view.texels);
    buffer_free(&seen);
}

/* ---- filter ---- */

typedef struct {
    const filter_planes *planes;
    const guide *guides;
} filter_task;

static const filter_method lobes = FILTER_EQ12;
static const float beta = 2;

static void filter_on_cpu(const void *task, image *picture) {
    const filter_task *t = (const filter_task *)task;
    filter_frame(t->planes, t->guides, lobes, &beta, filter_depth_variance, picture);
}

static double run_filter(void *prepared, gpu_stage stage, vec3 *pixels) {
    return gpu_filter_run((gpu_filter *)prepared, stage, pixels);
}

static void compare_filter(work *w, gpu *device, const settings *o) {
    static const subject tiles = {"tiles", scene_gallery, look_tiles, 0};
    const scene world = scene_gallery();
    frame f = frame_of(&world, &tiles, o->size.width, o->size.height);
    image noisy = shade_frame(&f, SAMPLES, (unsigned)o->seed, 0, "noisy light");
    filter_planes *planes =
        filter_planes_create(f.width, f.height, FILTER_RADIUS, filter_most_parts(f.guides, f.width * f.height));
    filter_task task;
    int i;
    filter_fill_colours(planes, &noisy);
    work_begin(w, f.width, f.height);
    task.planes = planes;
    task.guides = f.guides;
    measure_cpu(w, filter_on_cpu, &task);
    for (i = 0; i < LANGUAGES; i++) {
        char folder[OUTPUT_NAME];
        gpu_filter *prepared;
        output_name(folder, o->shaders, i ? "/hlsl" : "/glsl");
        prepared = gpu_filter_create(device, folder, &noisy, f.guides, lobes, beta, filter_depth_variance);
        measure(w, device, languages[i], run_filter, prepared);
        gpu_filter_free(prepared);
    }
    filter_planes_free(planes);
    image_free(&noisy);
    frame_free(&f);
}

/* ---- */

int main(int argc, char **argv) {
    settings o = {{256, 192}, 256, 1, NULL, "build/shaders", "build/gpu"};
    work shading = {
        "VSGL shading", {"-shade-cpu.png", "-shade-gpu.png", "-shade-difference.png"}, 2.2f, {0}, {0}, {0}, 0, 0};
    work filter = {
        "lobe filter", {"-filter-cpu.png", "-filter-gpu.png", "-filter-difference.png"}, 1, {0}, {0}, {0}, 0, 0};
    const option options[] = {
        OPTION_OF_SIZE(&o.size),
        {"--lights N", OPTION_WHOLE, &o.lights, 1, 65536, "virtual lights that shade", 0},
        {"--device NAME", OPTION_TEXT, &o.device, 0, 0,
         "a Vulkan device whose name contains it, else a GPU, else a CPU's driver", 0},
        {"--shaders FOLDER", OPTION_TEXT, &o.shaders, 0, 0, "where glsl/ and hlsl/ with the shaders in SPIR-V are", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    gpu *device;
    options_read(options, argc, argv,
                 "Runs the shaders on a Vulkan device and the same in C on the CPU, and prints times and what the\n"
                 "pictures differ by.");
    work_check(&shading, &o);
    work_check(&filter, &o);
    device = gpu_open(o.device ? o.device : "");
    compare_shading(&shading, device, &o);
    compare_filter(&filter, device, &o);
    printf("\n");
    work_end(&shading, &o);
    work_end(&filter, &o);
    gpu_close(device);
    return 0;
}
