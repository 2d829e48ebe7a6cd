/*
 ggx_bound_loops.c - one loop for each function of ggx_bound.h, which must become vector code, and one for each
 alternative: the usual forms, and the paper's bound as printed.
*/
#include "ggx_bound_columns.h"

#define FROM &in->column[0][i], BENCH_COUNT
#define IN(k) in->column[k][i]
#define VECTOR(k) vector_in(FROM, k)
#define OUT(k) out->column[k][i]
#define LIGHT VECTOR(VPL_AT), VECTOR(VPL_FRONT), VECTOR(VPL_TO_LIGHT), IN(VPL_ALPHA_X)
#define RANGE IN(VPL_FLUX), IN(VPL_FRESNEL), IN(VPL_DELTA), IN(VPL_XI)

/* All fifteen numbers, so that none is left out: the radii, and sums */
static inline void put_ellipsoid(bench_output *restrict out, int i, ggx_ellipsoid e) {
    out->column[0][i] = e.radius[0];
    out->column[1][i] = e.radius[1];
    out->column[2][i] = e.radius[2];
    out->column[3][i] = e.center.x + e.axis[0].x;
    out->column[4][i] = e.center.y + e.axis[0].y;
    out->column[5][i] = e.center.z + e.axis[0].z;
    out->column[6][i] = e.axis[1].x + e.axis[1].y + e.axis[1].z;
    out->column[7][i] = e.axis[2].x + e.axis[2].y + e.axis[2].z;
}

/* ---- ours ---- */

