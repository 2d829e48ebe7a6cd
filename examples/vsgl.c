/*
 vsgl.c - one-bounce glossy indirect light from virtual spherical Gaussian lights

 The pipeline and the experiment of Tokuyoshi 2016, Modified Filtered Importance Sampling for Virtual Spherical Gaussian
 Lights (paper 002): RSM rendering, PDF building, VSGL generation, shadow map rendering and shading. Lights are generated
 by filtered importance sampling with the kernel sizes of Krivanek and Colbert, of the paper and of fis.h, by cells of
 equal mass, and by k-means; for three PDFs. All are compared with path tracing, and over frames for their flicker. With
 an RSM from files instead, the lights are written as text.
*/
#include "../asg.h"
#include "../fis.h"
#include "common/brdf.h"
#include "common/buffers.h"
#include "common/fail.h"
#include "common/file.h"
#include "common/image.h"
#include "common/options.h"
#include "common/parallel.h"
#include "common/path_trace.h"
#include "common/progress.h"
#include "common/shadow_map.h"
#include "common/vpl.h"
#include "common/vsgl_generate.h"
#include "common/vsgl_inspect.h"
#include "common/vsgl_shade.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RSM_SIZE = 512,
    REPEATS = 9,          /* of timings */
    KERNELS_SHOWN = 256,  /* in a panel */
    FINEST_LIGHTS = 8192, /* of what flicker is compared with */
    RECEIVER_STEP = 4,    /* flicker is looked at in pixels this many times as large */
    MAX_ROWS = METHODS * OPTIONS_MAX_LIST * OPTIONS_MAX_LIST
};

const char *const program_name = "vsgl";

typedef enum {
    PDF_FLUX, /* reflected flux */
    PDF_BRSM, /* times the importance for the camera: by view lights, which the G-buffer's texels are clustered into */
    PDFS
} pdf_kind;
static const char *const pdf_names[PDFS] = {"flux", "brsm"};
static const char *const pdf_choices[] = {"both", "flux", "brsm", NULL};
static const char *const scene_choices[] = {"room", "caustic", NULL};

typedef struct {
    int scene, pdf, method;
    option_size size, view;
    option_list lights, kernels;
    option_place light;
    int view_lights, interleave, frames, samples, seed;
    const char *out, *rsm;
} settings;

static method chosen_method(const settings *o) {
    return (method)(o->method - 1);
}

/* ---- the stages, in the paper's order ---- */

static scene choose_scene(const settings *o) {
    return o->scene == 0 ? scene_room() : scene_ring(0.1f);
}

static vpl_map render_rsm(const scene *world) {
    buffer rsm = buffer_rsm(world, RSM_SIZE);
    vpl_map map;
    if (!rsm.texels) give_up("RSM", "not enough memory");
    map = vpl_map_create(&rsm, world->center);
    buffer_free(&rsm);
    return map;
}

/* The camera's G-buffer, as texels that reflect its importance */
static vpl_map render_view(const scene *world, option_size size) {
    buffer view = buffer_camera(world, size.width, size.height);
    vpl_map map;
    if (!view.texels) give_up("G-buffer", "not enough memory");
    map = vpl_map_create(&view, world->center);
    buffer_free(&view);
    return map;
}

static int texel_count(const vpl_map *map) {
    return map->width * map->height;
}

/* Reflectance in a G-buffer, reflected flux in an RSM */
static float *weights_of(const vpl_map *map) {
    float *weights = (float *)allocate("PDF", (size_t)texel_count(map), sizeof *weights);
    int i;
    for (i = 0; i < texel_count(map); i++) weights[i] = vpl_weight(&map->texels[i]);
    return weights;
}

/* PDF building on the RSM. By the bidirectional method it is what each texel contributes to the view: view lights cast
   the camera's importance on it, without shadows, and it reflects some towards the light. The frame changes which of
   the view lights an texel takes. */
