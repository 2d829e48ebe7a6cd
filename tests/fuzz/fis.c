/* Images of any size and texels, and any arguments of fis.h's functions: finite and in range in the documented domain,
   no harm outside of it. Pyramids and tables have exactly the memory that they ask for. */
#include "../../fis.h"
#include "bytes.h"

enum { SIDE = 64, CHANNELS = 18 };

/* Texels of any bits, and where the bytes are over any of those before */
static float *any_image(size_t count) {
    float *image = (float *)malloc(count * sizeof *image);
    unsigned state = 1;
    size_t i, given = 0;
    if (!image) abort();
    for (i = 0; i < count; i++) {
        if (bytes_next < bytes_end && i < 200) {
            unsigned bits = bytes_bits();
            memcpy(image + i, &bits, sizeof bits);
            given = i + 1;
        } else {
            state = state * 1664525u + 1013904223u;
            image[i] = given ? image[(state >> 8) % given] : 0;
        }
    }
    return image;
}

static void check_cell(const char *function, fis_cell c) {
    bytes_check(function, (float)c.u0, 0, (float)c.u1);
    bytes_check(function, (float)c.v0, 0, (float)c.v1);
    bytes_check(function, (float)c.u1, 0, 1);
    bytes_check(function, (float)c.v1, 0, 1);
}

/* n samples of a PDF, their kernels of every kind, and what an image holds there */
static void samples(const fis_pyramid *pdf, const fis_pyramid *light, int n, float k) {
    float texels = (float)pdf->width * (float)pdf->height, top = (float)(pdf->levels - 1);
    int i, c;
    for (i = 0; i < 4; i++) {
        fis_point place;
        fis_sample s;
        float level, values[CHANNELS];
        int iterations = bytes_int(0, 60);
        if (i == 0) {
            int which = bytes_int(0, 1000);
            place = fis_lattice(which < n ? which : n - 1, n);
            bytes_check("fis_lattice", place.u, 0, 1 - 0x1p-24f);
            bytes_check("fis_lattice", place.v, 0, 1 - 0x1p-24f);
        } else {
            place.u = bytes_float("u", 0, 1);
            place.v = bytes_float("v", 0, 1);
        }
        s = fis_warp(pdf, place);
        bytes_check("fis_warp", s.u, 1e-30f, 1 - 0x1p-24f);
        bytes_check("fis_warp", s.v, 1e-30f, 1 - 0x1p-24f);
        bytes_check("fis_warp", s.density, 0, FLT_MAX);
        for (c = 0; c < pdf->levels; c++) bytes_check("fis_warp", s.share[c], 0, 1.00001f);
        if (bytes_in_domain) /* the texel has a mass */
            bytes_check("fis_warp's texel",
                        pdf->texels[(size_t)(s.v * (float)pdf->height) * (size_t)pdf->width +
                                    (size_t)(s.u * (float)pdf->width)],
                        0x1p-96f, 0x1p96f);
        level = fis_level(pdf, &s, n, k);
        bytes_check("fis_level", level, 0, top);
        bytes_check("fis_scale", fis_scale(pdf, &s, level, n), 0, FLT_MAX);
        bytes_check("fis_level_bisect", fis_level_bisect(pdf, &s, n, k, iterations), 0, top);
        bytes_check("fis_level_density", fis_level_density(pdf, &s, n, k), 0, 16);
        bytes_check("fis_level_density_nearest", fis_level_density_nearest(pdf, &s, n, k), 0, 16);
        bytes_check("fis_scale_density", fis_scale_density(pdf, &s, n), 0, texels);
        bytes_check("fis_scale_density_nearest", fis_scale_density_nearest(pdf, &s, n), 0, texels);
        fis_fetch(light, s.u, s.v, level, values);
        for (c = 0; c < light->channels; c++) bytes_check("fis_fetch", values[c], -0x1p96f, 0x1p96f);
        level = bytes_float("level", -FLT_MAX, FLT_MAX);
        place.u = bytes_float("u", -FLT_MAX, FLT_MAX);
        place.v = bytes_float("v", -FLT_MAX, FLT_MAX);
        fis_fetch(light, place.u, place.v, level, values);
        for (c = 0; c < light->channels; c++) bytes_check("fis_fetch anywhere", values[c], -0x1p96f, 0x1p96f);
        memcpy(&s.u, &place.u, sizeof s.u); /* a sample that fis_warp has not made */
        s.v = place.v;
        level = fis_level(pdf, &s, n, k);
        bytes_check("fis_level anywhere", level, 0, top);
        bytes_check("fis_scale anywhere", fis_scale(pdf, &s, level, n), 0, FLT_MAX);
    }
}

