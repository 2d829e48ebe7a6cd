/* Any arguments of ggx_bound.h's functions: finite and in range in the documented domain, no harm outside of it. */
#include "../../ggx_bound.h"
#include "bytes.h"

static void check_ellipsoid(const char *function, ggx_ellipsoid e) {
    int k;
    bytes_check_vector(function, e.center, FLT_MAX);
    for (k = 0; k < 3; k++) {
        bytes_check_unit(function, e.axis[k]);
        bytes_check(function, e.radius[k], 1e-38f, FLT_MAX);
        bytes_check(function, lobe_dot(e.axis[k], e.axis[(k + 1) % 3]), -3e-6f, 3e-6f);
    }
}

static void check_sphere(const char *function, ggx_sphere s) {
    bytes_check_vector(function, s.center, FLT_MAX);
    bytes_check(function, s.radius, 1e-38f, FLT_MAX);
}

static void reflection(void) {
    lobe_vec3 normal = bytes_direction("normal"), tangent = bytes_direction("tangent"), wi = bytes_direction("wi");
    lobe_vec3 wo = bytes_direction("wo");
    float ax = bytes_float("alpha_x", 0, FLT_MAX), ay = bytes_float("alpha_y", 0, FLT_MAX);
    float cos_i = bytes_float("cos_i", -1, 1), cos_o = bytes_float("cos_o", -1, 1), f0 = bytes_float("f0", 0, 1);
    float half, intensity = bytes_float("intensity", 0, FLT_MAX), squared = bytes_float("squared", 0, FLT_MAX);
    float delta = bytes_float("delta", 1e-18f, FLT_MAX), xi = ggx_xi(bytes_bits()), probability, value;
    bytes_check("ggx_xi", xi, 0x1p-24f, 1 - 0x1p-24f);
    bytes_check("ggx_ndf", ggx_ndf(wo, normal, ax), 0, FLT_MAX);
    bytes_check("ggx_ndf_aniso", ggx_ndf_aniso(wo, normal, tangent, ax, ay), 0, FLT_MAX);
    bytes_check("ggx_smith_g1", ggx_smith_g1(cos_i, ax), 0, 1);
    bytes_check("ggx_smith_g1_aniso", ggx_smith_g1_aniso(wi, normal, tangent, ax, ay), 0, 1);
    bytes_check("ggx_smith_g2", ggx_smith_g2(cos_i, cos_o, ax), 0, 1);
    bytes_check("ggx_smith_g2_separable", ggx_smith_g2_separable(cos_i, cos_o, ax), 0, 1);
    bytes_check("ggx_brdf_cos", ggx_brdf_cos(normal, wi, wo, ax), 0, FLT_MAX);
    bytes_check("ggx_brdf_cos_separable", ggx_brdf_cos_separable(normal, wi, wo, ax), 0, FLT_MAX);
    bytes_check("ggx_brdf_cos_aniso", ggx_brdf_cos_aniso(normal, tangent, wi, wo, ax, ay), 0, FLT_MAX);
    half = ggx_cos_half(wi, wo);
    bytes_check("ggx_cos_half", half, 0, 1.000001f);
    value = ggx_fresnel(f0, half);
    bytes_check("ggx_fresnel", value, f0, 1);
    if (lobe_dot(normal, wo) >= 0) bytes_check("ggx_fresnel_max", ggx_fresnel_max(f0, lobe_dot(normal, wi)), value, 1);
    probability = ggx_accept_probability(intensity, squared, delta);
    bytes_check("ggx_accept_probability", probability, 0, 1);
    bytes_check("ggx_accept_weight", ggx_accept_weight(probability, xi), 0, 0x1p24f);
    bytes_check("ggx_estimate", ggx_estimate(intensity, squared, delta, xi), 0, FLT_MAX);
    bytes_check("ggx_range", ggx_range(intensity, delta, xi), 0, 1e12f);
}

/* Depths of a tile: both sides in order, depths too */
static float ordered(const char *name, float least, float most) {
    float value = bytes_float(name, least < 0 ? -10 : 0, most);
    return bytes_in_domain && value < least ? least : value;
}

