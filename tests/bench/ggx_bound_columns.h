/* ggx_bound_columns.h - what the columns of the rows for ggx_bound.h hold. */
#ifndef GGX_BOUND_COLUMNS_H
#define GGX_BOUND_COLUMNS_H

#include "../../ggx_bound.h"
#include "sg_columns.h"

/* A light on a surface, and a direction out of it */
enum {
    VPL_AT = 0,
    VPL_FRONT = 3,
    VPL_TO_LIGHT = 6,
    VPL_OUT = 9,
    VPL_TANGENT = 12,
    VPL_ALPHA_X = 15,
    VPL_ALPHA_Y,
    VPL_FLUX,
    VPL_FRESNEL,
    VPL_DELTA,
    VPL_XI
};

/* An ellipsoid, and a box or a tile with its depths */
enum { SHAPE_ELLIPSOID = 0, SHAPE_BOX = 15, SHAPE_TILE = 15, SHAPE_DEPTH = 19 };

/* Its stretched space, and a tile */
enum { SHAPE_STRETCHED = 0, SHAPE_FRUSTUM = 11, SHAPE_RANGE = 15 };

static inline ggx_ellipsoid ggx_ellipsoid_in(const float *in, int stride) {
    ggx_ellipsoid e;
    e.center = vector_in(in, stride, SHAPE_ELLIPSOID);
    e.axis[0] = vector_in(in, stride, SHAPE_ELLIPSOID + 3);
    e.axis[1] = vector_in(in, stride, SHAPE_ELLIPSOID + 6);
    e.axis[2] = vector_in(in, stride, SHAPE_ELLIPSOID + 9);
    e.radius[0] = in[(SHAPE_ELLIPSOID + 12) * stride];
    e.radius[1] = in[(SHAPE_ELLIPSOID + 13) * stride];
    e.radius[2] = in[(SHAPE_ELLIPSOID + 14) * stride];
    return e;
}

static inline ggx_tile ggx_tile_in(const float *in, int stride, int column) {
    ggx_tile t;
    t.left = in[column * stride];
    t.right = in[(column + 1) * stride];
    t.bottom = in[(column + 2) * stride];
    t.top = in[(column + 3) * stride];
    return t;
}

static inline ggx_stretched ggx_stretched_in(const float *in, int stride) {
    ggx_stretched s;
    s.xx = in[SHAPE_STRETCHED * stride];
    s.xy = in[(SHAPE_STRETCHED + 1) * stride];
    s.xz = in[(SHAPE_STRETCHED + 2) * stride];
    s.yy = in[(SHAPE_STRETCHED + 3) * stride];
    s.yz = in[(SHAPE_STRETCHED + 4) * stride];
    s.zz = in[(SHAPE_STRETCHED + 5) * stride];
    s.center = vector_in(in, stride, SHAPE_STRETCHED + 6);
    s.size = in[(SHAPE_STRETCHED + 9) * stride];
    s.swapped = in[(SHAPE_STRETCHED + 10) * stride] > 0;
    return s;
}

#endif
