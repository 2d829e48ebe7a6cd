/* fis.c - the tables of fis.h: kernels by each method, and pyramids beside a loop that only moves as many bytes. */
#include "tables.h"
#include "fis_build.h"
#include "fis_quality.h"
#include "../../examples/common/fail.h"
#include "../../fis.h"
#include <stdio.h>
#include <stdlib.h>

/* ---- kernels ---- */

static fis_pyramid pdf;
static fis_split_table table;
static fis_sample samples[FIS_KERNELS];
static volatile float levels[FIS_KERNELS]; /* written as if read */
static fis_cell cells[FIS_KERNELS];

enum { OURS = 3, SPLIT = 4 };

/* Five methods in fis_quality's order; then the samples, which all but the split need */
static void run_method(int method) {
    int i;
    switch (method) {
    case 0:
        for (i = 0; i < FIS_KERNELS; i++) levels[i] = fis_level_density_nearest(&pdf, samples + i, FIS_KERNELS, 1);
        break;
    case 1:
        for (i = 0; i < FIS_KERNELS; i++) levels[i] = fis_level_density(&pdf, samples + i, FIS_KERNELS, 1);
        break;
    case 2:
        for (i = 0; i < FIS_KERNELS; i++) levels[i] = fis_level_bisect(&pdf, samples + i, FIS_KERNELS, 1, 12);
        break;
    case 3:
        for (i = 0; i < FIS_KERNELS; i++) levels[i] = fis_level(&pdf, samples + i, FIS_KERNELS, 1);
        break;
    case 4:
        fis_split(&table, FIS_KERNELS, cells);
        break;
    default:
        for (i = 0; i < FIS_KERNELS; i++) samples[i] = fis_warp(&pdf, fis_lattice(i, FIS_KERNELS));
    }
}

void fis_level_bench(void) {
    const char *name;
    float *image, *memory = (float *)allocate("a pyramid", fis_pyramid_size(FIS_SIDE, FIS_SIDE, 1), sizeof *memory);
    double *sums = (double *)allocate("sums", fis_split_size(FIS_SIDE, FIS_SIDE), sizeof *sums);
    int kind, i;
    for (kind = 0; (image = fis_quality_image(kind, &name)); kind++) {
        fis_quality row[FIS_METHODS];
        quartiles seconds[FIS_METHODS + 1];
        const double scale = 1e9 / FIS_KERNELS;
        fis_quality_of(kind, row);
        pdf = fis_build_pdf(memory, image, FIS_SIDE, FIS_SIDE);
        table = fis_split_build(sums, image, FIS_SIDE, FIS_SIDE);
        run_method(FIS_METHODS);
        bench_times(run_method, FIS_METHODS + 1, seconds);
        printf("fis_level: %s, %d by %d, %d kernels; a sample takes %.1f ns\n", name, FIS_SIDE, FIS_SIDE, FIS_KERNELS,
               seconds[FIS_METHODS].median * scale);
        printf("  %-18s %8s %5s %7s %7s %9s %9s %6s %9s %9s %7s\n", "", "ns", "+-%", "/ ours", "texels", "level RMS",
               "max", "gap %", "overlap %", "brightest", "total");
        for (i = 0; i < FIS_METHODS; i++) {
            csv_text(&bench_table[TABLE_FIS], name);
            csv_text(&bench_table[TABLE_FIS], row[i].method);
            csv_number(&bench_table[TABLE_FIS], i == OURS || i == SPLIT);
            csv_quartiles(&bench_table[TABLE_FIS], quartiles_scaled(seconds[i], scale));
            csv_number(&bench_table[TABLE_FIS], row[i].reads);
            printf("  %-18s %8.1f %5.1f %7.2f %7.2f", row[i].method, seconds[i].median * scale,
                   bench_spread(seconds[i]), seconds[i].median / seconds[OURS].median, row[i].reads);
            if (row[i].rms < 0) {
                printf(" %9s %9s", "-", "-");
                csv_skip(&bench_table[TABLE_FIS], 2);
            } else {
                printf(" %9.2g %9.2g", row[i].rms, row[i].largest);
                csv_error(&bench_table[TABLE_FIS], row[i].rms);
                csv_error(&bench_table[TABLE_FIS], row[i].largest);
            }
            csv_error(&bench_table[TABLE_FIS], row[i].gap);
            csv_error(&bench_table[TABLE_FIS], row[i].overlap);
            csv_error(&bench_table[TABLE_FIS], row[i].firefly);
            csv_error(&bench_table[TABLE_FIS], row[i].total);
            csv_row(&bench_table[TABLE_FIS]);
            printf(" %6.1f %9.1f %9.2f %7.4f\n", 100 * row[i].gap, 100 * row[i].overlap, row[i].firefly, row[i].total);
        }
        printf("\n");
        fflush(stdout);
        free(image);
    }
    free(sums);
    free(memory);
}

