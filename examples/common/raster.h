/* raster.h - images of floats from files: PFM, and Radiance HDR to read. */
#ifndef RASTER_H
#define RASTER_H

#include <stddef.h>

typedef struct {
    float *values; /* interleaved, top row first; to be freed */
    int width, height, channels;
} raster;

enum { RASTER_MAX_SIDE = 32768, RASTER_MAX_TEXELS = 1 << 26 };

/* Reads a PFM file of one or three channels, either byte order, or a Radiance file of RGB (flat, run-length encoded by
   scanline, or in the old way; rows from the top and columns from the left). Values are as in the file, without its
   scale or exposure; PFM's may be infinite or NaN, Radiance's are the mantissa times 2^(exponent - 136). A file ends
   with its last texel. Both return null, or what is wrong: then there is nothing to free. Memory for the values is taken
   only once all of them are seen to be there. */
const char *raster_read(const char *path, raster *result);
const char *raster_parse(const unsigned char *bytes, size_t count, raster *result);

/* Whether a value is in [low, high], two finite numbers; NaN is not, even if the compiler knows none. */
int raster_in_range(float value, float low, float high);

/* Writes PFM of one or three channels, little endian. The file is whole or absent. Returns null, or what went wrong. */
const char *raster_write(const char *path, const raster *picture);

#endif