static float *build_pdf(const vpl_map *rsm, const light_set *view_lights, pdf_kind kind, int frame, const settings *o) {
    float *pdf = weights_of(rsm);
    vec3 *importance;
    int i;
    if (kind == PDF_FLUX) return pdf;
    importance = (vec3 *)allocate("PDF", (size_t)texel_count(rsm), sizeof *importance);
    vsgl_shade_interleaved(rsm, view_lights->lights, view_lights->count, o->interleave,
                           (unsigned)o->seed + (unsigned)frame, importance, "PDF");
    for (i = 0; i < texel_count(rsm); i++) pdf[i] = lobe_mean(importance[i]);
    free(importance);
    return pdf;
}

/* VSGL generation on the G-buffer, by its reflectance */
static light_set generate_view_lights(const vpl_map *view, const settings *o) {
    generator g = generator_create(view->width, view->height, o->view_lights);
    light_set set = light_set_create(o->view_lights);
    float *reflectance = weights_of(view);
    vsgl_generate(&g, view, reflectance, METHOD_FAST, 1, (unsigned)o->seed, &set);
    free(reflectance);
    generator_free(&g);
    return set;
}

/* A shadow map at the mean of each light. Its own extent does not shade it. */
static void render_shadow_maps(const scene *world, const light_set *set, shadow_map *maps) {
    progress line = progress_begin("shadow maps", set->count);
    int i;
    PARALLEL_FOR
    for (i = 0; i < set->count; i++) {
        shadow_map_render(&maps[i], world, set->lights[i].position, 0.01f + sqrtf(set->lights[i].variance));
        progress_step(&line);
    }
    progress_end(&line);
}

/* ---- what surrounds the pipeline ---- */

static void light_directly(const scene *world, const buffer *view, image *direct) {
    progress line = progress_begin("direct light", view->height);
    int row;
    PARALLEL_FOR
    for (row = 0; row < view->height; row++) {
        int i;
        for (i = row * view->width; i < (row + 1) * view->width; i++) {
            const texel *t = &view->texels[i];
            if (t->valid) direct->pixels[i] = brdf_lit_by_spot(world, &t->hit, t->view);
        }
        progress_step(&line);
    }
    progress_end(&line);
}

static image make_image(int width, int height) {
    image picture = image_create(width, height);
    if (!picture.pixels) give_up("images", "not enough memory");
    return picture;
}

/* Indirect light by path tracing, in two halves whose difference tells the noise. */
static image trace_reference(const scene *world, const buffer *view, const settings *o) {
    const double started = progress_clock();
    image reference = make_image(view->width, view->height), half = make_image(view->width, view->height);
    double noise;
    int i;
    if (!path_trace_indirect(world, view, o->samples / 2, 2 * (unsigned)o->seed, reference.pixels,
                             "reference, first half") ||
        !path_trace_indirect(world, view, o->samples / 2, 2 * (unsigned)o->seed + 1, half.pixels,
                             "reference, second half"))
        give_up("reference", "not enough memory");
    noise = image_rmse(&reference, &half) / 2;
    for (i = 0; i < view->width * view->height; i++)
        reference.pixels[i] = lobe_scale(lobe_add(reference.pixels[i], half.pixels[i]), 0.5f);
    image_free(&half);
    printf("reference: %dx%d pixels, %d paths each, %.0f ms, its own noise has an RMSE of about %.2g\n", view->width,
           view->height, o->samples / 2 * 2, progress_clock() - started, noise);
    fflush(stdout);
    return reference;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *times) {
    qsort(times, REPEATS, sizeof *times, ascending);
    return times[REPEATS / 2];
}

/* ---- how long generation takes: tables 1 and 2 ---- */

typedef struct {
    double ms[METHODS][STAGES];
} generation_times;

/* Medians. The methods take turns, so that what else the machine does meets all of them. */
static generation_times time_generation(const vpl_map *map, const float *pdf, int count, const settings *o,
                                        const char *label) {
    static double times[METHODS][STAGES][REPEATS];
    generator g = generator_create(map->width, map->height, count);
    light_set set = light_set_create(count);
    progress line = progress_begin(label, REPEATS * METHODS);
    generation_times result;
    int i, how, stage;
    memset(&result, 0, sizeof result);
    for (i = -1; i < REPEATS; i++) { /* the first touches the memory */
        for (how = 0; how < METHODS; how++) {
            vsgl_generate(&g, map, pdf, (method)how, 1, (unsigned)o->seed, &set);
            for (stage = 0; stage < STAGES && i >= 0; stage++) times[how][stage][i] = set.ms[stage];
            if (i >= 0) progress_step(&line);
        }
    }
    progress_end(&line);
    for (how = 0; how < METHODS; how++) {
        for (stage = 0; stage < STAGES; stage++) result.ms[how][stage] = median(times[how][stage]);
    }
    light_set_free(&set);
    generator_free(&g);
    return result;
}

