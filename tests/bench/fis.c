/* fis.c - the tables of fis.h: kernels by each method, and pyramids beside a loop that only moves as many bytes. */
#include "bench.h"
#include "fis_quality.h"
#include "../../fis.h"
#include <stdio.h>
#include <stdlib.h>

static void *allocate(size_t size) {
    void *memory = malloc(size);
    if (!memory) {
        fprintf(stderr, "bench: out of memory\n");
        exit(1);
    }
    return memory;
}

/* ---- kernels ---- */

static fis_pyramid pdf;
static fis_split_table table;
static fis_sample samples[FIS_KERNELS];
static volatile float levels[FIS_KERNELS]; /* written as if read */
static fis_cell cells[FIS_KERNELS];

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
    float *image, *memory = (float *)allocate(fis_pyramid_size(FIS_SIDE, FIS_SIDE, 1) * sizeof *memory);
    double *sums = (double *)allocate(fis_split_size(FIS_SIDE, FIS_SIDE) * sizeof *sums);
    int kind, i;
    for (kind = 0; (image = fis_quality_image(kind, &name)); kind++) {
        fis_quality row[FIS_METHODS];
        double seconds[FIS_METHODS + 1];
        fis_quality_of(kind, row);
        pdf = fis_build_pdf(memory, image, FIS_SIDE, FIS_SIDE);
        table = fis_split_build(sums, image, FIS_SIDE, FIS_SIDE);
        run_method(FIS_METHODS);
        bench_medians(run_method, FIS_METHODS + 1, seconds);
        printf("fis_level: %s, %d by %d, %d kernels; a sample takes %.1f ns\n", name, FIS_SIDE, FIS_SIDE, FIS_KERNELS,
               seconds[FIS_METHODS] * 1e9 / FIS_KERNELS);
        printf("  %-18s %8s %7s %7s %9s %9s %6s %9s %9s %7s\n", "", "ns", "/ ours", "texels", "level RMS", "max",
               "gap %", "overlap %", "brightest", "total");
        for (i = 0; i < FIS_METHODS; i++) {
            printf("  %-18s %8.1f %7.2f %7.2f", row[i].method, seconds[i] * 1e9 / FIS_KERNELS, seconds[i] / seconds[3],
                   row[i].reads);
            if (row[i].rms < 0)
                printf(" %9s %9s", "-", "-");
            else
                printf(" %9.2g %9.2g", row[i].rms, row[i].largest);
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

void fis_build_bench(void) {
    static const int sizes[][3] = {{512, 512, 1}, {512, 512, 16}, {1920, 1088, 1}, {1920, 1088, 16}};
    static const char *const names[] = {"its bytes moved", "fis_build", "fis_build_pdf"};
    size_t size, i, count;
    for (size = 0; size < sizeof sizes / sizeof *sizes; size++) {
        double seconds[3];
        void *memory[2];
        int forms, form;
        built.width = sizes[size][0];
        built.height = sizes[size][1];
        built.channels = sizes[size][2];
        forms = built.channels == 1 ? 3 : 2;
        count = fis_pyramid_size(built.width, built.height, built.channels);
        memory[0] = allocate(count * sizeof(float) + 64);
        memory[1] = allocate(count * sizeof(float) + 64);
        built.image = aligned(memory[0]);
        built.memory = aligned(memory[1]);
        for (i = 0; i < count; i++) built.image[i] = (float)test_uniform(&test_random);
        bench_medians(run_build, forms, seconds);
        printf("fis_build: %d by %d, %d channels\n  %-18s %8s %7s\n", built.width, built.height, built.channels, "",
               "ms", "/ moved");
        for (form = 0; form < forms; form++)
            printf("  %-18s %8.3f %7.2f\n", names[form], 1e3 * seconds[form], seconds[form] / seconds[0]);
        printf("\n");
        fflush(stdout);
        free(memory[1]);
        free(memory[0]);
    }
}
