/*
 filter.c - what a tap of a filter costs with each weight of bilateral.h, beside the papers' forms as printed

 All on one image of curved and flat parts with edges of gloss; times are medians of interleaved runs, per tap.
 Errors are those of the filtered colour against the same sums in double, largest over some pixels.
*/
#include "filter.h"
#include "tables.h"
#include "../exact_asg.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FORMS = 12, CHECKED = 6 };

#define INPUTS "17 x 17 taps of kernel, depth and lobe, three channels; beta %d"

FILTER_DECLARE(our_eq4);
FILTER_DECLARE(our_eq12_even);
FILTER_DECLARE(our_eq12);
FILTER_DECLARE(eq12_rows);
FILTER_DECLARE(eq12_pairs);
FILTER_DECLARE(eq11_rows);
FILTER_DECLARE(eq11_pairs);
FILTER_DECLARE(eq13_rows);
FILTER_DECLARE(eq13_pairs);
FILTER_DECLARE(printed_eq4);
FILTER_DECLARE(printed_eq12);
FILTER_DECLARE(printed_eq11);

/* Vector instructions of a tap with Eq. 4: differences 4; squares and sums 4; exp2: bounds 2, k 4, r 2, polynomial 6,
   last step 2; sums 4. */
enum { EQ4_OPERATIONS = 28 };

typedef struct {
    const char *name, *loop;
    filter_loop *scalar, *vector, *counted;
    int equation, both;
} filter_form;