static double sum_stages(const generation_times *t, int how) {
    return t->ms[how][0] + t->ms[how][1] + t->ms[how][2];
}

static void print_times(const generation_times *view, const generation_times *light, const char *pdf) {
    const double fast = sum_stages(view, METHOD_FAST) + sum_stages(light, METHOD_FAST);
    const double density = sum_stages(view, METHOD_DENSITY) + sum_stages(light, METHOD_DENSITY);
    double more[METHODS];
    int how;
    for (how = 0; how < METHODS; how++) {
        const double *v = view->ms[how], *l = light->ms[how], both = sum_stages(view, how) + sum_stages(light, how);
        printf("%-5s %-9s %8.3f %8.3f %8.3f  %8.3f %8.3f %8.3f  %8.3f %7.2f %10.2f\n", pdf, method_names[how], v[0],
               v[1], v[2], l[0], l[1], l[2], both, both / fast,
               sum_stages(light, how) / sum_stages(light, METHOD_FAST));
        more[how] = v[STAGE_LIGHTS] - view->ms[METHOD_DENSITY][STAGE_LIGHTS] + l[STAGE_LIGHTS] -
                    light->ms[METHOD_DENSITY][STAGE_LIGHTS];
    }
    /* What comes before their lights is the same code. */
    printf("%-5s takes longer than density: bisection by %.2f %% of all generation, fast by %.2f %%\n", pdf,
           100 * more[METHOD_BISECTION] / density, 100 * more[METHOD_FAST] / density);
    fflush(stdout);
}

static void measure_times(const vpl_map *view, const vpl_map *rsm, float *const pdfs[PDFS], const settings *o) {
    float *reflectance = weights_of(view);
    generation_times on_view = time_generation(view, reflectance, o->view_lights, o, "generation on the G-buffer");
    int kind;
    printf(
        "\nGeneration in ms on one thread, %d lights of a %dx%d G-buffer, then %d of the %dx%d RSM. Texels: sums of\n"
        "each, or its label; pyramid: or table, or sort; lights: or sums of clusters\n",
        o->view_lights, view->width, view->height, o->lights.value[0], rsm->width, rsm->height);
    printf("PDF   method      texels  pyramid   lights    texels  pyramid   lights      both  / fast RSM / fast\n");
    for (kind = 0; kind < PDFS; kind++) {
        generation_times on_rsm;
        if (!pdfs[kind]) continue;
        on_rsm = time_generation(rsm, pdfs[kind], o->lights.value[0], o, "generation on the RSM");
        print_times(&on_view, &on_rsm, pdf_names[kind]);
    }
    free(reflectance);
}

/* ---- how well the lights do ---- */

/* Over the pixels: the root mean square of the standard deviation in time, and the median of it over the radiance */
typedef struct {
    double rms, relative;
} flicker;

typedef struct {
    method how;
    int count;
    float k;
    double generation, visibility, shading, flux, firefly, rmse, relative;
    flicker moving, still; /* of a light that moves; of a PDF whose noise does, alone */
    coverage covered;
} row;

/* What is to be tried: only filtered sampling has sizes of kernels. */
static int plan_rows(const settings *o, row *rows) {
    int count = 0, how, i, k;
    memset(rows, 0, MAX_ROWS * sizeof *rows);
    for (i = 0; i < o->lights.count; i++) {
        for (how = 0; how < METHODS; how++) {
            if (o->method && how != (int)chosen_method(o)) continue;
            for (k = 0; k < (method_is_filtered((method)how) ? o->kernels.count : 1); k++) {
                rows[count].how = (method)how;
                rows[count].count = o->lights.value[i];
                rows[count++].k = method_is_filtered((method)how) ? (float)o->kernels.value[k] : 1;
            }
        }
    }
    return count;
}

