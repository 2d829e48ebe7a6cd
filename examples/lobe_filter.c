/*
 lobe_filter.c - noisy glossy light, filtered and upsampled by weights that know the reflection lobes

 The pipeline of Tokuyoshi 2015, Specular Lobe-Aware Filtering and Upsampling for Interactive Indirect Illumination: one
 bounce of specular light by path tracing, reflectance divided out; a cross bilateral filter whose weights come from
 normals (Eq. 4) or from lobes (Eq. 11, 12, 13), each at its best parameter; the error against that parameter (Figs. 10
 to 13); upsampling of 4 x 4 pixels in space and time with recomputation of what has no like neighbours (Figs. 14 to
 16). With --color and its like it filters buffers of a renderer of yours.
*/
#include "common/csv.h"
#include "common/fail.h"
#include "common/glossy_frame.h"
#include "common/options.h"
#include "common/output.h"
#include "common/parallel.h"
#include "common/progress.h"
#include "common/raster.h"
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "lobe_filter";

enum { SIDE_LIMIT = 16384 };

typedef struct {
    const char *name, *parameter;
    int parameters; /* 0 to 2; searched by powers of two: */
    float low[2], high[2];
} method_data;

static const method_data methods[FILTER_METHODS] = {
    {"unfiltered", "", 0, {0, 0}, {0, 0}},
    {"normals, Eq. 4", "variance", 1, {-20, 0}, {2, 0}},
    {"normals, bandlimit", "variance, width", 2, {-20, 0}, {2, 12}},
    {"normals and alpha", "variances", 2, {-20, -20}, {2, 2}},
    {"lobes, Eq. 12", "beta", 1, {-6, 0}, {10, 0}},
    {"lobes, Eq. 11", "beta", 1, {-6, 0}, {10, 0}},
    {"lobes, Eq. 13", "beta", 1, {-6, 0}, {10, 0}},
};

typedef struct {
    option_size size;
    option_list radii; /* of the filters */
    int scene, samples, reference, seed;
    const char *out;
    const char *color, *depth, *normal, *alpha; /* a user's buffers */
    float field_of_view, beta, depth_variance;
} settings;

/* ---- measuring ---- */

/* What an image should be, twice: their noise is independent, so that it does not count as an error. And the mean. */
typedef struct {
    image half[2], mean;
} truth;

static truth truth_of(const frame *f, int samples, unsigned seed, const char *label) {
    truth t;
    int i, k;
    for (k = 0; k < 2; k++) t.half[k] = shade_frame(f, samples > 1 ? samples / 2 : 1, seed + 1 + (unsigned)k, 1, label);
    t.mean = image_create(f->width, f->height);
    for (i = 0; i < f->width * f->height; i++)
        t.mean.pixels[i] = lobe_scale(lobe_add(t.half[0].pixels[i], t.half[1].pixels[i]), 0.5f);
    return t;
}

static void truth_free(truth *t) {
    image_free(&t->half[0]);
    image_free(&t->half[1]);
    image_free(&t->mean);
}

/* One noisy image, what it should be, and room for filtering it with kernels of a radius */
typedef struct {
    frame f;
    image noisy, result;
    truth wanted;
    filter_planes *room;
    int radius;
} study;

/* Other kernels */
static void study_resize(study *s, int radius) {
    const int width = s->f.width, height = s->f.height;
    if (s->room) filter_planes_free(s->room);
    s->radius = radius;
    s->room = filter_planes_create(width, height, radius, filter_most_parts(s->f.guides, width * height));
    filter_fill_colours(s->room, &s->noisy);
}

static void study_begin(study *s, const subject *what, const settings *o) {
    const scene world = what->build();
    const unsigned seed = (unsigned)o->seed;
    s->f = frame_of(&world, what, o->size.width, o->size.height);
    s->noisy = shade_frame(&s->f, o->samples, seed, 0, what->name);
    s->wanted = truth_of(&s->f, o->reference, seed, what->name);
    s->result = image_create(o->size.width, o->size.height);
    s->room = NULL;
    study_resize(s, o->radii.value[0]);
}

static void study_end(study *s) {
    frame_free(&s->f);
    image_free(&s->noisy);
    truth_free(&s->wanted);
    image_free(&s->result);
    filter_planes_free(s->room);
}

/* Mean square error over the channels of what is glossy */
static double error_of(const frame *f, const image *got, const truth *wanted) {
    double sum = 0;
    long count = 0;
    int i;
    for (i = 0; i < f->width * f->height; i++) {
        if (!f->guides[i].valid) continue;
        sum += (double)lobe_dot(lobe_sub(got->pixels[i], wanted->half[0].pixels[i]),
                                lobe_sub(got->pixels[i], wanted->half[1].pixels[i]));
        count += 3;
    }
    return count ? sum / (double)count : 0;
}

static double try_filter(study *s, filter_method m, const float *parameter) {
    filter_frame(s->room, s->f.guides, m, parameter, filter_depth_variance, &s->result);
    return error_of(&s->f, &s->result, &s->wanted);
}

/* The error at powers of two */
static double try_powers(study *s, filter_method m, float first, float second) {
    float parameter[2];
    parameter[0] = exp2f(first);
    parameter[1] = exp2f(second);
    return try_filter(s, m, parameter);
}

/* Golden section of one exponent about a value that is lower than those a step away */
static void refine(study *s, filter_method m, float at[2], int which, float step) {
    const float golden = 0.618033989f;
    float low = at[which] - step, high = at[which] + step, x[2];
    double y[2];
    int i, k;
    x[0] = high - golden * (high - low);
    x[1] = low + golden * (high - low);
    for (k = 0; k < 2; k++) {
        at[which] = x[k];
        y[k] = try_powers(s, m, at[0], at[1]);
    }
    for (i = 0; i < 6; i++) {
        k = y[0] < y[1]; /* the one that moves */
        if (k)
            high = x[1];
        else
            low = x[0];
        x[k] = x[!k];
        y[k] = y[!k];
        at[which] = x[!k] = k ? high - golden * (high - low) : low + golden * (high - low);
        y[!k] = try_powers(s, m, at[0], at[1]);
    }
    at[which] = y[0] < y[1] ? x[0] : x[1];
}

/* The parameters of least error: a sweep in steps, then golden sections */
static double search(study *s, filter_method m, float step, float parameter[2], progress *line) {
    const method_data *d = &methods[m];
    float at[2], best[2] = {0, 0};
    double least = 1e300;
    int k;
    for (at[0] = d->low[0]; at[0] <= d->high[0]; at[0] += d->parameters > 0 ? step : 100) {
        for (at[1] = d->low[1]; at[1] <= d->high[1]; at[1] += d->parameters > 1 ? step : 100) {
            double found = try_powers(s, m, at[0], at[1]);
            if (!(found < least)) continue;
            least = found;
            best[0] = at[0];
            best[1] = at[1];
        }
    }
    for (k = 0; k < (d->parameters > 1 ? 4 : d->parameters); k++) refine(s, m, best, k & 1, k < 2 ? step : 0.5f * step);
    parameter[0] = exp2f(best[0]);
    parameter[1] = exp2f(best[1]);
    progress_step(line);
    return try_filter(s, m, parameter);
}

