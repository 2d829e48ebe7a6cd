/* Unit tests of fis.h. References are sums and lookups in double, made from the image and not from the pyramid. */
#include "fis_study.h"
#include <float.h>
#include <stdio.h>
#include <stdlib.h>

/* To float and back; through memory, since -ffast-math leaves out the trip. */
static double rounded(double x) {
    volatile float single = (float)x;
    return (double)single;
}

/* ---- pyramids ---- */

static const int sizes[][2] = {{1, 1}, {2, 3}, {1, 97}, {97, 1}, {37, 53}, {64, 64}, {128, 32}, {129, 65}, {200, 255}};
enum { SIZES = (int)(sizeof sizes / sizeof *sizes) };

static fis_pyramid build_pdf(const float *image, int width, int height) {
    float *memory = (float *)malloc(fis_pyramid_size(width, height, 1) * sizeof *memory);
    return fis_build_pdf(memory, image, width, height);
}

static void free_pyramid(fis_pyramid p) {
    free((float *)p.texels);
}

/* The lowest and highest value of the share when the position moves by 2^-23 and the level by its last bit: what
   rounding them to float costs */
static void share_range(const reference *r, double u, double v, double level, double *low, double *high) {
    int i;
    *low = DBL_MAX;
    *high = 0;
    for (i = 0; i < 27; i++) {
        double value =
            share(r, u + (i % 3 - 1) * 0x1p-23, v + (i / 3 % 3 - 1) * 0x1p-23, level + (i / 9 - 1) * test_ulp(level));
        if (value < *low) *low = value;
        if (value > *high) *high = value;
    }
}

/* Whether share = wanted has one solution; found by sampling each level's interval */
static int crosses_once(const reference *r, double u, double v, double wanted) {
    double mean[LOBE_FIS_LEVELS];
    int level, i, crossings = 0, above = 0;
    for (level = 0; level < r->levels; level++) mean[level] = bilinear(r, u, v, level) / r->total;
    for (level = 0; level + 1 < r->levels; level++) {
        for (i = 0; i <= 64; i++) {
            double t = i / 64.0;
            int now = exp2(2 * (level + t)) * ((1 - t) * mean[level] + t * mean[level + 1]) >= wanted;
            if (level == 0 && i == 0 && now) return 0;
            crossings += now != above;
            above = now;
        }
    }
    return crossings == 1;
}

/* The same where rounding does not decide it */
static int unique(const reference *r, double u, double v, double wanted) {
    return crosses_once(r, u, v, wanted * (1 - 1e-6)) && crosses_once(r, u, v, wanted * (1 + 1e-6));
}

/* Algorithm 1 in double */
static double bisect(const reference *r, double u, double v, double wanted, int iterations) {
    double low = 0, high = r->levels - 1;
    while (iterations-- > 0) {
        double level = 0.5 * (low + high);
        if (share(r, u, v, level) < wanted)
            low = level;
        else
            high = level;
    }
    return 0.5 * (low + high);
}

/* With -ffast-math four texels may be added one by one: three roundings instead of two on the way */
static test_bound integral_bound(const char *function, const char *kind) {
    test_bound bound = test_bound_of("fis.h", function, kind);
#ifdef __FAST_MATH__
    bound.limit *= 1.5;
#endif
    return bound;
}

static void check_integral(test_bound *bound, int width, int height, int channels, int pdf) {
    size_t count = (size_t)width * (size_t)height * (size_t)channels, i;
    size_t size = fis_pyramid_size(width, height, channels);
    float *image = (float *)malloc(count * sizeof *image), *memory = (float *)malloc((size + 1) * sizeof *memory);
    test_rng rng = {(unsigned long long)(width * 7919 + height) + test_seed};
    fis_pyramid p;
    double inputs[2];
    int c;
    inputs[0] = width;
    inputs[1] = height;
    for (i = 0; i < count; i++) image[i] = (float)(pdf ? test_uniform(&rng) : 4 * test_uniform(&rng) - 1);
    memory[size] = 42;
    p = pdf ? fis_build_pdf(memory, image, width, height) : fis_build(memory, image, width, height, channels);
    test_that(memory[size] == 42.0f, "the pyramid stays in its memory", inputs, 2);
    test_that(p.levels == fis_levels(width, height) && halved(width, p.levels - 1) == 1 &&
                  halved(height, p.levels - 1) == 1 &&
                  (p.levels == 1 || halved(width, p.levels - 2) * halved(height, p.levels - 2) > 1),
              "the top level is the first of one texel", inputs, 2);
    for (c = 0; c < channels; c++) {
        double sum = 0, magnitude = 0;
        for (i = (size_t)c; i < count; i += (size_t)channels) {
            sum += (double)image[i];
            magnitude += fabs((double)image[i]);
        }
        test_within(bound, ldexp((double)memory[size - (size_t)channels + (size_t)c], 2 * (p.levels - 1)), sum,
                    magnitude, inputs, 2);
    }
    free(memory);
    free(image);
}

static void integral(void) {
    static const int sides[] = {1, 2, 3, 31, 32, 33, 127, 128, 129, 511, 512, 513, 1023, 1025, 1087, 1088, 1919, 1920};
    enum { SIDES = (int)(sizeof sides / sizeof *sides) };
    test_bound bound = integral_bound("fis_build", "rel"), pdf = integral_bound("fis_build_pdf", "rel");
    int width, height, i, k;
    for (width = 1; width < 34; width++) {
        for (height = 1; height < 34; height++) {
            check_integral(&bound, width, height, 2, 0);
            check_integral(&pdf, width, height, 1, 1);
        }
    }
    for (i = 34; i <= 1920; i += 1 + 9 * test_quick) { /* every width with some height, and every height */
        check_integral(&pdf, i, 1 + i % 7, 1, 1);
        if (i <= 1088) check_integral(&pdf, 1 + i % 7, i, 1, 1);
    }
    for (i = 0; i < SIDES; i++)
        for (k = 0; k < SIDES - 2; k++) check_integral(&pdf, sides[i], sides[k], 1, 1);
    check_integral(&bound, 255, 257, 17, 0);
    check_integral(&bound, 1920, 1088, 1, 0);
    check_integral(&bound, 1, 32768, 3, 0);
    check_integral(&bound, 32768, 1, 1, 0);
    test_report(&bound);
    test_report(&pdf);
}

/* The image that loses most: a texel of 1 in a corner, and in the three squares that each level adds to its square just
   so much that every sum with it is halfway to the next float and is rounded down. */
static void integral_worst(void) {
    enum { SIDE = 512 };
    test_bound bound = integral_bound("fis_build", "levels");
    float *image = (float *)malloc(SIDE * SIDE * sizeof *image);
    double sum = 0;
    fis_pyramid p;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            int level = 0, right;
            while (x >> level || y >> level) level++;
            right = level && x >> (level - 1);
            image[y * SIDE + x] = (float)(level ? ldexp(right ? 0x1p-25 : 0x1p-24, -2 * (level - 1)) : 1);
            sum += (double)image[y * SIDE + x];
        }
    }
    p = build_pdf(image, SIDE, SIDE);