static int most_lights(const settings *o) {
    int i, most = 0;
    for (i = 0; i < o->lights.count; i++) most = o->lights.value[i] > most ? o->lights.value[i] : most;
    return most;
}

/* Generates and shades, and says in the row how well. */
static void render(const scene *world, const vpl_map *view, const vpl_map *rsm, const float *pdf, const settings *o,
                   row *r, const image *reference, image *indirect) {
    generator g = generator_create(rsm->width, rsm->height, r->count);
    light_set set = light_set_create(r->count);
    shadow_map *maps = (shadow_map *)allocate("shadow maps", (size_t)r->count, sizeof *maps);
    double total = 0, brightest = 0, power, started;
    char label[64];
    int i;
    vsgl_generate(&g, rsm, pdf, r->how, r->k, (unsigned)o->seed, &set); /* also touches the memory */
    vsgl_generate(&g, rsm, pdf, r->how, r->k, (unsigned)o->seed, &set);
    r->generation = set.ms[0] + set.ms[1] + set.ms[2];
    started = progress_clock();
    render_shadow_maps(world, &set, maps);
    r->visibility = progress_clock() - started;
    started = progress_clock();
    snprintf(label, sizeof label, "%d lights, %s", r->count, method_names[r->how]);
    vsgl_shade(view, set.lights, maps, set.count, indirect->pixels, label);
    r->shading = progress_clock() - started;
    for (i = 0; i < texel_count(rsm); i++) total += (double)vpl_weight(&rsm->texels[i]);
    for (i = 0; i < set.count; i++) {
        power = vsgl_power(&set.lights[i]);
        brightest = power > brightest ? power : brightest;
    }
    r->flux = light_set_power(&set) / total;
    r->firefly = brightest * set.count / total;
    r->rmse = image_rmse(indirect, reference);
    r->relative = image_relative_error(indirect, reference);
    if (!set.labels) r->covered = light_set_coverage(&set, pdf, rsm->width, rsm->height);
    free(maps);
    light_set_free(&set);
    generator_free(&g);
}

/* How the error of each pixel changes from frame to frame, over sqrt 2: that makes it the standard deviation of errors
   that know nothing of each other. */
typedef struct {
    image last;                 /* error of the last frame */
    double *changes, *radiance; /* sums of squared changes, and of the truth; of the channels' mean */
} flicker_sums;

static void add_frame(flicker_sums *f, const image *picture, const image *truth, int frame) {
    int i;
    for (i = 0; i < picture->width * picture->height; i++) {
        const vec3 error = lobe_sub(picture->pixels[i], truth->pixels[i]);
        const double change = (double)lobe_mean(lobe_sub(error, f->last.pixels[i]));
        if (frame) f->changes[i] += 0.5 * change * change;
        f->radiance[i] += (double)lobe_mean(truth->pixels[i]);
        f->last.pixels[i] = error;
    }
}

static flicker sum_up(flicker_sums *f, int pixels, int frames) {
    flicker result = {0, 0};
    int i, lit = 0;
    for (i = 0; i < pixels; i++) {
        const double variance = f->changes[i] / (frames - 1);
        result.rms += variance / pixels;
        if (f->radiance[i] > 0) f->changes[lit++] = sqrt(variance) / (f->radiance[i] / frames);
    }
    qsort(f->changes, (size_t)lit, sizeof *f->changes, ascending);
    result.rms = sqrt(result.rms);
    result.relative = lit ? f->changes[lit / 2] : 0;
    return result;
}

/* Flicker of the receivers, without shadows, which would add their own. The light moves a centimetre each frame, which
   changes the truth too: that is taken from lights so many and so regular that they hardly flicker. Where the light
   stands still, all that changes is which view lights each texel of the RSM takes. */