/* ---- time ---- */

enum { ROUNDS = 5, LIMIT_MS = 1000 };

/* Milliseconds of each method on one core, turn by turn */
static void time_methods(study *s, float parameters[FILTER_METHODS][2], quartiles ms[FILTER_METHODS]) {
    timing taken[FILTER_METHODS];
    int round, m, row;
    memset(taken, 0, sizeof taken);
    for (round = 0; round < ROUNDS; round++) {
        for (m = 0; m < FILTER_METHODS; m++) {
            const double started = progress_clock();
            if (!timing_goes_on(&taken[m], 1, ROUNDS, LIMIT_MS)) continue;
            for (row = -s->radius; row < s->f.height + s->radius; row++)
                filter_fill_row(s->room, s->f.guides, (filter_method)m, parameters[m],
                                bilateral_scale(filter_depth_variance), row);
            for (row = 0; row < s->f.height; row++)
                filter_row(s->room, (filter_method)m, parameters[m], row, &s->result);
            timing_add(&taken[m], progress_clock() - started);
        }
    }
    for (m = 0; m < FILTER_METHODS; m++) ms[m] = timing_quartiles(&taken[m]);
}

/* ---- files ---- */

static void write_picture(const char *prefix, const char *rest, const image *picture, const char *what) {
    output_picture(prefix, rest, picture, 1);
    printf("wrote %s%s: %s\n", prefix, rest, what);
}

/* Twice the difference where something is glossy */
static image difference(const frame *f, const image *got, const image *wanted) {
    image result = image_create(f->width, f->height);
    int i;
    for (i = 0; i < f->width * f->height; i++) {
        vec3 d = lobe_sub(got->pixels[i], wanted->pixels[i]);
        if (f->guides[i].valid) result.pixels[i] = lobe_vector(2 * fabsf(d.x), 2 * fabsf(d.y), 2 * fabsf(d.z));
    }
    return result;
}

static void paste_with_difference(const frame *f, image *sheet, const image *got, const image *wanted, int column) {
    image d = difference(f, got, wanted);
    image_paste(sheet, got, column * got->width, 0);
    image_paste(sheet, &d, column * got->width, got->height);
    image_free(&d);
}

/* ---- Fig. 4: what Eq. 12 loses against Eq. 11 of one lobe each ---- */

static void compare_similarities(const settings *o) {
    static const float sharpnesses[] = {1, 3, 10, 30, 100, 1000};
    enum { COLUMNS = sizeof sharpnesses / sizeof *sharpnesses, STEPS = 180 };
    float worst[COLUMNS], where[COLUMNS];
    csv table = csv_begin(NULL);
    int i, k;
    csv_text(&table, "degrees");
    for (k = 0; k < COLUMNS; k++) {
        char heading[64];
        snprintf(heading, sizeof heading, "Eq. 11 of sharpness %g", (double)sharpnesses[k]);
        csv_text(&table, heading);
        csv_text(&table, "Eq. 12");
        worst[k] = where[k] = 0;
    }
    for (i = 0; i <= STEPS; i++) {
        const float angle = (float)i * LOBE_PI / STEPS;
        csv_row(&table);
        csv_count(&table, i);
        for (k = 0; k < COLUMNS; k++) {
            sg_lobe a = blank_lobe(), b = blank_lobe();
            float exact, approximate;
            a.sharpness = b.sharpness = sharpnesses[k];
            b.axis = lobe_vector(sinf(angle), 0, cosf(angle));
            exact = bilateral_sg_mixture_weight(&a, 1, &b, 1, 20);
            approximate = bilateral_sg_weight(a, b, 20);
            csv_error(&table, (double)exact);
            csv_error(&table, (double)approximate);
            if (fabsf(exact - approximate) <= worst[k]) continue;
            worst[k] = fabsf(exact - approximate);
            where[k] = angle * 180 / LOBE_PI;
        }
    }
    csv_row(&table);
    printf("\nEq. 12 against Eq. 11, lobes of one sharpness, beta 20 (Fig. 4): the largest difference\n\nsharpness ");
    for (k = 0; k < COLUMNS; k++) printf("%10g", (double)sharpnesses[k]);
    printf("\ndifference");
    for (k = 0; k < COLUMNS; k++) printf("%10.5f", (double)worst[k]);
    printf("\nat degrees");
    for (k = 0; k < COLUMNS; k++) printf("%10.0f", (double)where[k]);
    printf("\n\n");
    csv_end(&table, o->out, "-similarity.csv", "both weights over the angle (Fig. 4)");
}

/* ---- Figs. 10 to 13: the error over the parameter, one material a picture, and three in one ---- */

enum { SINGLES = 3, GROUPS = 3, MATERIALS = GROUPS * SINGLES + 1, ALL_THREE = MATERIALS - 1, GRID = 45 };
static const subject materials[MATERIALS] = {{"Phong 10", scene_spheres, look_phong, 0},
                                             {"Phong 100", scene_spheres, look_phong, 1},
                                             {"Phong 1000", scene_spheres, look_phong, 2},
                                             {"three wide lobes", scene_spheres, look_mixture, 0},
                                             {"three lobes", scene_spheres, look_mixture, 1},
                                             {"three narrow lobes", scene_spheres, look_mixture, 2},
                                             {"brushed 100, 5", scene_spheres, look_stretched, 0},
                                             {"brushed 1000, 10", scene_spheres, look_stretched, 1},
                                             {"brushed 5000, 100", scene_spheres, look_stretched, 2},
                                             {"10, 100 and 1000", scene_spheres, look_phong, 3}};
static const filter_method group_methods[GROUPS] = {FILTER_EQ12, FILTER_EQ11, FILTER_EQ13};

/* Errors of one method at the powers of two that its search covers, in half steps */
typedef struct {
    int count;
    double error[MATERIALS][GRID];
} curve;

static float grid_parameter(const method_data *d, int i) {
    return exp2f(d->low[0] + 0.5f * (float)i);
}

static void find_curve(study *s, filter_method m, int which, curve *c) {
    int i;
    c->count = (int)(2 * (methods[m].high[0] - methods[m].low[0])) + 1;
    for (i = 0; i < c->count; i++) {
        const float parameter = grid_parameter(&methods[m], i);
        c->error[which][i] = try_filter(s, m, &parameter);
    }
}