BENCH_LOOP(our_ggx_ndf, OUT(0) = ggx_ndf(VECTOR(VPL_OUT), VECTOR(VPL_FRONT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_ndf_aniso, OUT(0) = ggx_ndf_aniso(VECTOR(VPL_OUT), VECTOR(VPL_FRONT), VECTOR(VPL_TANGENT),
                                                     IN(VPL_ALPHA_X), IN(VPL_ALPHA_Y));)
BENCH_LOOP(our_ggx_smith_g1, OUT(0) = ggx_smith_g1(IN(VPL_OUT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_smith_g1_aniso, OUT(0) = ggx_smith_g1_aniso(VECTOR(VPL_OUT), VECTOR(VPL_FRONT), VECTOR(VPL_TANGENT),
                                                               IN(VPL_ALPHA_X), IN(VPL_ALPHA_Y));)
BENCH_LOOP(our_ggx_smith_g2, OUT(0) = ggx_smith_g2(IN(VPL_OUT), IN(VPL_FRONT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_smith_g2_separable, OUT(0) = ggx_smith_g2_separable(IN(VPL_OUT), IN(VPL_FRONT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_brdf_cos,
           OUT(0) = ggx_brdf_cos(VECTOR(VPL_FRONT), VECTOR(VPL_TO_LIGHT), VECTOR(VPL_OUT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_brdf_cos_separable,
           OUT(0) = ggx_brdf_cos_separable(VECTOR(VPL_FRONT), VECTOR(VPL_TO_LIGHT), VECTOR(VPL_OUT), IN(VPL_ALPHA_X));)
BENCH_LOOP(our_ggx_brdf_cos_aniso,
           OUT(0) = ggx_brdf_cos_aniso(VECTOR(VPL_FRONT), VECTOR(VPL_TANGENT), VECTOR(VPL_TO_LIGHT), VECTOR(VPL_OUT),
                                       IN(VPL_ALPHA_X), IN(VPL_ALPHA_Y));)
BENCH_LOOP(our_ggx_fresnel, OUT(0) = ggx_fresnel(IN(VPL_FRESNEL), ggx_cos_half(VECTOR(VPL_TO_LIGHT), VECTOR(VPL_OUT)));)
BENCH_LOOP(our_ggx_fresnel_max, OUT(0) = ggx_fresnel_max(IN(VPL_FRESNEL), IN(VPL_FRONT));)
BENCH_LOOP(our_ggx_accept,
           OUT(0) = ggx_accept_weight(ggx_accept_probability(IN(VPL_FLUX), IN(VPL_ALPHA_X), IN(VPL_DELTA)),
                                      IN(VPL_XI));)
BENCH_LOOP(our_ggx_estimate, OUT(0) = ggx_estimate(IN(VPL_FLUX), IN(VPL_ALPHA_X), IN(VPL_DELTA), IN(VPL_XI));)
BENCH_LOOP(our_ggx_range, OUT(0) = ggx_range(IN(VPL_FLUX), IN(VPL_DELTA), IN(VPL_XI));)
BENCH_LOOP(our_ggx_bound_spheroid, put_ellipsoid(out, i, ggx_bound_spheroid(LIGHT, RANGE));)
BENCH_LOOP(our_ggx_bound_ellipsoid, put_ellipsoid(out, i, ggx_bound_ellipsoid(LIGHT, RANGE));)
BENCH_LOOP(our_ggx_bound_ellipsoid_aniso,
           put_ellipsoid(out, i,
                         ggx_bound_ellipsoid_aniso(VECTOR(VPL_AT), VECTOR(VPL_FRONT), VECTOR(VPL_TANGENT),
                                                   VECTOR(VPL_TO_LIGHT), IN(VPL_ALPHA_X), IN(VPL_ALPHA_Y), RANGE));)
BENCH_LOOP(our_ggx_bound_sphere, put_ellipsoid(out, i, ggx_ellipsoid_of_sphere(ggx_bound_sphere(LIGHT, RANGE)));)
BENCH_LOOP(our_ggx_bound_enclosing,
           put_ellipsoid(out, i, ggx_ellipsoid_of_sphere(ggx_bound_enclosing(ggx_ellipsoid_in(FROM))));)
BENCH_LOOP(our_ggx_bound_diffuse,
           put_ellipsoid(out, i, ggx_ellipsoid_of_sphere(ggx_bound_diffuse(VECTOR(VPL_AT), VECTOR(VPL_FRONT), RANGE)));)
BENCH_LOOP(our_ggx_bound_diffuse_ellipsoid,
           put_ellipsoid(out, i, ggx_bound_diffuse_ellipsoid(VECTOR(VPL_AT), VECTOR(VPL_FRONT), RANGE));)
BENCH_LOOP(our_ggx_ellipsoid_transform, {
    lobe_vec3 view[3];
    view[0] = VECTOR(15);
    view[1] = VECTOR(18);
    view[2] = VECTOR(21);
    put_ellipsoid(out, i, ggx_ellipsoid_transform(ggx_ellipsoid_in(FROM), view, VECTOR(0)));
})
BENCH_LOOP(our_ggx_ellipsoid_reach, OUT(0) = ggx_ellipsoid_reach(ggx_ellipsoid_in(FROM), VECTOR(SHAPE_BOX));)
BENCH_LOOP(our_ggx_ellipsoid_hits_half_space,
           OUT(0) = (float)ggx_ellipsoid_hits_half_space(ggx_ellipsoid_in(FROM), VECTOR(SHAPE_BOX), IN(18));)
BENCH_LOOP(our_ggx_ellipsoid_hits_box,
           OUT(0) = (float)ggx_ellipsoid_hits_box(ggx_ellipsoid_in(FROM), VECTOR(SHAPE_BOX), VECTOR(SHAPE_BOX + 3));)
BENCH_LOOP(our_ggx_ellipsoid_hits_sides,
           OUT(0) = (float)ggx_ellipsoid_hits_sides(ggx_ellipsoid_in(FROM), ggx_tile_in(FROM, SHAPE_TILE));)
BENCH_LOOP(our_ggx_stretch_ellipsoid, {
    ggx_stretched s = ggx_stretch_ellipsoid(ggx_ellipsoid_in(FROM));
    OUT(0) = s.xx + s.center.x;
    OUT(1) = s.xy + s.center.y;
    OUT(2) = s.xz + s.center.z;
    OUT(3) = s.yy + s.size;
    OUT(4) = s.yz;
    OUT(5) = s.zz;
    OUT(6) = (float)s.swapped;
})
BENCH_LOOP(our_ggx_stretched_hits_tile,
           OUT(0) = (float)ggx_stretched_hits_tile(ggx_stretched_in(FROM), ggx_tile_in(FROM, SHAPE_FRUSTUM),
                                                   IN(SHAPE_RANGE), IN(SHAPE_RANGE + 1));)
BENCH_LOOP(our_ggx_stretched_hits_frustum,
           OUT(0) = (float)ggx_stretched_hits_frustum(ggx_stretched_in(FROM), ggx_tile_in(FROM, SHAPE_FRUSTUM),
                                                      IN(SHAPE_RANGE), IN(SHAPE_RANGE + 1));)
BENCH_LOOP(our_ggx_stretched_hits_clusters, {
    float near_depth[2], far_depth[2];
    near_depth[0] = IN(SHAPE_RANGE);
    near_depth[1] = IN(SHAPE_RANGE + 1);
    far_depth[0] = IN(SHAPE_RANGE + 2);
    far_depth[1] = IN(SHAPE_RANGE + 3);
    OUT(0) = (float)ggx_stretched_hits_clusters(ggx_stretched_in(FROM), ggx_tile_in(FROM, SHAPE_FRUSTUM), near_depth,
                                                far_depth);
})
BENCH_LOOP(our_ggx_tile_above,
           OUT(0) = (float)ggx_tile_above(VECTOR(VPL_AT), VECTOR(VPL_FRONT), ggx_tile_in(FROM, SHAPE_TILE),
                                          IN(SHAPE_DEPTH), IN(SHAPE_DEPTH + 1));)

/* ---- the usual forms ---- */

static inline float usual_ndf(float cosine, float alpha) {
    float a2 = alpha * alpha, base = cosine * cosine * (a2 - 1) + 1;
    return cosine > 0 ? a2 / (LOBE_PI * base * base) : 0;
}

static inline float usual_g1(float cosine, float alpha) {
    float a2 = alpha * alpha;
    return 2 * cosine / (cosine + sqrtf(a2 + (1 - a2) * cosine * cosine));
}

BENCH_LOOP(usual_ggx_ndf, OUT(0) = usual_ndf(lobe_dot(VECTOR(VPL_OUT), VECTOR(VPL_FRONT)), IN(VPL_ALPHA_X));)
BENCH_LOOP(usual_ggx_brdf_cos, {
    lobe_vec3 n = VECTOR(VPL_FRONT), wi = VECTOR(VPL_TO_LIGHT), wo = VECTOR(VPL_OUT), h = lobe_add(wi, wo);
    float ci = lobe_dot(n, wi), co = lobe_dot(n, wo), a = IN(VPL_ALPHA_X), d;
    h = lobe_scale(h, 1 / sqrtf(lobe_dot(h, h)));
    d = usual_ndf(lobe_dot(h, n), a);
    OUT(0) = ci > 0 && co > 0 ? d * usual_g1(ci, a) * usual_g1(co, a) / (4 * ci) : 0;
})

/* The paper's, Eqs. 12 to 15: nothing is added for rounding. */
BENCH_LOOP(printed_ggx_bound_spheroid, {
    lobe_vec3 n = VECTOR(VPL_FRONT), wi = VECTOR(VPL_TO_LIGHT);
    float ci = lobe_dot(n, wi), a = IN(VPL_ALPHA_X), r;
    ggx_ellipsoid e;
    r = sqrtf(IN(VPL_FLUX) * IN(VPL_FRESNEL) * usual_g1(ci, a) / (4 * LOBE_PI * IN(VPL_DELTA) * IN(VPL_XI) * ci));
    e.axis[0] = lobe_sub(lobe_scale(n, 2 * ci), wi);
    e.axis[2] = lobe_cross(e.axis[0], n);
    e.axis[2] = lobe_scale(e.axis[2], 1 / sqrtf(lobe_dot(e.axis[2], e.axis[2])));
    e.axis[1] = lobe_cross(e.axis[2], e.axis[0]);
    e.center = lobe_add(VECTOR(VPL_AT), lobe_scale(e.axis[0], (1 - a * a) / (2 * a) * r));
    e.radius[0] = (1 + a * a) / (2 * a) * r;
    e.radius[1] = r;
    e.radius[2] = r;
    put_ellipsoid(out, i, e);
})