static void measure_flicker(const scene *first, const light_set *view_lights, pdf_kind kind, int moving,
                            const settings *o, row *rows, int row_count) {
    const option_size size = {(o->size.width + RECEIVER_STEP - 1) / RECEIVER_STEP,
                              (o->size.height + RECEIVER_STEP - 1) / RECEIVER_STEP};
    const spot_light *spot = &first->spot;
    const vpl_map view = render_view(first, size);
    const int most = most_lights(o) > FINEST_LIGHTS ? most_lights(o) : FINEST_LIGHTS, pixels = texel_count(&view);
    generator g = generator_create(RSM_SIZE, RSM_SIZE, most);
    light_set set = light_set_create(most);
    image truth = make_image(size.width, size.height), picture = make_image(size.width, size.height);
    flicker_sums *sums = (flicker_sums *)allocate("images", (size_t)row_count, sizeof *sums);
    progress line = progress_begin("flicker", o->frames * row_count);
    int frame, i;
    for (i = 0; i < row_count; i++) {
        sums[i].last = make_image(size.width, size.height);
        sums[i].changes = (double *)allocate("images", (size_t)pixels, sizeof(double));
        sums[i].radiance = (double *)allocate("images", (size_t)pixels, sizeof(double));
    }
    for (frame = 0; frame < o->frames; frame++) {
        const vec3 step = lobe_scale(spot->right, moving ? 0.01f * (float)frame : 0);
        scene world = *first;
        vpl_map rsm;
        float *pdf;
        spot_aim(&world.spot, lobe_add(spot->position, step), lobe_add(spot->target, step));
        rsm = render_rsm(&world);
        if (frame == 0 || moving) {
            pdf = weights_of(&rsm);
            set.count = FINEST_LIGHTS;
            vsgl_generate(&g, &rsm, pdf, METHOD_SPLIT, 1, 0, &set);
            vsgl_shade(&view, set.lights, NULL, set.count, truth.pixels, "flicker");
            free(pdf);
        }
        pdf = build_pdf(&rsm, view_lights, kind, frame, o);
        for (i = 0; i < row_count; i++) {
            set.count = rows[i].count;
            vsgl_generate(&g, &rsm, pdf, rows[i].how, rows[i].k, (unsigned)o->seed, &set);
            vsgl_shade(&view, set.lights, NULL, set.count, picture.pixels, "flicker");
            add_frame(&sums[i], &picture, &truth, frame);
            progress_step(&line);
        }
        free(pdf);
        free(rsm.texels);
    }
    progress_end(&line);
    for (i = 0; i < row_count; i++) {
        *(moving ? &rows[i].moving : &rows[i].still) = sum_up(&sums[i], pixels, o->frames);
        image_free(&sums[i].last);
        free(sums[i].changes);
        free(sums[i].radiance);
    }
    free(sums);
    image_free(&truth);
    image_free(&picture);
    light_set_free(&set);
    generator_free(&g);
    free(view.texels);
}

static void print_rows(const row *rows, int count, pdf_kind kind) {
    int i;
    for (i = 0; i < count; i++) {
        const row *r = &rows[i];
        printf("%-5s %6d %-9s", pdf_names[kind], r->count, method_names[r->how]);
        if (method_is_filtered(r->how))
            printf(" %2.0f", (double)r->k);
        else
            printf("  -");
        printf(" %10.2f %7.1f %7.1f ", r->generation, r->visibility, r->shading);
        if (method_is_labelling(r->how)) /* every texel is in one cluster */
            printf("     -       -");
        else
            printf("%6.2f %7.2f", 100 * r->covered.gap, 100 * r->covered.overlap);
        printf(" %7.2f  %.5f %.5f ", r->firefly, r->moving.rms, r->moving.relative);
        if (kind == PDF_BRSM)
            printf(" %.5f %.5f", r->still.rms, r->still.relative);
        else
            printf("       -       -");
        printf("  %.5f  %.4f  %.6f\n", r->rmse, r->relative, r->flux);
    }
    fflush(stdout);
}

/* ---- pictures ---- */

enum { PICTURE_DIRECT, PICTURE_RESULT, PICTURE_REFERENCE, PICTURE_DIFFERENCE, PICTURE_ALL, PICTURE_KERNELS, PICTURES };
static const char *const picture_names[PICTURES] = {"-direct.png",     "-result.png", "-reference.png",
                                                    "-difference.png", ".png",        "-kernels.png"};