static double mean_of_group(const curve *c, int group, int i) {
    const int k = group * SINGLES;
    return (c->error[k][i] + c->error[k + 1][i] + c->error[k + 2][i]) / SINGLES;
}

static int best_of(const curve *c, int which) {
    int i, best = 0;
    for (i = 1; i < c->count; i++) best = c->error[which][i] < c->error[which][best] ? i : best;
    return best;
}

static int best_of_group(const curve *c, int group) {
    int i, best = 0;
    for (i = 1; i < c->count; i++) best = mean_of_group(c, group, i) < mean_of_group(c, group, best) ? i : best;
    return best;
}

static void write_curve(const settings *o, const char *rest, const char *parameter, filter_method m, const curve *c,
                        const char *what) {
    csv table = csv_begin(NULL);
    int i, k, group;
    csv_text(&table, parameter);
    for (group = 0; group < GROUPS; group++) {
        for (k = 0; k < SINGLES; k++) csv_text(&table, materials[group * SINGLES + k].name);
        csv_text(&table, "mean");
    }
    csv_text(&table, materials[ALL_THREE].name);
    csv_row(&table);
    for (i = 0; i < c->count; i++) {
        csv_number(&table, (double)grid_parameter(&methods[m], i));
        for (group = 0; group < GROUPS; group++) {
            for (k = 0; k < SINGLES; k++) csv_error(&table, c->error[group * SINGLES + k][i]);
            csv_error(&table, mean_of_group(c, group, i));
        }
        csv_error(&table, c->error[ALL_THREE][i]);
        csv_row(&table);
    }
    csv_end(&table, o->out, rest, what);
}

/* One method's four columns: errors of a material at its own best parameter and at the group's, and the parameters */
static void print_errors(filter_method m, const curve *c, int group, int which) {
    const int own = best_of(c, which), shared = best_of_group(c, group);
    printf("%11.5f%9.3g%11.5f%9.3g", c->error[which][own], (double)grid_parameter(&methods[m], own),
           c->error[which][shared], (double)grid_parameter(&methods[m], shared));
}

/* Prints what each method loses by a shared parameter; returns those of the three exponents. */
static void compare_materials(const settings *o, float shared[2]) {
    curve *normals = (curve *)allocate("curves", 2, sizeof *normals), *lobes = normals + 1;
    progress line = progress_begin("materials", MATERIALS);
    int i, k, group;
    for (i = 0; i < MATERIALS; i++) {
        const filter_method m = i == ALL_THREE ? FILTER_EQ12 : group_methods[i / SINGLES];
        study s;
        study_begin(&s, &materials[i], o);
        find_curve(&s, FILTER_NORMAL, i, normals);
        find_curve(&s, m, i, lobes);
        study_end(&s);
        progress_step(&line);
    }
    progress_end(&line);
    printf(
        "\nMean square error of one material a picture, at its own best parameter and at that of the least mean\n\n");
    printf("%-22s%-40s%s\n", "", "normals, Eq. 4", "lobes");
    printf("%-22s%11s%9s%11s%9s%11s%9s%11s%9s\n", "", "own best", "variance", "shared", "variance", "own best", "beta",
           "shared", "beta");
    for (group = 0; group < GROUPS; group++) {
        const int best[2] = {best_of_group(normals, group), best_of_group(lobes, group)};
        double own[2] = {0, 0};
        for (k = group * SINGLES; k < (group + 1) * SINGLES; k++) {
            printf("%-22s", materials[k].name);
            print_errors(FILTER_NORMAL, normals, group, k);
            print_errors(group_methods[group], lobes, group, k);
            printf("\n");
            own[0] += normals->error[k][best_of(normals, k)] / SINGLES;
            own[1] += lobes->error[k][best_of(lobes, k)] / SINGLES;
        }
        printf("%-22s%11.5f%9s%11.5f%9s%11.5f%9s%11.5f%9s\n",
               group == 0   ? "mean, Eq. 12"
               : group == 1 ? "mean, Eq. 11"
                            : "mean, Eq. 13",
               own[0], "", mean_of_group(normals, group, best[0]), "", own[1], "", mean_of_group(lobes, group, best[1]),
               "");
        if (group == 0) {
            shared[0] = grid_parameter(&methods[FILTER_NORMAL], best[0]);
            shared[1] = grid_parameter(&methods[FILTER_EQ12], best[1]);
            printf("%-22s", "all three in one");
            print_errors(FILTER_NORMAL, normals, 0, ALL_THREE);
            print_errors(FILTER_EQ12, lobes, 0, ALL_THREE);
            printf("\n");
        }
    }
    printf("\n");
    write_curve(o, "-normals.csv", "variance", FILTER_NORMAL, normals,
                "error of Eq. 4 over its variance (Figs. 10 to 13, left)");
    write_curve(o, "-lobes.csv", "beta", FILTER_EQ12, lobes,
                "error of Eq. 12, 11 and 13 over beta (Figs. 10 to 13, right)");
    free(normals);
}

/* ---- the scenes: each filter at its best, and at what was best for three exponents ---- */

enum { SCENES = 5, SHEET_COLUMNS = 5 };

typedef struct {
    subject what;
    filter_method shown; /* in the picture, beside those of normals */
    const char *about;
} shown_scene;

static const shown_scene scenes[SCENES] = {
    {{"tiles", scene_gallery, look_tiles, 0}, FILTER_EQ12, "GGX of alpha .04, .1 and .3; bands on the balls"},
    {{"models", scene_gallery, look_models, 0}, FILTER_EQ12, "Phong beside Beckmann"},
    {{"brushed", scene_gallery, look_brushed, 0}, FILTER_EQ13, "brushed along x and z by turns, exponents 4000 and 12"},
    {{"layers", scene_gallery, look_layers, 0}, FILTER_EQ11, "three lobes each"},
    {{"spheres", scene_spheres, look_phong, 3}, FILTER_EQ12, "Phong of exponent 10, 100 and 1000 in bands"}};

static const char row_columns[] = "scene,method,radius,best_mse,best_parameter,best_second,shared_mse,filter_ms,"
                                  "filter_ms_low,filter_ms_high,tap_ns";

/* What one method does in one scene with kernels of one radius */
typedef struct {
    filter_method how;
    int radius;
    float best[2];
    double error, shared_error; /* at its best, and at what was best for three exponents */
    quartiles ms;               /* of a megapixel */
} result_row;

