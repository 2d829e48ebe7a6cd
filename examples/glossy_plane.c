/*
 glossy_plane.c - a sphere light over a glossy plane, seen down to grazing angles

 Figure 1 of Tokuyoshi 2015, Virtual Spherical Gaussian Lights for Real-Time Glossy Indirect Illumination (supplement):
 reflection lobe and incident radiance as two SGs, two ASGs, an ASG and an SG, against numerical integration of the
 true distribution over the sphere. All panels share the convention of section 4.2 of Tokuyoshi 2016: the lobe's
 integral times a coefficient, BRDF times cosine over the distribution's value, taken once at the light's center.
*/
#include "../asg.h"
#include "common/csv.h"
#include "common/fail.h"
#include "common/image.h"
#include "common/options.h"
#include "common/output.h"
#include "common/parallel.h"
#include "common/progress.h"
#include <stdio.h>
#include <stdlib.h>

const char *const program_name = "glossy_plane";

/* ---- the scene ---- */

static const vec3 light_center = {0, 0.62f, 8}, eye = {0, 0.5f, 0}, up = {0, 1, 0};
static const float light_radius = 0.3f;
/* The plane is y = 0; the camera looks along z at this slope, and sees this much of it each way. */
static const float view_slope = -0.19f, view_half_height = 0.2f;

typedef enum { NDF_PHONG, NDF_GGX } ndf_kind;

typedef struct {
    const char *name;
    ndf_kind ndf;
    float parameter; /* exponent or alpha */
} glossy;

enum { MATERIALS = 3, REPEATS = 5 };
static const glossy materials[MATERIALS] = {
    {"Phong 1000", NDF_PHONG, 1000}, {"GGX .05", NDF_GGX, 0.05f}, {"GGX .2", NDF_GGX, 0.2f}};

/* The distribution of half vectors: its peak, and its value over the peak */
static float ndf_peak(glossy look) {
    float a = look.parameter;
    return look.ndf == NDF_PHONG ? (a + 2) / (2 * LOBE_PI) : 1 / (LOBE_PI * a * a);
}

static inline float ndf_shape(glossy look, float cos_h) {
    float c2 = cos_h * cos_h, base;
    if (look.ndf == NDF_PHONG) return lobe_exp(0.5f * look.parameter * lobe_log(c2));
    base = c2 + (1 - c2) / (look.parameter * look.parameter);
    return 1 / (base * base);
}

/* BRDF times cosine over the distribution: Kelemen's visibility for Phong, Smith's for GGX */
static float coefficient(glossy look, vec3 wi, vec3 wo) {
    float ci = lobe_at_least(wi.y, 0), co = lobe_at_least(wo.y, 1e-4f), a2 = look.parameter * look.parameter;
    vec3 sum = lobe_add(wi, wo);
    if (look.ndf == NDF_PHONG) return ci / lobe_dot(sum, sum); /* 4 (h.w)^2 = |wi + wo|^2 */
    return 0.5f * ci / (ci * sqrtf(a2 + (1 - a2) * co * co) + co * sqrtf(a2 + (1 - a2) * ci * ci));
}

/* ---- pixels as planes: the loops over them become vector code ---- */

enum { VIEW_X, VIEW_Y, VIEW_Z, LIGHT_X, LIGHT_Y, LIGHT_Z, LIGHT_SHARPNESS, COEFFICIENT, PLANES };

typedef struct {
    int count;
    int *pixel; /* of the image; only those that see the plane */
    float *plane[PLANES];
} plane_view;

static vec3 pixel_ray(int width, int height, int column, int row) {
    float step = 2 * view_half_height / (float)height;
    return vec3_normalize(lobe_vector(step * ((float)column + 0.5f - 0.5f * (float)width),
                                      view_slope + step * (0.5f * (float)height - (float)row - 0.5f), 1));
}

