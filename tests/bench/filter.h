/*
 filter.h - the loops of a filter of 17 x 17 taps: kernel, depth and lobe for the weight, three channels of colour

 The filters that sum over taps write the sums of one row of pixels; those that use each weight twice take half the taps
 of a row and add to the sums of all pixels. An image is planar, as an engine has it.
*/
#ifndef FILTER_H
#define FILTER_H

#include "../../bilateral.h"
#include "bench.h"

enum {
    FILTER_RADIUS = 8,
    FILTER_TAPS = (2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1),
    FILTER_ROW = 256, /* pixels that are filtered of a row; the others are margin */
    FILTER_WIDTH = FILTER_ROW + 2 * FILTER_RADIUS,
    FILTER_ROWS = 8,
    FILTER_HEIGHT = FILTER_ROWS + 2 * FILTER_RADIUS,
    FILTER_PIXELS = FILTER_WIDTH * FILTER_HEIGHT,
    FILTER_LOBES = 3,
    FILTER_BETA = 20
};

/* Planes as the prepared forms have them, and what the forms as printed need */
enum {
    PLANE_COLOUR = 0,
    PLANE_DEPTH = 3,
    PLANE_NORMAL = 4,
    PLANE_SG = 7,
    PLANE_MIXTURE = 11,
    PLANE_ASG = PLANE_MIXTURE + 6 * FILTER_LOBES,
    PLANE_RAW_DEPTH = PLANE_ASG + 13,
    PLANE_RAW_AXIS,
    PLANE_RAW_SHARPNESS = PLANE_RAW_AXIS + 3, /* of the first lobe, of the others multiples */
    PLANES
};

#define FILTER_DEPTH_VARIANCE 0.04f
#define FILTER_NORMAL_VARIANCE 0.02f
#define FILTER_KERNEL_VARIANCE 16.f

typedef struct {
    float plane[PLANES][FILTER_PIXELS];
} filter_image;

typedef struct {
    float sum[4][FILTER_PIXELS]; /* three channels, then weights */
} filter_sums;

typedef struct {
    int offset[FILTER_TAPS];
    float exponent[FILTER_TAPS], factor[FILTER_TAPS]; /* of the kernel */
} filter_kernel;

/* Filters the row that starts at pixel i. */
typedef void filter_loop(const filter_image *restrict in, const filter_kernel *restrict kernel, int i, float beta,
                         filter_sums *restrict out);

#define FILTER_DECLARE(name) filter_loop name##_scalar, name##_vector, name##_counted

/* For limits.c. filter_prepare returns how many forms there are that are ours; filter_run runs one of them as vector code,
   filter_count so that it counts its operations, where it can: both return how many taps that were. */
int filter_prepare(void);
const char *filter_name(int form);
double filter_run(int form);
double filter_count(int form);

/* Nothing but independent multiply-adds, or divisions: FILTER_PEAK_STEPS of them on each of the lanes, which are as many as
   registers hold. */
typedef void filter_peak_loop(float *values);
filter_peak_loop filter_peak_scalar, filter_peak_vector, division_peak_scalar, division_peak_vector;
#ifdef __AVX512F__
enum { FILTER_PEAK_LANES = 192 };
#else
enum { FILTER_PEAK_LANES = 96 };
#endif
enum { FILTER_PEAK_STEPS = 20000, FILTER_PEAK_OPERATIONS = FILTER_PEAK_STEPS * FILTER_PEAK_LANES };

#endif