static void print_row(const result_row *r) {
    const method_data *d = &methods[r->how];
    char second[32] = "", at_shared[32] = "";
    if (d->parameters > 1) snprintf(second, sizeof second, ", %.3g", (double)r->best[1]);
    if (d->parameters == 1) snprintf(at_shared, sizeof at_shared, "%.5f", r->shared_error);
    if (d->parameters > 0)
        printf("%-20s%10.5f%10.3g%-20s%10s%14.0f%9.2f\n", d->name, r->error, (double)r->best[0], second, at_shared,
               r->ms.median, r->ms.median / filter_taps(r->radius));
    else
        printf("%-20s%10.5f\n", d->name, r->error);
}

static void add_row(csv *table, const char *name, const result_row *r) {
    const method_data *d = &methods[r->how];
    int k;
    csv_text(table, name);
    csv_text(table, d->name);
    csv_count(table, r->radius);
    csv_error(table, r->error);
    for (k = 0; k < 2; k++) {
        if (k < d->parameters)
            csv_error(table, (double)r->best[k]);
        else
            csv_skip(table, 1);
    }
    if (d->parameters == 1)
        csv_error(table, r->shared_error);
    else
        csv_skip(table, 1);
    if (d->parameters > 0) {
        csv_quartiles(table, r->ms);
        csv_number(table, r->ms.median / filter_taps(r->radius));
    } else { /* nothing is done */
        csv_skip(table, 4);
    }
    csv_row(table);
}

/* Each method at its best with kernels of the study's radius. Those that the picture shows go there, if there is one. */
static void compare_filters(study *s, const shown_scene *which, const float shared[2], image *sheet,
                            result_row rows[FILTER_METHODS]) {
    static const filter_method columns[SHEET_COLUMNS - 1] = {FILTER_UNFILTERED, FILTER_NORMAL, FILTER_BANDLIMIT,
                                                             FILTER_METHODS};
    const double megapixels = 1e-6 * s->f.width * s->f.height;
    float best[FILTER_METHODS][2];
    quartiles ms[FILTER_METHODS];
    progress line = progress_begin(which->what.name, FILTER_METHODS);
    int m, k;
    for (m = 0; m < FILTER_METHODS; m++) {
        rows[m].how = (filter_method)m;
        rows[m].radius = s->radius;
        rows[m].error = search(s, (filter_method)m, 2, best[m], &line);
        memcpy(rows[m].best, best[m], sizeof best[m]);
        for (k = 0; sheet && k < SHEET_COLUMNS - 1; k++) {
            if (m == (int)(columns[k] == FILTER_METHODS ? which->shown : columns[k]))
                paste_with_difference(&s->f, sheet, &s->result, &s->wanted.mean, k);
        }
        if (methods[m].parameters == 1)
            rows[m].shared_error = try_filter(s, (filter_method)m, &shared[m == FILTER_NORMAL ? 0 : 1]);
    }
    progress_end(&line);
    time_methods(s, best, ms);
    for (m = 0; m < FILTER_METHODS; m++) rows[m].ms = quartiles_scaled(ms[m], 1 / megapixels);
}

static void show_scene(const settings *o, const shown_scene *which, const float shared[2], csv *table) {
    char rest[64];
    image sheet = image_create(SHEET_COLUMNS * o->size.width, 2 * o->size.height);
    study s;
    int m, i;
    study_begin(&s, &which->what, o);
    for (i = 0; i < o->radii.count; i++) {
        result_row rows[FILTER_METHODS];
        if (i > 0) study_resize(&s, o->radii.value[i]);
        compare_filters(&s, which, shared, i > 0 ? NULL : &sheet, rows);
        printf("\n%s: %s", which->what.name, which->about);
        if (o->radii.count > 1) printf("; filters of radius %d", s.radius);
        printf("\n\n%-20s%10s%10s  %-18s%10s%14s%9s\n", "", "MSE", "best at", "", "at shared", "ms/megapixel",
               "ns/tap");
        for (m = 0; m < FILTER_METHODS; m++) {
            print_row(&rows[m]);
            add_row(table, which->what.name, &rows[m]);
        }
        fflush(stdout);
    }
    image_paste(&sheet, &s.wanted.mean, (SHEET_COLUMNS - 1) * o->size.width, 0);
    snprintf(rest, sizeof rest, "-%s.png", which->what.name);
    write_picture(o->out, rest, &sheet, "noisy, Eq. 4, the same with a bandlimit, with lobes, reference; errors below");
    image_free(&sheet);
    study_end(&s);
}

/* ---- Fig. 19: the weights of Eq. 13 around a pixel, and by Cardano's formula ---- */

/* The papers' product integral of two ASGs in float: the lowest eigenvalue of the summed quadratic form by Cardano's
   formula, its vector as the longest cross product of two rows */
static float product_by_cardano(const asg_lobe *a, const asg_lobe *b) {
    const vec3 v[4] = {a->x, a->y, b->x, b->y};
    const float l[4] = {a->sharpness_x, a->sharpness_y, b->sharpness_x, b->sharpness_y};
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, mean, p, q, angle, high, middle, low, length = 0;
    vec3 rows[3], axis = a->z;
    int k;
    for (k = 0; k < 4; k++) {
        xx += l[k] * v[k].x * v[k].x;
        yy += l[k] * v[k].y * v[k].y;
        zz += l[k] * v[k].z * v[k].z;
        xy += l[k] * v[k].x * v[k].y;
        xz += l[k] * v[k].x * v[k].z;
        yz += l[k] * v[k].y * v[k].z;
    }
    mean = (xx + yy + zz) / 3;
    rows[0] = lobe_vector(xx - mean, xy, xz);
    rows[1] = lobe_vector(xy, yy - mean, yz);
    rows[2] = lobe_vector(xz, yz, zz - mean);
    p = sqrtf((lobe_dot(rows[0], rows[0]) + lobe_dot(rows[1], rows[1]) + lobe_dot(rows[2], rows[2])) / 6);
    q = 0.5f * lobe_dot(rows[0], lobe_cross(rows[1], rows[2])) / lobe_max(p * p * p, LOBE_TINY);
    angle = acosf(lobe_max(-1, lobe_min(1, q))) / 3;
    high = mean + 2 * p * cosf(angle);
    low = mean + 2 * p * cosf(angle + 2 * LOBE_PI / 3);
    middle = 3 * mean - high - low;
    rows[0].x = xx - low;
    rows[1].y = yy - low;
    rows[2].z = zz - low;
    for (k = 0; k < 3; k++) {
        const vec3 cross = lobe_cross(rows[k], rows[(k + 1) % 3]);
        if (lobe_dot(cross, cross) <= length) continue;
        length = lobe_dot(cross, cross);
        axis = lobe_scale(cross, 1 / sqrtf(length));
    }
    return LOBE_PI * expf(-low) * lobe_max(lobe_dot(axis, a->z) * lobe_dot(axis, b->z), 0) /
           sqrtf(lobe_max((high - low) * (middle - low), LOBE_TINY));
}

