/* hard_ggx_bound.c - hard cases of ggx_bound.h. The printed forms are those of ggx_bound_loops.c. */
#include "ggx_bound_columns.h"
#include "hard_cases.h"
#include "../exact.h"

BENCH_DECLARE(usual_ggx_ndf);
BENCH_DECLARE(usual_ggx_brdf_cos);

static double printed(bench_loop *loop) {
    loop(&hard_in, &hard_out);
    return (double)hard_out.column[0][0];
}

/* In the plane that two angles tell: from the normal, and around it */
static vec at(double theta, double phi) {
    vec v = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    return v;
}

static double density(vec h, vec n, double a) {
    vec s = combine(1, h, -dot(h, n), n);
    double c = dot(h, n), base = a * a * c * c + dot(s, s);
    return a * a / (REFERENCE_PI * base * base);
}

static double slope(double c, double a) {
    return sqrt(a * a + (1 - a * a) * c * c);
}

/* With the masking that the function has: heights correlated, or independent */
static double brdf_cos(vec n, vec wi, vec wo, double a, int correlated) {
    double ci = dot(n, wi), co = dot(n, wo), d = density(unit(combine(1, wi, 1, wo)), n, a);
    if (!(co > 0)) return 0;
    return correlated ? d * co / (2 * (ci * slope(co, a) + co * slope(ci, a)))
                      : d * co / ((ci + slope(ci, a)) * (co + slope(co, a)));
}

static void distribution(const char *name, double alpha, double angle) {
    const float a = (float)alpha;
    const lobe_vec3 n = lobe_vector(0, 0, 1), h = narrow(at(angle, 0.7));
    double wanted = density(unit(wide(h)), wide(n), (double)a);
    hard_put(VPL_FRONT, n);
    hard_put(VPL_OUT, h);
    hard_in.column[VPL_ALPHA_X][0] = a;
    hard_case_row_printed(hard_case_of("ggx_bound.h", "ggx_ndf", "angular", name, (double)ggx_ndf(h, n, a), wanted,
                                       wanted * (1 + 1 / (double)a) * TEST_EPSILON),
                          printed(usual_ggx_ndf_scalar));
}

/* Angles from the normal, and between the planes; errors are those of the logarithm */
static void reflect(const char *name, double alpha, double incidence, double outgoing, double turn) {
    const float a = (float)alpha;
    const lobe_vec3 n = lobe_vector(0, 0, 1), wi = narrow(at(incidence, 0.3)), wo = narrow(at(outgoing, 0.3 + turn));
    const vec i = unit(wide(wi)), o = unit(wide(wo));
    double ci = i.z, co = o.z, wanted = brdf_cos(wide(n), i, o, (double)a, 1);
    double unit_of = (1 + 1 / (double)a) * TEST_EPSILON * 2 / length(combine(1, i, 1, o)) +
                     TEST_EPSILON * (1 / fmax(ci, (double)a) + 1 / co);
    hard_case c = hard_case_of("ggx_bound.h", "ggx_brdf_cos", "angular", name, (double)ggx_brdf_cos(n, wi, wo, a),
                               wanted, unit_of);
    c.error = HARD_LOGARITHM;
    hard_case_row(c);
    hard_put(VPL_FRONT, n);
    hard_put(VPL_TO_LIGHT, wi);
    hard_put(VPL_OUT, wo);
    hard_in.column[VPL_ALPHA_X][0] = a;
    c = hard_case_of("ggx_bound.h", "ggx_brdf_cos_separable", "angular", name,
                     (double)ggx_brdf_cos_separable(n, wi, wo, a), brdf_cos(wide(n), i, o, (double)a, 0), unit_of);
    c.error = HARD_LOGARITHM;
    hard_case_row_printed(c, printed(usual_ggx_brdf_cos_scalar));
}

static void mask(const char *name, double cosine, double alpha) {
    const float c = (float)cosine, a = (float)alpha;
    double wanted = 2 * (double)c / ((double)c + slope((double)c, (double)a));
    hard_case_row(
        hard_case_of("ggx_bound.h", "ggx_smith_g1", "ulp", name, (double)ggx_smith_g1(c, a), wanted, test_ulp(wanted)));
}

