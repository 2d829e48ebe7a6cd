// A program with a vector class of its own: what a glossy floor reflects of a lamp, for four values of roughness, by the
// closed form and by samples of the reflection lobe.
#include <cstdio>

class vec3 {
  public:
    float x, y, z;
    vec3() : x(0), y(0), z(0) {
    }
    vec3(float right, float up, float forward) : x(right), y(up), z(forward) {
    }
};

#define LOBE_VEC3 vec3
#include "fis.h"
#include "sg.h"

static float sampled(sg_lobe reflection, sg_lobe lamp, int count) {
    float sum = 0;
    for (int i = 0; i < count; i++) {
        fis_point place = fis_lattice(i, count);
        sum += sg_eval(lamp, sg_sample(reflection, place.u, place.v));
    }
    return sum / static_cast<float>(count) * sg_integral(reflection.sharpness);
}

int main() {
    const vec3 normal(0, 1, 0), eye(0.6f, 0.8f, 0);
    const sg_lobe lamp = {vec3(-0.64f, 0.768f, 0.024f), 200, 0};
    for (float alpha = 0.05f; alpha < 0.5f; alpha *= 2) {
        sg_lobe reflection = sg_ggx_lobe(normal, eye, alpha);
        reflection.log_amplitude = 0;
        std::printf("alpha %.2f: %.5f, sampled %.5f\n", static_cast<double>(alpha),
                    static_cast<double>(sg_product_integral(reflection, lamp)),
                    static_cast<double>(sampled(reflection, lamp, 4096)));
    }
    return 0;
}
