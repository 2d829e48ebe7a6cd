/* Any arguments of asg.h's functions: finite and in range in the documented domain, no harm outside of it. */
#include "../../asg.h"
#include "bytes.h"

/* Orthonormal axes, or any */
static asg_lobe any_lobe(const char *name) {
    asg_lobe a;
    a.z = bytes_direction(name);
    lobe_frame(a.z, &a.x, &a.y);
    if (bytes_in_domain) { /* turned about z */
        float angle = bytes_float("angle", 0, 6.5f), c = cosf(angle), s = sinf(angle);
        lobe_vec3 x = a.x;
        a.x = lobe_normalize_or(lobe_add(lobe_scale(x, c), lobe_scale(a.y, s)), x);
        a.y = lobe_cross(a.z, a.x);
    } else {
        a.x = bytes_direction(name);
        a.y = bytes_direction(name);
    }
    a.sharpness_x = bytes_float("sharpness_x", 0, 1e30f);
    a.sharpness_y = bytes_float("sharpness_y", 0, 1e30f);
    a.log_amplitude = bytes_float("log_amplitude", -1e30f, 1e30f);
    return a;
}

static void check_lobe(const char *function, asg_lobe a) {
    bytes_check_unit(function, a.x);
    bytes_check_unit(function, a.y);
    bytes_check_unit(function, a.z);
    bytes_check(function, lobe_dot(a.x, a.y), -3e-6f, 3e-6f);
    bytes_check(function, lobe_dot(a.x, a.z), -3e-6f, 3e-6f);
    bytes_check(function, lobe_dot(a.y, a.z), -3e-6f, 3e-6f);
    bytes_check(function, a.sharpness_x, 0, FLT_MAX);
    bytes_check(function, a.sharpness_y, 0, FLT_MAX);
    bytes_check_finite(function, a.log_amplitude);
}

static void integrals(void) {
    asg_lobe a = any_lobe("a"), b = any_lobe("b"), plain = a, other = b;
    sg_lobe g = bytes_sg("g", 1e30f, 1e30f), unit = g;
    lobe_vec3 dir = bytes_direction("dir");
    float kappa = bytes_float("kappa", 1e-45f, FLT_MAX), tolerance = bytes_float("tolerance", 0, 1);
    plain.log_amplitude = other.log_amplitude = unit.log_amplitude = 0;
    bytes_check("asg_eval", asg_eval(a, dir), 0, 0x1.00001p122f);
    bytes_check("asg_eval of peak 1", asg_eval(plain, dir), 0, 1.000001f);
    bytes_check("asg_integral", asg_integral(a), 0, FLT_MAX);
    bytes_check("asg_integral of peak 1", asg_integral(plain), 0, 3.1416f);
    bytes_check("asg_integral_approx", asg_integral_approx(a), 0, FLT_MAX);
    bytes_check("asg_sg_integral_xu", asg_sg_integral_xu(a, g), 0, FLT_MAX);
    bytes_check("asg_sg_integral", asg_sg_integral(a, g), 0, FLT_MAX);
    bytes_check("asg_sg_integral of peaks 1", asg_sg_integral(plain, unit), 0, 3.1416f * 1.042f);
    bytes_check_sg("asg_isotropic", asg_isotropic(a), 2.0001e30f);
    bytes_check("asg_sg_form", (float)asg_sg_form(a, g.sharpness, tolerance), 0, 2);
    bytes_check("asg_product_integral", asg_product_integral(a, b), 0, FLT_MAX);
    bytes_check("asg_product_integral of peaks 1", asg_product_integral(plain, other), 0, 3.1416f);
    bytes_check("asg_product_integral_xu", asg_product_integral_xu(a, b), 0, FLT_MAX);
    a = asg_convolve(a, kappa);
    bytes_check("asg_convolve", a.sharpness_x, 0, plain.sharpness_x);
    bytes_check("asg_convolve", a.sharpness_y, 0, plain.sharpness_y);
    bytes_check_finite("asg_convolve", a.log_amplitude);
}

static void reflections(void) {
    lobe_vec3 normal = bytes_direction("normal"), wi = bytes_direction("wi"), place, x, y;
    float angle = bytes_float("angle", 0, 6.5f), c = cosf(angle), s = sinf(angle);
    float alpha = bytes_float("alpha", 0, FLT_MAX), other = bytes_float("alpha_y", 0, FLT_MAX);
    float sharpness = bytes_float("half_sharpness", 0, 1e9f), across = bytes_float("half_sharpness_y", 0, 1e9f);
    vsgl light;
    int k;
    lobe_frame(normal, &x, &y);
    x = lobe_normalize_or(lobe_add(lobe_scale(x, c), lobe_scale(y, s)), x);
    check_lobe("asg_reflection_lobe", asg_reflection_lobe(normal, wi, sharpness));
    check_lobe("asg_reflection_lobe_aniso", asg_reflection_lobe_aniso(normal, x, wi, sharpness, across));
    check_lobe("asg_ggx_lobe", asg_ggx_lobe(normal, wi, alpha));
    check_lobe("asg_ggx_lobe_aniso", asg_ggx_lobe_aniso(normal, x, wi, alpha, other));
    check_lobe("asg_beckmann_lobe", asg_beckmann_lobe(normal, wi, alpha));
    check_lobe("asg_beckmann_lobe_aniso", asg_beckmann_lobe_aniso(normal, x, wi, alpha, other));
    check_lobe("asg_ward_lobe", asg_ward_lobe(normal, x, wi, alpha, other));
    check_lobe("asg_phong_lobe", asg_phong_lobe(normal, wi, sharpness));
    check_lobe("asg_ashikhmin_lobe", asg_ashikhmin_lobe(normal, x, wi, sharpness, across));
    place = bytes_vector("place", 1e4f);
    light = bytes_vsgl(1e10f);
    alpha = bytes_float("alpha of the light's surface", 1e-4f, 1);
    for (k = 0; k < 2; k++)
        bytes_check("asg_vsgl_specular",
                    asg_vsgl_specular(light, k, place, normal, wi, alpha, asg_ggx_lobe(normal, wi, alpha)), 0, FLT_MAX);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    bytes_begin(bytes, count);
    if (bytes_byte() % 2)
        reflections();
    else
        integrals();
    return 0;
}