static void check_path(const char *prefix, const char *name) {
    char path[1024];
    const char *wrong = "name too long";
    if (snprintf(path, sizeof path, "%s%s", prefix, name) < (int)sizeof path) wrong = file_check(path);
    if (wrong) give_up(path, wrong);
}

static void write_picture(const char *prefix, int which, image *picture, float exposure) {
    char path[1024];
    const char *wrong;
    snprintf(path, sizeof path, "%s%s", prefix, picture_names[which]);
    wrong = image_write_png(path, picture, exposure);
    if (wrong) give_up(path, wrong);
    image_free(picture);
}

static void write_pictures(const char *prefix, const image *direct, const image *indirect, const image *reference,
                           float exposure) {
    const int width = direct->width, height = direct->height, count = width * height;
    image pictures[PICTURE_ALL], all = make_image(2 * width, 2 * height);
    int i;
    for (i = 0; i < PICTURE_ALL; i++) pictures[i] = make_image(width, height);
    for (i = 0; i < count; i++) {
        vec3 result = lobe_add(direct->pixels[i], indirect->pixels[i]);
        vec3 wanted = lobe_add(direct->pixels[i], reference->pixels[i]), d = lobe_sub(result, wanted);
        pictures[PICTURE_DIRECT].pixels[i] = direct->pixels[i];
        pictures[PICTURE_RESULT].pixels[i] = result;
        pictures[PICTURE_REFERENCE].pixels[i] = wanted;
        pictures[PICTURE_DIFFERENCE].pixels[i] = lobe_vector(fabsf(d.x), fabsf(d.y), fabsf(d.z));
    }
    for (i = 0; i < PICTURE_ALL; i++) {
        image_paste(&all, &pictures[i], i % 2 * width, i / 2 * height);
        write_picture(prefix, i, &pictures[i], exposure);
    }
    write_picture(prefix, PICTURE_ALL, &all, exposure);
    printf("wrote %s.png: direct, direct + indirect, reference, difference; and each alone\n", prefix);
}

/* Figure 1: where the kernels lie, by density, by bisection, by split and by k-means in the image. */
static void write_kernels(const vpl_map *rsm, const float *pdf, const char *pdf_name, const settings *o) {
    static const method shown[4] = {METHOD_DENSITY, METHOD_BISECTION, METHOD_SPLIT, METHOD_KMEANS_2D};
    generator g = generator_create(rsm->width, rsm->height, KERNELS_SHOWN);
    light_set set = light_set_create(KERNELS_SHOWN);
    image panel = make_image(rsm->width, rsm->height), all = make_image(2 * rsm->width, 2 * rsm->height);
    int i;
    for (i = 0; i < 4; i++) {
        vsgl_generate(&g, rsm, pdf, shown[i], 1, (unsigned)o->seed, &set);
        light_set_draw(&set, pdf, &panel);
        image_paste(&all, &panel, i % 2 * rsm->width, i / 2 * rsm->height);
    }
    write_picture(o->out, PICTURE_KERNELS, &all, 2.2f);
    printf("wrote %s%s: %d kernels on the PDF %s, by density, bisection, split and kmeans2d\n", o->out,
           picture_names[PICTURE_KERNELS], KERNELS_SHOWN, pdf_name);
    image_free(&panel);
    light_set_free(&set);
    generator_free(&g);
}

/* ---- an RSM from files ---- */

static void write_lights(const char *path, const light_set *set) {
    static const char *const components[2] = {"diffuse", "specular"};
    file f;
    const char *wrong = file_begin(&f, path);
    int i, k;
    if (wrong) give_up(path, wrong);
    fprintf(f.stream, "x y z variance");
    for (k = 0; k < 2; k++) {
        const char *c = components[k];
        fprintf(f.stream, " %s_axis_x %s_axis_y %s_axis_z %s_sharpness %s_red %s_green %s_blue", c, c, c, c, c, c, c);
    }
    fprintf(f.stream, "\n");
    for (i = 0; i < set->count; i++) {
        const vsgl *v = &set->lights[i];
        fprintf(f.stream, "%.9g %.9g %.9g %.9g", (double)v->position.x, (double)v->position.y, (double)v->position.z,
                (double)v->variance);
        for (k = 0; k < 2; k++) {
            fprintf(f.stream, " %.9g %.9g %.9g %.9g %.9g %.9g %.9g", (double)v->emission[k].axis.x,
                    (double)v->emission[k].axis.y, (double)v->emission[k].axis.z, (double)v->emission[k].sharpness,
                    (double)v->intensity[k].x, (double)v->intensity[k].y, (double)v->intensity[k].z);
        }
        fprintf(f.stream, "\n");
    }
    wrong = file_end(&f);
    if (wrong) give_up(path, wrong);
}