#ifndef __FAST_MATH__
    test_that(sum - (double)lobe_fis_total(&p) > 0.9 * bound.limit * (p.levels - 1) * TEST_EPSILON,
              "the bound is not far from this", 0, 0);
#endif
    test_within(&bound, (double)lobe_fis_total(&p), sum, (p.levels - 1) * TEST_EPSILON * sum, 0, 0);
    test_report(&bound);
    free_pyramid(p);
    free(image);
}

/* 1 + ceil(log2 of the larger) */
static void check_levels(int width, int height) {
    int larger = width > height ? width : height, wanted = 1;
    double in[2];
    while (1 << (wanted - 1) < larger) wanted++;
    in[0] = width, in[1] = height;
    test_that(fis_levels(width, height) == wanted, "fis_levels", in, 2);
}

static void levels(void) {
    static const int wanted[][3] = {{1, 1, 1},      {2, 1, 2},    {1, 3, 3},        {4, 4, 3},         {5, 4, 4},
                                    {512, 512, 10}, {513, 2, 11}, {1920, 1088, 12}, {32768, 32768, 16}};
    const double floats = 16 * (ldexp(1, 32) - 1) / 3;
    int width, height, draw;
    size_t i;
    for (width = 1; width <= 330; width++)
        for (height = 1; height <= 330; height++) check_levels(width, height);
    for (draw = 0; draw < 20000; draw++)
        check_levels((int)test_log_uniform(&test_random, 1, 32768), (int)test_log_uniform(&test_random, 1, 32768));
    for (i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        double input = (double)i;
        test_that(fis_levels(wanted[i][0], wanted[i][1]) == wanted[i][2], "fis_levels", &input, 1);
    }
    test_that(fis_pyramid_size(5, 3, 2) == 2 * (15 + 6 + 2 + 1), "fis_pyramid_size", 0, 0);
    test_that((double)fis_pyramid_size(32768, 32768, 16) ==
                  (floats < (double)((size_t)-1 / 4) ? floats : (double)(size_t)-1),
              "no overflow", &floats, 1);
}

static void bad_pixels(void) {
    static const double places[] = {0, 0.3, 0.5, 0.77, 1};
    float image[12], memory[40], values[3], inverse = 1;
    fis_pyramid p;
    int i, j;
    volatile float zero = 0;
    memset(image, 0, sizeof image);
    image[0] = 3;
    image[1] = -2;
    image[4] = 1 / zero;
    image[5] = -1 / zero;
    image[6] = zero / zero;
    image[7] = FLT_MAX;
    image[8] = 0x1p96f;
    image[9] = 0x1.fffffep95f;
    image[10] = 0x1p-97f;
    image[11] = 0x1p-96f;
    p = fis_build(memory, image, 4, 3, 1);
    for (i = 0; i < 12; i++) {
        float wanted = i >= 4 && i <= 8 ? 0.0f : image[i];
        double input = i;
        test_that(p.texels[i] == wanted, "only bad texels are replaced", &input, 1);
    }
    memcpy(memory, image, sizeof image);
    p = fis_build(memory, memory, 4, 3, 1);
    for (i = 0; i < 12; i++) {
        double input = i;
        test_that(p.texels[i] == (i >= 4 && i <= 8 ? 0.0f : image[i]), "and in place", &input, 1);
    }
    p = fis_build_pdf(memory, image, 4, 3);
    for (i = 0; i < 12; i++) {
        float wanted = i == 0 || i == 9 || i == 11 ? image[i] : 0.0f;
        double input = i;
        test_that(p.texels[i] == wanted, "a PDF has no negative and no tiny texels", &input, 1);
    }
    for (i = 0; i < 5; i++) { /* the widest range that there is */
        for (j = 0; j < 5; j++) {
            fis_point point;
            fis_sample s;
            float results[4];
            int c;
            point.u = (float)places[i];
            point.v = (float)places[j];
            s = fis_warp(&p, point);
            results[0] = fis_level(&p, &s, 3, 1);
            results[1] = fis_scale(&p, &s, 0, 3) * 1e-3f;
            results[2] = fis_level_density(&p, &s, 3, 1);
            results[3] = fis_scale_density(&p, &s, 3);
            for (c = 0; c < 4; c++) test_that(results[c] >= 0 && results[c] <= FLT_MAX, "finite", places + i, 1);
        }
    }
    for (i = 0; i < 12; i++) image[i] = i % 3 == 0 ? -1.0f : i % 3 == 1 ? zero / zero : 0.0f;
    p = fis_build_pdf(image, image, 1, 3); /* in place; three texels fit into 12 with their pyramid */
    test_that(image[0] == 1.0f && image[1] == 1.0f && image[2] == 1.0f, "no mass: uniform", 0, 0);
    test_that(p.texels[p.offset[2]] == 3.0f / 16, "and its pyramid", 0, 0);
    image[0] = -1;
    image[1] = 42;
    p = fis_build_pdf(image, image, 1, 1);
    test_that(image[0] == 1.0f && image[1] == 42.0f, "of one texel, in its memory", 0, 0);
    for (i = 0; i < 3; i++) {
        values[i] = inverse;
        inverse *= -0.5f;
    }
    memcpy(memory, values, sizeof values);
    p = fis_build(memory, memory, 1, 1, 3);
    test_that(!memcmp(memory, values, sizeof values) && p.levels == 1, "in place", 0, 0);
}

