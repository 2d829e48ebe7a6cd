/* image.h - linear images, their difference, and PNG files. */
#ifndef IMAGE_H
#define IMAGE_H

#include "scene.h"

typedef struct {
    vec3 *pixels;
    int width, height;
} image;

/* A black image. Gives up when memory is short. */
image image_create(int width, int height);
void image_free(image *picture);

/* Root mean square difference over pixels and channels, and mean absolute difference over mean reference. */
double image_rmse(const image *picture, const image *wanted);
double image_relative_error(const image *picture, const image *wanted);

/* Peak signal-to-noise ratio of what image_write_png would write if it did not round to 8 bits, in dB, at most 200 */
double image_psnr(const image *picture, const image *wanted, float exposure);

/* Copies a picture into another at a position. */
void image_paste(image *target, const image *part, int x, int y);

/* Writes linear radiance as 8-bit sRGB after 1 - exp(-exposure radiance). The file is whole or absent: it is written
   under another name first. Returns null, or what went wrong. */
const char *image_write_png(const char *path, const image *picture, float exposure);

#endif