void fis_flicker_bench(void) {
    fis_quality row[FIS_METHODS];
    double flicker[FIS_METHODS];
    int i;
    fis_quality_of(0, row); /* for the names */
    fis_quality_flicker(flicker);
    printf("fis_flicker: light of %d kernels at 64 receivers, PDF with fresh noise each frame\n", FIS_KERNELS);
    printf("  %-18s %11s %15s\n", "", "deviation %", "bilinear / this");
    for (i = 0; i < FIS_METHODS; i++)
        printf("  %-18s %11.3f %15.1f\n", row[i].method, 100 * flicker[i], flicker[1] / flicker[i]);
    printf("\n");
}

/* ---- pyramids ---- */

static struct {
    int width, height, channels;
    float *image, *memory;
} built;

/* The first address in there that is a multiple of 64 bytes, which the widest vectors want */
static float *aligned(void *memory) {
    char *at = (char *)memory;
    return (float *)(void *)(at + (64 - (size_t)at % 64) % 64);
}

/* As many floats as a pyramid of the image has, read and written */
static void move(void) {
    size_t count = (size_t)built.width * (size_t)built.height * (size_t)built.channels, i;
    size_t above = fis_pyramid_size(built.width, built.height, built.channels) - count;
    float *to = built.memory;
    const float *from = built.image;
    for (i = 0; i < count; i++) to[i] = 1.5f * from[i];
    to += count;
    for (i = 0; i < above; i++) to[i] = 1.5f * from[i];
}

static void run_build(int which) {
    if (which == 0)
        move();
    else if (which == 1)
        fis_build(built.memory, built.image, built.width, built.height, built.channels);
    else
        fis_build_pdf(built.memory, built.image, built.width, built.height);
}

static void *pixels[2];

static void build_begin(int width, int height, int channels) {
    size_t i, count = fis_pyramid_size(width, height, channels);
    built.width = width;
    built.height = height;
    built.channels = channels;
    pixels[0] = allocate("an image", count * sizeof(float) + 64, 1);
    pixels[1] = allocate("a pyramid", count * sizeof(float) + 64, 1);
    built.image = aligned(pixels[0]);
    built.memory = aligned(pixels[1]);
    for (i = 0; i < count; i++) built.image[i] = (float)test_uniform(&test_random);
}

static void build_end(void) {
    free(pixels[1]);
    free(pixels[0]);
}

void fis_build_bench(void) {
    static const int sizes[][3] = {{512, 512, 1}, {512, 512, 16}, {1920, 1088, 1}, {1920, 1088, 16}};
    static const char *const names[] = {"its bytes moved", "fis_build", "fis_build_pdf"};
    size_t size;
    for (size = 0; size < sizeof sizes / sizeof *sizes; size++) {
        quartiles seconds[3];
        char inputs[64];
        const double texels = (double)sizes[size][0] * sizes[size][1];
        int forms = sizes[size][2] == 1 ? 3 : 2, form;
        build_begin(sizes[size][0], sizes[size][1], sizes[size][2]);
        bench_times(run_build, forms, seconds);
        build_end();
        snprintf(inputs, sizeof inputs, "%d by %d, %d channels", sizes[size][0], sizes[size][1], sizes[size][2]);
        printf("fis_build: %s\n  %-18s %8s %5s %7s\n", inputs, "", "ms", "+-%", "/ moved");
        for (form = 0; form < forms; form++) {
            printf("  %-18s %8.3f %5.1f %7.2f\n", names[form], 1e3 * seconds[form].median, bench_spread(seconds[form]),
                   seconds[form].median / seconds[0].median);
            bench_function_row("fis.h", "fis_build", names[form], form > 0, inputs, "");
            csv_skip(&bench_table[TABLE_FUNCTIONS], 5);
            csv_quartiles(&bench_table[TABLE_FUNCTIONS], quartiles_scaled(seconds[form], 1e9 / texels));
            csv_row(&bench_table[TABLE_FUNCTIONS]);
        }
        printf("\n");
        fflush(stdout);
    }
}

/* The image is read and the pyramid, which begins with it, is written. The copy moves as many, but that it reads more. */
fis_build_limit fis_build_measure(int channels) {
    const int width = 1920, height = 1088;
    const double texels = (double)width * height, pyramid = (double)fis_pyramid_size(width, height, channels);
    quartiles seconds[2];
    fis_build_limit l;
    build_begin(width, height, channels);
    bench_times(run_build, 2, seconds);
    build_end();
    l.bytes = sizeof(float) * (channels + pyramid / texels);
    l.nanoseconds.median = seconds[1].median * 1e9 / texels;
    l.nanoseconds.low = seconds[1].low * 1e9 / texels;
    l.nanoseconds.high = seconds[1].high * 1e9 / texels;
    l.peak = sizeof(float) * 2 * pyramid / seconds[0].median * 1e-9;
    return l;
}