static void fetch(void) {
    test_bound bound = test_bound_of("fis.h", "fis_fetch", "position");
    test_rng rng = {11 + test_seed};
    int size, i, c, x, y;
    for (size = 0; size < SIZES; size++) {
        int width = sizes[size][0], height = sizes[size][1], channels = 3;
        float *planes[3], *image, *memory;
        reference r[3];
        fis_pyramid p;
        image = (float *)malloc((size_t)(width * height * channels) * sizeof *image);
        memory = (float *)malloc(fis_pyramid_size(width, height, channels) * sizeof *memory);
        for (c = 0; c < channels; c++) {
            planes[c] = make_image(c == 0 ? POWER : c == 1 ? CONSTANT : OCTAVES, width, height, 5);
            for (i = 0; i < width * height; i++) {
                if (c == 2 && i % 2) planes[c][i] = -planes[c][i];
                image[i * channels + c] = planes[c][i];
            }
            r[c] = make_reference(planes[c], width, height);
        }
        p = fis_build(memory, image, width, height, channels);
        for (i = 0; i < test_few(2000); i++) {
            double in[3], largest = 0;
            float result[3];
            in[0] = rounded(1.1 * test_uniform(&rng) - 0.05);
            in[1] = rounded(1.1 * test_uniform(&rng) - 0.05);
            in[2] = rounded(test_uniform(&rng) * (p.levels + 1) - 1);
            if (i % 8 == 0) in[2] = floor(in[2]);
            if (i < 4) in[0] = i & 1, in[1] = i >> 1;
            fis_fetch(&p, (float)in[0], (float)in[1], (float)in[2], result);
            for (c = 0; c < channels; c++) {
                int texel;
                for (texel = 0; texel < width * height; texel++)
                    if (fabs((double)planes[c][texel]) > largest) largest = fabs((double)planes[c][texel]);
                test_within(&bound, (double)result[c], trilinear(&r[c], in[0], in[1], in[2]),
                            (width + height + 4) * TEST_EPSILON * largest, in, 3);
            }
        }
        for (y = 0; y < height; y++) {
            for (x = 0; x < width; x++) {
                float result[3], u, v;
                double in[2];
                in[0] = rounded((x + 0.5) / width);
                in[1] = rounded((y + 0.5) / height);
                u = (float)in[0];
                v = (float)in[1];
                fis_fetch(&p, u, v, 0, result);
                test_that(fabs((double)(result[0] - planes[0][y * width + x])) <= (width + height) * TEST_EPSILON,
                          "the centre of a texel gives the texel", in, 2);
                test_that(result[1] == 1.0f, "a constant stays", in, 2);
                if (width == 64) { /* a power of two: not diluted */
                    fis_fetch(&p, u, v, (float)(x + y) / 14, result);
                    test_that(fabs((double)result[1] - 1) <= 2 * TEST_EPSILON, "a constant stays at all levels", in, 2);
                }
            }
        }
        for (c = 0; c < channels; c++) {
            free_reference(r[c]);
            free(planes[c]);
        }
        free(image);
        free(memory);
    }
    { /* the largest number of levels */
        float *image = make_image(CONSTANT, 32768, 1, 1), mean;
        fis_pyramid p = build_pdf(image, 32768, 1);
        fis_fetch(&p, 0.5f, 0.5f, 99, &mean);
        test_that(mean == 1.0f / 32768, "the top of 16 levels", 0, 0);
        free_pyramid(p);
        free(image);
    }
    test_report(&bound);
}

/* ---- samples ---- */

static void lattice(void) {
    test_bound bound = test_bound_of("fis.h", "fis_lattice", "abs");
    test_rng rng = {3 + test_seed};
    const long double golden = (sqrtl(5.0L) - 1) / 2;
    int i, n, k;
    for (k = 0; k < 20000; k++) {
        double in[2], v;
        fis_point point;
        n = (int)test_log_uniform(&rng, 1, 2147483647.0);
        i = k % 3 == 0 ? n - 1 : (int)(test_uniform(&rng) * n);
        if (k == 0) n = i = 2147483647, i--;
        in[0] = i;
        in[1] = n;
        point = fis_lattice(i, n);
        v = (double)fmodl((long double)i * golden, 1.0L);
        test_within(&bound, (double)point.u, (i + 0.5) / n, 1, in, 2);
        test_within(&bound, (double)point.v + 0x1p-25, v, 1, in, 2); /* v is rounded down */
        test_that(point.u >= 0 && point.u < 1 && point.v >= 0 && point.v < 1, "in [0, 1)", in, 2);
    }
    for (n = 1; n <= 987; n += 29) { /* any interval of m / n of v holds about m points */
        double deviation = 0;
        for (k = 0; k <= 64; k++) {
            int inside = 0;
            for (i = 0; i < n; i++) inside += fis_lattice(i, n).v < (float)k / 64;
            deviation = fmax(deviation, fabs(inside - n * k / 64.0));
        }
        {
            double in = n;
            test_that(deviation < 3, "v is stratified", &in, 1);
        }
    }
    for (k = 0; k < 200000; k++) { /* the bits of v, whose carries are rare */
        double in;
        i = (int)(test_uniform(&rng) * 2147483647.0);
        in = i;
        test_that(fis_lattice(i, 2147483647).v == (float)((unsigned long long)i * 0x9E3779B97F4A7C15u >> 40) * 0x1p-24f,
                  "v is rounded down", &in, 1);
    }
    test_report(&bound);
}

#ifndef __FAST_MATH__ /* which knows no NaN */
/* Arguments that are not finite lead to no texel outside of the image: sanitizers see the rest. */
static void not_finite(void) {
    enum { WIDTH = 37, HEIGHT = 5 };
    volatile float zero = 0;
    const float bad[] = {zero / zero, -zero / zero, 1 / zero, -1 / zero};
    float *image = make_image(OCTAVES, WIDTH, HEIGHT, 3), value;
    fis_pyramid p = build_pdf(image, WIDTH, HEIGHT);
    int i, j;
    for (i = 0; i < 4; i++) {
        for (j = 0; j < 4; j++) {
            double in[2];
            fis_point place;
            fis_sample s;
            in[0] = (double)bad[i], in[1] = (double)bad[j];
            place.u = bad[i];
            place.v = bad[j];
            s = fis_warp(&p, place);
            test_that(s.u > 0 && s.u < 1 && s.v > 0 && s.v < 1, "a place that is not finite", in, 2);
            fis_fetch(&p, bad[i], bad[j], bad[i], &value);
            test_that(value >= 0 && value <= FLT_MAX, "a lookup that is not finite", in, 2);
        }
    }
    free_pyramid(p);
    free(image);
}
#endif

/* Upper critical value of chi-square at a probability of 1e-4: Wilson and Hilferty 1931 */
static double chi_square_limit(int freedom) {
    double s = 2.0 / (9 * freedom);
    return freedom * pow(1 - s + 3.719 * sqrt(s), 3);
}

