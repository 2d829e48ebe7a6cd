/* vsgl_generate.h - virtual SG lights from an RSM or a G-buffer: filtered importance sampling and what it is compared
   with. */
#ifndef VSGL_GENERATE_H
#define VSGL_GENERATE_H

#include "../../fis.h"
#include "kmeans.h"
#include "vpl.h"

typedef enum {
    METHOD_NEAREST,   /* kernel size from the PDF at the centre, Eq. 1 and 4 of paper 002: of its texel, */
    METHOD_DENSITY,   /* read bilinearly */
    METHOD_BISECTION, /* kernel size from the PDF in the kernel, Eq. 3 and 5: as published, */
    METHOD_FAST,      /* by fis_level */
    METHOD_SPLIT,     /* cells of equal mass */
    METHOD_KMEANS_2D, /* texels to their nearest centre: in the image, by a kd-tree, */
    METHOD_KMEANS_3D, /* in the world, */
    METHOD_TRANSFORM, /* in the image, by a distance transform */
    METHODS
} method;
extern const char *const method_names[METHODS + 1]; /* null after the last */

static inline int method_is_filtered(method how) {
    return how <= METHOD_FAST;
}

static inline int method_is_labelling(method how) {
    return how >= METHOD_KMEANS_2D;
}

/* Milliseconds. First the sums of each texel, or its label; then pyramids, or a table, or the sort; then the lights. */
enum { STAGE_TEXELS, STAGE_PYRAMID, STAGE_LIGHTS, STAGES };

/* Lights, and where they come from in the image. All arrays have `count` elements but labels. */
typedef struct {
    vsgl *lights;
    fis_point *centers;
    fis_cell *cells;   /* of filtered sampling and the split */
    const int *labels; /* of the others, of each texel; negative where nothing is reflected, but for the transform */
    int count;
    double ms[STAGES];
} light_set;

/* Memory for maps of one size and any method, so that no time goes into getting it. */
typedef struct {
    float *moments, *pdf;
    double *table, *scratch;
    int *labels, *order, *begins, *columns, *rows;
    kmeans_center *centers;
    kmeans_node *nodes;
    vsgl_moments *sums;
    float *levels;
} generator;

/* They give up when memory is short. `most` is the largest number of lights. */
generator generator_create(int width, int height, int most);
void generator_free(generator *g);
light_set light_set_create(int most);
void light_set_free(light_set *set);

/* `set->count` lights of a map by a PDF with one number a texel, which need not be normalised. k is the kernel size of
   filtered sampling in shares of a light. On one thread, so that methods compare. */
void vsgl_generate(generator *g, const vpl_map *map, const float *pdf, method how, float k, unsigned seed,
                   light_set *set);

#endif