/* How far out a point is in the space in which the ellipsoid is a unit sphere */
static double outside(const ggx_ellipsoid *e, vec p) {
    vec offset = combine(1, p, -1, wide(e->center));
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        double x = dot(wide(e->axis[k]), offset) / (double)e->radius[k];
        sum += x * x;
    }
    return sqrt(sum);
}

/* The farthest accepted point of each of many directions about the mirror's, rounded to the floats that a renderer has:
   the one that is farthest out of the volume must be in it. */
static void hold(const char *name, double alpha, double far_away, double incidence) {
    enum { RINGS = 200, SECTORS = 64 };
    const float a = (float)alpha;
    const double delta = (double)1e-3f, xi = 0.5, flux = 1;
    const vec n = at(0, 0), i = at(incidence, 0), mirror = at(incidence, REFERENCE_PI), side = {0, 1, 0};
    const lobe_vec3 position = narrow(combine(far_away, at(1, 2), 0, n)), normal = narrow(n), wi = narrow(i);
    const vec down = {-mirror.z, 0, mirror.x};
    const ggx_ellipsoid e = ggx_bound_ellipsoid(position, normal, wi, a, (float)flux, 1, 1e-3f, (float)xi);
    double worst = 0;
    hard_case c;
    int ring, sector;
    for (ring = 0; ring <= RINGS; ring++) {
        double angle = ring ? (double)a * 1e-2 * pow(1e4, ring / (double)RINGS) : 0;
        for (sector = 0; sector < SECTORS && angle < 1.5; sector++) {
            double phi = 2 * REFERENCE_PI * sector / SECTORS, value, range;
            vec u = combine(cos(angle), mirror, sin(angle) * cos(phi), down), p;
            u = unit(combine(1, u, sin(angle) * sin(phi), side));
            if (u.z <= 0) continue;
            value = flux * brdf_cos(unit(wide(normal)), unit(wide(wi)), u, (double)a, 1);
            range = sqrt(value / (delta * xi));
            p = combine(1, wide(position), range, u);
            p = wide(narrow(p));
            /* rounding may have moved it out of the region */
            u = combine(1, p, -1, wide(position));
            range = length(u);
            if (!(range > 0) || !(flux * brdf_cos(unit(wide(normal)), unit(wide(wi)), unit(u), (double)a, 1) >
                                  delta * xi * range * range))
                continue;
            worst = fmax(worst, outside(&e, p));
        }
    }
    c = hard_case_within("ggx_bound_ellipsoid", "out of it", 0, name, worst, 1);
    c.error = HARD_AT_MOST;
    hard_case_row(c);
}

static void opposed(const char *name, double apart) {
    const lobe_vec3 wi = narrow(at(0.4, 0.3)), wo = narrow(at(REFERENCE_PI - 0.4 - apart, 0.3 + REFERENCE_PI));
    double wanted = 0.5 * length(combine(1, wide(wi), 1, wide(wo)));
    hard_case_row(hard_case_of("ggx_bound.h", "ggx_cos_half", "abs", name, (double)ggx_cos_half(wi, wo), wanted, 1));
}

void hard_ggx_bound(void) {
    distribution("alpha 1e-4, at the peak", 1e-4, 0);
    distribution("alpha 1e-4, half vector alpha off", 1e-4, 1e-4);
    reflect("alpha 1e-4, cosines .001, .0011", 1e-4, acos(1e-3), acos(1.1e-3), REFERENCE_PI);
    reflect("alpha .5, cosines 1e-5 both", 0.5, acos(1e-5), acos(1e-5), REFERENCE_PI);
    reflect("alpha .5, directions at the horizon, 1.4 apart", 0.5, acos(1e-4), acos(1e-4), 1.4);
    mask("alpha 1e-4, cosine 1e-6", 1e-6, 1e-4);
    opposed("1e-6 from opposed", 1e-6);
    hold("alpha 1e-4, farthest accepted point", 1e-4, 1, 0.8);
    hold("alpha 1e-4, the same 1e4 from the origin", 1e-4, 1e4, 0.8);
    hold("alpha .05, incidence at 89.9 degrees", 0.05, 1, 89.9 / 180 * REFERENCE_PI);
}