static float weight_by_cardano(const asg_lobe *a, const asg_lobe *b, float beta) {
    const float own = product_by_cardano(a, a) * product_by_cardano(b, b);
    return powf(lobe_min(product_by_cardano(a, b) / sqrtf(lobe_max(own, LOBE_TINY)), 1), beta);
}

/* White is 1; the PNG's tone curve undone */
static vec3 as_grey(float weight) {
    const float c = -logf(1 - 0.999f * lobe_max(lobe_min(weight, 1), 0));
    return lobe_vector(c, c, c);
}

static int same_tile(const frame *f, int i, int k) {
    const surface *a = &f->seen.texels[i].hit, *b = &f->seen.texels[k].hit;
    return f->guides[i].valid && f->guides[k].valid && a->shape == b->shape &&
           (a->shape != GALLERY_FLOOR || tile_of(a) == tile_of(b));
}

static void show_weights(const settings *o) {
    static const subject what = {"brushed", scene_gallery, look_brushed, 0};
    const int width = o->size.width, height = o->size.height, target = height * 11 / 20 * width + width / 2;
    scene world = what.build();
    image sheet = image_create(2 * width, height);
    frame f;
    float *weights[2], jump[2] = {0, 0};
    int i, k;
    world.eye.target = lobe_vector(0, 0, 0.7f); /* closer to the floor */
    world.eye.field_of_view *= 0.6f;
    f = frame_of(&world, &what, width, height);
    for (k = 0; k < 2; k++) weights[k] = (float *)allocate("images", (size_t)(width * height), sizeof(float));
    for (i = 0; i < width * height; i++) {
        const asg_lobe a = f.guides[target].stretched, b = f.guides[i].stretched;
        if (!f.guides[target].valid || !f.guides[i].valid) continue;
        weights[0][i] = bilateral_asg_weight(a, b, 1);
        weights[1][i] = weight_by_cardano(&a, &b, 1);
        for (k = 0; k < 2; k++) {
            sheet.pixels[i / width * 2 * width + k * width + i % width] = as_grey(weights[k][i]);
            if (i % width > 0 && same_tile(&f, i, i - 1))
                jump[k] = lobe_max(jump[k], fabsf(weights[k][i] - weights[k][i - 1]));
            if (i >= width && same_tile(&f, i, i - width))
                jump[k] = lobe_max(jump[k], fabsf(weights[k][i] - weights[k][i - width]));
        }
    }
    printf(
        "\nWeights of a brushed pixel's neighbours, beta 1 (Fig. 19): the largest step between pixels side by side of\n"
        "one tile or ball is %.3f by Eq. 13, and %.3f with Cardano's formula in float\n\n",
        (double)jump[0], (double)jump[1]);
    write_picture(o->out, "-weights.png", &sheet,
                  "weights around a brushed pixel by Eq. 13, and with Cardano's formula");
    for (k = 0; k < 2; k++) free(weights[k]);
    image_free(&sheet);
    frame_free(&f);
}

/* ---- upsampling: one pixel of 4 x 4 is shaded a frame ---- */

enum { FRAMES = UPSAMPLE_CELL * UPSAMPLE_CELL, MOST_SAMPLES = 16, MOVING_BALL = GALLERY_WALLS + 1 };
static const float upsampling_kappa = 100, normal_variance = 0.01f, lobe_beta = 20, least_weight = 0.25f;

/* Which pixel of a cell is shaded in each frame: every one once */
static const int shaded_column[FRAMES] = {1, 3, 0, 2, 3, 1, 2, 0, 0, 2, 1, 3, 2, 0, 3, 1};
static const int shaded_row[FRAMES] = {1, 3, 3, 1, 0, 2, 2, 0, 2, 0, 0, 2, 3, 1, 1, 3};

typedef struct {
    int lobes, temporal, adaptive; /* similarity of lobes, not of normals; with a history; recomputing */
    float parameter;
    image result, history;        /* of this frame and of the last */
    float *samples, *old_samples; /* total weight that a pixel's value is the mean of */
    int recomputed;
    double filter_ms, shade_ms;
} upsampler;

static filter_method method_of(const upsampler *u) {
    return u->lobes ? FILTER_EQ12 : FILTER_NORMAL;
}

/* Where a point of the scene is in the image */
static void project(const frame *f, vec3 point, float *x, float *y, float *distance) {
    const camera *eye = &f->world.eye;
    const vec3 forward = vec3_normalize(lobe_sub(eye->target, eye->position)), d = lobe_sub(point, eye->position);
    const float scale = 0.5f * (float)f->height / (tanf(0.5f * eye->field_of_view) * lobe_dot(d, forward));
    vec3 right, up;
    scene_frame(forward, &right, &up);
    *x = 0.5f * (float)f->width - 0.5f + scale * lobe_dot(d, right);
    *y = 0.5f * (float)f->height - 0.5f - scale * lobe_dot(d, up);
    *distance = vec3_length(d);
}

/* The value that the last frame has for what is seen here, and the samples that it is the mean of */
static float recall_pixel(const upsampler *u, const frame *f, const frame *last, vec3 motion, int index, vec3 *colour) {
    const surface *hit = &f->seen.texels[index].hit;
    const vec3 before = hit->shape == MOVING_BALL ? lobe_sub(hit->position, motion) : hit->position;
    float x, y, distance, footprint[4], similarity[4], weight[4], total, samples = 0;
    int left, top, k;
    project(last, before, &x, &y, &distance);
    bilateral_footprint(x, y, f->width, f->height, &left, &top, footprint);
    for (k = 0; k < 4; k++) {
        similarity[k] = 0;
        if (footprint[k] > 0.001f) /* not by rounding of the place */
            similarity[k] = upsample_likeness(method_of(u), u->parameter, &f->guides[index], distance,
                                              &last->guides[(top + (k >> 1)) * f->width + left + (k & 1)]);
    }
    total = bilateral_footprint_weights(footprint, similarity, weight);
    *colour = lobe_vector(0, 0, 0);
    for (k = 0; k < 4; k++) {
        const int at = (top + (k >> 1)) * f->width + left + (k & 1);
        if (!(weight[k] > 0)) continue;
        *colour = lobe_add(*colour, lobe_scale(u->history.pixels[at], weight[k]));
        samples += weight[k] * u->old_samples[at];
    }
    return total * lobe_min(samples, MOST_SAMPLES);
}