#define FORM(text, name, equation, both)                                                                               \
    { text, #name, name##_scalar, name##_vector, BENCH_COUNTED(name), equation, both }

static const filter_form forms[FORMS] = {
    FORM("Eq. 4", our_eq4, 4, 0),
    FORM("Eq. 12, beta 20, power", our_eq12_even, 12, 0),
    FORM("Eq. 12, any beta", our_eq12, 12, 0),
    FORM("Eq. 12, any beta, rows", eq12_rows, 12, 0),
    FORM("Eq. 12, any beta, pairs", eq12_pairs, 12, 1),
    FORM("Eq. 11, 3 x 3 lobes, rows", eq11_rows, 11, 0),
    FORM("Eq. 11, 3 x 3 lobes, pairs", eq11_pairs, 11, 1),
    FORM("Eq. 13, rows", eq13_rows, 13, 0),
    FORM("Eq. 13, pairs", eq13_pairs, 13, 1),
    FORM("Eq. 4 as printed, libm", printed_eq4, 4, 0),
    FORM("Eq. 12 as printed, libm", printed_eq12, 12, 0),
    FORM("Eq. 11 as printed, libm", printed_eq11, 11, 0),
};

static filter_image image;
static filter_sums sums;
static filter_kernel kernel;
static sg_lobe lobe[FILTER_PIXELS];
static sg_lobe mixture[FILTER_PIXELS][FILTER_LOBES];
static asg_lobe anisotropic[FILTER_PIXELS];

static double uniform(void) {
    return test_uniform(&test_random);
}

static void put(int plane, int x, lobe_vec3 v) {
    image.plane[plane][x] = v.x;
    image.plane[plane + 1][x] = v.y;
    image.plane[plane + 2][x] = v.z;
}

static void put_asg(int x, asg_lobe a) {
    bilateral_asg p = bilateral_asg_prepare(a);
    put(PLANE_ASG, x, p.x);
    put(PLANE_ASG + 3, x, p.y);
    put(PLANE_ASG + 6, x, p.z);
    image.plane[PLANE_ASG + 9][x] = p.sharpness_x;
    image.plane[PLANE_ASG + 10][x] = p.sharpness_y;
    image.plane[PLANE_ASG + 11][x] = p.own_exponent;
    image.plane[PLANE_ASG + 12][x] = p.own_scale;
}

static void draw_pixel(int i) {
    const double column = i % FILTER_WIDTH, row = (double)(i / FILTER_WIDTH);
    const double bend = fmod(column, 60) < 30 ? 0.01 : 0,
                 sharpness = (column < 130 ? 20 : 60) * (0.9 + 0.2 * uniform());
    double axis[3];
    bilateral_sg p;
    bilateral_sg_part parts[FILTER_LOBES];
    int k;
    axis[0] = bend * (column - 30 * floor(column / 30)) + 0.02 * (uniform() - 0.5);
    axis[1] = bend * row + 0.02 * (uniform() - 0.5);
    axis[2] = 1;
    normalize(axis);
    lobe[i] = sg_around(axis, sharpness);
    for (k = 0; k < FILTER_LOBES; k++) {
        image.plane[PLANE_COLOUR + k][i] = (float)uniform();
        mixture[i][k] = sg_around(axis, sharpness);
        mixture[i][k].sharpness = lobe[i].sharpness * (float)(1 << 2 * k);
        mixture[i][k].log_amplitude = 0.693147181f * (float)k;
    }
    anisotropic[i] = lobe_around(axis, 0.02 * column, 2 * sharpness, 0.2 * sharpness);
    image.plane[PLANE_RAW_DEPTH][i] = (float)(1 + 0.01 * column + 0.1 * uniform());
    put(PLANE_RAW_AXIS, i, lobe[i].axis);
    image.plane[PLANE_RAW_SHARPNESS][i] = lobe[i].sharpness;
    image.plane[PLANE_DEPTH][i] = image.plane[PLANE_RAW_DEPTH][i] * bilateral_scale(FILTER_DEPTH_VARIANCE);
    put(PLANE_NORMAL, i, lobe_scale(lobe[i].axis, bilateral_scale(FILTER_NORMAL_VARIANCE)));
    p = bilateral_sg_prepare(lobe[i], FILTER_BETA);
    put(PLANE_SG, i, p.axis);
    image.plane[PLANE_SG + 3][i] = p.width;
    bilateral_sg_mixture_prepare(mixture[i], FILTER_LOBES, parts);
    for (k = 0; k < FILTER_LOBES; k++) {
        put(PLANE_MIXTURE + 6 * k, i, parts[k].axis);
        image.plane[PLANE_MIXTURE + 6 * k + 3][i] = parts[k].sharpness;
        image.plane[PLANE_MIXTURE + 6 * k + 4][i] = parts[k].amplitude;
        image.plane[PLANE_MIXTURE + 6 * k + 5][i] = parts[k].tail;
    }
    put_asg(i, anisotropic[i]);
}

static void draw_image(void) {
    int i, x, y;
    for (i = 0; i < FILTER_PIXELS; i++) draw_pixel(i);
    i = 0;
    for (y = -FILTER_RADIUS; y <= FILTER_RADIUS; y++) {
        for (x = -FILTER_RADIUS; x <= FILTER_RADIUS; x++) {
            kernel.offset[i] = y * FILTER_WIDTH + x;
            kernel.factor[i] = (float)exp(-(x * x + y * y) / (2. * (double)FILTER_KERNEL_VARIANCE));
            kernel.exponent[i++] = (float)(-(x * x + y * y) / (2. * (double)FILTER_KERNEL_VARIANCE * log(2)));
        }
    }
}

/* ---- in double ---- */

static double squared_between(lobe_vec3 a, lobe_vec3 b) {
    double u[3], v[3], sum = 0;
    int k;
    widen(a, u);
    widen(b, v);
    normalize(u);
    normalize(v);
    for (k = 0; k < 3; k++) sum += (u[k] - v[k]) * (u[k] - v[k]);
    return sum;
}

static double exact_product_of(int i, int j) {
    double sum = 0, chord2 = squared_between(lobe[i].axis, lobe[j].axis);
    int l, m;
    for (l = 0; l < FILTER_LOBES; l++) {
        for (m = 0; m < FILTER_LOBES; m++) {
            double a = (double)mixture[i][l].sharpness, b = (double)mixture[j][m].sharpness;
            double size = sqrt((a + b) * (a + b) - a * b * chord2);
            sum += exp((double)mixture[i][l].log_amplitude + (double)mixture[j][m].log_amplitude -
                       a * b * chord2 / (size + a + b)) *
                   -expm1(-2 * size) / size;
        }
    }
    return sum;
}

static double exact_lobe_weight(int equation, int i, int j) {
    double chord2 = squared_between(lobe[i].axis, lobe[j].axis), beta = FILTER_BETA;
    if (equation == 4) return exp(-chord2 / (2 * (double)FILTER_NORMAL_VARIANCE));
    if (equation == 12) {
        double a = (double)lobe[i].sharpness, b = (double)lobe[j].sharpness;
        return pow(4 * a * b / ((a + b) * (a + b)), 0.5 * beta) * exp(-0.5 * beta * chord2 * a * b / (a + b));
    }
    if (equation == 11) {
        return pow(exact_product_of(i, j) / sqrt(exact_product_of(i, i) * exact_product_of(j, j)), beta);
    }
    return pow(reference_product(anisotropic[i], &anisotropic[j], NULL) /
                   sqrt(reference_product(anisotropic[i], &anisotropic[i], NULL) *
                        reference_product(anisotropic[j], &anisotropic[j], NULL)),
               beta);
}

static int checked_pixel(int k) {
    return (FILTER_RADIUS + k % FILTER_ROWS) * FILTER_WIDTH + 2 * FILTER_RADIUS +
           k * (FILTER_ROW - 2 * FILTER_RADIUS) / CHECKED;
}

/* Three channels and the weights of a pixel, over all taps */
static void exact_sums(int equation, int i, double out[4]) {
    int t, c;
    for (c = 0; c < 4; c++) out[c] = 0;
    for (t = 0; t < FILTER_TAPS; t++) {
        const int j = i + kernel.offset[t];
        double d = (double)image.plane[PLANE_RAW_DEPTH][i] - (double)image.plane[PLANE_RAW_DEPTH][j], w;
        w = exp2((double)kernel.exponent[t]) * exp(-d * d / (2 * (double)FILTER_DEPTH_VARIANCE)) *
            exact_lobe_weight(equation, i, j);
        for (c = 0; c < 3; c++) out[c] += w * (double)image.plane[PLANE_COLOUR + c][j];
        out[3] += w;
    }
}

static double error_of(const filter_form *form) {
    static double wanted[14][CHECKED][4];
    static int known[14];
    double worst = 0;
    int y, k, c, count = form->equation == 13 ? 2 : CHECKED;
    memset(&sums, 0, sizeof sums);
    for (y = FILTER_RADIUS; y < (form->both ? FILTER_HEIGHT : FILTER_RADIUS + FILTER_ROWS); y++) {
        form->vector(&image, &kernel, y * FILTER_WIDTH + FILTER_RADIUS, FILTER_BETA, &sums);
    }
    for (k = 0; k < count; k++) {
        double exact[4];
        const int i = checked_pixel(k);
        if (!known[form->equation]) exact_sums(form->equation, i, wanted[form->equation][k]);
        for (c = 0; c < 4; c++) { /* pairs leave out the pixel itself, whose weight is 1 */
            exact[c] = wanted[form->equation][k][c];
            if (form->both) exact[c] -= c < 3 ? (double)image.plane[PLANE_COLOUR + c][i] : 1;
        }
        for (c = 0; c < 3; c++) {
            double got = (double)sums.sum[c][i] / (double)sums.sum[3][i];
            worst = fmax(worst, fabs(got - exact[c] / exact[3]));
        }
        worst = fmax(worst, fabs((double)sums.sum[3][i] / exact[3] - 1));
    }
    known[form->equation] = 1;
    return worst;
}

/* ---- times ---- */

static void run_row(filter_loop *run) {
    run(&image, &kernel, FILTER_RADIUS * FILTER_WIDTH + FILTER_RADIUS, FILTER_BETA, &sums);
}

/* Form f scalar is 2 f, vector 2 f + 1, on one row; then the peak of multiply-adds. */
static void run_form(int which) {
    static float values[FILTER_PEAK_LANES];
    if (which == 2 * FORMS)
        filter_peak_vector(values);
    else
        run_row(which % 2 ? forms[which / 2].vector : forms[which / 2].scalar);
}

/* Of run_row: a weight for two pixels is two taps */
static double taps_of(const filter_form *form) {
    return (form->both ? 2 * (FILTER_TAPS / 2) : FILTER_TAPS) * FILTER_ROW;
}

void bilateral_filter_bench(void) {
    quartiles times[2 * FORMS + 1];
    double bound, eq4 = 0;
    int f;
    draw_image();
    memset(&sums, 0, sizeof sums);
    bench_times(run_form, 2 * FORMS + 1, times);
    printf("bilateral_filter: " INPUTS "; errors of colours, and of weights relative\n", FILTER_BETA);
    printf("  %-34s %9s %9s %5s %7s %10s\n", "ns for each tap", "scalar", "vector", "+-%", "/ Eq. 4", "max error");
    for (f = 0; f < FORMS; f++) {
        const double scale = 1e9 / taps_of(&forms[f]), error = error_of(&forms[f]);
        const quartiles scalar = times[2 * f], vector = times[2 * f + 1];
        char inputs[128];
        if (f == 0) eq4 = vector.median * scale;
        printf("  %-34s %9.3f %9.3f %5.1f %7.2f %10.3g\n", forms[f].name, scalar.median * scale, vector.median * scale,
               bench_spread(vector), vector.median * scale / eq4, error);
        snprintf(inputs, sizeof inputs, INPUTS, FILTER_BETA);
        bench_function_row("bilateral.h", "bilateral_filter", forms[f].name, strncmp(forms[f].loop, "printed", 7) != 0,
                           inputs, "1 of colours, weights relative");
        csv_error(&bench_table[TABLE_FUNCTIONS], error);
        csv_skip(&bench_table[TABLE_FUNCTIONS], 1);
        csv_quartiles(&bench_table[TABLE_FUNCTIONS], quartiles_scaled(scalar, scale));
        csv_quartiles(&bench_table[TABLE_FUNCTIONS], quartiles_scaled(vector, scale));
        csv_row(&bench_table[TABLE_FUNCTIONS]);
    }
    bound = EQ4_OPERATIONS * times[2 * FORMS].median * 1e9 / FILTER_PEAK_OPERATIONS;
    printf("  Eq. 4's bound, %d operations at the measured peak of multiply-adds: %.3f ns; it reaches %.0f %%\n\n",
           EQ4_OPERATIONS, bound, 100 * bound / eq4);
}

/* ---- for limits.c ---- */

int filter_prepare(void) {
    int f = 0;
    draw_image();
    memset(&sums, 0, sizeof sums);
    while (f < FORMS && strncmp(forms[f].loop, "printed", 7)) f++;
    return f;
}

const char *filter_name(int form) {
    return forms[form].name;
}

double filter_run(int form) {
    run_row(forms[form].vector);
    return taps_of(&forms[form]);
}

double filter_count(int form) {
    if (!forms[form].counted) return 0;
    run_row(forms[form].counted);
    return taps_of(&forms[form]);
}

/* ---- Fig. 4 of 004 ---- */

void bilateral_figure4(void) {
    int k, degrees;
    printf("bilateral_figure4: Eqs. 11 and 12 of one lobe each, beta 20, by the angle between axes\n  degrees");
    for (k = 0; k < 5; k++) printf(",  Eq. 11 l=%-5.3g, Eq. 12 l=%-5.3g", pow(10, k - 1), pow(10, k - 1));
    printf("\n");
    for (degrees = 0; degrees <= 180; degrees += degrees < 20 ? 1 : 10) {
        double angle = degrees * REFERENCE_PI / 180;
        printf("  %7d", degrees);
        for (k = 0; k < 5; k++) {
            sg_lobe i, j;
            i.axis = lobe_vector(0, 0, 1);
            j.axis = lobe_vector((float)sin(angle), 0, (float)cos(angle));
            i.sharpness = j.sharpness = (float)pow(10, k - 1);
            i.log_amplitude = j.log_amplitude = 0;
            printf(", %14.6g, %14.6g", (double)bilateral_sg_mixture_weight(&i, 1, &j, 1, 20),
                   (double)bilateral_sg_weight(i, j, 20));
        }
        printf("\n");
    }
    printf("\n");
}
