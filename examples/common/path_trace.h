/* path_trace.h - one-bounce indirect light by path tracing: the reference, which knows nothing of SGs. */
#ifndef PATH_TRACE_H
#define PATH_TRACE_H

#include "buffers.h"

/* Writes the indirect radiance of each camera pixel. Two estimators are combined by the balance heuristic: a ray from
   the pixel by its BRDF, and a ray from the light guided by reflected flux. Unbiased. Returns 0 when memory is short.
   The label is that of the progress line. */
int path_trace_indirect(const scene *world, const buffer *view, int samples, unsigned seed, vec3 *image,
                        const char *label);

#endif