static void ask(const char *name, ggx_ellipsoid e) {
    lobe_vec3 box = bytes_vector("box", 1e5f), half_size = bytes_colour("half_size", 1e5f);
    lobe_vec3 normal = bytes_vector("plane", 577), forward = bytes_direction("forward"), view[3];
    float offset = bytes_float("offset", -1e6f, 1e6f), near_depth[2], far_depth[2];
    ggx_tile tile;
    ggx_ellipsoid t;
    ggx_stretched s;
    tile.left = bytes_float("left", -10, 10);
    tile.right = ordered("right", tile.left, 10);
    tile.bottom = bytes_float("bottom", -10, 10);
    tile.top = ordered("top", tile.bottom, 10);
    near_depth[0] = bytes_float("depth0", 0, 1e5f);
    near_depth[1] = ordered("depth1", near_depth[0], 1e5f);
    far_depth[0] = bytes_float("far depth0", 0, 1e5f);
    far_depth[1] = ordered("far depth1", far_depth[0], 1e5f);
    bytes_check(name, (float)ggx_ellipsoid_hits_box(e, box, half_size), 0, 1);
    bytes_check(name, (float)ggx_ellipsoid_hits_half_space(e, normal, offset), 0, 1);
    bytes_check(name, ggx_ellipsoid_reach(e, normal), 0, FLT_MAX);
    check_sphere("ggx_bound_enclosing", ggx_bound_enclosing(e));
    view[2] = forward;
    lobe_frame(forward, view, view + 1);
    t = ggx_ellipsoid_transform(e, view, box);
    check_ellipsoid("ggx_ellipsoid_transform", t);
    s = ggx_stretch_ellipsoid(t);
    bytes_check("ggx_stretch_ellipsoid", s.xx, 0, FLT_MAX);
    bytes_check("ggx_stretch_ellipsoid", s.yy, 0, FLT_MAX);
    bytes_check("ggx_stretch_ellipsoid", s.zz, 0, FLT_MAX);
    bytes_check_finite("ggx_stretch_ellipsoid", s.xy);
    bytes_check_finite("ggx_stretch_ellipsoid", s.xz);
    bytes_check_finite("ggx_stretch_ellipsoid", s.yz);
    bytes_check_vector("ggx_stretch_ellipsoid", s.center, FLT_MAX);
    bytes_check("ggx_stretch_ellipsoid", s.size, 0, FLT_MAX);
    bytes_check("ggx_stretched_hits_tile", (float)ggx_stretched_hits_tile(s, tile, near_depth[0], near_depth[1]), 0, 1);
    bytes_check("ggx_ellipsoid_hits_sides", (float)ggx_ellipsoid_hits_sides(t, tile), 0, 1);
    bytes_check("ggx_stretched_hits_frustum", (float)ggx_stretched_hits_frustum(s, tile, near_depth[0], near_depth[1]),
                0, 1);
    bytes_check("ggx_stretched_hits_clusters", (float)ggx_stretched_hits_clusters(s, tile, near_depth, far_depth), 0,
                3);
    bytes_check("ggx_tile_above", (float)ggx_tile_above(box, forward, tile, near_depth[0], near_depth[1]), 0, 1);
}

static void volumes(void) {
    lobe_vec3 position = bytes_vector("position", 1e5f), normal = bytes_direction("normal");
    lobe_vec3 wi = bytes_direction("wi"), tangent = bytes_direction("tangent");
    float ax = bytes_float("alpha_x", 0, FLT_MAX), ay = bytes_float("alpha_y", 0, FLT_MAX);
    float flux = bytes_float("flux", 0, 1e18f), fresnel = bytes_float("fresnel_max", 0, 1);
    float delta = bytes_float("delta", 1e-18f, FLT_MAX), xi = bytes_float("xi", 0, 1);
    unsigned which = bytes_byte() % 5;
    ggx_ellipsoid e;
    ggx_sphere s;
    s = ggx_bound_sphere(position, normal, wi, ax, flux, fresnel, delta, xi);
    check_sphere("ggx_bound_sphere", s);
    e = ggx_ellipsoid_of_sphere(s);
    if (which == 0) ask("a sphere", e);
    s = ggx_bound_diffuse(position, normal, flux, fresnel, delta, xi);
    check_sphere("ggx_bound_diffuse", s);
    e = ggx_bound_diffuse_ellipsoid(position, normal, flux, fresnel, delta, xi);
    check_ellipsoid("ggx_bound_diffuse_ellipsoid", e);
    if (which == 1) ask("a Lambert surface's ellipsoid", e);
    e = ggx_bound_spheroid(position, normal, wi, ax, flux, fresnel, delta, xi);
    check_ellipsoid("ggx_bound_spheroid", e);
    if (which == 2) ask("a spheroid", e);
    e = ggx_bound_ellipsoid(position, normal, wi, ax, flux, fresnel, delta, xi);
    check_ellipsoid("ggx_bound_ellipsoid", e);
    if (which == 3) ask("an ellipsoid", e);
    e = ggx_bound_ellipsoid_aniso(position, normal, tangent, wi, ax, ay, flux, fresnel, delta, xi);
    check_ellipsoid("ggx_bound_ellipsoid_aniso", e);
    if (which == 4) ask("an anisotropic surface's ellipsoid", e);
}

/* Ellipsoids and spaces that no light has made */
static void made_up(void) {
    ggx_ellipsoid e;
    int k;
    e.center = bytes_vector("center", 1e5f);
    e.axis[2] = bytes_direction("axis");
    lobe_frame(e.axis[2], e.axis, e.axis + 1);
    for (k = 0; k < 3; k++) e.radius[k] = bytes_float("radius", 1e-12f, 1e12f);
    ask("an ellipsoid made up", e);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    unsigned which;
    bytes_begin(bytes, count);
    which = bytes_byte() % 3;
    if (which == 0) reflection();
    if (which == 1) volumes();
    if (which == 2) made_up();
    return 0;
}