/* How much a frame's value counts at a pixel: that of pixels near a shaded one is better. */
static float nearness(const coarse *low, int x, int y) {
    int dx = (x - low->column + UPSAMPLE_CELL) % UPSAMPLE_CELL, dy = (y - low->row + UPSAMPLE_CELL) % UPSAMPLE_CELL;
    dx = dx > UPSAMPLE_CELL / 2 ? UPSAMPLE_CELL - dx : dx;
    dy = dy > UPSAMPLE_CELL / 2 ? UPSAMPLE_CELL - dy : dy;
    return lobe_exp(-(float)(dx * dx + dy * dy));
}

/* One frame of one upsampler: Eq. 1 over samples near in space and, by the history, in time */
static void upsample(upsampler *u, const frame *f, const frame *last, vec3 motion, const coarse *low, int reference,
                     unsigned seed) {
    const image swapped = u->history;
    float *const samples = u->old_samples;
    char *poor = (char *)allocate("images", (size_t)(f->width * f->height), 1);
    double started = progress_clock();
    int row, i;
    u->history = u->result;
    u->result = swapped;
    u->old_samples = u->samples;
    u->samples = samples;
    PARALLEL_FOR
    for (row = 0; row < f->height; row++) {
        int x;
        for (x = 0; x < f->width; x++) {
            const int at = row * f->width + x;
            vec3 now, old = {0, 0, 0};
            float total, share, recalled = 0;
            if (!f->guides[at].valid) {
                u->result.pixels[at] = shade_pixel(f, at, 1, seed, 1); /* a wall, as it is */
                continue;
            }
            total = upsample_pixel(method_of(u), u->parameter, f->guides, f->width, low, x, row, &now);
            if (u->temporal && last) recalled = recall_pixel(u, f, last, motion, at, &old);
            poor[at] = total + recalled < least_weight;
            total *= u->temporal ? nearness(low, x, row) : 1;
            share = recalled / lobe_max(recalled + total, 1e-20f);
            u->result.pixels[at] = lobe_add(lobe_scale(old, share), lobe_scale(now, 1 - share));
            u->samples[at] = recalled + total;
        }
    }
    u->filter_ms = progress_clock() - started;
    u->recomputed = 0;
    started = progress_clock();
    if (u->adaptive) {
        PARALLEL_FOR
        for (row = 0; row < f->height; row++) {
            int at;
            for (at = row * f->width; at < (row + 1) * f->width; at++) {
                if (!poor[at]) continue;
                u->result.pixels[at] = shade_pixel(f, at, reference, seed, 1);
                u->samples[at] = 1;
            }
        }
    }
    u->shade_ms = progress_clock() - started;
    for (i = 0; i < f->width * f->height; i++) u->recomputed += poor[i];
    free(poor);
}

static void shade_coarse(const frame *f, coarse *low, int number, int reference, unsigned seed) {
    int row;
    low->column = shaded_column[number];
    low->row = shaded_row[number];
    PARALLEL_FOR
    for (row = 0; row < low->height; row++) {
        int x;
        for (x = 0; x < low->width; x++)
            low->colours[row * low->width + x] = shade_pixel(
                f, (row * UPSAMPLE_CELL + low->row) * f->width + x * UPSAMPLE_CELL + low->column, reference, seed, 1);
    }
}

/* What parameters would have been best in space alone: the first two upsamplers' */
static void find_upsampling_best(const upsampler *first, const frame *f, const coarse *low, const truth *wanted,
                                 unsigned seed) {
    const vec3 still = {0, 0, 0};
    int k;
    printf("\nIn space alone, at the best parameter:");
    for (k = 0; k < 2; k++) {
        const method_data *d = &methods[k ? FILTER_EQ12 : FILTER_NORMAL];
        upsampler u = first[k];
        double least = 1e300;
        float power, best = 0;
        u.result = image_create(f->width, f->height);
        u.history = image_create(f->width, f->height);
        for (power = d->low[0]; power <= d->high[0]; power += 1) {
            double error;
            u.parameter = exp2f(power);
            upsample(&u, f, NULL, still, low, 1, seed);
            error = error_of(f, &u.result, wanted);
            if (error < least) {
                least = error;
                best = u.parameter;
            }
        }
        printf(" %s %.5f at %s %.3g%s", k ? "lobes" : "normals", least, d->parameter, (double)best, k ? "\n" : ",");
        image_free(&u.result);
        image_free(&u.history);
    }
}

enum { UPSAMPLERS = 8 };

static const char upsampling_columns[] =
    "method,in_time,anew,mse,poor,weights_ms,weights_ms_low,weights_ms_high,shading_ms,shading_ms_low,shading_ms_high,"
    "total_ms,total_ms_low,total_ms_high";

