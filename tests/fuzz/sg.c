/* Any arguments of sg.h's functions: finite and in range in the documented domain, no harm outside of it. */
#include "../../sg.h"
#include "bytes.h"

/* The size of what sums up to powers of 1e18 and positions of 1e5 */
static void check_light(const char *function, vsgl v, float sharpness) {
    int k;
    bytes_check_vector(function, v.position, FLT_MAX);
    bytes_check(function, v.variance, 0, FLT_MAX);
    for (k = 0; k < 2; k++) {
        bytes_check_sg(function, v.emission[k], sharpness);
        bytes_check_vector(function, v.intensity[k], FLT_MAX);
    }
}

static void check_cluster(const char *function, vsgl_cluster c) {
    int k;
    for (k = 0; k < 2; k++) {
        bytes_check_vector(function, c.power[k], FLT_MAX);
        bytes_check_sg(function, c.direction[k], FLT_MAX);
    }
    bytes_check_vector(function, c.origin, 1e5f);
    bytes_check_vector(function, c.offset, FLT_MAX);
    bytes_check(function, c.spread, 0, FLT_MAX);
}

static void check_moments(const char *function, vsgl_moments m) {
    int k;
    for (k = 0; k < 2; k++) {
        bytes_check_vector(function, m.power[k], FLT_MAX);
        bytes_check_vector(function, m.direction[k], FLT_MAX);
    }
    bytes_check_vector(function, m.position, FLT_MAX);
    bytes_check(function, m.position_squared, 0, FLT_MAX);
}

static void lobes(void) {
    sg_lobe a = bytes_sg("a", FLT_MAX, 1e30f), b = bytes_sg("b", FLT_MAX, 1e30f), plain = a;
    lobe_vec3 dir = bytes_direction("dir"), sampled;
    float u = bytes_float("u", 0, 1), v = bytes_float("v", 0, 1), kappa = bytes_float("kappa", 1e-45f, FLT_MAX);
    float length = bytes_float("mean_length", 0, 1), alpha = bytes_float("alpha", 0, FLT_MAX);
    plain.log_amplitude = 0;
    bytes_check("sg_eval", sg_eval(a, dir), 0, 0x1p122f);
    bytes_check("sg_eval of peak 1", sg_eval(plain, dir), 0, 1);
    bytes_check("sg_integral", sg_integral(a.sharpness), 0, 12.566374f);
    bytes_check_sg("sg_normalize", sg_normalize(a), FLT_MAX);
    sampled = sg_sample(a, u, v);
    bytes_check_unit("sg_sample", sampled);
    bytes_check("sg_pdf", sg_pdf(a, dir), 0, FLT_MAX);
    bytes_check_sg("sg_product", sg_product(a, b), 2.0001e30f);
    bytes_check("sg_product_integral", sg_product_integral(a, b), 0, FLT_MAX);
    bytes_check("sg_product_integral_approx", sg_product_integral_approx(a, b), 0, FLT_MAX);
    bytes_check_sg("sg_convolve", sg_convolve(a, kappa), a.sharpness);
    bytes_check("sg_cosine_integral", sg_cosine_integral(a, dir), 0, FLT_MAX);
    bytes_check("sg_cosine_integral of peak 1", sg_cosine_integral(plain, dir), 0, 3.1416f);
    bytes_check("sg_cosine_integral_approx", sg_cosine_integral_approx(a, dir), 0, FLT_MAX);
    bytes_check("sg_mean_length", sg_mean_length(a.sharpness), 0, 1);
    bytes_check("sg_sharpness_from_mean_length", sg_sharpness_from_mean_length(length), 0, 0x1p25f);
    bytes_check_sg("sg_diffuse_lobe", sg_diffuse_lobe(dir), 2);
    bytes_check_sg("sg_reflection_lobe", sg_reflection_lobe(dir, a.axis, b.sharpness), 1e30f);
    bytes_check_sg("sg_ggx_lobe", sg_ggx_lobe(dir, a.axis, alpha), 1e30f);
    bytes_check_sg("sg_beckmann_lobe", sg_beckmann_lobe(dir, a.axis, alpha), 1e30f);
    bytes_check_sg("sg_phong_lobe", sg_phong_lobe(dir, a.axis, b.sharpness), 1e30f);
}

/* Its light at a place */
static void shade(const char *function, vsgl v, lobe_vec3 place, lobe_vec3 normal) {
    int k;
    for (k = 0; k < 2; k++) {
        sg_lobe g = vsgl_incoming_lobe(v, k, place);
        bytes_check_unit(function, g.axis);
        bytes_check(function, g.sharpness, 0, FLT_MAX);
        bytes_check_finite(function, g.log_amplitude);
        bytes_check(function, vsgl_diffuse(v, k, place, normal), 0, FLT_MAX);
        bytes_check(function, vsgl_diffuse_integral(v, k, place, normal), 0, FLT_MAX);
    }
}

static void lights(void) {
    lobe_vec3 place = bytes_vector("place", 1e4f), towards = bytes_direction("normal");
    lobe_vec3 center = bytes_vector("center", 9e4f);
    float radius = bytes_float("radius", 0, 1e5f), share = bytes_float("share", 0, 1);
    vsgl_moments m;
    vsgl_cluster c;
    vsgl light;
    int i;
    bytes_check_sg("vsl_lobe", vsl_lobe(center, radius, place), 1.0001e18f);
    light = bytes_vsgl(1e10f);
    shade("vsgl_incoming_lobe of any light", light, place, towards);
    memset(&m, 0, sizeof m);
    memset(&c, 0, sizeof c);
    for (i = 0; i < 3; i++) {
        lobe_vec3 position = bytes_vector("position", 5e4f), normal = bytes_direction("normal");
        lobe_vec3 wi = bytes_direction("wi"), diffuse = bytes_colour("diffuse", 1e18f);
        lobe_vec3 specular = bytes_colour("specular", 1e18f);
        float alpha = bytes_float("alpha", 1e-4f, 1);
        vsgl_moments one = vsgl_moments_from_vpl(position, normal, wi, diffuse, specular, alpha);
        vsgl_cluster single = vsgl_cluster_from_vpl(position, normal, wi, diffuse, specular, alpha);
        check_moments("vsgl_moments_from_vpl", one);
        check_cluster("vsgl_cluster_from_vpl", single);
        light = vsgl_from_cluster(single);
        check_light("vsgl_from_cluster of one light", light, 1e18f);
        bytes_check("the variance of one light", light.variance, 0, 0);
        m = i ? vsgl_moments_add(m, one) : one;
        c = i ? vsgl_cluster_merge(c, single) : single;
        check_moments("vsgl_moments_add", m);
        check_cluster("vsgl_cluster_merge", c);
    }
    m = vsgl_moments_scale(m, share);
    check_moments("vsgl_moments_scale", m);
    light = vsgl_from_moments(m, lobe_vector(0, 0, 0));
    check_light("vsgl_from_moments", light, 0x1p25f);
    shade("the light of vsgl_from_moments", light, place, towards);
    light = vsgl_from_cluster(c);
    check_light("vsgl_from_cluster", light, 1e18f);
    shade("the light of vsgl_from_cluster", light, place, towards);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    bytes_begin(bytes, count);
    if (bytes_byte() % 2)
        lights();
    else
        lobes();
    return 0;
}
