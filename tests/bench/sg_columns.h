/* sg_columns.h - what the columns of the rows for sg.h hold. */
#ifndef SG_COLUMNS_H
#define SG_COLUMNS_H

#include "../../sg.h"
#include "bench.h"

/* Two lobes, or a lobe and a direction; two uniform numbers; the cosine of both axes. */
enum { LOBE_A = 0, LOBE_B = 5, UNIFORM_U = 10, UNIFORM_V, LOBE_COSINE };

/* A virtual point light, seen from a point: power of the component in question, of the other one none. */
enum {
    VPL_POSITION = 0,
    VPL_NORMAL = 3,
    VPL_WI = 6,
    VPL_ALPHA = 9,
    VPL_POINT = 10,
    VPL_FACING = 13,
    VPL_VARIANCE = 16
};

static inline lobe_vec3 vector_in(const float *in, int stride, int column) {
    return lobe_vector(in[column * stride], in[(column + 1) * stride], in[(column + 2) * stride]);
}

static inline sg_lobe lobe_in(const float *in, int stride, int column) {
    sg_lobe g;
    g.axis = vector_in(in, stride, column);
    g.sharpness = in[(column + 3) * stride];
    g.log_amplitude = in[(column + 4) * stride];
    return g;
}

#endif
