/* fis_build.h - what limits.c needs of the pyramids that fis.c times */
#ifndef FIS_BUILD_H
#define FIS_BUILD_H

#include "bench.h"

typedef struct {
    double bytes; /* that a texel moves at least */
    quartiles nanoseconds;
    double peak; /* bytes a nanosecond of a copy, interleaved with it */
} fis_build_limit;

/* fis_build of an image of 1920 by 1088 */
fis_build_limit fis_build_measure(int channels);

#endif
