/* asg_columns.h - what the columns of the rows for asg.h hold. */
#ifndef ASG_COLUMNS_H
#define ASG_COLUMNS_H

#include "../../asg.h"
#include "sg_columns.h"

/* Two ASGs; an ASG and an SG or a direction */
enum { ASG_A = 0, ASG_B = 12, SG_B = 12 };

/* A surface, and a light seen from it */
enum {
    SURFACE_NORMAL = 0,
    SURFACE_TANGENT = 3,
    SURFACE_WI = 6,
    SURFACE_ALPHA_X = 9,
    SURFACE_ALPHA_Y,
    LIGHT_POSITION = 11,
    LIGHT_EMISSION = 14,
    LIGHT_SHARPNESS = 17,
    LIGHT_VARIANCE
};

static inline asg_lobe asg_in(const float *in, int stride, int column) {
    asg_lobe a;
    a.x = vector_in(in, stride, column);
    a.y = vector_in(in, stride, column + 3);
    a.z = vector_in(in, stride, column + 6);
    a.sharpness_x = in[(column + 9) * stride];
    a.sharpness_y = in[(column + 10) * stride];
    a.log_amplitude = in[(column + 11) * stride];
    return a;
}

static inline vsgl asg_vsgl_in(const float *in, int stride) {
    vsgl v;
    v.position = vector_in(in, stride, LIGHT_POSITION);
    v.variance = in[LIGHT_VARIANCE * stride];
    v.emission[0].axis = vector_in(in, stride, LIGHT_EMISSION);
    v.emission[0].sharpness = in[LIGHT_SHARPNESS * stride];
    v.emission[0].log_amplitude = 0;
    v.emission[1] = v.emission[0];
    v.intensity[0] = lobe_vector(1, 1, 1);
    v.intensity[1] = lobe_vector(1, 1, 1);
    return v;
}

#endif