static plane_view see_plane(int width, int height) {
    plane_view view;
    int i, k;
    view.count = 0;
    view.pixel = (int *)allocate("image", (size_t)width * (size_t)height, sizeof(int));
    for (k = 0; k < PLANES; k++)
        view.plane[k] = (float *)allocate("image", (size_t)width * (size_t)height, sizeof(float));
    for (i = 0; i < width * height; i++) {
        vec3 ray = pixel_ray(width, height, i % width, i / width), point;
        sg_lobe light;
        if (ray.y >= 0) continue;
        point = lobe_add(eye, lobe_scale(ray, -eye.y / ray.y));
        light = vsl_lobe(light_center, light_radius, point);
        k = view.count++;
        view.pixel[k] = i;
        view.plane[VIEW_X][k] = -ray.x;
        view.plane[VIEW_Y][k] = -ray.y;
        view.plane[VIEW_Z][k] = -ray.z;
        view.plane[LIGHT_X][k] = light.axis.x;
        view.plane[LIGHT_Y][k] = light.axis.y;
        view.plane[LIGHT_Z][k] = light.axis.z;
        view.plane[LIGHT_SHARPNESS][k] = light.sharpness;
    }
    return view;
}

static inline vec3 view_at(const plane_view *v, int i) {
    return lobe_vector(v->plane[VIEW_X][i], v->plane[VIEW_Y][i], v->plane[VIEW_Z][i]);
}

static inline vec3 toward_light(const plane_view *v, int i) {
    return lobe_vector(v->plane[LIGHT_X][i], v->plane[LIGHT_Y][i], v->plane[LIGHT_Z][i]);
}

/* Incident radiance 1 from the sphere: half its solid angle is the integral of an SG of peak 1. */
static inline sg_lobe light_at(const plane_view *v, int i) {
    sg_lobe g;
    g.axis = toward_light(v, i);
    g.sharpness = v->plane[LIGHT_SHARPNESS][i];
    g.log_amplitude = 0.693147181f;
    return g;
}

/* Near its axis an SG is an ASG of half its sharpness. */
static inline asg_lobe as_asg(sg_lobe g) {
    asg_lobe a;
    a.z = g.axis;
    lobe_frame(g.axis, &a.x, &a.y);
    a.sharpness_x = 0.5f * g.sharpness;
    a.sharpness_y = 0.5f * g.sharpness;
    a.log_amplitude = g.log_amplitude;
    return a;
}

/* ---- the panels ---- */

enum { PANEL_SG_SG, PANEL_ASG_ASG, PANEL_ASG_SG, PANEL_ACCURATE, PANEL_TRUTH, PANELS };
static const char *const panel_names[PANELS] = {"SG x SG", "ASG x ASG", "ASG x SG, Xu", "ASG x SG, accurate", "truth"};

/* The NDF's sharpness as an SG; half of it as an ASG */
static float half_vector_sharpness(glossy look) {
    return look.ndf == NDF_PHONG ? look.parameter : 2 / (look.parameter * look.parameter);
}

static void shade_sg_sg(const plane_view *v, glossy look, float *restrict radiance) {
    const float scale = ndf_peak(look), sharpness = half_vector_sharpness(look);
    int i;
    for (i = 0; i < v->count; i++)
        radiance[i] = scale * v->plane[COEFFICIENT][i] *
                      sg_product_integral(sg_reflection_lobe(up, view_at(v, i), sharpness), light_at(v, i));
}

static void shade_asg_asg(const plane_view *v, glossy look, float *restrict radiance) {
    const float scale = ndf_peak(look), sharpness = 0.5f * half_vector_sharpness(look);
    int i;
    for (i = 0; i < v->count; i++)
        radiance[i] =
            scale * v->plane[COEFFICIENT][i] *
            asg_product_integral_xu(asg_reflection_lobe(up, view_at(v, i), sharpness), as_asg(light_at(v, i)));
}

static void shade_asg_sg(const plane_view *v, glossy look, float *restrict radiance) {
    const float scale = ndf_peak(look), sharpness = 0.5f * half_vector_sharpness(look);
    int i;
    for (i = 0; i < v->count; i++)
        radiance[i] = scale * v->plane[COEFFICIENT][i] *
                      asg_sg_integral_xu(asg_reflection_lobe(up, view_at(v, i), sharpness), light_at(v, i));
}

static void shade_accurate(const plane_view *v, glossy look, float *restrict radiance) {
    const float scale = ndf_peak(look), sharpness = 0.5f * half_vector_sharpness(look);
    int i;
    for (i = 0; i < v->count; i++)
        radiance[i] = scale * v->plane[COEFFICIENT][i] *
                      asg_sg_integral(asg_reflection_lobe(up, view_at(v, i), sharpness), light_at(v, i));
}

/* Directions to the sphere about its center's, equal shares of its solid angle: midpoints of rings, and the trapezoid
   rule along each */