static void show_upsampling(const settings *o) {
    static const subject what = {"upsampling", scene_gallery, look_tiles, 0};
    const int width = o->size.width, height = o->size.height;
    const vec3 motion = {0.025f, 0, 0.01f}; /* of the ball in the middle, a frame */
    const unsigned seed = (unsigned)o->seed + 7;
    upsampler u[UPSAMPLERS];
    image sheet = image_create(SHEET_COLUMNS * width, 2 * height);
    progress line = progress_begin("upsampling", FRAMES);
    double coarse_ms, full_ms, count = 0;
    enum { WEIGHTS, SHADING, TOTAL, TIMES };
    timing taken[UPSAMPLERS][TIMES];
    csv table = csv_begin(upsampling_columns);
    frame f, last;
    coarse low;
    truth wanted;
    int number, k, i;
    low.width = width / UPSAMPLE_CELL;
    low.height = height / UPSAMPLE_CELL;
    low.colours = (vec3 *)allocate("images", (size_t)(low.width * low.height), sizeof *low.colours);
    memset(u, 0, sizeof u);
    memset(taken, 0, sizeof taken);
    for (k = 0; k < UPSAMPLERS; k++) {
        u[k].lobes = k & 1;
        u[k].temporal = k >> 1 & 1;
        u[k].adaptive = k >> 2;
        u[k].parameter = u[k].lobes ? lobe_beta : normal_variance;
        u[k].result = image_create(width, height);
        u[k].history = image_create(width, height);
        u[k].samples = (float *)allocate("images", (size_t)(width * height), sizeof(float));
        u[k].old_samples = (float *)allocate("images", (size_t)(width * height), sizeof(float));
    }
    for (number = 0; number < FRAMES; number++) {
        scene world = what.build();
        double started;
        shape *ball = &world.shapes[MOVING_BALL];
        ball->center = lobe_add(ball->center, lobe_scale(motion, (float)(number - FRAMES / 2)));
        if (number > 0) last = f;
        f = frame_of(&world, &what, width, height);
        for (i = 0; i < width * height; i++) {
            if (f.guides[i].valid) f.guides[i].lobe = sg_convolve(f.guides[i].lobe, upsampling_kappa);
        }
        started = progress_clock();
        shade_coarse(&f, &low, number, o->reference, seed);
        coarse_ms = progress_clock() - started;
        for (k = 0; k < UPSAMPLERS; k++) {
            const int is_timed = number >= FRAMES - ROUNDS && timing_goes_on(&taken[k][TOTAL], 1, ROUNDS, LIMIT_MS);
            if (!u[k].temporal && !is_timed && number < FRAMES - 1) continue;
            upsample(&u[k], &f, number > 0 ? &last : NULL, motion, &low, o->reference, seed);
            if (!is_timed) continue;
            timing_add(&taken[k][WEIGHTS], u[k].filter_ms);
            timing_add(&taken[k][SHADING], coarse_ms + u[k].shade_ms);
            timing_add(&taken[k][TOTAL], coarse_ms + u[k].shade_ms + u[k].filter_ms);
        }
        if (number > 0) frame_free(&last);
        progress_step(&line);
    }
    full_ms = progress_clock();
    wanted = truth_of(&f, 2 * o->reference, seed, "upsampling");
    full_ms = 0.5 * (progress_clock() - full_ms);
    progress_end(&line);
    for (i = 0; i < width * height; i++) count += f.guides[i].valid;
    printf(
        "\nUpsampling of one shaded pixel in 4 x 4, frame %d of a scene with a moving ball; normals: variance %g, "
        "lobes:\n"
        "beta %g, kappa %g; recomputed where the total weight is below %g. Milliseconds by all threads; shading all\n"
        "pixels takes %.0f ms.\n\n%-34s%10s%12s%10s%12s%10s\n",
        FRAMES, (double)normal_variance, (double)lobe_beta, (double)upsampling_kappa, (double)least_weight, full_ms, "",
        "MSE", "poor or", "weights", "shading", "total");
    printf("%-34s%10s%12s%10s%12s%10s\n", "", "", "recomputed", "ms", "ms", "ms");
    for (k = 0; k < UPSAMPLERS; k++) {
        const double error = error_of(&f, &u[k].result, &wanted), poor = 100 * u[k].recomputed / count;
        quartiles ms[TIMES];
        for (i = 0; i < TIMES; i++) ms[i] = timing_quartiles(&taken[k][i]);
        printf("%-9s%-16s%-9s%10.5f%10.2f %%%10.2f%12.1f%10.1f\n", u[k].lobes ? "lobes," : "normals,",
               u[k].temporal ? "space and time" : "space", u[k].adaptive ? " anew" : "", error, poor,
               ms[WEIGHTS].median, ms[SHADING].median, ms[TOTAL].median);
        csv_text(&table, u[k].lobes ? "lobes" : "normals");
        csv_count(&table, u[k].temporal);
        csv_count(&table, u[k].adaptive);
        csv_error(&table, error);
        csv_error(&table, poor);
        for (i = 0; i < TIMES; i++) csv_quartiles(&table, ms[i]);
        csv_row(&table);
    }
    find_upsampling_best(u, &f, &low, &wanted, seed);
    for (k = 0; k < SHEET_COLUMNS - 1; k++) {
        static const int columns[SHEET_COLUMNS - 1] = {0, 1, 3, 7};
        paste_with_difference(&f, &sheet, &u[columns[k]].result, &wanted.mean, k);
    }
    image_paste(&sheet, &wanted.mean, (SHEET_COLUMNS - 1) * width, 0);
    printf("\n");
    write_picture(o->out, "-upsampling.png", &sheet,
                  "by normals; by lobes; in time too; and anew where poor; reference; errors below");
    csv_end(&table, o->out, "-upsampling.csv", "the numbers of upsampling");
    for (k = 0; k < UPSAMPLERS; k++) {
        image_free(&u[k].result);
        image_free(&u[k].history);
        free(u[k].samples);
        free(u[k].old_samples);
    }
    frame_free(&f);
    truth_free(&wanted);
    image_free(&sheet);
    free(low.colours);
}

/* ---- buffers of a user's ---- */

static void refuse_texel(const char *path, int x, int y, const char *why) {
    char text[128];
    snprintf(text, sizeof text, "at column %d of row %d from the top %s", x, y, why);
    give_up(path, text);
}

/* Values of a file that must have so many channels and be of the first one's size */
static raster read_buffer(const char *path, int channels, const raster *like) {
    raster r;
    const char *wrong = raster_read(path, &r);
    if (wrong) give_up(path, wrong);
    if (r.channels != channels)
        give_up(path, channels == 1 ? "it has three channels, not one" : "it has one channel, not three");
    if (r.width > SIDE_LIMIT || r.height > SIDE_LIMIT) give_up(path, "it is wider or higher than 16384");
    if (like && (r.width != like->width || r.height != like->height)) give_up(path, "its size is not that of --color");
    return r;
}

static vec3 texel_of(const raster *r, int i) {
    const float *v = r->values + 3 * (size_t)i;
    return lobe_vector(v[0], v[1], v[2]);
}

static int is_within(vec3 v, float limit) {
    return raster_in_range(v.x, -limit, limit) && raster_in_range(v.y, -limit, limit) &&
           raster_in_range(v.z, -limit, limit);
}

/* In the camera's frame: x to the right, y up, z towards the viewer. A depth of 0: nothing there. */
static void read_guides(const settings *o, const raster *depth, const raster *normals, const raster *alphas,
                        guide *guides) {
    const float tangent = tanf(0.5f * o->field_of_view * LOBE_PI / 180), width = (float)depth->width,
                height = (float)depth->height;
    int x, y;
    for (y = 0; y < depth->height; y++) {
        for (x = 0; x < depth->width; x++) {
            const int i = y * depth->width + x;
            const float z = depth->values[i], alpha = alphas->values[i];
            vec3 n = texel_of(normals, i), view, unused;
            glossy look;
            if (!raster_in_range(z, 0, 1e9f)) refuse_texel(o->depth, x, y, "it is not from 0 to 1e9");
            if (!raster_in_range(alpha, 0, 1)) refuse_texel(o->alpha, x, y, "it is not from 0 to 1");
            if (!is_within(n, 1e6f)) refuse_texel(o->normal, x, y, "it is not a normal");
            if (!(z > 0)) continue;
            if (!(lobe_dot(n, n) > 1e-6f)) refuse_texel(o->normal, x, y, "its length is 0");
            n = vec3_normalize(n);
            view = vec3_normalize(lobe_vector((1 - (2 * (float)x + 1) / width) * tangent * width / height,
                                              ((2 * (float)y + 1) / height - 1) * tangent, 1));
            look = one_lobe(GLOSSY_GGX, lobe_max(alpha, 1e-3f), lobe_max(alpha, 1e-3f));
            lobe_frame(n, &look.tangent, &unused);
            guides[i] = filter_guide_of(&look, n, view, z);
        }
    }
}