static void cells(const float *importance, const float *image, int width, int height, int channels, int n) {
    size_t size = fis_split_size(width, height);
    double *memory = (double *)malloc(size * sizeof *memory);
    fis_cell *cells = (fis_cell *)malloc((n > 0 ? (size_t)n : 1) * sizeof *cells), any;
    float *sums = (float *)malloc((size_t)channels * sizeof *sums);
    fis_split_table table;
    int i, c;
    if (!memory || !cells || !sums) abort();
    table = fis_split_build(memory, importance, width, height);
    bytes_check("fis_split_build", (float)table.sums[size - 1], 0x1p-96f, FLT_MAX);
    fis_split(&table, n, cells);
    for (i = 0; i < n; i++) check_cell("fis_split", cells[i]);
    any.u0 = (double)bytes_float("u0", -FLT_MAX, FLT_MAX);
    any.v0 = (double)bytes_float("v0", -FLT_MAX, FLT_MAX);
    any.u1 = (double)bytes_float("u1", -FLT_MAX, FLT_MAX);
    any.v1 = (double)bytes_float("v1", -FLT_MAX, FLT_MAX);
    fis_cell_sum(image, width, height, channels, n > 0 ? cells[n / 2] : any, sums);
    for (c = 0; c < channels; c++) bytes_check_finite("fis_cell_sum", sums[c]);
    fis_cell_sum(image, width, height, channels, any, sums);
    for (c = 0; c < channels; c++) bytes_check_finite("fis_cell_sum anywhere", sums[c]);
    free(sums);
    free(cells);
    free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    int width, height, channels, n;
    float k, *importance, *image, *pdf_memory, *memory;
    size_t size, i;
    fis_pyramid pdf, light;
    bytes_begin(bytes, count);
    width = bytes_int(1, bytes_byte() % 4 ? 9 : SIDE); /* mostly small ones, which take little time */
    height = bytes_int(1, bytes_byte() % 4 ? 9 : SIDE);
    channels = bytes_int(1, bytes_byte() % 4 ? 2 : CHANNELS);
    n = bytes_int(0, 3) ? bytes_int(1, 300) : 1 + (int)(bytes_bits() % 2147483647u);
    k = bytes_float("k", 1e-45f, FLT_MAX);
    bytes_record("width", (float)width);
    bytes_record("height", (float)height);
    bytes_record("n", (float)n);
    importance = any_image((size_t)width * (size_t)height);
    image = any_image((size_t)width * (size_t)height * (size_t)channels);
    size = fis_pyramid_size(width, height, channels);
    pdf_memory = (float *)malloc(fis_pyramid_size(width, height, 1) * sizeof *pdf_memory);
    memory = (float *)malloc(size * sizeof *memory);
    if (!pdf_memory || !memory) abort();
    pdf = fis_build_pdf(pdf_memory, importance, width, height);
    light = fis_build(memory, image, width, height, channels);
    for (i = 0; i < size; i++) bytes_check("fis_build", memory[i], -0x1p96f, 0x1p96f);
    for (i = 0; i < fis_pyramid_size(width, height, 1); i++) bytes_check("fis_build_pdf", pdf_memory[i], 0, 0x1p96f);
    samples(&pdf, &light, n, k);
    cells(importance, image, width, height, channels, n % 301);
    free(memory);
    free(pdf_memory);
    free(image);
    free(importance);
    return 0;
}