static float true_radiance(const plane_view *v, int i, glossy look, int rings) {
    const vec3 axis = toward_light(v, i), wo = view_at(v, i);
    const float cap = 2 / v->plane[LIGHT_SHARPNESS][i]; /* 1 - cos of the sphere's half angle */
    const int around = 3 * rings;
    vec3 x, y;
    double sum = 0;
    int ring, k;
    lobe_frame(axis, &x, &y);
    for (ring = 0; ring < rings; ring++) {
        const float height = cap * ((float)ring + 0.5f) / (float)rings, sine = sqrtf(height * (2 - height));
        float part = 0;
        for (k = 0; k < around; k++) {
            float c, s;
            vec3 wi, h;
            lobe_turn(((float)k + 0.5f) / (float)around, &c, &s);
            wi = lobe_add(lobe_scale(axis, 1 - height), lobe_scale(lobe_add(lobe_scale(x, c), lobe_scale(y, s)), sine));
            h = lobe_add(wi, wo);
            part += wi.y > 0 ? ndf_shape(look, h.y / sqrtf(lobe_dot(h, h))) : 0.0f;
        }
        sum += (double)part;
    }
    return ndf_peak(look) * v->plane[COEFFICIENT][i] * 2 * LOBE_PI * cap * (float)(sum / ((double)rings * around));
}

static void shade_truth(const plane_view *v, glossy look, int rings, float *radiance) {
    const int block = 256, blocks = (v->count + block - 1) / block;
    progress line = progress_begin(look.name, blocks);
    int b;
    PARALLEL_FOR
    for (b = 0; b < blocks; b++) {
        int i;
        for (i = b * block; i < v->count && i < (b + 1) * block; i++) radiance[i] = true_radiance(v, i, look, rings);
        progress_step(&line);
    }
    progress_end(&line);
}

/* ---- what is said and shown of them ---- */

/* Milliseconds of a panel, which is shaded so often that the clock can tell */
static double shade_panel(int panel, const plane_view *v, glossy look, int rings, float *radiance) {
    static void (*const forms[PANEL_TRUTH])(const plane_view *, glossy, float *restrict) = {
        shade_sg_sg, shade_asg_asg, shade_asg_sg, shade_accurate};
    const int turns = panel == PANEL_TRUTH ? 1 : 1 + 1000000 / v->count;
    const double started = progress_clock();
    int turn;
    for (turn = 0; turn < turns; turn++) {
        if (panel == PANEL_TRUTH)
            shade_truth(v, look, rings, radiance);
        else
            forms[panel](v, look, radiance);
    }
    return (progress_clock() - started) / turns;
}

/* All of them, turn by turn; times are nanoseconds of a pixel. */
static void shade_panels(const plane_view *v, glossy look, int rings, float *const radiance[PANELS],
                         quartiles times[PANELS]) {
    timing taken[PANELS] = {{0, {0}, 0}};
    int repeat, k;
    for (repeat = 0; repeat < REPEATS; repeat++) {
        for (k = 0; k < PANELS; k++) {
            if (timing_goes_on(&taken[k], 1, REPEATS, 1000))
                timing_add(&taken[k], shade_panel(k, v, look, rings, radiance[k]));
        }
    }
    for (k = 0; k < PANELS; k++) times[k] = quartiles_scaled(timing_quartiles(&taken[k]), 1e6 / v->count);
}

static double rmse(const float *values, const float *wanted, int count) {
    double sum = 0;
    int i;
    for (i = 0; i < count; i++) sum += wanted ? pow((double)(values[i] - wanted[i]), 2) : pow((double)values[i], 2);
    return sqrt(sum / count);
}

/* For which share of the pixels the rule names a form simple enough */
static void say_forms(const plane_view *v, glossy look, float tolerance) {
    const float sharpness = 0.5f * half_vector_sharpness(look);
    int forms[3] = {0, 0, 0}, i;
    for (i = 0; i < v->count; i++)
        forms[asg_sg_form(asg_reflection_lobe(up, view_at(v, i), sharpness), v->plane[LIGHT_SHARPNESS][i],
                          tolerance)]++;
    printf("%-11s form for a loss of at most %.0f %%: SG %.1f %% of the pixels, Xu %.1f %%, accurate %.1f %%\n",
           look.name, 100 * (double)tolerance, 100.0 * forms[ASG_FORM_SG] / v->count,
           100.0 * forms[ASG_FORM_XU] / v->count, 100.0 * forms[ASG_FORM_ACCURATE] / v->count);
}