static void write_raster(const char *prefix, const image *picture) {
    char path[OUTPUT_NAME];
    const char *wrong;
    raster r;
    int i;
    output_name(path, prefix, ".pfm");
    r.width = picture->width;
    r.height = picture->height;
    r.channels = 3;
    r.values = (float *)allocate("images", (size_t)r.width * (size_t)r.height, 3 * sizeof *r.values);
    for (i = 0; i < r.width * r.height; i++) {
        r.values[3 * (size_t)i] = picture->pixels[i].x;
        r.values[3 * (size_t)i + 1] = picture->pixels[i].y;
        r.values[3 * (size_t)i + 2] = picture->pixels[i].z;
    }
    wrong = raster_write(path, &r);
    free(r.values);
    if (wrong) give_up(path, wrong);
    printf("wrote %s\n", path);
}

/* Eq. 12, of GGX lobes */
static void filter_buffers(const settings *o) {
    raster color, depth, normals, alphas;
    image noisy, result;
    guide *guides;
    filter_planes *room;
    progress line;
    int i, row;
    if (!o->color || !o->depth || !o->normal || !o->alpha)
        give_up("buffers", "--color, --depth, --normal and --alpha are needed together");
    output_check(o->out, ".pfm");
    output_check(o->out, ".png");
    color = read_buffer(o->color, 3, NULL);
    depth = read_buffer(o->depth, 1, &color);
    normals = read_buffer(o->normal, 3, &color);
    alphas = read_buffer(o->alpha, 1, &color);
    noisy = image_create(color.width, color.height);
    for (i = 0; i < color.width * color.height; i++) {
        noisy.pixels[i] = texel_of(&color, i);
        if (!is_within(noisy.pixels[i], 1e30f))
            refuse_texel(o->color, i % color.width, i / color.width, "it is not a number up to 1e30");
    }
    guides = (guide *)allocate("images", (size_t)color.width * (size_t)color.height, sizeof *guides);
    read_guides(o, &depth, &normals, &alphas, guides);
    free(color.values);
    free(depth.values);
    free(normals.values);
    free(alphas.values);
    room = filter_planes_create(noisy.width, noisy.height, o->radii.value[0], 1);
    result = image_create(noisy.width, noisy.height);
    filter_fill_colours(room, &noisy);
    filter_fill_planes(room, guides, FILTER_EQ12, &o->beta, o->depth_variance);
    line = progress_begin("filter", noisy.height);
    PARALLEL_FOR
    for (row = 0; row < noisy.height; row++) {
        filter_row(room, FILTER_EQ12, &o->beta, row, &result);
        progress_step(&line);
    }
    progress_end(&line);
    write_raster(o->out, &result);
    write_picture(o->out, ".png", &result, "the same, as it looks");
    free(guides);
    filter_planes_free(room);
    image_free(&noisy);
    image_free(&result);
}

static int is_shown(const settings *o, int i) {
    return o->scene == 0 || o->scene == 1 + i;
}

static void check_study_files(const settings *o) {
    static const char *const rests[] = {
        ".csv", "-similarity.csv", "-normals.csv", "-lobes.csv", "-upsampling.csv", "-weights.png", "-upsampling.png"};
    char rest[64];
    int i;
    for (i = 0; i < (int)(sizeof rests / sizeof *rests); i++) output_check(o->out, rests[i]);
    for (i = 0; i < SCENES; i++) {
        if (!is_shown(o, i)) continue;
        snprintf(rest, sizeof rest, "-%s.png", scenes[i].what.name);
        output_check(o->out, rest);
    }
}

static const char *const scene_choices[] = {"all", "tiles", "models", "brushed", "layers", "spheres", NULL};

int main(int argc, char **argv) {
    settings o = {{256, 192}, {1, {FILTER_RADIUS}}, 0, 8, 256, 0, "build/lobe_filter", NULL, NULL, NULL, NULL, 45, 8,
                  0.1f};
    const option options[] = {
        {"--scene S", OPTION_CHOICE, &o.scene, 0, 0, "what filters are compared in", scene_choices},
        OPTION_OF_SIZE(&o.size),
        {"--radius N,...", OPTION_LIST, &o.radii, 1, 32,
         "of the filters in pixels; the first for all, others in each scene", 0},
        {"--samples N", OPTION_WHOLE, &o.samples, 1, 4096, "paths a pixel of what is filtered", 0},
        {"--reference N", OPTION_WHOLE, &o.reference, 2, 65536, "paths a pixel of what that should be", 0},
        OPTION_OF_SEED(&o.seed),
        OPTION_OF_OUT(&o.out),
        {"--color FILE", OPTION_TEXT, &o.color, 0, 0,
         "PFM of yours to filter instead of all that, by Eq. 12: noisy light, reflectance divided out", 0},
        {"--depth FILE", OPTION_TEXT, &o.depth, 0, 0, "its depths, one channel; 0: nothing there", 0},
        {"--normal FILE", OPTION_TEXT, &o.normal, 0, 0, "its normals: x to the right, y up, z to the viewer", 0},
        {"--alpha FILE", OPTION_TEXT, &o.alpha, 0, 0, "its GGX roughness, one channel", 0},
        {"--fov DEGREES", OPTION_REAL, &o.field_of_view, 1, 170, "vertical field of view of yours", 0},
        {"--beta X", OPTION_REAL, &o.beta, 1e-3, 1e3, "how like lobes must be in yours", 0},
        {"--depth-variance X", OPTION_REAL, &o.depth_variance, 1e-9, 1e9, "how like depths must be in yours", 0},
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    float shared[2];
    csv table;
    int i;
    options_read(options, argc, argv,
                 "Filters and upsamples noisy glossy light by weights that know the reflection lobes and by others,\n"
                 "and prints how far each is from what it should be, and how long it takes.");
    if (o.color || o.depth || o.normal || o.alpha) {
        filter_buffers(&o);
        return 0;
    }
    check_study_files(&o);
    table = csv_begin(row_columns);
    printf("%dx%d pixels, %d paths each, %d for the reference; filters of %dx%d pixels. Errors are mean squares over\n"
           "what is glossy; times are the medians of up to %d turns on one core, preparation included.\n",
           o.size.width, o.size.height, o.samples, o.reference, 2 * o.radii.value[0] + 1, 2 * o.radii.value[0] + 1,
           ROUNDS);
    compare_similarities(&o);
    compare_materials(&o, shared);
    for (i = 0; i < SCENES; i++) {
        if (is_shown(&o, i)) show_scene(&o, &scenes[i], shared, &table);
    }
    show_weights(&o);
    show_upsampling(&o);
    csv_end(&table, o.out, ".csv", "errors and times of the filters in each scene");
    return 0;
}