static void convert(const settings *o) {
    const method how = o->method ? chosen_method(o) : METHOD_FAST;
    const int count = o->lights.value[0];
    const vec3 light = {o->light.x, o->light.y, o->light.z};
    vpl_map rsm;
    generator g;
    light_set set;
    float *pdf;
    double flux = 0;
    char path[1024];
    int i;
    if (o->pdf > 1 + PDF_FLUX) give_up("--pdf", "without a camera there is only flux");
    check_path(o->out, ".txt");
    snprintf(path, sizeof path, "%s.txt", o->out);
    rsm = vpl_map_read(o->rsm, o->light.given ? &light : NULL);
    g = generator_create(rsm.width, rsm.height, count);
    set = light_set_create(count);
    pdf = weights_of(&rsm);
    vsgl_generate(&g, &rsm, pdf, how, (float)o->kernels.value[0], (unsigned)o->seed, &set);
    write_lights(path, &set);
    for (i = 0; i < texel_count(&rsm); i++) flux += (double)pdf[i];
    printf("wrote %s: %d lights by %s of %dx%d texels, %.2f ms; flux %g of %g\n", path, count, method_names[how],
           rsm.width, rsm.height, set.ms[0] + set.ms[1] + set.ms[2], light_set_power(&set), flux);
    free(pdf);
    light_set_free(&set);
    generator_free(&g);
    free(rsm.texels);
}

/* ---- */

static void compare(const settings *o) {
    const scene world = choose_scene(o);
    buffer seen = buffer_camera(&world, o->size.width, o->size.height);
    const vpl_map rsm = render_rsm(&world), view = render_view(&world, o->view), pixels = render_view(&world, o->size);
    image direct = make_image(o->size.width, o->size.height), indirect = make_image(o->size.width, o->size.height);
    image best = make_image(o->size.width, o->size.height), reference;
    light_set view_lights;
    float *pdfs[PDFS] = {NULL, NULL};
    row rows[MAX_ROWS], chosen;
    int kind, last = 0, chosen_pdf = 0, i;
    if (!seen.texels) give_up("images", "not enough memory");
    light_directly(&world, &seen, &direct);
    reference = trace_reference(&world, &seen, o);
    view_lights = generate_view_lights(&view, o);
    for (kind = 0; kind < PDFS; kind++) {
        if (o->pdf && o->pdf != 1 + kind) continue;
        pdfs[kind] = build_pdf(&rsm, &view_lights, (pdf_kind)kind, 0, o);
        last = kind;
    }
    measure_times(&view, &rsm, pdfs, o);
    memset(&chosen, 0, sizeof chosen);
    chosen.relative = 1e30;
    printf(
        "\nGeneration, shadow maps and shading in ms; gap and overlap in %% of the PDF; brightest light over the\n"
        "mean; flicker over %d frames of a moving light, and of the PDF's noise alone: RMS, and median of the share\n"
        "of a pixel's radiance; RMSE and mean error over mean of the indirect light; power of the lights over the\n"
        "RSM's\n",
        o->frames);
    printf("PDF   lights method     K generation shadows shading    gap overlap firefly   moving  median    noise "
           " median     RMSE   error    power\n");
    for (kind = 0; kind < PDFS; kind++) {
        int row_count = plan_rows(o, rows);
        if (!pdfs[kind]) continue;
        for (i = 0; i < row_count; i++) {
            render(&world, &pixels, &rsm, pdfs[kind], o, &rows[i], &reference, &indirect);
            if (rows[i].relative >= chosen.relative) continue;
            chosen = rows[i];
            chosen_pdf = kind;
            image_paste(&best, &indirect, 0, 0);
        }
        measure_flicker(&world, &view_lights, (pdf_kind)kind, 1, o, rows, row_count);
        if (kind == PDF_BRSM) measure_flicker(&world, &view_lights, PDF_BRSM, 0, o, rows, row_count);
        print_rows(rows, row_count, (pdf_kind)kind);
    }
    printf("\n");
    write_pictures(o->out, &direct, &best, &reference, o->scene == 0 ? 2.2f : 0.6f);
    printf("their lights are those of the smallest error: %d by %s, PDF %s\n", chosen.count, method_names[chosen.how],
           pdf_names[chosen_pdf]);
    write_kernels(&rsm, pdfs[last], pdf_names[last], o);
    for (kind = 0; kind < PDFS; kind++) free(pdfs[kind]);
    light_set_free(&view_lights);
    free(rsm.texels);
    free(view.texels);
    free(pixels.texels);
    image_free(&direct);
    image_free(&indirect);
    image_free(&best);
    image_free(&reference);
    buffer_free(&seen);
}

