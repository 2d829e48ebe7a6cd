/* lobe_filter.h - cross bilateral filters and upsampling whose weights know the reflection lobes (paper 004), and others. */
#ifndef LOBE_FILTER_H
#define LOBE_FILTER_H

#include "../../bilateral.h"
#include "glossy.h"
#include "image.h"

/* Of all filters: weights of distance in the image are the same, of a variance by their radius (default: 8), and those of
   depth in the scenes. */
enum { FILTER_RADIUS = 8 };
static const float filter_depth_variance = 0.1f;

static inline int filter_taps(int radius) {
    return (2 * radius + 1) * (2 * radius + 1);
}

static inline float filter_kernel_variance(int radius) {
    return 0.25f * (float)(radius * radius);
}

/* What filters know of a pixel */
typedef struct {
    int valid, parts_count;
    float depth, alpha, half_sharpness; /* of a distribution of half vectors like it */
    vec3 normal;
    sg_lobe parts[GLOSSY_LOBES], lobe; /* Eq. 11, Eq. 12 */
    asg_lobe stretched;                /* Eq. 13 */
} guide;

guide filter_guide_of(const glossy *look, vec3 normal, vec3 view, float depth);

/* What neighbours are weighed by */
typedef enum {
    FILTER_UNFILTERED,
    FILTER_NORMAL,
    FILTER_BANDLIMIT,
    FILTER_ALPHA_GUIDE,
    FILTER_EQ12,
    FILTER_EQ11,
    FILTER_EQ13,
    FILTER_METHODS
} filter_method;

/* Guides and colours as planes with a border, so that the loops over them become vector code. Guides of one method at a
   time; parts: the most lobes of a pixel. */
typedef struct filter_planes filter_planes;
filter_planes *filter_planes_create(int width, int height, int radius, int parts);
void filter_planes_free(filter_planes *p);

int filter_most_parts(const guide *guides, int count);

void filter_fill_colours(filter_planes *p, const image *noisy);

/* All rows, by all threads, or one: those from the radius above the picture to the radius below it are needed. */
void filter_fill_planes(const filter_planes *p, const guide *guides, filter_method m, const float *parameter,
                        float depth_variance);
void filter_fill_row(const filter_planes *p, const guide *guides, filter_method m, const float *parameter,
                     float depth_scale, int row);
void filter_row(const filter_planes *p, filter_method m, const float *parameter, int row, image *result);

/* A whole frame, by all threads */
void filter_frame(const filter_planes *p, const guide *guides, filter_method m, const float *parameter,
                  float depth_variance, image *result);

/* A lobe for what has none */
static inline sg_lobe blank_lobe(void) {
    sg_lobe g;
    g.axis = lobe_vector(0, 0, 1);
    g.sharpness = 1;
    g.log_amplitude = 0;
    return g;
}

/* ---- upsampling: one pixel of 4 x 4 is shaded ---- */

enum { UPSAMPLE_CELL = 4 };

typedef struct {
    int width, height, column, row; /* and where in its cell each is */
    vec3 *colours;
} coarse;

/* How like two pixels are, at a depth of the first: by Eq. 12, 13, or else 4 */
float upsample_likeness(filter_method m, float parameter, const guide *i, float depth, const guide *j);

/* The value by the shaded pixels around, and their total weight. The guides are of the whole picture, as wide as this. */
float upsample_pixel(filter_method m, float parameter, const guide *guides, int width, const coarse *low, int x, int y,
                     vec3 *colour);

#endif