static void paint(image *sheet, const plane_view *v, int width, int height, int column, int row, const float *values,
                  const float *wanted, float scale) {
    int i;
    for (i = 0; i < v->count; i++) {
        float value = scale * (wanted ? fabsf(values[i] - wanted[i]) : values[i]);
        int x = v->pixel[i] % width + column * (width + 2), y = v->pixel[i] / width + row * (height + 2);
        sheet->pixels[y * sheet->width + x] = lobe_vector(value, value, value);
    }
}

static void print_row(csv *table, const char *name, const char *panel, double error, double relative, quartiles ns) {
    printf("%-11s %-18s %8.5f %9.4f %9.1f\n", name, panel, error, relative, ns.median);
    fflush(stdout);
    csv_text(table, name);
    csv_text(table, panel);
    csv_error(table, error);
    csv_error(table, relative);
    csv_quartiles(table, ns);
    csv_row(table);
}

int main(int argc, char **argv) {
    option_size size = {160, 200};
    int samples = 3072;
    const char *out = "build/glossy_plane";
    const option options[] = {
        OPTION_OF_SIZE(&size),
        {"--samples N", OPTION_WHOLE, &samples, 2, 1000000, "directions per pixel of the truth", 0},
        OPTION_OF_OUT(&out),
        {0, OPTION_WHOLE, 0, 0, 0, 0, 0},
    };
    plane_view view;
    image sheet;
    csv table;
    float *radiance[PANELS];
    int m, k, i, rings;

    options_read(options, argc, argv,
                 "Draws a sphere light over a glossy plane, reflection and light as SGs and ASGs,\n"
                 "and prints the speed and the error of each against numerical integration.");
    output_check(out, ".png");
    output_check(out, ".csv");
    for (rings = 1; 3 * (rings + 1) * (rings + 1) <= samples; rings++) continue;
    view = see_plane(size.width, size.height);
    sheet = image_create(PANELS * (size.width + 2) - 2, 2 * MATERIALS * (size.height + 2) - 2);
    for (k = 0; k < PANELS; k++)
        radiance[k] = (float *)allocate("image", (size_t)size.width * (size_t)size.height, sizeof(float));

    printf("%dx%d pixels a panel, %d directions a pixel of the truth\n\n", size.width, size.height, 3 * rings * rings);
    printf("material    panel                 RMSE  relative  ns/pixel\n");
    table = csv_begin("material,panel,rmse,relative,pixel_ns,pixel_ns_low,pixel_ns_high");
    for (m = 0; m < MATERIALS; m++) {
        const glossy look = materials[m];
        float brightest = 0, scale;
        quartiles times[PANELS];
        double root;
        for (i = 0; i < view.count; i++)
            view.plane[COEFFICIENT][i] = coefficient(look, toward_light(&view, i), view_at(&view, i));
        shade_panels(&view, look, rings, radiance, times);
        root = rmse(radiance[PANEL_TRUTH], NULL, view.count);
        for (i = 0; i < view.count; i++) brightest = lobe_max(brightest, radiance[PANEL_TRUTH][i]);
        scale = 1.5f / lobe_max(brightest, LOBE_TINY);
        for (k = 0; k < PANELS; k++) {
            const double error = rmse(radiance[k], radiance[PANEL_TRUTH], view.count);
            paint(&sheet, &view, size.width, size.height, k, 2 * m, radiance[k], NULL, scale);
            paint(&sheet, &view, size.width, size.height, k, 2 * m + 1, radiance[k], radiance[PANEL_TRUTH], scale);
            print_row(&table, look.name, panel_names[k], error, error / root, times[k]);
        }
        say_forms(&view, look, 0.01f);
    }
    output_picture(out, ".png", &sheet, 1);
    printf(
        "\nwrote %s.png: a column for each panel; for each material its panels, and their differences from the truth\n",
        out);
    csv_end(&table, out, ".csv", "the numbers above");
    for (k = 0; k < PANELS; k++) free(radiance[k]);
    for (k = 0; k < PLANES; k++) free(view.plane[k]);
    free(view.pixel);
    image_free(&sheet);
    return 0;
}