int main(int argc, char **argv) {
    settings o = {0};
    const char *method_choices[METHODS + 2] = {"all"};
    const option options[] = {
        {"--scene S", OPTION_CHOICE, &o.scene, 0, 0, "what is lit", scene_choices},
        OPTION_OF_SIZE(&o.size),
        {"--lights N,...", OPTION_LIST, &o.lights, 1, 65536, "numbers of lights to try", 0},
        {"--method M", OPTION_CHOICE, &o.method, 0, 0, "how they are made", method_choices},
        {"--k N,...", OPTION_LIST, &o.kernels, 1, 64, "sizes of filtered sampling's kernels, in shares of a light", 0},
        {"--pdf P", OPTION_CHOICE, &o.pdf, 0, 0, "what they are placed by", pdf_choices},
        {"--view WxH", OPTION_SIZE, &o.view, 16, 4096, "of the G-buffer that view lights are made of", 0},
        {"--view-lights N", OPTION_WHOLE, &o.view_lights, 1, 65536, "that tell what the camera needs", 0},
        {"--interleave N", OPTION_WHOLE, &o.interleave, 1, 64, "N x N texels of the RSM share them; 1: no noise", 0},
        {"--frames N", OPTION_WHOLE, &o.frames, 2, 1000, "that flicker is measured over", 0},
        {"--samples N", OPTION_WHOLE, &o.samples, 2, 1000000, "samples per pixel of the reference", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {"--rsm PREFIX", OPTION_TEXT, &o.rsm, 0, 0,
         "an RSM of yours: PREFIX-position.pfm, -normal.pfm, -flux.pfm, -alpha.pfm", 0},
        {"--light X,Y,Z", OPTION_PLACE, &o.light, -1e5, 1e5, "where its light is", 0},
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    int i;
    o.size.width = 256;
    o.size.height = 192;
    o.view.width = 960; /* half of the paper's */
    o.view.height = 544;
    o.lights.count = o.kernels.count = 1;
    o.lights.value[0] = 1024;
    o.kernels.value[0] = 1;
    o.view_lights = 2048;
    o.interleave = 8;
    o.frames = 8;
    o.samples = 256;
    o.out = "build/vsgl";
    for (i = 0; i <= METHODS; i++) method_choices[i + 1] = method_names[i];
    options_read(
        options, argc, argv,
        "Renders one-bounce glossy indirect light with virtual spherical Gaussian lights (VSGL), and prints\n"
        "speed against error, gaps, overlaps and flicker of ways to generate them from a reflective shadow\n"
        "map (RSM).\n\n"
        "With --rsm it writes the lights of your RSM to OUT.txt instead, a line each, with columns named in\n"
        "the first: the first number of --lights, by --method (fast if all) and the first of --k. The four\n"
        "files are of one size, any: position and normal in world space, RGB flux that the texel reflects (0:\n"
        "nothing there), alpha of GGX. Where alpha is 1 all of the flux is reflected diffusely, elsewhere all\n"
        "of it specularly, away from --light.");
    if (o.rsm) {
        convert(&o);
    } else {
        for (i = 0; i < PICTURES; i++) check_path(o.out, picture_names[i]);
        compare(&o);
    }
    return 0;
}
