/* vsgl_inspect.h - how well a set of virtual SG lights stands for the image that it comes from. */
#ifndef VSGL_INSPECT_H
#define VSGL_INSPECT_H

#include "vsgl_generate.h"
#include "image.h"

/* Power of one light, the mean of the channels, and of all of them */
double vsgl_power(const vsgl *light);
double light_set_power(const light_set *set);

/* Shares of the PDF in no cell, and in more than one. Counted at 4 x 4 points of each texel; cells that share an edge
   share it there too. */
typedef struct {
    double gap, overlap;
} coverage;
coverage light_set_coverage(const light_set *set, const float *pdf, int width, int height);

/* Figure 1 of paper 002: the PDF as brightness, cells orange, centres red. The picture is as large as the map. */
void light_set_draw(const light_set *set, const float *pdf, image *picture);

#endif