static void warp_distribution(void) {
    static const int shapes[][2] = {{16, 8}, {13, 9}, {1, 11}, {5, 1}};
    enum { POINTS = 200000 };
    test_rng rng = {1234 + test_seed};
    int shape, stratified, i;
    for (shape = 0; shape < 4; shape++) {
        int width = shapes[shape][0], height = shapes[shape][1];
        float *image = make_image(POWER, width, height, 77);
        fis_pyramid pdf;
        double total = 0;
        for (i = 0; i < width * height; i++) {
            image[i] = i % 7 == 3 ? 0.0f : image[i] + 0.05f;
            total += (double)image[i];
        }
        pdf = build_pdf(image, width, height);
        for (stratified = 0; stratified < 2; stratified++) {
            int *hits = (int *)calloc((size_t)(4 * width * height), sizeof *hits), bins = 0; /* quarters of texels */
            double chi_square = 0, in[4];
            for (i = 0; i < POINTS; i++) {
                fis_point point = fis_lattice(i, POINTS);
                fis_sample s;
                if (!stratified) {
                    point.u = (float)test_uniform(&rng);
                    point.v = (float)test_uniform(&rng);
                }
                s = fis_warp(&pdf, point);
                hits[(int)(s.v * 2 * (float)height) * 2 * width + (int)(s.u * 2 * (float)width)]++;
            }
            for (i = 0; i < 4 * width * height; i++) {
                int texel = i / (4 * width) * width + i % (2 * width) / 2;
                double wanted = (double)image[texel] / total * POINTS / 4, difference = hits[i] - wanted;
                in[0] = width;
                in[1] = height;
                in[2] = i;
                in[3] = difference;
                if (image[texel] == 0.0f) {
                    test_that(hits[i] == 0, "no hits without mass", in, 4);
                } else {
                    chi_square += difference * difference / wanted;
                    bins++;
                }
                if (stratified) test_that(fabs(difference) < 12, "the lattice stays stratified", in, 4);
            }
            in[2] = chi_square;
            in[3] = bins - 1;
            test_that(chi_square < chi_square_limit(bins - 1), "chi-square", in, 4);
            if (!stratified) /* random points that are too regular are not */
                test_that(bins < 100 || chi_square > bins - 1 - 5 * sqrt(2.0 * bins), "chi-square, low", in, 4);
            free(hits);
        }
        free_pyramid(pdf);
        free(image);
    }
}

static void warp_support(void) {
    static const float edges[] = {0, 1e-38f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 0.99999994f, 1, -0.1f, 1.1f, -1e30f, 1e30f};
    enum { EDGES = (int)(sizeof edges / sizeof *edges), POINTS = 2000 };
    test_bound bound = test_bound_of("fis.h", "fis_warp", "rel");
    test_rng rng = {5 + test_seed};
    int kind, size, i;
    for (kind = 0; kind < KINDS; kind++) {
        for (size = 0; size < SIZES; size++) {
            int width = sizes[size][0], height = sizes[size][1];
            float *image = make_image(kind, width, height, 9);
            fis_pyramid pdf = build_pdf(image, width, height);
            reference r = make_reference(image, width, height);
            for (i = 0; i < EDGES * EDGES + POINTS; i++) {
                fis_point point;
                fis_sample s;
                double in[6], density;
                int x, y, level;
                point.u = i < POINTS ? (float)test_uniform(&rng) : edges[(i - POINTS) / EDGES];
                point.v = i < POINTS ? (float)test_uniform(&rng) : edges[(i - POINTS) % EDGES];
                s = fis_warp(&pdf, point);
                in[0] = kind;
                in[1] = width;
                in[2] = height;
                in[3] = (double)point.u;
                in[4] = (double)point.v;
                x = (int)floorf(s.u * (float)width);
                y = (int)floorf(s.v * (float)height);
                test_that(s.u > 0 && s.u < 1 && s.v > 0 && s.v < 1, "in the image", in, 5);
                if (x < 0 || x >= width || y < 0 || y >= height) continue;
                test_that(image[y * width + x] > 0, "a texel with mass", in, 5);
                density = (double)image[y * width + x] * width * height / r.total;
                test_within(&bound, (double)s.density, density, density, in, 5);
                for (level = 0; level < r.levels; level++) {
                    double wanted =
                        ldexp(r.level[level][(y >> level) * halved(width, level) + (x >> level)], 2 * level) / r.total;
                    in[5] = level;
                    test_within(&bound, (double)s.share[level], wanted, wanted, in, 6);
                }
            }
            free_reference(r);
            free_pyramid(pdf);
            free(image);
        }
    }
    test_report(&bound);
}

/* A texel's border must not be crossed by rounding, at the largest sizes least of all. */
static void warp_borders(void) {
    enum { SIDE = 32768 };
    float *image = (float *)calloc(SIDE, sizeof *image);
    fis_pyramid pdf;
    test_rng rng = {6 + test_seed};
    int i, vertical;
    for (i = 0; i < SIDE; i += 2) image[i] = 1;
    for (vertical = 0; vertical < 2; vertical++) {
        pdf = build_pdf(image, vertical ? 1 : SIDE, vertical ? SIDE : 1);
        for (i = 0; i < test_few(200000); i++) {
            fis_point point;
            fis_sample s;
            double in[2];
            point.u = point.v = (float)((i / 6 + (i % 6 - 2) * 0x1p-9 * test_uniform(&rng)) / SIDE);
            s = fis_warp(&pdf, point);
            in[0] = vertical;
            in[1] = (double)point.u;
            test_that((int)((vertical ? s.v : s.u) * (float)SIDE) % 2 == 0, "a texel with mass", in, 2);
        }
        free_pyramid(pdf);
    }
    free(image);
}

/* ---- kernel sizes ---- */

/* Some of the lattice, others for each seed */
static fis_point place(int i, int n) {
    enum { SEEDS = 101 };
    return fis_lattice(SEEDS * i + (int)(test_seed >> 32) % SEEDS, SEEDS * n);
}

static const int counts[] = {1, 2, 37, 1024, 100000};
static const float factors[] = {1, 4, 0.3f, 1e-6f, 1e6f};

static void level_solver(void) {
    test_bound residual = test_bound_of("fis.h", "fis_level", "residual");
    test_bound rms = test_bound_of("fis.h", "fis_level", "rms");
    test_bound bisection = test_bound_of("fis.h", "fis_level_bisect", "residual");
    double squares = 0, in[8];
    int kind, size, i, count, factor, solved = 0, several = 0;
    for (kind = 0; kind < KINDS; kind++) {
        for (size = 0; size < SIZES; size++) {
            int width = sizes[size][0], height = sizes[size][1];
            float *image = make_image(kind, width, height, 21);
            fis_pyramid pdf = build_pdf(image, width, height);
            reference r = make_reference(image, width, height);
            for (i = 0; i < test_few(24); i++) {
                fis_sample s = fis_warp(&pdf, place(i, 24));
                for (count = 0; count < 5; count++) {
                    for (factor = 0; factor < 5; factor++) {
                        int n = counts[count];
                        float k = factors[factor], level = fis_level(&pdf, &s, n, k);
                        float bisected = fis_level_bisect(&pdf, &s, n, k, 60);
                        double wanted = (double)k / n, low, high, off, u = (double)s.u, v = (double)s.v;
                        in[0] = kind, in[1] = width, in[2] = height, in[3] = n, in[4] = (double)k;
                        in[5] = u, in[6] = v, in[7] = (double)level;
                        test_that(level >= 0 && level <= (float)(r.levels - 1), "in the pyramid", in, 8);
                        share_range(&r, u, v, (double)level, &low, &high);
                        off = wanted < low ? wanted - low : wanted > high ? wanted - high : 0;
                        if (level == 0.0f && off < 0) off = 0;                  /* one texel holds more */
                        if (level == (float)(r.levels - 1) && off > 0) off = 0; /* all holds less */
                        test_within(&residual, off, 0, wanted, in, 8);
                        if (unique(&r, u, v, wanted)) {
                            double root = bisect(&r, u, v, wanted, 40);
                            squares += ((double)level - root) * ((double)level - root);
                            solved++;
                            share_range(&r, u, v, (double)bisected, &low, &high);
                            in[7] = (double)bisected;
                            test_within(&bisection, wanted, clamped(wanted, low, high), wanted, in, 8);
                        } else {
                            several++;
                        }
                    }
                }
            }
            free_reference(r);
            free_pyramid(pdf);
            free(image);
        }
    }
    in[0] = solved;
    in[1] = several;
    test_that(solved > 1000, "enough cases with one solution", in, 2);
    test_within(&rms, sqrt(squares / solved), 0, 1, in, 2);
    test_report(&residual);
    test_report(&rms);
    test_report(&bisection);
}

