/*
 Some functions of every header, and their values as %a: the same in every build that drops the headers in another way.

   VEC3     a file that makes a vector type; LOBE_VEC3 is its name
   HOSTILE  a file of macros that other headers leave behind
   VALUES   the name of a function to write instead of main, so that several are linked into one program
*/
#ifdef HOSTILE
#include <stdio.h>
#include <stdlib.h>
#ifdef __cplusplus /* whose own headers do not survive it */
#include <math.h>
#include <string.h>
#endif
#include HOSTILE
#endif
#ifdef VEC3
#include VEC3
#endif
#include "bilateral.h"
#include "fis.h"
#include "ggx_bound.h"
#include "sg.h"
#include "asg.h"
#include "bilateral.h"
#include "fis.h"
#include <stdio.h>
#include <stdlib.h>

typedef struct {
    const char *name;
    float (*of)(float);
} one_number;

static void show(const char *name, float value) {
    printf("%s %a\n", name, (double)value);
}

static void show_vector(const char *name, lobe_vec3 v) {
    printf("%s %a %a %a\n", name, (double)v.x, (double)v.y, (double)v.z);
}

static lobe_vec3 direction_of(float turn, float height) {
    lobe_vec3 v;
    float wide = sqrtf(1 - height * height);
    lobe_turn(turn, &v.x, &v.y);
    v.x *= wide;
    v.y *= wide;
    v.z = height;
    return v;
}

/* Lights and lobes */
static void show_lobes(lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 wo, float alpha) {
    lobe_vec3 power = lobe_vector(1, 2, 3), point = lobe_scale(wo, 4);
    sg_lobe narrow = sg_ggx_lobe(normal, wi, alpha), wide = sg_diffuse_lobe(normal);
    asg_lobe long_lobe = asg_ggx_lobe(normal, wi, alpha);
    vsgl_moments m = vsgl_moments_from_vpl(normal, normal, wi, power, power, alpha);
    vsgl light;
    m = vsgl_moments_add(m, vsgl_moments_from_vpl(point, normal, wo, power, power, alpha));
    light = vsgl_from_moments(m, normal);
    show_vector("axis", narrow.axis);
    show("sg_eval", sg_eval(narrow, wo));
    show("sg_product", sg_product(narrow, wide).log_amplitude);
    show("sg_product_integral", sg_product_integral(narrow, wide));
    show("sg_cosine_integral", sg_cosine_integral(narrow, normal));
    show_vector("sg_sample", sg_sample(narrow, 0.25f, 0.75f));
    show_vector("position", light.position);
    show("vsgl_diffuse_integral", vsgl_diffuse_integral(light, VSGL_DIFFUSE, lobe_scale(wo, -3), wo));
    show("asg_vsgl_specular",
         asg_vsgl_specular(light, VSGL_SPECULAR, lobe_scale(wo, -3), normal, wi, alpha, long_lobe));
    show("asg_eval", asg_eval(long_lobe, wo));
    show("asg_sg_integral", asg_sg_integral(long_lobe, wide));
    show("bilateral_sg_weight", bilateral_sg_weight(narrow, wide, 2));
    show("bilateral_asg_weight", bilateral_asg_weight(long_lobe, asg_ggx_lobe(normal, wo, alpha), 2));
}

/* Reflection and what bounds it */
static void show_bounds(lobe_vec3 normal, lobe_vec3 wi, lobe_vec3 wo, float alpha) {
    lobe_vec3 position = lobe_vector(3, -2, 1);
    ggx_ellipsoid volume = ggx_bound_ellipsoid(position, normal, wi, alpha, 1, 1, 0.001f, 0.25f);
    ggx_sphere sphere = ggx_bound_enclosing(volume);
    show("ggx_brdf_cos", ggx_brdf_cos(normal, wi, wo, alpha));
    show_vector("center", volume.center);
    show_vector("its axis", volume.axis[0]);
    show("its radius", volume.radius[0]);
    show_vector("sphere", sphere.center);
}

static void show_images(void) {
    enum { WIDTH = 9, HEIGHT = 7, SAMPLES = 8 };
    float image[WIDTH * HEIGHT], *memory = (float *)malloc(fis_pyramid_size(WIDTH, HEIGHT, 1) * sizeof *memory);
    fis_pyramid pdf;
    int i;
    if (!memory) exit(1);
    for (i = 0; i < WIDTH * HEIGHT; i++) image[i] = (float)(i * 37 % 11);
    pdf = fis_build_pdf(memory, image, WIDTH, HEIGHT);
    for (i = 0; i < SAMPLES; i++) {
        fis_sample s = fis_warp(&pdf, fis_lattice(i, SAMPLES));
        show("fis_warp", s.u);
        show("fis_level", fis_level(&pdf, &s, SAMPLES, 1));
    }
    free(memory);
}

static void show_all(void) {
    /* addresses of functions, also of those that are always inlined where they are called */
    static const one_number functions[] = {{"sg_integral", sg_integral},
                                           {"sg_mean_length", sg_mean_length},
                                           {"bilateral_scale", bilateral_scale},
                                           {"lobe_exp", lobe_exp}};
    float (*const depth)(float, float) = bilateral_depth_exponent;
    size_t k;
    int i;
    for (i = 0; i < 16; i++) {
        float part = (float)i / 16;
        lobe_vec3 normal = direction_of(0, 1), wi = direction_of(part, 0.03f + 0.9f * part);
        show_lobes(normal, wi, direction_of(1 - part, 0.5f), 0.05f + part);
        show_bounds(normal, wi, direction_of(1 - part, 0.5f), 0.05f + part);
        for (k = 0; k < sizeof functions / sizeof *functions; k++)
            show(functions[k].name, functions[k].of(0.1f + (float)i));
        show("bilateral_depth_exponent", depth(1, 1 + part));
    }
    show_images();
}

#ifndef VALUES
int main(void) {
    show_all();
    return 0;
}
#else
#ifdef __cplusplus
extern "C"
#endif
    void
    VALUES(void);
void VALUES(void) {
    show_all();
}
#endif
