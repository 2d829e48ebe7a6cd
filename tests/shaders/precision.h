/*
 precision.h - how exact a device's own functions are, on which all errors of the shaders rest
*/
#ifndef PRECISION_H
#define PRECISION_H

#include "../../examples/common/gpu.h"

/* Prints the largest error of each function, in either language; one that Vulkan does not allow is a failure, and counts
   as what it does allow. Returns how many times larger than in the headers' C they are at most. */
double precision_measure(gpu *device, const char *folder, int *failures);

#endif