/* 4^t (a + t (b - a)) = 1 near a double root at t = 1, where the slope vanishes too, and with extreme ends */
static void level_tangent(void) {
    double in[2];
    int i, j;
    for (i = -3000; i < 3000; i++) {
        for (j = -4; j < 10; j++) {
            float a = (float)(0.5965735902799727 + i * (i % 2 ? 0x1p-24 : 1e-4));
            float b = (float)(0.25 + (j < 0 ? 0 : pow(10, 2 * j - 8))), t;
            if (a < 0) a = 0;
            if (a >= 1) a = 0.99999994f;
            t = lobe_fis_root(a, b);
            in[0] = (double)a;
            in[1] = (double)b;
            test_that(t >= 0 && t <= 1, "in [0, 1]", in, 2);
            /* two last bits of t, and four of the values */
            test_that(fabs((in[0] + (double)t * (in[1] - in[0])) * pow(4, (double)t) - 1) <
                          2.5e-7 + 0x1p-23 * (double)t * (4 * in[1] + 2),
                      "a root", in, 2);
        }
    }
}

/* The same equation with ratios of the ends from the least to 1e8, and solutions anywhere, next to each end and next to
   a double root, 1e-5 from it and, for the largest error, as near as there are floats: against bisection in double */
static void level_stress(void) {
    test_bound rms = test_bound_of("fis.h", "fis_level", "stress"), most = test_bound_of("fis.h", "fis_level", "worst");
    int solved = 0, count = test_repeat > 1 ? 878040 : 87804, i, step;
    double squares = 0, in[3];
    for (i = 0; i < count; i++) {
        double kind = 6 * test_uniform(&test_random), part = test_uniform(&test_random), low = 0, high = 1, ratio;
        double nearest = kind < 5 ? 1e-5 : 1e-9;
        float a, b, t;
        ratio = kind < 2   ? test_log_uniform(&test_random, 0.2501, 1e3)
                : kind < 3 ? 0.25 + 0.25 * test_uniform(&test_random)
                : kind < 4 ? test_log_uniform(&test_random, 4, 1e8)
                           : 0.41905978 + (part < 0.5 ? 1 : -1) * test_log_uniform(&test_random, nearest, 0.05);
        if (kind < 1) part = test_log_uniform(&test_random, 1e-7, 1);
        if (kind >= 4) part = 1 - test_log_uniform(&test_random, nearest, 1);
        a = (float)pow(4 * ratio, -part); /* 4^0 a is so much of the whole way below 1 */
        b = (float)(ratio * pow(4 * ratio, -part));
        if (a >= 1 || 4 * b < 1) continue;
        t = lobe_fis_root(a, b);
        in[0] = (double)a, in[1] = (double)b, in[2] = (double)t;
        test_that(t >= 0 && t <= 1, "in [0, 1]", in, 3);
        for (step = 0; step < 40; step++) {
            double middle = 0.5 * (low + high);
            if (exp2(2 * middle) * (in[0] + middle * (in[1] - in[0])) < 1)
                low = middle;
            else
                high = middle;
        }
        test_within(&most, in[2], high, 1, in, 3);
        if (kind >= 5) continue;
        squares += (in[2] - high) * (in[2] - high);
        solved++;
    }
    test_within(&rms, sqrt(squares / solved), 0, 1, 0, 0);
    test_report(&rms);
    test_report(&most);
}

/* 002, Eq. 1 and 4 in double, from the PDF at the sample in the two readings */
/* Of the positions that rounding may make of this one, the nearest to its texel's centre, where a bilinear lookup has a
   kink */
static double near_centre(double x, int size) {
    return clamped((floor(x * size) + 0.5) / size, x - 0x1p-23, x + 0x1p-23);
}

static void density(void) {
    test_bound level[2], scale[2];
    double in[7];
    int kind, size, i, count, factor, nearest;
    level[0] = test_bound_of("fis.h", "fis_level_density", "abs");
    level[1] = test_bound_of("fis.h", "fis_level_density_nearest", "abs");
    scale[0] = test_bound_of("fis.h", "fis_scale_density", "rel");
    scale[1] = test_bound_of("fis.h", "fis_scale_density_nearest", "rel");
    for (kind = 0; kind < KINDS; kind++) {
        for (size = 0; size < SIZES; size++) {
            int width = sizes[size][0], height = sizes[size][1], texels = width * height;
            float *image = make_image(kind, width, height, 33);
            fis_pyramid pdf = build_pdf(image, width, height);
            reference r = make_reference(image, width, height);
            for (i = 0; i < 48 * 25; i++) {
                fis_sample s = fis_warp(&pdf, place(i, 48 * 25));
                double low = DBL_MAX, high = 0;
                int n = counts[i % 5], corner;
                float k = factors[factor = i / 5 % 5];
                count = i % 5;
                in[0] = kind, in[1] = width, in[2] = height, in[3] = counts[count], in[4] = (double)factors[factor];
                in[5] = (double)s.u, in[6] = (double)s.v;
                for (nearest = 0; nearest < 2; nearest++) {
                    double got = nearest ? (double)fis_level_density_nearest(&pdf, &s, n, k)
                                         : (double)fis_level_density(&pdf, &s, n, k);
                    double factor_got = nearest ? (double)fis_scale_density_nearest(&pdf, &s, n)
                                                : (double)fis_scale_density(&pdf, &s, n);
                    double wanted, p;
                    if (nearest) {
                        int x = (int)((double)s.u * width), y = (int)((double)s.v * height);
                        low = high = r.level[0][y * width + x] * texels / r.total;
                    } else { /* the position is rounded: the range over its last bits */
                        for (corner = 0; corner < 9; corner++) {
                            double u = corner % 3 == 1 ? near_centre((double)s.u, width)
                                                       : (double)s.u + (corner % 3 - 1) * 0x1p-23;
                            double v = corner / 3 == 1 ? near_centre((double)s.v, height)
                                                       : (double)s.v + (corner / 3 - 1) * 0x1p-23;
                            p = bilinear(&r, u, v, 0) * texels / r.total;
                            if (p < low) low = p;
                            if (p > high) high = p;
                        }
                    }
                    wanted = fmax(0.5 * log2(texels * fmin((double)k / (n * high), 1)), 0);
                    wanted = clamped(got, wanted, fmax(0.5 * log2(texels * fmin((double)k / (n * low), 1)), 0));
                    test_within(&level[nearest], got, wanted, 1, in, 7);
                    wanted = clamped(factor_got, texels / fmax(n * high, 1), texels / fmax(n * low, 1));
                    test_within(&scale[nearest], factor_got, wanted, wanted, in, 7);
                }
            }
            free_reference(r);
            free_pyramid(pdf);
            free(image);
        }
    }
    test_report(&level[0]);
    test_report(&level[1]);
    test_report(&scale[0]);
    test_report(&scale[1]);
}

/* ---- totals ---- */

static void totals(void) {
    test_bound bound = test_bound_of("fis.h", "fis_scale", "rel");
    test_bound model = test_bound_of("fis.h", "fis_scale", "model");
    int kind, size, count, i;
    double in[4];
    for (kind = 0; kind < KINDS; kind++) {
        for (size = 0; size < SIZES; size++) {
            int width = sizes[size][0], height = sizes[size][1];
            float *image = make_image(kind, width, height, 13);
            fis_pyramid pdf = build_pdf(image, width, height);
            for (count = 0; count < 4; count++) {
                int n = counts[count];
                double sum = 0, total = 0;
                for (i = 0; i < n; i++) {
                    fis_sample s = fis_warp(&pdf, fis_lattice(i, n));
                    float level = fis_level(&pdf, &s, n, 1), mean;
                    fis_fetch(&pdf, s.u, s.v, level, &mean);
                    sum += (double)fis_scale(&pdf, &s, level, n) * (double)mean;
                }
                for (i = 0; i < width * height; i++) total += (double)image[i];
                in[0] = kind, in[1] = width, in[2] = height, in[3] = n;
                test_within(&bound, sum, total, total, in, 4);
            }
            free_pyramid(pdf);
            free(image);
        }
    }
    { /* improbable, but not yet so that it counts as 0 */
        float pair[2] = {1, 0x1p-90f};
        fis_pyramid pdf = build_pdf(pair, 2, 1);
        fis_sample s = fis_warp(&pdf, fis_lattice(0, 1));
        s.u = 0.75f;
        s.v = 0.5f;
        test_within(&bound, (double)fis_scale(&pdf, &s, 0, 4), 0x1p88, 0x1p88, in, 0);
        test_that(fis_level_bisect(&pdf, &s, 1, 100, 20) <= (float)(pdf.levels - 1), "no level above the top one", in,
                  0);
        free_pyramid(pdf);
    }
    { /* another channel: a smooth image, unlike the PDF */
        enum { SIDE = 256, COUNT = 1024 };
        float *image = make_image(SMOOTH, SIDE, SIDE, 13), *memory;
        fis_pyramid pdf = build_pdf(image, SIDE, SIDE), other;
        double sum = 0, total = 0;
        memory = (float *)malloc(fis_pyramid_size(SIDE, SIDE, 1) * sizeof *memory);
        for (i = 0; i < SIDE * SIDE; i++) {
            image[i] = (float)(1 + 0.5 * cos(6.283185307179586 * ((i % SIDE + 0.5) / SIDE)));
            total += (double)image[i];
        }
        other = fis_build(memory, image, SIDE, SIDE, 1);
        for (i = 0; i < COUNT; i++) {
            fis_sample s = fis_warp(&pdf, fis_lattice(i, COUNT));
            float level = fis_level(&pdf, &s, COUNT, 1), mean;
            fis_fetch(&other, s.u, s.v, level, &mean);
            sum += (double)fis_scale(&pdf, &s, level, COUNT) * (double)mean;
        }
        test_within(&model, sum, total, total, in, 0);
        free_pyramid(pdf);
        free(memory);
        free(image);
    }
    {
        static const float lone[5] = {0, 0, 0, 0, 1};
        fis_pyramid pdf = build_pdf(lone, 5, 1);
        fis_sample s;
        memset(&s, 0, sizeof s);
        test_that(fis_scale(&pdf, &s, 0, 8) == 0.0f, "no mass: 0, not infinity", 0, 0);
        test_that(fis_scale_density(&pdf, &s, 8) == 5.0f, "M at most", 0, 0);
        test_that(fis_level(&pdf, &s, 8, 1) > 1 && fis_level(&pdf, &s, 8, 1) < 3, "a level beside the mass", 0, 0);
        free_pyramid(pdf);
    }
    test_report(&bound);
    test_report(&model);
}

/* ---- cells ---- */

/* Sum over a cell of an image in double, texel by texel */
static double cell_total(const float *image, int width, int height, fis_cell cell) {
    double sum = 0;
    int x, y;
    for (y = (int)(cell.v0 * height); y < height && y < cell.v1 * height; y++)
        for (x = (int)(cell.u0 * width); x < width && x < cell.u1 * width; x++)
            sum += fmax(fmin(x + 1, cell.u1 * width) - fmax(x, cell.u0 * width), 0) *
                   fmax(fmin(y + 1, cell.v1 * height) - fmax(y, cell.v0 * height), 0) * (double)image[y * width + x];
    return sum;
}

/* Whether cells tile: every one inside the image, areas adding up to 1, and no point of a grid in two or in none */
static void check_tiles(const fis_cell *cells, int n, const double *in) {
    enum { GRID = 61 };
    static int cover[GRID * GRID];
    double area = 0;
    int i, x, y;
    memset(cover, 0, sizeof cover);
    for (i = 0; i < n; i++) {
        fis_cell c = cells[i];
        test_that(c.u0 >= 0 && c.u0 <= c.u1 && c.u1 <= 1 && c.v0 >= 0 && c.v0 <= c.v1 && c.v1 <= 1, "in the image", in,
                  4);
        area += (c.u1 - c.u0) * (c.v1 - c.v0);
        for (y = (int)ceil(c.v0 * GRID); y < c.v1 * GRID && y < GRID; y++)
            for (x = (int)ceil(c.u0 * GRID); x < c.u1 * GRID && x < GRID; x++) cover[y * GRID + x]++;
    }
    test_that(fabs(area - 1) < (n + 4) * 0x1p-53, "areas add up to 1", in, 4);
    for (i = 0; i < GRID * GRID; i++) test_that(cover[i] == 1, "no gaps and no overlaps", in, 4);
}

static void split(void) {
    enum { MOST = 100000 };
    test_bound mass = test_bound_of("fis.h", "fis_split", "total");
    test_bound table_bound = test_bound_of("fis.h", "fis_split_build", "sides");
    fis_cell *cells = (fis_cell *)malloc((MOST + 1) * sizeof *cells);
    double in[4], unit;
    int kind, size, count, i;
    for (kind = 0; kind < KINDS; kind++) {
        for (size = 0; size < SIZES; size++) {
            int width = sizes[size][0], height = sizes[size][1], texels = width * height,
                numbers[9] = {1, 2, 3, 37, 1000};
            float *image = make_image(kind, width, height, 8);
            size_t table_size = fis_split_size(width, height);
            double *memory = (double *)malloc((table_size + 1) * sizeof *memory), total = 0;
            fis_split_table table;
            numbers[5] = texels;
            numbers[6] = texels > 1 ? texels - 1 : 1;
            numbers[7] = 2 * texels + 1 < MOST ? 2 * texels + 1 : MOST;
            numbers[8] = size == 4 ? test_few(MOST) : 5;
            memory[table_size] = 42;
            table = fis_split_build(memory, image, width, height);
            test_that(memory[table_size] == 42.0, "the table stays in its memory", in, 0);
            for (i = 0; i < texels; i++) total += (double)image[i];
            unit = (width + height) * 0x1p-53 * total;
            in[0] = kind, in[1] = width, in[2] = height;
            test_within(&table_bound, table.sums[table_size - 1], total, unit, in, 3);
            for (count = 0; count < 9; count++) {
                int n = numbers[count];
                in[3] = n;
                cells[n].u0 = 42;
                fis_split(&table, n, cells);
                test_that(cells[n].u0 == 42.0, "n cells", in, 4);
                check_tiles(cells, n, in);
                for (i = 0; i < n; i++) {
                    double error = cell_total(image, width, height, cells[i]) - total / n;
                    test_within(&mass, error, 0, unit, in, 4);
                    test_that(fabs(error) < 1e-6 * total / n, "mass to 1e-6", in, 4);
                }
            }
            free(memory);
            free(image);
        }
    }
    { /* a constant image with a square's cells: the cut goes across the longer side, where the count is halved */
        float image[64];
        double memory[81];
        volatile float zero = 0;
        fis_split_table table;
        for (i = 0; i < 64; i++) image[i] = -1;
        table = fis_split_build(memory, image, 8, 8); /* no mass: uniform */
        fis_split(&table, 16, cells);
        for (i = 0; i < 16; i++)
            test_that(fabs(cells[i].u1 - cells[i].u0 - 0.25) < 1e-12 && fabs(cells[i].v1 - cells[i].v0 - 0.25) < 1e-12,
                      "squares", in, 0);
        for (i = 0; i < 64; i++) image[i] = i == 9 ? 2.0f : i == 54 ? 6.0f : i % 2 ? -1e3f : 1 / (zero * zero);
        table = fis_split_build(memory, image, 8, 8);
        test_that(table.sums[80] == 8.0 && table.sums[20] == 2.0, "bad texels are 0", in, 0);
        cells[0].u0 = 42;
        fis_split(&table, 0, cells);
        test_that(cells[0].u0 == 42.0, "no cells", in, 0);
    }
    { /* the rows that lose most: what follows the first texel is halfway to the next double, and is rounded down */
        enum { WIDTH = 2000 };
        float image[WIDTH];
        double memory[2 * (WIDTH + 1)], total;
        fis_split_table table;
        image[0] = 1;
        for (i = 1; i < WIDTH; i++) image[i] = 0x1p-53f;
        table = fis_split_build(memory, image, WIDTH, 1);
        total = 1 + (WIDTH - 1) * 0x1p-53;
        test_within(&table_bound, table.sums[2 * WIDTH + 1], total, (WIDTH + 1) * 0x1p-53, 0, 0);
        test_that(table_bound.worst > 0.9 * table_bound.limit, "the bound is not far from this", 0, 0);
    }
    free(cells);
    test_report(&mass);
    test_report(&table_bound);
}

static void cell_sum(void) {
    test_bound bound = test_bound_of("fis.h", "fis_cell_sum", "rel");
    enum { WIDTH = 129, HEIGHT = 65, CHANNELS = 18, CELLS = 300 };
    float *image = (float *)malloc(WIDTH * HEIGHT * CHANNELS * sizeof *image), sums[2 * CHANNELS];
    float *plane = (float *)malloc(WIDTH * HEIGHT * sizeof *plane), *pdf = make_image(POWER, WIDTH, HEIGHT, 4);
    double *memory = (double *)malloc(fis_split_size(WIDTH, HEIGHT) * sizeof *memory);
    double added[CHANNELS] = {0}, total, magnitude, input;
    fis_cell cells[CELLS + 5];
    fis_split_table table = fis_split_build(memory, pdf, WIDTH, HEIGHT);
    test_rng rng = {17 + test_seed};
    volatile float zero = 0;
    int i, c;
    for (i = 0; i < WIDTH * HEIGHT * CHANNELS; i++) image[i] = (float)(test_uniform(&rng) * 3 - 1);
    image[7 * CHANNELS + 3] = 1 / zero;
    image[9 * CHANNELS + 3] = zero / zero;
    fis_split(&table, CELLS, cells);
    memset(cells + CELLS, 0, 5 * sizeof *cells);
    cells[CELLS].u1 = cells[CELLS].v1 = 1; /* the image */
    cells[CELLS + 1].u0 = cells[CELLS + 1].v0 = -3;
    cells[CELLS + 1].u1 = cells[CELLS + 1].v1 = 1e30; /* more than it */
    cells[CELLS + 2].u0 = cells[CELLS + 2].u1 = 0.3;  /* nothing */
    cells[CELLS + 2].v1 = 1;
    cells[CELLS + 3].u0 = 0.5; /* nor here */
    cells[CELLS + 3].u1 = 0.4;
    cells[CELLS + 3].v1 = 1;
    cells[CELLS + 4].u0 = cells[CELLS + 4].v0 = 0.5; /* within one texel */
    cells[CELLS + 4].u1 = cells[CELLS + 4].v1 = 0.501;
    { /* a wide cell: many sums, of what is no round number */
        enum { WIDE = 32768 };
        float *wide = (float *)malloc(WIDE * sizeof *wide);
        for (i = 0; i < WIDE; i++) wide[i] = 0.1f;
        fis_cell_sum(wide, WIDE, 1, 1, cells[CELLS], sums);
        total = WIDE * (double)wide[0];
        test_within(&bound, (double)sums[0], total, total, &total, 1);
        free(wide);
    }
    for (c = 0; c < CHANNELS; c++) {
        total = magnitude = 0;
        for (i = 0; i < WIDTH * HEIGHT; i++) {
            plane[i] = image[i * CHANNELS + c];
            if (c == 3 && (i == 7 || i == 9)) plane[i] = 0;
            total += (double)plane[i];
            magnitude += fabs((double)plane[i]);
        }
        for (i = 0; i < CELLS + 5; i++) {
            fis_cell inside = cells[i];
            double wanted, size;
            inside.u0 = clamped(inside.u0, 0, 1), inside.u1 = clamped(inside.u1, 0, 1);
            inside.v0 = clamped(inside.v0, 0, 1), inside.v1 = clamped(inside.v1, 0, 1);
            wanted = cell_total(plane, WIDTH, HEIGHT, inside);
            size = fmax((inside.u1 - inside.u0) * (inside.v1 - inside.v0), 1e-30);
            sums[CHANNELS] = 42;
            fis_cell_sum(image, WIDTH, HEIGHT, CHANNELS, cells[i], sums);
            test_that(sums[CHANNELS] == 42.0f, "a sum for each channel", 0, 0);
            input = i;
            test_within(&bound, (double)sums[c], wanted, WIDTH * HEIGHT * size, &input, 1);
            if (i < CELLS) added[c] += (double)sums[c];
        }
        input = c;
        test_within(&bound, added[c], total, magnitude, &input, 1);
    }
    free(memory);
    free(pdf);
    free(plane);
    free(image);
    test_report(&bound);
}

/* ---- what kernels are good for ---- */

/* Fetches, errors of levels, coverage, the brightest kernel and the total, on PDFs with a kernel to 256 texels */
static void quality(void) {
    enum { SIDE = 256, COUNT = 256 };
    static study_kernel kernels[COUNT];
    test_bound reads = test_bound_of("fis.h", "fis_level", "reads");
    test_bound firefly = test_bound_of("fis.h", "fis_scale", "firefly");
    double mean_reads = 0, lost[STUDY_METHODS] = {0}, brightest[STUDY_METHODS] = {0}, in[4];
    int kind, method, i;
    for (kind = SMOOTH; kind <= ROW; kind++) {
        float *importance = make_image(kind, SIDE, SIDE, 7), *power = make_power(importance, SIDE, SIDE);
        study s = study_begin(importance, power, SIDE, SIDE);
        study_quality q[STUDY_METHODS];
        int noise = kind == CHECKERBOARD || kind == POWER || kind == BRSM;
        double most = 0, sum[2] = {0};
        for (i = 0; i < SIDE * SIDE; i++) {
            sum[0] += (double)importance[i];
            sum[1] += (double)power[i];
        }
        for (i = 0; i < SIDE * SIDE; i++) /* what a texel has of the power over what it has of the PDF */
            if (importance[i] > 0) most = fmax(most, (double)power[i] / sum[1] / ((double)importance[i] / sum[0]));
        for (method = 0; method < STUDY_METHODS; method++) {
            study_kernels(&s, method, COUNT, kernels);
            q[method] = study_measure(&s, method, kernels, COUNT);
            in[0] = kind, in[1] = method;
            if (method >= STUDY_BISECTION) {
                in[2] = q[method].firefly, in[3] = most;
                test_within(&firefly, fmax(in[2], in[3]), in[3], in[3], in, 4);
            }
        }
        in[1] = STUDY_FAST;
        in[2] = q[STUDY_FAST].reads, in[3] = q[STUDY_BISECTION].reads;
        test_that(in[2] <= 9 && in[3] == 96, "texels read", in, 4);
        mean_reads += q[STUDY_FAST].reads / (ROW - SMOOTH + 1);
        in[2] = q[STUDY_FAST].rms, in[3] = q[STUDY_BISECTION].rms;
        test_that(in[2] <= 2e-6 && in[3] > 100 * in[2] && in[3] < 2e-3, "errors of the levels", in, 4);
        in[1] = STUDY_SPLIT;
        in[2] = q[STUDY_SPLIT].gap, in[3] = q[STUDY_SPLIT].overlap;
        test_that(in[2] == 0 && in[3] == 0, "no gap and no overlap", in, 4);
        test_that(fabs(q[STUDY_SPLIT].total - 1) < 1e-6, "the total", &q[STUDY_SPLIT].total, 1);
        for (method = 0; (noise || kind == SPARSE) && method < STUDY_METHODS; method++) {
            lost[method] += fabs(q[method].total - 1);
            if (noise) brightest[method] += q[method].firefly;
            if (method > STUDY_DENSITY) continue;
            in[1] = method;
            in[2] = q[method].gap + q[method].overlap, in[3] = q[STUDY_FAST].gap + q[STUDY_FAST].overlap;
            test_that(in[2] > 1.1 * in[3], "less gap and overlap than by the density", in, 4);
        }
        study_end(&s);
        free(power);
        free(importance);
    }
    for (method = STUDY_NEAREST; method <= STUDY_DENSITY; method++) {
        in[0] = method, in[1] = lost[method], in[2] = lost[STUDY_FAST];
        test_that(in[1] > 10 * in[2], "nearer to the total than by the density", in, 3);
        in[1] = brightest[method], in[2] = brightest[STUDY_FAST];
        test_that(in[1] > 2 * in[2], "fewer fireflies than by the density", in, 3);
    }
    test_within(&reads, mean_reads, 0, 1, 0, 0);
    test_report(&reads);
    test_report(&firefly);
}

static void flicker(void) {
    double by[STUDY_METHODS], in[2];
    study_flicker(256, 256, 16, by);
    in[0] = by[STUDY_DENSITY] / by[STUDY_BISECTION];
    in[1] = by[STUDY_DENSITY] / by[STUDY_FAST];
    test_that(in[0] >= 8 && in[1] >= 8, "an eighth of the flicker by the density", in, 2);
    in[0] = by[STUDY_BISECTION] / by[STUDY_SPLIT];
    test_that(in[0] >= 2, "the split's is half of the kernels'", in, 1);
}

const test_case fis_tests[] = {{"fis_integral", integral},
                               {"fis_integral_worst", integral_worst},
                               {"fis_levels", levels},
                               {"fis_bad_pixels", bad_pixels},
                               {"fis_fetch", fetch},
                               {"fis_lattice", lattice},
#ifndef __FAST_MATH__
                               {"fis_not_finite", not_finite},
#endif
                               {"fis_warp_distribution", warp_distribution},
                               {"fis_warp_support", warp_support},
                               {"fis_warp_borders", warp_borders},
                               {"fis_level_solver", level_solver},
                               {"fis_level_tangent", level_tangent},
                               {"fis_level_stress", level_stress},
                               {"fis_density", density},
                               {"fis_totals", totals},
                               {"fis_split", split},
                               {"fis_cell_sum", cell_sum},
                               {"fis_quality", quality},
                               {"fis_flicker", flicker},
                               {0, 0}};
