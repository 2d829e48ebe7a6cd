/*
 ggx_bound.c - tests of ggx_bound.h: the BRDF against double and quadrature; bounding volumes by a search for accepted
 points outside of them; the estimator's mean; tests against boxes and tiles by exact distances
*/
#include "../ggx_bound.h"
#include "exact.h"
#include "record.h"
#include "test.h"
#include <float.h>

#define PI REFERENCE_PI

static test_bound bound_of(const char *function, const char *kind) {
    return test_bound_of("ggx_bound.h", function, kind);
}

/* ---- input ---- */

static double uniform(void) {
    return test_uniform(&test_random);
}

static double log_uniform(double low, double high) {
    return test_log_uniform(&test_random, low, high);
}

static vec of(double x, double y, double z) {
    vec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static vec add(vec a, vec b) {
    return combine(1, a, 1, b);
}

static vec cross(vec a, vec b) {
    return of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* A float direction near a given one, of a length anywhere within 1e-7 of 1. */
static lobe_vec3 nearly_unit(vec v) {
    lobe_vec3 w;
    do w = narrow(combine((1 + 1e-7 * (2 * uniform() - 1)) / length(v), v, 0, v));
    while (fabs(length(wide(w)) - 1) > 1e-7);
    return w;
}

static vec perpendicular(vec a) { /* any of them, at random */
    vec t = random_direction();
    return unit(combine(1, t, -dot(t, a), a));
}

/* a turned by an angle towards a perpendicular b */
static vec towards(vec a, vec b, double angle) {
    return combine(cos(angle), a, sin(angle), b);
}

static float float_of(double x) { /* surely rounded, as narrow */
    volatile float y = (float)x;
    return y;
}

/* ---- the BRDF in double, from unit vectors ---- */

static double exact_ndf(vec h, vec n, double a) {
    vec s = cross(n, h);
    double c = dot(h, n), base = a * a * c * c + dot(s, s);
    return c > 0 ? a * a / (PI * base * base) : 0;
}

/* Two perpendicular tangents, the first as near as may be to the given */
static vec exact_tangent(vec n, vec t) {
    return unit(combine(1, t, -dot(t, n), n));
}

static double exact_ndf_aniso(vec h, vec n, vec t, double ax, double ay) {
    double x = dot(h, t) / ax, y = dot(h, cross(n, t)) / ay, z = dot(h, n), base = x * x + y * y + z * z;
    return z > 0 ? 1 / (PI * ax * ay * base * base) : 0;
}

static double exact_slope(vec w, vec n, vec t, double ax, double ay) {
    double x = ax * dot(w, t), y = ay * dot(w, cross(n, t)), z = dot(w, n);
    return sqrt(x * x + y * y + z * z);
}

typedef enum { CORRELATED, SEPARABLE, ENVELOPE } masking; /* G2, or G1(wi) in its place, which bounds any */

/* D G2 / (4 cos_i), 0 below the horizon */
static double exact_brdf_cos(vec n, vec t, vec wi, vec wo, double ax, double ay, masking kind) {
    double ci = dot(wi, n), co = dot(wo, n), si, so, d;
    if (ci < 0 || co <= 0) return 0;
    si = exact_slope(wi, n, t, ax, ay);
    so = exact_slope(wo, n, t, ax, ay);
    d = exact_ndf_aniso(unit(add(wi, wo)), n, t, ax, ay);
    if (kind == CORRELATED) return d * co / (2 * (co * si + ci * so));
    if (kind == SEPARABLE) return d * co / ((ci + si) * (co + so));
    return d / (2 * (ci + si));
}

/* ---- the BRDF ---- */

static double angular(double alpha) {
    return (1 + 1 / alpha) * TEST_EPSILON;
}

/* A half vector at any of the distances that matter to a lobe of that width */
static vec half_vector(vec n, double alpha) {
    int kind = pick(4);
    double angle = kind == 0 ? 0 : kind == 1 ? asin(sqrt(uniform())) : atan(alpha * log_uniform(1e-3, 1e3));
    return towards(n, perpendicular(n), angle);
}

static void test_ndf(void) {
    test_bound iso = bound_of("ggx_ndf", "angular"), aniso = bound_of("ggx_ndf_aniso", "angular");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        float ax = float_of(log_uniform(iso.low, iso.high)), ay = float_of(log_uniform(aniso.low, aniso.high));
        lobe_vec3 n = nearly_unit(random_direction()), t = nearly_unit(random_direction());
        lobe_vec3 h = nearly_unit(half_vector(unit(wide(n)), (double)(pick(2) ? ax : ay)));
        vec nn = unit(wide(n)), hh = unit(wide(h)), tt = exact_tangent(nn, wide(t));
        double wanted, least = fmin((double)ax, (double)ay);
        if (fabs(dot(wide(t), nn)) > 0.9) continue;
        begin();
        record_vector(h);
        record_vector(n);
        record_vector(t);
        record((double)ax);
        record((double)ay);
        if (fabs(dot(nn, hh)) < 1e-6) continue;
        wanted = exact_ndf(hh, nn, (double)ax);
        within(&iso, (double)ggx_ndf(h, n, ax), wanted, wanted * angular((double)ax) + DBL_MIN);
        wanted = exact_ndf_aniso(hh, nn, tt, (double)ax, (double)ay);
        within(&aniso, (double)ggx_ndf_aniso(h, n, t, ax, ay), wanted, wanted * angular(least) + DBL_MIN);
        that(ggx_ndf(lobe_scale(n, -1), n, ax) == 0 && ggx_ndf_aniso(lobe_scale(n, -1), n, t, ax, ay) == 0,
             "no facets from below");
    }
    test_report(&iso);
    test_report(&aniso);
}

static void test_smith(void) {
    test_bound g1 = bound_of("ggx_smith_g1", "ulp"), g2 = bound_of("ggx_smith_g2", "ulp");
    test_bound aniso = bound_of("ggx_smith_g1_aniso", "grazing");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        float alpha = float_of(log_uniform(1e-4, 1)), ay = float_of(log_uniform(1e-4, 1));
        double c = (double)float_of(log_uniform(g1.low, g1.high)), o = (double)float_of(log_uniform(g2.low, g2.high));
        double a2 = (double)alpha * (double)alpha, si, so, wanted;
        lobe_vec3 n = nearly_unit(random_direction()), t = nearly_unit(random_direction()), w;
        vec nn = unit(wide(n)), tt = exact_tangent(nn, wide(t));
        if (fabs(dot(wide(t), nn)) > 0.9) continue;
        w = nearly_unit(towards(nn, perpendicular(nn), acos(c)));
        begin();
        record(c);
        record(o);
        record((double)alpha);
        record((double)ay);
        record_vector(n);
        record_vector(t);
        record_vector(w);
        si = sqrt(a2 + (1 - a2) * c * c);
        so = sqrt(a2 + (1 - a2) * o * o);
        within(&g1, (double)ggx_smith_g1((float)c, alpha), 2 * c / (c + si), test_ulp(2 * c / (c + si)));
        wanted = 2 * c * o / (c * so + o * si);
        within(&g2, (double)ggx_smith_g2((float)c, (float)o, alpha), wanted, test_ulp(wanted));
        that(ggx_smith_g2(1 - 1e-6f * (float)c, 1 - 1e-6f * (float)o, alpha) <= 1, "G2 is at most 1");
        that(ggx_smith_g1(1 - 1e-6f * (float)c, alpha) <= 1, "G1 is at most 1");
        that(ggx_smith_g1_aniso(nearly_unit(combine(1, nn, 1e-3 * c, wide(w))), n, t, alpha, ay) <= 1,
             "G1 is at most 1");
        wanted = 4 * c * o / ((c + si) * (o + so));
        within(&g2, (double)ggx_smith_g2_separable((float)c, (float)o, alpha), wanted, test_ulp(wanted));
        c = dot(unit(wide(w)), nn);
        if (c <= 1e-6) continue;
        wanted = 2 * c / (c + exact_slope(unit(wide(w)), nn, tt, (double)alpha, (double)ay));
        within(&aniso, (double)ggx_smith_g1_aniso(w, n, t, alpha, ay), wanted, wanted * TEST_EPSILON * (1 + 1 / c));
    }
    begin();
    that(ggx_smith_g1(0, .1f) == 0 && ggx_smith_g1(-1, .1f) == 0 && ggx_smith_g1(1, .1f) == 1, "ends of G1");
    that(ggx_smith_g2(0, 1, .1f) == 0 && ggx_smith_g2(1, 0, .1f) == 0 && ggx_smith_g2(1, 1, .1f) == 1, "ends of G2");
    test_report(&g1);
    test_report(&g2);
    test_report(&aniso);
}

/* Any pair of directions above a surface, one often near the other's mirror direction */
static vec incidence(vec n, double *cosine) {
    int kind = pick(5);
    double c = uniform();
    if (kind == 0) c = log_uniform(1e-7, 1);
    if (kind == 1) c = cos(log_uniform(1e-7, 1));
    *cosine = c;
    return towards(n, perpendicular(n), acos(c));
}

/* A direction at any distance from opposed to its mirror direction about a half vector, and both above the horizon */
static vec opposed(vec n, vec h) {
    double c = log_uniform(1e-6, 1), s = sqrt((1 - c) * (1 + c)), most;
    vec across = length(cross(n, h)) > 1e-9 ? unit(cross(n, h)) : perpendicular(h), down = cross(h, across);
    most = fmin(c * dot(h, n) / fmax(s * fabs(dot(down, n)), DBL_MIN), 1);
    return towards(h, towards(across, down, asin(most * (2 * uniform() - 1))), acos(c));
}

static void test_brdf(void) {
    test_bound correlated = bound_of("ggx_brdf_cos", "angular");
    test_bound separable = bound_of("ggx_brdf_cos_separable", "angular");
    test_bound aniso = bound_of("ggx_brdf_cos_aniso", "angular");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        float ax = float_of(log_uniform(1e-4, 1)), ay = float_of(log_uniform(1e-4, 1));
        double a = (double)ax, least = fmin((double)ax, (double)ay), ci, co, wanted, short_sum, units;
        lobe_vec3 n = nearly_unit(random_direction()), t = nearly_unit(random_direction()), wi, wo;
        vec nn = unit(wide(n)), tt = exact_tangent(nn, wide(t)), h, i3, o3;
        if (fabs(dot(wide(t), nn)) > 0.9) continue;
        h = half_vector(nn, pick(2) ? a : least);
        wi = nearly_unit(pick(2) ? incidence(nn, &ci) : opposed(nn, h));
        i3 = unit(wide(wi));
        wo = nearly_unit(combine(2 * dot(i3, h), h, -1, i3));
        o3 = unit(wide(wo));
        ci = dot(i3, nn);
        co = dot(o3, nn);
        begin();
        record_vector(n);
        record_vector(t);
        record_vector(wi);
        record_vector(wo);
        record((double)ax);
        record((double)ay);
        that(co > -1e-6 || ggx_brdf_cos(n, wi, wo, ax) == 0, "nothing below the horizon");
        that(co > -1e-6 || ggx_brdf_cos_aniso(n, t, wi, wo, ax, ay) == 0, "nothing below the horizon");
        if (ci < 1e-6 || co < 1e-6) continue;
        /* logarithms, since a half vector off by its lobe's width changes the value by any factor */
        short_sum = 2 / length(add(i3, o3));
        units = angular(a) * short_sum + TEST_EPSILON * (1 / fmax(ci, a) + 1 / co);
        wanted = exact_brdf_cos(nn, tt, i3, o3, a, a, CORRELATED);
        within(&correlated, log((double)ggx_brdf_cos(n, wi, wo, ax) / wanted), 0, units);
        wanted = exact_brdf_cos(nn, tt, i3, o3, a, a, SEPARABLE);
        within(&separable, log((double)ggx_brdf_cos_separable(n, wi, wo, ax) / wanted), 0, units);
        units = angular(least) * short_sum + TEST_EPSILON * (1 / ci + 1 / co);
        wanted = exact_brdf_cos(nn, tt, i3, o3, a, (double)ay, CORRELATED);
        within(&aniso, log((double)ggx_brdf_cos_aniso(n, t, wi, wo, ax, ay) / wanted), 0, units);
    }
    test_report(&correlated);
    test_report(&separable);
    test_report(&aniso);
}

/* ---- bounding volumes ---- */

/* A light as floats, and the same in double */
typedef struct {
    lobe_vec3 position, normal, tangent, wi;
    float alpha_x, alpha_y, flux, fresnel, delta, xi;
    vec q, n, t, i;
} light;

static void widen(light *l) {
    l->q = wide(l->position);
    l->n = unit(wide(l->normal));
    l->t = exact_tangent(l->n, wide(l->tangent));
    l->i = unit(wide(l->wi));
}

static void record_light(const light *l) {
    begin();
    record_vector(l->position);
    record_vector(l->normal);
    record_vector(l->tangent);
    record_vector(l->wi);
    record((double)l->alpha_x);
    record((double)l->alpha_y);
    record((double)l->flux);
    record((double)l->fresnel);
    record((double)l->delta);
    record((double)l->xi);
}

static float draw_alpha(void) {
    int kind = pick(6);
    return kind == 0 ? 1.0f : kind == 1 ? 1e-4f : kind == 2 ? 1e-3f : float_of(log_uniform(1e-4, 1));
}

static light draw_light(double tip_low, double tip_high) {
    light l;
    double c, tip = log_uniform(tip_low, tip_high), a;
    l.position = narrow(combine(pick(3) ? log_uniform(1e-2, 1e5) : 0, random_direction(), 0, random_direction()));
    l.normal = nearly_unit(pick(8) ? random_direction() : of(0, 0, 1));
    do l.tangent = nearly_unit(random_direction());
    while (fabs(dot(wide(l.tangent), wide(l.normal))) > 0.9);
    l.wi = nearly_unit(incidence(unit(wide(l.normal)), &c));
    l.alpha_x = draw_alpha();
    l.alpha_y = pick(4) ? draw_alpha() : l.alpha_x;
    l.fresnel = pick(2) ? 1 : float_of(log_uniform(1e-2, 1));
    l.delta = float_of(log_uniform(1e-4, 1));
    l.xi = ggx_xi((unsigned)(4294967296.0 * uniform()));
    /* the flux that takes the light about that far at its peak */
    a = fmin((double)l.alpha_x, (double)l.alpha_y);
    l.flux = float_of(fmin(1e18, tip * tip * (double)l.delta * (double)l.xi * a * a * (c + a)));
    widen(&l);
    return l;
}

typedef enum { SPHEROID, ELLIPSOID, ANISOTROPIC, AT_LIGHT, ENCLOSING, VOLUMES } volume;
static const char *const volume_names[VOLUMES] = {
    "no accepted point is outside of the spheroid", "no accepted point is outside of the ellipsoid",
    "no accepted point is outside of the anisotropic ellipsoid",
    "no accepted point is outside of the sphere at the light", "no accepted point is outside of the enclosing sphere"};

static ggx_ellipsoid volume_of(const light *l, volume kind) {
    switch (kind) {
    case SPHEROID:
        return ggx_bound_spheroid(l->position, l->normal, l->wi, l->alpha_x, l->flux, l->fresnel, l->delta, l->xi);
    case ELLIPSOID:
        return ggx_bound_ellipsoid(l->position, l->normal, l->wi, l->alpha_x, l->flux, l->fresnel, l->delta, l->xi);
    case ANISOTROPIC:
        return ggx_bound_ellipsoid_aniso(l->position, l->normal, l->tangent, l->wi, l->alpha_x, l->alpha_y, l->flux,
                                         l->fresnel, l->delta, l->xi);
    case AT_LIGHT:
        return ggx_ellipsoid_of_sphere(
            ggx_bound_sphere(l->position, l->normal, l->wi, l->alpha_x, l->flux, l->fresnel, l->delta, l->xi));
    case ENCLOSING:
    case VOLUMES:
        break;
    }
    return ggx_ellipsoid_of_sphere(ggx_bound_enclosing(volume_of(l, SPHEROID)));
}

/* |p - center|^2 in the space where the ellipsoid is a unit sphere */
static double stretched_squared(const ggx_ellipsoid *e, vec p) {
    vec offset = combine(1, p, -1, wide(e->center));
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        double x = dot(wide(e->axis[k]), offset) / (double)e->radius[k];
        sum += x * x;
    }
    return sum;
}

static double covariance(const ggx_ellipsoid *e, vec a, vec b) { /* a.(K r^2 K').b */
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++)
        sum += (double)e->radius[k] * (double)e->radius[k] * dot(wide(e->axis[k]), a) * dot(wide(e->axis[k]), b);
    return sum;
}

static ggx_ellipsoid random_ellipsoid(double size, double ratio) {
    ggx_ellipsoid e;
    vec u = random_direction(), v = perpendicular(u);
    e.center = lobe_vector(0, 0, 0);
    e.axis[0] = narrow(u);
    e.axis[1] = narrow(v);
    e.axis[2] = narrow(cross(u, v));
    e.radius[0] = float_of(size);
    e.radius[1] = float_of(size * log_uniform(ratio, 1));
    e.radius[2] = float_of(size * log_uniform(ratio, 1));
    return e;
}

static void record_ellipsoid(const ggx_ellipsoid *e) {
    int k;
    begin();
    record_vector(e->center);
    for (k = 0; k < 3; k++) record_vector(e->axis[k]);
    for (k = 0; k < 3; k++) record((double)e->radius[k]);
}

/* Whether a point is accepted with a form of masking, in double; in float, by the library itself */
static int accepted(const light *l, vec p, double ay, masking kind) {
    vec offset = combine(1, p, -1, l->q);
    double squared = dot(offset, offset), value;
    if (squared == 0) return 1;
    value = exact_brdf_cos(l->n, l->t, l->i, unit(offset), (double)l->alpha_x, ay, kind);
    return (double)l->flux * (double)l->fresnel * value > (double)l->xi * (double)l->delta * squared;
}

static int accepted_in_float(const light *l, lobe_vec3 p, int anisotropic) {
    lobe_vec3 offset = lobe_sub(p, l->position), wo;
    float squared = lobe_dot(offset, offset), value;
    wo = lobe_scale(offset, 1 / sqrtf(squared));
    value = anisotropic ? ggx_brdf_cos_aniso(l->normal, l->tangent, l->wi, wo, l->alpha_x, l->alpha_y)
                        : ggx_brdf_cos(l->normal, l->wi, wo, l->alpha_x);
    return ggx_accept_weight(ggx_accept_probability(l->flux * l->fresnel * value, squared, l->delta), l->xi) > 0;
}

static double range_towards(const light *l, vec wo, double ay, masking kind) {
    double value = exact_brdf_cos(l->n, l->t, l->i, wo, (double)l->alpha_x, ay, kind);
    return sqrt((double)l->flux * (double)l->fresnel * value / ((double)l->xi * (double)l->delta));
}

/* An outgoing direction by two numbers: a half vector at distance alpha tan(x) in direction y; so even numbers reach
   the core, the tail, and the plane of incidence */
static vec outgoing(const light *l, double x, double y) {
    vec across = cross(l->n, l->i), w, v, h;
    double least = (double)l->alpha_x, angle;
    w = length(across) > 1e-9 ? unit(across) : exact_tangent(l->n, of(0.6, 0.48, 0.64));
    v = cross(w, l->n);
    angle = atan(least * tan(1.5707 * x));
    h = towards(l->n, combine(cos(y), v, sin(y), w), angle);
    return unit(combine(2 * dot(l->i, h), h, -1, l->i));
}

/* The point farthest out in a direction that is accepted as a float, and how far outside of the volume it is: above 1,
   it is outside. */
static double excess(const light *l, const ggx_ellipsoid *e, vec wo, double ay, masking kind, long *points) {
    double r = range_towards(l, wo, ay, kind), s;
    vec p = wide(narrow(combine(1, l->q, r, wo)));
    if (!(r > 0)) return 0;
    ++*points;
    s = stretched_squared(e, p);
    if (s <= 1) return s;
    /* rounding may have moved it out of the region; if so, there is one nearby that is inside */
    if (accepted(l, p, ay, kind)) return s;
    return 0;
}

static long points_tried;

/* Climbs from random directions of one light to where its volume is nearest to being exceeded. */
static void search(const light *l, volume kind, int starts, int steps, double *worst) {
    const ggx_ellipsoid e = volume_of(l, kind);
    const double ay = kind == ANISOTROPIC ? (double)l->alpha_y : (double)l->alpha_x;
    int start, step;
    for (start = 0; start < starts; start++) {
        masking form = (masking)pick(3);
        double x = uniform(), y = pick(3) ? 2 * PI * uniform() : PI * pick(2), size = 0.1, best = 0;
        lobe_vec3 p;
        for (step = 0; step < steps; step++) {
            double u = step ? fabs(x + size * (2 * uniform() - 1)) : x, v = step ? y + size * (2 * uniform() - 1) : y;
            double got;
            if (u > 1) u = 2 - u;
            got = excess(l, &e, outgoing(l, u, v), ay, form, &points_tried);
            if (got > 1) {
                record_light(l);
                record(u);
                record(v);
                record(got);
                record((double)form);
                that(0, volume_names[kind]);
            }
            if (got >= best) {
                best = got;
                x = u;
                y = v;
            } else {
                size *= 0.7;
                if (size < 1e-7) size = 0.03;
            }
        }
        if (best > *worst) *worst = best;
        /* the same with the library's own arithmetic, a little inside and outside of the exact range */
        p = narrow(combine(1, l->q,
                           range_towards(l, outgoing(l, x, y), ay, CORRELATED) * (1 + 1e-6 * (2 * uniform() - 1)),
                           outgoing(l, x, y)));
        points_tried++;
        if (distance(wide(p), l->q) > 0 && accepted_in_float(l, p, kind == ANISOTROPIC)) {
            record_light(l);
            record_vector(p);
            record(stretched_squared(&e, wide(p)));
            that(stretched_squared(&e, wide(p)) <= 1, volume_names[kind]);
        }
    }
}

static float scaled(float x, double spread, double low, double high) {
    return float_of(fmin(high, fmax(low, (double)x * exp(spread * (2 * uniform() - 1)))));
}

/* A light like another, in all that a volume depends on */
static light nearby(light l, double size) {
    l.position = narrow(combine(exp(size * (2 * uniform() - 1)), l.q, 0, l.q));
    l.normal = nearly_unit(combine(1, l.n, 0.2 * size, random_direction()));
    l.wi = nearly_unit(combine(1, l.i, size * uniform(), random_direction()));
    l.alpha_x = scaled(l.alpha_x, size, 1e-4, 1);
    l.alpha_y = scaled(l.alpha_y, size, 1e-4, 1);
    l.flux = scaled(l.flux, 2 * size, 1e-30, 1e18);
    if (pick(2)) l.xi = ggx_xi((unsigned)(4294967296.0 * uniform()));
    widen(&l);
    return l;
}

/* Climbs in the light as well: from one to the next of which a search comes nearer to the volume's surface */
static void climb(volume kind, int lights, int steps, double *worst) {
    int i, step;
    for (i = 0; i < lights * test_repeat; i++) {
        light l = draw_light(1e-3, 1e5);
        double best = 0, size = 0.5;
        for (step = 0; step < steps; step++) {
            light next = step ? nearby(l, size) : l;
            double got = 0;
            search(&next, kind, 2, 15, &got);
            if (got >= best) {
                best = got;
                l = next;
            } else {
                size = size < 1e-3 ? 0.5 : 0.8 * size;
            }
        }
        if (best > *worst) *worst = best;
    }
}

static void search_volume(volume kind, int lights, int starts, int steps) {
    double worst = 0;
    test_bound note;
    int i;
    points_tried = 0;
    for (i = 0; i < lights * test_repeat; i++) {
        light l = draw_light(1e-3, 1e5);
        search(&l, kind, starts, steps, &worst);
    }
    climb(kind, lights / 10, 40, &worst);
    note = stated("1 less the largest square of the stretched distance", 1);
    note.worst = 1 - worst;
    test_report(&note);
    if (test_repeat > 1) {
        note = stated("points tried", 1e9);
        note.worst = (double)points_tried;
        test_report(&note);
    }
}

static void test_spheroid(void) {
    search_volume(SPHEROID, 1000, 8, 25);
}

static void test_ellipsoid(void) {
    search_volume(ELLIPSOID, 1500, 8, 30);
}

static void test_ellipsoid_aniso(void) {
    search_volume(ANISOTROPIC, 1500, 8, 30);
}

static void test_spheres(void) {
    int i;
    for (i = 0; i < test_few(100000); i++) { /* the reach at the NDF's peak, where grazing angles make it uncertain */
        light l = draw_light(1e-3, 1e5);
        vec mirror = combine(2 * dot(l.i, l.n), l.n, -1, l.i);
        ggx_sphere s = ggx_bound_sphere(l.position, l.normal, l.wi, l.alpha_x, l.flux, l.fresnel, l.delta, l.xi);
        record_light(&l);
        that((double)s.radius >= range_towards(&l, mirror, (double)l.alpha_x, ENVELOPE), "the radius is the reach");
    }
    search_volume(AT_LIGHT, 250, 4, 25);
    search_volume(ENCLOSING, 250, 4, 25);
}

static double volume_size(ggx_ellipsoid e) {
    return (double)e.radius[0] * (double)e.radius[1] * (double)e.radius[2];
}

/* Lit from an angle of incidence in degrees, with a range r of about 1 */
static light tilted(double degrees, double alpha) {
    light l;
    double angle = degrees * PI / 180, a2 = alpha * alpha, c = cos(angle);
    l.position = lobe_vector(0, 0, 0);
    l.normal = lobe_vector(0, 0, 1);
    l.tangent = lobe_vector(1, 0, 0);
    l.wi = narrow(of(sin(angle), 0, c));
    l.alpha_x = (float)alpha;
    l.alpha_y = (float)alpha;
    l.fresnel = 1;
    l.delta = 0.001f;
    l.xi = 0.5f;
    l.flux = (float)(2 * PI * 0.001 * 0.5 * (c + sqrt(a2 + (1 - a2) * c * c)));
    widen(&l);
    return l;
}

static double least_radius(const ggx_ellipsoid *e) {
    return fmin(fmin((double)e->radius[0], (double)e->radius[1]), (double)e->radius[2]);
}

static double extent_of(vec v) {
    return fmax(fmax(fabs(v.x), fabs(v.y)), fabs(v.z));
}

/* On all sides by what is stated, where that is much more than rounding of the radii */
static void test_pad(void) {
    test_bound growth = bound_of("lobe_ggx_pad", "growth");
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-5), grown;
        float extent = float_of((double)e.radius[0] * log_uniform(100, 1e6));
        double unit = TEST_EPSILON * (double)extent;
        float swap = e.radius[0];
        k = pick(3);
        e.radius[0] = e.radius[k];
        e.radius[k] = swap;
        grown = e;
        lobe_ggx_pad(&grown, extent);
        record_ellipsoid(&e);
        record((double)extent);
        within(&growth, least_radius(&grown), least_radius(&e), unit);
        for (k = 0; k < 4; k++) {
            vec way = k < 3 ? wide(e.axis[k]) : random_direction();
            double more = sqrt(covariance(&grown, way, way)) - sqrt(covariance(&e, way, way));
            that(more >= 7.9 * unit, "an ellipsoid grows on all sides");
        }
    }
    test_report(&growth);
}

/* At grazing angles the range takes 8e-7 off the cosine and the slope, which has to outweigh their rounding. */
static void test_grazing_range(void) {
    test_bound taken = bound_of("lobe_ggx_range", "taken");
    int i;
    for (i = 0; i < 50000; i++) {
        lobe_vec3 normal = nearly_unit(random_direction()), wi;
        double alpha = (double)(float)log_uniform(1e-4, 1e-2), c, r, divisor;
        vec n = unit(wide(normal));
        c = log_uniform(1e-5, 1e-2);
        wi = nearly_unit(towards(n, perpendicular(n), acos(c)));
        c = dot(n, unit(wide(wi)));
        begin();
        record_vector(normal);
        record_vector(wi);
        record(alpha);
        r = (double)lobe_ggx_range(normal, wi, lobe_ggx_slope(lobe_ggx_cosine(normal, wi), (float)alpha), 1, 1, 1, .5f);
        divisor = c + sqrt(alpha * alpha + (1 - alpha * alpha) * c * c);
        r = divisor - 1 / (2 * PI * .5 * r * r);
        within(&taken, r, 0, 1 + 16 * TEST_EPSILON * divisor / 8e-7);
        that(r > 0, "no range is less than exact");
        wi = narrow(towards(n, perpendicular(n), PI / 2 + log_uniform(3e-6, 1)));
        record_vector(wi);
        that(lobe_ggx_range(normal, wi, 1, 1, 1, 1, 1) == 0, "below the horizon no light");
        wi = narrow(towards(n, perpendicular(n), PI / 2 + 4e-7 * uniform()));
        record_vector(wi);
        that(lobe_ggx_range(normal, wi, 1, 1, 1, 1, 1) > 0, "below the horizon by rounding");
    }
    test_report(&taken);
}

/* What the volumes are grown by: of the same light here and far away; of a long ellipsoid, by its length */
static void test_padding(void) {
    test_bound place = stated("what a bound grows by, of the position", 9), along = stated("of its length", 9);
    test_bound diffuse = stated("what a diffuse bound grows by, of twice the range", 9);
    int i, k;
    for (i = 0; i < 3000; i++) {
        light l = tilted(80 * uniform(), log_uniform(.003, .01)), far;
        vec turn = random_direction(), side = perpendicular(turn), n = turn, wi;
        double a = (double)l.alpha_x, c, s, r, reach, unit;
        float albedo = .5f;
        wi = combine((double)l.wi.z, n, (double)l.wi.x, side);
        l.normal = narrow(n);
        l.wi = narrow(wi);
        l.tangent = narrow(perpendicular(n));
        widen(&l);
        far = l;
        far.position = narrow(combine(log_uniform(2e4, 1e5), random_direction(), 0, n));
        widen(&far);
        c = dot(l.n, l.i);
        s = length(cross(l.n, l.i));
        r = sqrt((double)l.flux / (2 * PI * (double)l.delta * (double)l.xi * (c + exact_slope(l.i, l.n, l.t, a, a))));
        reach = r / a;
        record_light(&far);
        for (k = 0; k <= AT_LIGHT; k++) {
            ggx_ellipsoid here = volume_of(&l, (volume)k), there = volume_of(&far, (volume)k);
            unit = TEST_EPSILON * extent_of(far.q);
            within(&place, least_radius(&there), least_radius(&here), unit);
            that(least_radius(&there) - least_radius(&here) >= 7.5 * unit, "grows by the position");
            if (k == AT_LIGHT) continue;
            unit = TEST_EPSILON * reach;
            if (k != SPHEROID) { /* its least radius, as the family has it */
                double eps = 2 * a * a / (1 + a * a), h = (1 - eps) * s * s, eta, d;
                d = (double)lobe_ggx_tightness((float)eps, (float)(c * c), (float)s);
                eta = sqrt(1 - d);
                r = reach * a * sqrt(d * (2 - eps) / (2 * d - eps));
                r /= sqrt(1 + h * (1 + eta) / (d / (1 + eta) + 2 * eta * c * c));
            }
            within(&along, least_radius(&here), r, unit);
            that(least_radius(&here) - r >= 7.5 * unit, "grows by its length");
        }
        {
            ggx_sphere here = ggx_bound_diffuse(l.position, l.normal, l.flux, albedo, l.delta, l.xi);
            ggx_sphere there = ggx_bound_diffuse(far.position, l.normal, l.flux, albedo, l.delta, l.xi);
            unit = TEST_EPSILON * extent_of(far.q);
            within(&place, (double)there.radius, (double)here.radius, unit);
            that((double)(there.radius - here.radius) >= 7.5 * unit, "grows by the position");
            r = (double)lobe_ggx_diffuse_range(l.flux, albedo, l.delta, l.xi);
            unit = TEST_EPSILON * 2 * r;
            r *= pow(4 / 27., .25);
            within(&diffuse, (double)here.radius, r, unit);
            that((double)here.radius - r >= 7 * unit, "the diffuse sphere grows by its size");
        }
    }
    test_report(&place);
    test_report(&along);
    test_report(&diffuse);
}

/* Volumes of the ellipsoid over the spheroid's, and that the anisotropic one with equal alphas is the same */
static void test_volumes(void) {
    static const double degrees[] = {0, 15, 30, 45, 60, 75, 85, 89};
    static const double alphas[] = {0.02, 0.05, 0.1, 0.2, 0.4, 0.7};
    static const double table[6][8] = {{1.000, 0.967, 0.871, 0.717, 0.515, 0.278, 0.108, 0.043},
                                       {1.000, 0.968, 0.878, 0.731, 0.538, 0.308, 0.145, 0.091},
                                       {1.000, 0.969, 0.889, 0.755, 0.575, 0.360, 0.213, 0.175},
                                       {1.000, 0.970, 0.900, 0.800, 0.651, 0.470, 0.360, 0.339},
                                       {1.000, 0.977, 0.920, 0.852, 0.774, 0.675, 0.621, 0.613},
                                       {1.000, 0.989, 0.960, 0.924, 0.888, 0.858, 0.847, 0.846}};
    static const struct {
        const char *kind;
        double degrees, alpha;
    } stated_in_header[] = {{"volume_05_30", 30, 0.05}, {"volume_05_60", 60, 0.05}, {"volume_05_85", 85, 0.05},
                            {"volume_20_30", 30, 0.2},  {"volume_20_60", 60, 0.2},  {"volume_20_85", 85, 0.2}};
    test_bound near_table = stated("volume over spheroid's against the derivation's, relative", 0.02);
    test_bound same = stated("anisotropic ellipsoid of equal alphas, relative volume", 0.002);
    int i, j;
    for (i = 0; i < COUNT(alphas); i++) {
        for (j = 0; j < COUNT(degrees); j++) {
            light l = tilted(degrees[j], alphas[i]);
            double spheroid = volume_size(volume_of(&l, SPHEROID)), own = volume_size(volume_of(&l, ELLIPSOID));
            record_light(&l);
            within(&near_table, own / spheroid, table[i][j], table[i][j] + 0.025);
            within(&same, volume_size(volume_of(&l, ANISOTROPIC)), own, own);
        }
    }
    for (i = 0; i < COUNT(stated_in_header); i++) {
        test_bound most = bound_of("ggx_bound_ellipsoid", stated_in_header[i].kind);
        light l = tilted(stated_in_header[i].degrees, stated_in_header[i].alpha);
        record_light(&l);
        within(&most, volume_size(volume_of(&l, ELLIPSOID)) / volume_size(volume_of(&l, SPHEROID)), 0, 1);
        test_report(&most);
    }
    test_report(&near_table);
    test_report(&same);
}

/* Volume of the family's ellipsoid over the spheroid's, in double */
static double family_volume(double a, double c, double d) {
    double a2 = a * a, eps = 2 * a2 / (1 + a2), eta = sqrt(fmax(1 - d, 0));
    double k = 1 + (1 - eps) * (1 - c * c) * (1 + eta) / (d / (1 + eta) + 2 * eta * c * c);
    double g = d * (2 - eps) / (2 * d - eps);
    return g * g / sqrt(k);
}

static void test_tightness(void) {
    test_bound mean = bound_of("lobe_ggx_tightness", "mean"), worst = bound_of("lobe_ggx_tightness", "worst");
    double sum = 0;
    int i, k;
    for (i = 0; i < 2000; i++) {
        double a = log_uniform(0.01, 1), c = uniform(), eps = 2 * a * a / (1 + a * a), best = 1, loss;
        float d = lobe_ggx_tightness((float)eps, (float)(c * c), (float)sqrt(1 - c * c));
        for (k = 0; k <= 2000; k++) best = fmin(best, family_volume(a, c, pow(0.51 * eps, k / 2000.0)));
        loss = family_volume(a, c, (double)d) / best - 1;
        begin();
        record(a);
        record(c);
        within(&worst, loss, 0, 1);
        sum += loss;
    }
    begin();
    within(&mean, sum / 2000, 0, 1);
    test_report(&mean);
    test_report(&worst);
}

/* Least volume over the bounds for all d, of a range sqrt(alpha_x alpha_y), in double: the header's derivation anew, for
   a light at azimuth phi of the tangent */
static double family_volume_aniso(double ax, double ay, double c, double phi) {
    double xx = 1 / (ax * ax) - 1, yy = 1 / (ay * ay) - 1, s2 = 1 - c * c, c2 = c * c, best = DBL_MAX;
    double x11 = xx * cos(phi) * cos(phi) + yy * sin(phi) * sin(phi), x22 = xx + yy - x11;
    double b = x11 * c2 + x22;
    double kappa = 2 * xx * yy / (b + sqrt(fmax(b * b - 4 * c2 * xx * yy, 0))); /* det(X - kappa diag(1, c^2)) = 0 */
    double along = fmax(x11 - kappa, 0), across = fmax(x22 - kappa * c2, 0), eps = 2 / (2 + kappa);
    double l2 = along * c2 + across;
    int k;
    for (k = 0; k <= 400; k++) {
        double d = pow(0.501 * eps, k / 400.0), eta = sqrt(1 - d), om = d / (1 + eta);
        double t = 0.5 * eps * (1 + eta) / (om + 2 * eta * c2), sg = d + t * om * om * along * s2;
        double uu = eps * (2 - eps / sg), bb = 1 + t * d / sg * l2,
               ub2 = eps * eps * t * t * om * om * along * s2 * l2 / (sg * sg);
        double det = uu * bb - ub2, level = eps * sqrt(bb / det);
        best = fmin(best, level * level * level / sqrt(det));
    }
    return best;
}

/* Alphas that differ by little more than rounding, where all that makes the ellipsoid anisotropic cancels */
static void test_alphas_nearly_equal(void) {
    test_bound same = stated("ellipsoid of nearly equal alphas, relative volume", 0.002);
    int i;
    for (i = 0; i < 20000; i++) {
        light l = tilted(0, log_uniform(1e-4, 1)), round;
        double wanted;
        l.normal = nearly_unit(random_direction());
        l.tangent = nearly_unit(perpendicular(unit(wide(l.normal))));
        l.wi = nearly_unit(towards(unit(wide(l.normal)), perpendicular(unit(wide(l.normal))), log_uniform(1e-6, 1.5)));
        l.alpha_y = float_of((double)l.alpha_x * (1 + (2 * uniform() - 1) * log_uniform(1e-7, 1e-4)));
        widen(&l);
        round = l;
        round.alpha_y = round.alpha_x;
        wanted = volume_size(volume_of(&round, ELLIPSOID));
        record_light(&l);
        within(&same, volume_size(volume_of(&l, ANISOTROPIC)), wanted, wanted);
    }
    test_report(&same);
}

/* The corrected spheroid of the larger alpha: its range times the larger alpha over the mean one */
static void test_volumes_aniso(void) {
    test_bound mean = bound_of("ggx_bound_ellipsoid_aniso", "volume");
    test_bound mean_loss = bound_of("ggx_bound_ellipsoid_aniso", "mean");
    test_bound worst_loss = bound_of("ggx_bound_ellipsoid_aniso", "worst");
    double sum = 0, squares = 0, chance, losses = 0;
    int i;
    for (i = 0; i < 4000; i++) {
        double loss;
        vec across;
        light l = tilted(0, 1);
        double c, most, r, ratio;
        ggx_ellipsoid e;
        l.alpha_x = float_of(log_uniform(mean.low, mean.high));
        l.alpha_y = float_of(log_uniform(mean.low, mean.high));
        l.tangent = nearly_unit(perpendicular(l.n));
        c = uniform();
        l.wi = nearly_unit(towards(l.n, perpendicular(l.n), acos(c)));
        widen(&l);
        most = fmax((double)l.alpha_x, (double)l.alpha_y);
        r = sqrt((double)l.flux / (2 * PI * (double)l.delta * (double)l.xi *
                                   (dot(l.i, l.n) + exact_slope(l.i, l.n, l.t, (double)l.alpha_x, (double)l.alpha_y))));
        r *= most / sqrt((double)l.alpha_x * (double)l.alpha_y);
        e = volume_of(&l, ANISOTROPIC);
        ratio = log(volume_size(e) / (r * r * r * (1 + most * most) / (2 * most)));
        r /= most;
        across = unit(cross(l.n, l.i));
        loss = family_volume_aniso((double)l.alpha_x, (double)l.alpha_y, dot(l.n, l.i),
                                   atan2(-dot(across, l.t), dot(across, cross(l.n, l.t))));
        loss = volume_size(e) / (r * r * r) / loss - 1;
        record_light(&l);
        within(&worst_loss, loss, 0, 1);
        losses += loss;
        sum += ratio / 4000;
        squares += ratio * ratio / 4000;
    }
    begin();
    chance = 4.5 * sqrt((squares - sum * sum) / 4000); /* standard errors of the mean */
    within(&mean, exp(sum - chance), 0, 1);
    within(&mean_loss, losses / 4000, 0, 1);
    test_report(&mean);
    test_report(&mean_loss);
    test_report(&worst_loss);
}

/* Diffuse: the region is a curve turned about the normal, |p| = R sqrt(cos). */
static void test_diffuse(void) {
    test_bound share = bound_of("ggx_bound_diffuse_ellipsoid", "volume");
    double tight = 0, tight_ellipsoid = 0;
    int i;
    for (i = 0; i < test_draws(300000); i++) {
        light l = draw_light(1e-3, 1e5);
        float albedo = float_of(uniform()), reach;
        ggx_sphere sphere;
        ggx_ellipsoid e;
        double r, c = i % 2 ? uniform() : log_uniform(1e-9, 1), d;
        vec p, offset;
        l.flux = float_of(log_uniform(1e-3, 1e3));
        reach = lobe_ggx_diffuse_range(l.flux, albedo, l.delta, l.xi);
        if (i < 1000) l.position = lobe_vector(0, 0, 0);
        widen(&l);
        sphere = ggx_bound_diffuse(l.position, l.normal, l.flux, albedo, l.delta, l.xi);
        e = ggx_bound_diffuse_ellipsoid(l.position, l.normal, l.flux, albedo, l.delta, l.xi);
        r = sqrt((double)l.flux * (double)albedo / (PI * (double)l.delta * (double)l.xi) * c);
        p = wide(narrow(combine(1, l.q, r, towards(l.n, perpendicular(l.n), acos(c)))));
        offset = combine(1, p, -1, l.q);
        d = dot(offset, offset);
        record_light(&l);
        record((double)albedo);
        record(c);
        if (d > 0 &&
            (double)l.flux * (double)albedo * dot(offset, l.n) / sqrt(d) / PI > (double)l.delta * (double)l.xi * d) {
            that(distance(p, wide(sphere.center)) <= (double)sphere.radius, "the diffuse sphere bounds");
            that(stretched_squared(&e, p) <= 1, "the diffuse ellipsoid bounds");
        }
        if (i >= 1000) continue;
        tight = fmax(tight, distance(p, wide(sphere.center)) / (double)sphere.radius);
        tight_ellipsoid = fmax(tight_ellipsoid, stretched_squared(&e, p));
        within(&share, volume_size(e) / pow((double)sphere.radius, 3), 0, 1);
        that((double)reach >= 0, "a range");
    }
    begin();
    that(tight > 0.9999 && tight_ellipsoid > 0.9999, "the diffuse bounds are touched");
    test_report(&share);
}

/* ---- stochastic culling ---- */

static void test_accept(void) {
    test_bound probability = bound_of("ggx_accept_probability", "ulp"), range = bound_of("ggx_range", "ulp");
    test_bound weight = bound_of("ggx_accept_weight", "ulp"), estimate = bound_of("ggx_estimate", "ulp");
    int i;
    for (i = 0; i < test_few(200000); i++) {
        float intensity = float_of(log_uniform(1e-9, 1e9)), squared = float_of(log_uniform(1e-9, 1e9));
        float delta = float_of(log_uniform(1e-6, 1)), xi = ggx_xi((unsigned)(4294967296.0 * uniform())), got;
        double p = (double)intensity / ((double)delta * (double)squared), wanted;
        begin();
        record((double)intensity);
        record((double)squared);
        record((double)delta);
        record((double)xi);
        within(&probability, (double)ggx_accept_probability(intensity, squared, delta), fmin(p, 1),
               test_ulp(fmin(p, 1)));
        wanted = sqrt((double)intensity / ((double)delta * (double)xi));
        within(&range, (double)ggx_range(intensity, delta, xi), wanted, test_ulp(wanted));
        got = ggx_accept_probability(intensity, squared, delta);
        wanted = got > xi ? 1 / (double)got : 0;
        within(&weight, (double)ggx_accept_weight(got, xi), wanted, test_ulp(wanted));
        wanted = got > xi ? fmax((double)intensity / (double)squared, (double)delta) : 0;
        within(&estimate, (double)ggx_estimate(intensity, squared, delta, xi), wanted, test_ulp(wanted));
    }
    begin();
    that(ggx_xi(0) == 0x1p-24f && ggx_xi(0xFFFFFFFFu) == 1 - 0x1p-24f, "ends of the random numbers");
    that(ggx_accept_probability(1, 0, .1f) == 1 && ggx_accept_probability(0, 0, .1f) == 0, "probability at the light");
    that(ggx_range(1e-10f, 1e-20f, .5f) == ggx_range(1e-10f, 1e-18f, .5f), "delta counts as 1e-18");
    that(ggx_accept_weight(0, 0) == 0 && ggx_estimate(0, 1, .1f, 0) == 0, "no light is never accepted");
    that(test_is_finite(ggx_estimate(1e18f, 0, .1f, .5f)) && ggx_estimate(1, 0, .1f, .5f) > 0, "estimate at the light");
    for (i = 0; i < 1000; i++) { /* above, not at */
        float p = ggx_xi((unsigned)i << 22);
        begin();
        record((double)p);
        that(ggx_accept_weight(p, p) == 0 && ggx_accept_weight(p + 0x1p-22f, p) > 0, "accepted above xi");
        that(ggx_estimate(p, 1, 1, p) == 0 && ggx_estimate(p + 0x1p-22f, 1, 1, p) == 1, "estimated above xi");
    }
    test_report(&probability);
    test_report(&range);
    test_report(&weight);
    test_report(&estimate);
}

static void test_accept_mean(void) {
    test_bound bias = bound_of("ggx_accept_weight", "bias");
    int i;
    unsigned k, step = 1;
    while ((unsigned)test_draws(4 * 0x800000) * step < 4 * 0x800000u) step *= 2;
    for (i = 0; i < 4; i++) { /* every random number there is, or the middle one of each few */
        float p = float_of(i == 0 ? 1 : i == 1 ? 0x1p-22 * step : log_uniform(1e-5, 1));
        double sum = 0;
        for (k = step / 2; k < 0x800000u; k += step) sum += (double)ggx_accept_weight(p, ggx_xi(k << 9)) * step;
        begin();
        record((double)p);
        within(&bias, sum / 0x800000, 1, step / (double)p + 4);
    }
    test_report(&bias);
}

static void test_fresnel(void) {
    test_bound ulp = bound_of("ggx_fresnel", "ulp"), most = bound_of("ggx_fresnel_max", "abs");
    test_bound half = bound_of("ggx_cos_half", "abs");
    int i;
    for (i = 0; i < test_few(100000); i++) {
        float f0 = float_of(pick(5) ? uniform() : pick(3) ? 0.04 : 1), c = float_of(uniform());
        double ci, fine = 1 - (double)c, wanted = (double)f0 + (1 - (double)f0) * pow(fine, 5), sup;
        vec n = random_direction(), wi = incidence(n, &ci), wo = towards(n, perpendicular(n), acos(uniform())), mirror;
        lobe_vec3 fi, fo;
        float got;
        begin();
        record((double)f0);
        record((double)c);
        record_vector(narrow(n));
        record_vector(narrow(wi));
        within(&ulp, (double)ggx_fresnel(f0, c), wanted, test_ulp(wanted));
        that(ggx_fresnel(f0, 1 + 100 * c) == f0 && ggx_fresnel(f0, -c) == ggx_fresnel(f0, 0),
             "a cosine counts as 0 to 1");
        if (pick(2)) { /* on the far side, in the plane of incidence, near the horizon */
            mirror = unit(combine(1, n, -1 / fmax(ci, 1e-9), wi));
            wo = unit(combine(log_uniform(1e-9, 1), n, 1, mirror));
        }
        fi = narrow(wi);
        fo = narrow(wo);
        got = ggx_fresnel_max(f0, lobe_dot(fi, narrow(n)));
        within(&half, (double)ggx_cos_half(fi, fo), length(add(wide(fi), wide(fo))) / 2, 1);
        that(got >= ggx_fresnel(f0, ggx_cos_half(fi, fo)), "no Fresnel factor is above the largest");
        sup = 1 - sqrt((1 - sqrt((1 - ci) * (1 + ci))) / 2);
        sup = (double)f0 + (1 - (double)f0) * pow(sup, 5);
        within(&most, (double)got, sup, 1);
        that((double)got >= sup - 1e-7, "the largest Fresnel factor is the supremum");
        that(got <= 1, "no Fresnel factor is above 1");
    }
    test_report(&ulp);
    test_report(&most);
}

enum { LIGHTS = 32, SEEDS = 45000, PIXELS = 6 };
static const char *const pixel_names[PIXELS] = {"in the lobes, near", "in the lobes, far", "off the lobes",
                                                "at the horizon",     "very far",          "below the horizon"};

/* Lights around the origin with the normal up, lit from the left */
static light patch_light(int i) {
    light l = draw_light(1, 1);
    l.position = narrow(of(0.5 * uniform() - 0.25, 0.5 * uniform() - 0.25, 0));
    l.normal = lobe_vector(0, 0, 1);
    l.wi = narrow(unit(of(-1, 0.2 * uniform() - 0.1, 0.8)));
    l.alpha_x = float_of(i % 2 ? 0.05 : 0.4);
    l.alpha_y = l.alpha_x;
    l.flux = float_of(log_uniform(0.01, 0.1));
    l.fresnel = 1;
    l.delta = 0.05f;
    widen(&l);
    return l;
}

static void test_unbiased(void) {
    static const double places[PIXELS][3] = {{1.2, 0, 1},      {12, 0.1, 9.6}, {-1, 1, 2},
                                             {3, 0.5, 0.0625}, {70, 2, 50},    {1, 0, -0.5}};
    light lights[LIGHTS];
    double mean[PIXELS] = {0}, variance[PIXELS] = {0}, truth[PIXELS] = {0}, clamped[PIXELS] = {0};
    long shaded = 0;
    int i, j, seed;
    for (i = 0; i < LIGHTS; i++) {
        lights[i] = patch_light(i);
        for (j = 0; j < PIXELS; j++) {
            vec offset = combine(1, of(places[j][0], places[j][1], places[j][2]), -1, lights[i].q);
            double squared = dot(offset, offset), a = (double)lights[i].alpha_x;
            double radiance = (double)lights[i].flux / squared *
                              exact_brdf_cos(lights[i].n, lights[i].t, lights[i].i, unit(offset), a, a, CORRELATED);
            truth[j] += radiance;
            /* delta as often as its mean takes, else 0 */
            variance[j] += radiance * fmax((double)lights[i].delta - radiance, 0);
            if (radiance > 0.1 * (double)lights[i].delta) clamped[j] += radiance; /* a range for good */
        }
    }
    for (seed = 0; seed < SEEDS; seed++) {
        double sum[PIXELS] = {0};
        for (i = 0; i < LIGHTS; i++) {
            light l = lights[i];
            ggx_ellipsoid e;
            l.xi = ggx_xi((unsigned)(4294967296.0 * uniform()));
            e = volume_of(&l, ELLIPSOID);
            for (j = 0; j < PIXELS; j++) {
                lobe_vec3 p = lobe_vector((float)places[j][0], (float)places[j][1], (float)places[j][2]), offset;
                float squared, value;
                if (stretched_squared(&e, wide(p)) > 1) continue;
                shaded++;
                offset = lobe_sub(p, l.position);
                squared = lobe_dot(offset, offset);
                value = ggx_brdf_cos(l.normal, l.wi, lobe_scale(offset, 1 / sqrtf(squared)), l.alpha_x);
                sum[j] += (double)ggx_estimate(l.flux * value, squared, l.delta, l.xi);
            }
        }
        for (j = 0; j < PIXELS; j++) mean[j] += sum[j] / SEEDS;
    }
    for (j = 0; j < PIXELS; j++) {
        double error = sqrt(variance[j] / SEEDS);
        test_bound bound = stated(pixel_names[j], 4.5), dark = stated(pixel_names[j], 1);
        begin();
        record(mean[j]);
        record(truth[j]);
        record(error);
        within(&bound, mean[j], truth[j], error + 1e-6 * truth[j] + DBL_MIN);
        that(truth[j] == 0 ? mean[j] == 0 : error < 0.05 * truth[j], "enough seeds to tell a bias");
        test_report(&bound);
        dark.worst = truth[j] > 0 ? 1 - clamped[j] / truth[j] : 0;
        test_report(&dark);
    }
    begin();
    that(clamped[4] < 0.5 * truth[4] && clamped[1] < 0.9 * truth[1], "a fixed range darkens what is far");
    that(shaded < (long)SEEDS * LIGHTS * PIXELS / 3, "most lights are culled");
}

/* ---- normalisation ---- */

typedef struct {
    lobe_vec3 n, t, wi;
    float ax, ay;
    vec i;
} surface;

static double ndf_cosine(const double w[3], const void *context) {
    const surface *s = (const surface *)context;
    vec h = of(w[0], w[1], w[2]);
    return (double)ggx_ndf(narrow(h), s->n, s->ax) * fmax(dot(h, wide(s->n)), 0);
}

static double ndf_cosine_aniso(const double w[3], const void *context) {
    const surface *s = (const surface *)context;
    vec h = of(w[0], w[1], w[2]);
    return (double)ggx_ndf_aniso(narrow(h), s->n, s->t, s->ax, s->ay) * fmax(dot(h, wide(s->n)), 0);
}

static double ndf_seen(const double w[3], const void *context) {
    const surface *s = (const surface *)context;
    vec h = of(w[0], w[1], w[2]);
    return (double)ggx_ndf(narrow(h), s->n, s->ax) * fmax(dot(h, s->i), 0);
}

static double ndf_seen_aniso(const double w[3], const void *context) {
    const surface *s = (const surface *)context;
    vec h = of(w[0], w[1], w[2]);
    return (double)ggx_ndf_aniso(narrow(h), s->n, s->t, s->ax, s->ay) * fmax(dot(h, s->i), 0);
}

static double reflected(const double w[3], const void *context) {
    const surface *s = (const surface *)context;
    return (double)ggx_brdf_cos(s->n, s->wi, narrow(of(w[0], w[1], w[2])), s->ax);
}

static double reflected_unshadowed(const double w[3], const void *context) { /* the weak white furnace */
    const surface *s = (const surface *)context;
    vec o = of(w[0], w[1], w[2]), h = unit(add(s->i, o));
    float c = lobe_dot(s->n, s->wi);
    return (double)(ggx_smith_g1(c, s->ax) * ggx_ndf(narrow(h), s->n, s->ax) / (4 * c));
}

/* Integral over the directions above a surface; panels grow from the width of the NDF */
static double hemisphere(double (*f)(const double w[3], const void *context), const surface *s, double alpha) {
    const reference_gauss rule = reference_gauss_rule();
    const int azimuths = 512;
    double from = 0, to = alpha < 0.2 ? alpha / 2 : 0.1, n[3], u[3], v[3], sum = 0;
    vec normal = unit(wide(s->n));
    int i, j, k;
    n[0] = normal.x;
    n[1] = normal.y;
    n[2] = normal.z;
    reference_frame(n, u, v);
    while (from < PI / 2) {
        for (i = 0; i < REFERENCE_GAUSS_COUNT; i++) {
            double theta = from + (to - from) * 0.5 * (1 + rule.node[i]), ring = 0;
            for (j = 0; j < azimuths; j++) {
                double phi = 2 * PI * (j + 0.5) / azimuths, w[3];
                for (k = 0; k < 3; k++) w[k] = cos(theta) * n[k] + sin(theta) * (cos(phi) * u[k] + sin(phi) * v[k]);
                ring += f(w, s);
            }
            sum += rule.weight[i] * (to - from) * 0.5 * sin(theta) * ring * (2 * PI / azimuths);
        }
        from = to;
        to = fmin(fmin(to * 1.7, to + 0.2), PI / 2);
    }
    return sum;
}

static void test_normalisation(void) {
    test_bound whole = stated("integral of the NDF with the cosine", 1e-5);
    test_bound masked = stated("G1 against its integral, relative", 1e-4);
    test_bound furnace = stated("weak white furnace", 2e-3);
    int i;
    for (i = 0; i < 10; i++) {
        surface s;
        double mirror[3], sum, c = 0.05 + 0.95 * uniform();
        vec n, m;
        s.n = nearly_unit(random_direction());
        n = unit(wide(s.n));
        s.t = nearly_unit(perpendicular(n));
        s.ax = float_of(log_uniform(0.02, 1));
        s.ay = float_of(fmin(1, (double)s.ax * log_uniform(1, 4)));
        s.wi = nearly_unit(towards(n, perpendicular(n), acos(c)));
        s.i = unit(wide(s.wi));
        begin();
        record_vector(s.n);
        record_vector(s.t);
        record_vector(s.wi);
        record((double)s.ax);
        record((double)s.ay);
        sum = hemisphere(ndf_cosine, &s, (double)s.ax);
        within(&whole, sum, 1, 1);
        sum = hemisphere(ndf_cosine_aniso, &s, (double)s.ax);
        within(&whole, sum, 1, 1);
        c = dot(n, s.i);
        sum = hemisphere(ndf_seen, &s, (double)s.ax);
        within(&masked, (double)ggx_smith_g1((float)c, s.ax), c / sum, c / sum);
        sum = hemisphere(ndf_seen_aniso, &s, (double)s.ax);
        within(&masked, (double)ggx_smith_g1_aniso(s.wi, s.n, s.t, s.ax, s.ay), c / sum, c / sum);
        m = combine(2 * c, n, -1, s.i);
        mirror[0] = m.x;
        mirror[1] = m.y;
        mirror[2] = m.z;
        if (s.ax < 0.1f) continue;
        sum =
            reference_sphere_azimuth(reflected_unshadowed, &s, mirror, 30 / ((double)s.ax * (double)s.ax * c * c), 256);
        within(&furnace, sum, 1, 1);
        sum = reference_sphere_azimuth(reflected, &s, mirror, 30 / ((double)s.ax * (double)s.ax * c * c), 256);
        /* what one bounce reflects is least head-on at alpha 1: 1 - ln 2; of these smooth ones, .923 at the corner */
        that(sum <= 1.0001 && sum > 0.306, "reflects no more than arrives");
        if (c > 0.7 && s.ax < 0.2f) that(sum > 0.92, "a smooth surface reflects nearly all");
    }
    test_report(&whole);
    test_report(&masked);
    test_report(&furnace);
}

/* A tangent counts down to .001 of the normal; nearer, any does, whichever is given. */
static void test_tangents_near(void) {
    test_bound same = stated("as the perpendicular tangent", 2e-3);
    int i;
    for (i = 0; i < 20000; i++) {
        lobe_vec3 normal, h, tangent, other, x, y;
        double angle;
        float ax, ay, wanted;
        vec n, t;
        begin();
        record_vector(normal = nearly_unit(random_direction()));
        n = unit(wide(normal));
        t = perpendicular(n);
        ax = (float)record(log_uniform(0.3, 1));
        ay = (float)record(log_uniform(0.3, 1));
        record_vector(h = nearly_unit(towards(n, perpendicular(n), 1.5 * uniform())));
        angle = record(log_uniform(.00105, .1));
        record_vector(tangent = nearly_unit(towards(n, t, angle)));
        wanted = ggx_ndf_aniso(h, normal, narrow(t), ax, ay);
        within(&same, (double)ggx_ndf_aniso(h, normal, tangent, ax, ay), (double)wanted, (double)wanted);
        angle = record(log_uniform(1e-8, .00095));
        record_vector(tangent = nearly_unit(towards(n, t, angle)));
        record_vector(other = nearly_unit(towards(n, perpendicular(n), angle)));
        wanted = ggx_ndf_aniso(h, normal, other, ax, ay);
        within(&same, (double)ggx_ndf_aniso(h, normal, tangent, ax, ay), (double)wanted, (double)wanted);
        lobe_ggx_tangents(normal, tangent, &x, &y);
        that(fabs(length(wide(x)) - 1) < 1e-6 && fabs(dot(wide(x), n)) < 1e-6 &&
                 distance(wide(y), cross(n, wide(x))) < 1e-6,
             "two tangents");
    }
    test_report(&same);
}

/* At the finest roughness, where floats are scarce, against long double */
static void test_sharp(void) {
    test_bound bound = bound_of("ggx_ndf", "angular");
    lobe_vec3 n = {0, 0, 1};
    double naive = 0;
    int i;
    for (i = 0; i < test_few(100000); i++) {
        double x = log_uniform(1e-6, 1e-2);
        lobe_vec3 h = narrow(of(x * 0.6, x * 0.8, sqrt(1 - x * x)));
        long double s2 = (long double)h.x * (long double)h.x + (long double)h.y * (long double)h.y;
        long double base, wanted, a2 = (long double)1e-4f * (long double)1e-4f;
        float c2 = h.z * h.z, short_base = c2 * (1e-8f - 1) + 1;
        base = (a2 * (1 - s2) + s2) / (long double)1;
        wanted = a2 / (3.14159265358979323846L * base * base);
        begin();
        record_vector(h);
        within(&bound, (double)ggx_ndf(h, n, 1e-4f), (double)wanted, (double)wanted * angular(1e-4));
        if (x < 2e-4)
            naive = fmax(naive, fabs((double)(1e-8f / (LOBE_PI * short_base * short_base)) / (double)wanted - 1));
    }
    begin();
    that(naive > 0.1, "the usual form fails where this does not");
    test_report(&bound);
}

/* ---- boxes, half-spaces and tiles ---- */

/* A convex body of up to six faces: points with dot(p, face) <= offset */
typedef struct {
    vec face[6];
    double offset[6];
} body;

static vec covariance_times(const ggx_ellipsoid *e, vec a) {
    vec sum = of(0, 0, 0);
    int k;
    for (k = 0; k < 3; k++) {
        vec axis = wide(e->axis[k]);
        sum = combine(1, sum, (double)e->radius[k] * (double)e->radius[k] * dot(axis, a), axis);
    }
    return sum;
}

/* Where the ellipsoid that grows about its center first meets all of the given faces: false when they are parallel */
static int meet(const ggx_ellipsoid *e, const body *b, const int *faces, int count, vec *p) {
    double m[3][4];
    int i, j, k;
    for (i = 0; i < count; i++) {
        for (j = 0; j < count; j++) m[i][j] = covariance(e, b->face[faces[i]], b->face[faces[j]]);
        m[i][count] = b->offset[faces[i]] - dot(wide(e->center), b->face[faces[i]]);
    }
    for (i = 0; i < count; i++) { /* Gauss and Jordan, with pivots */
        int best = i;
        for (j = i + 1; j < count; j++)
            if (fabs(m[j][i]) > fabs(m[best][i])) best = j;
        for (k = 0; k <= count; k++) {
            double swap = m[i][k];
            m[i][k] = m[best][k];
            m[best][k] = swap;
        }
        if (fabs(m[i][i]) < 1e-12 * covariance(e, b->face[faces[i]], b->face[faces[i]])) return 0;
        for (j = 0; j < count; j++) {
            double factor = m[j][i] / m[i][i];
            if (j == i) continue;
            for (k = i; k <= count; k++) m[j][k] -= factor * m[i][k];
        }
    }
    *p = wide(e->center);
    for (i = 0; i < count; i++) *p = combine(1, *p, m[i][count] / m[i][i], covariance_times(e, b->face[faces[i]]));
    return 1;
}

static int inside_body(const body *b, vec p, double slack) {
    int k;
    for (k = 0; k < 6; k++)
        if (dot(b->face[k], p) > b->offset[k] + slack) return 0;
    return 1;
}

/* The least stretched squared distance of the body from the ellipsoid's center: at 1 they touch. All sets of faces. */
static double body_distance(const ggx_ellipsoid *e, const body *b, double slack) {
    double least = DBL_MAX;
    int f[3], count;
    vec p = wide(e->center);
    if (inside_body(b, p, 0)) return 0;
    for (f[0] = 0; f[0] < 6; f[0]++)
        for (f[1] = f[0]; f[1] < 6; f[1]++)
            for (f[2] = f[1]; f[2] < 6; f[2]++) {
                if (f[1] == f[0] && f[2] != f[1]) continue;
                count = f[1] == f[0] ? 1 : f[2] == f[1] ? 2 : 3;
                if (!meet(e, b, f, count, &p) || !inside_body(b, p, slack)) continue;
                least = fmin(least, stretched_squared(e, p));
            }
    return least;
}

static double component(vec v, int k) {
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
}

static vec unit_axis(int k) {
    return of(k == 0, k == 1, k == 2);
}

static body box_body(lobe_vec3 center, lobe_vec3 half) {
    body b;
    int k;
    for (k = 0; k < 3; k++) {
        b.face[2 * k] = unit_axis(k);
        b.face[2 * k + 1] = combine(-1, unit_axis(k), 0, unit_axis(k));
        b.offset[2 * k] = component(wide(center), k) + component(wide(half), k);
        b.offset[2 * k + 1] = component(wide(half), k) - component(wide(center), k);
    }
    return b;
}

/* x/z and y/z within the tile, z within the depths */
static body tile_body(ggx_tile t, double depth0, double depth1) {
    body b;
    b.face[0] = of(1, 0, -(double)t.right);
    b.face[1] = of(-1, 0, (double)t.left);
    b.face[2] = of(0, 1, -(double)t.top);
    b.face[3] = of(0, -1, (double)t.bottom);
    b.face[4] = of(0, 0, 1);
    b.face[5] = of(0, 0, -1);
    b.offset[0] = b.offset[1] = b.offset[2] = b.offset[3] = 0;
    b.offset[4] = depth1;
    b.offset[5] = -depth0;
    return b;
}

/* Moves an ellipsoid so that it touches a body from outside, at a point of its surface where the given faces meet */
static void touch(ggx_ellipsoid *e, const body *b, vec p, const int *faces, int count) {
    vec inward = of(0, 0, 0), step;
    int i;
    for (i = 0; i < count; i++) inward = combine(1, inward, -uniform(), b->face[faces[i]]);
    if (length(inward) < 1e-9) inward = random_direction();
    step = covariance_times(e, inward);
    e->center = narrow(combine(1, p, -(1 - log_uniform(1e-9, 1e-5)) / sqrt(covariance(e, inward, inward)), step));
}

static void test_boxes(void) {
    test_bound extent = bound_of("ggx_ellipsoid_reach", "extent");
    test_bound slack = bound_of("ggx_ellipsoid_hits_half_space", "slack");
    long touching = 0;
    int i, k;
    for (i = 0; i < test_few(200000); i++) { /* what touches must be found */
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-4);
        double away = pick(2) ? log_uniform(1, 1e4) : 0, size = (double)e.radius[0] * log_uniform(1e-3, 1e3);
        lobe_vec3 center = narrow(combine(away, random_direction(), 0, random_direction()));
        lobe_vec3 half = narrow(of(size * uniform(), size * uniform(), size * uniform()));
        body b = box_body(center, half);
        int faces[3], count = 0;
        double side[3];
        vec p;
        for (k = 0; k < 3; k++) {
            int face = pick(3);
            side[k] = face == 0 ? -1 : face == 1 ? 1 : 2 * uniform() - 1;
            if (face < 2) faces[count++] = 2 * k + (face == 0);
        }
        p = of(component(wide(center), 0) + side[0] * component(wide(half), 0),
               component(wide(center), 1) + side[1] * component(wide(half), 1),
               component(wide(center), 2) + side[2] * component(wide(half), 2));
        touch(&e, &b, p, faces, count);
        record_ellipsoid(&e);
        record_vector(center);
        record_vector(half);
        if (stretched_squared(&e, p) <= 1) {
            lobe_vec3 normal = narrow(combine(log_uniform(1e-3, 1e3), random_direction(), 0, p));
            vec wn = wide(normal);
            double reach = sqrt(covariance(&e, wn, wn)), at = dot(wide(e.center), wn), offset, scale;
            touching++;
            that(ggx_ellipsoid_hits_box(e, center, half), "a box that the ellipsoid touches is hit");
            within(&extent, (double)ggx_ellipsoid_reach(e, normal), reach,
                   TEST_EPSILON * (double)e.radius[0] * length(wn));
            scale = TEST_EPSILON * length(wn) * (length(wide(e.center)) + (double)e.radius[0]);
            offset = (double)float_of(at + reach - 0x1p-23 * (fabs(at) + fabs(reach)));
            if (offset <= at + reach)
                that(ggx_ellipsoid_hits_half_space(e, normal, (float)offset), "a half-space that is touched is hit");
            offset = (double)float_of(at + reach + slack.limit * scale);
            if (offset > at + reach + slack.limit * scale)
                that(!ggx_ellipsoid_hits_half_space(e, normal, (float)offset), "a half-space apart is not hit");
        }
    }
    begin();
    that(touching > test_few(50000), "enough boxes touch");
    test_report(&extent);
}

/* A share of what was drawn, less 4.5 standard errors: what chance adds to it in one draw out of 300000 */
static double share(long part, long whole) {
    double p = (double)part / (double)whole;
    return p - 4.5 * sqrt(p * (1 - p) / (double)whole);
}

/* Whichever radius is the longest; and a half-space across the thin side of one at 0, where only its radius tells what
   rounding takes. */
static void test_thin_ellipsoids(void) {
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-5);
        float longest = e.radius[0], swap;
        vec normal, axis;
        double reach, offset;
        int across = 1 + pick(2);
        k = pick(3);
        swap = e.radius[k];
        e.radius[k] = e.radius[0];
        e.radius[0] = swap;
        record_ellipsoid(&e);
        that(ggx_bound_enclosing(e).radius >= longest && ggx_bound_enclosing(e).radius <= longest * 1.00001f,
             "the enclosing sphere has the longest radius");
        axis = wide(e.axis[(k + across) % 3]);
        normal = wide(narrow(unit(combine(1, axis, 1e-6 * uniform(), wide(e.axis[k])))));
        record_vector(narrow(normal));
        reach = sqrt(covariance(&e, normal, normal));
        offset = (double)float_of(reach * (1 - 0x1p-23));
        that(ggx_ellipsoid_hits_half_space(e, narrow(normal), (float)offset), "a half-space across the thin side");
    }
}

/* A box beside the ellipsoid's own bounding box is not hit, by more than the growth that covers rounding. */
static void test_boxes_beside(void) {
    int i, k;
    for (i = 0; i < 50000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-4);
        double size = (double)e.radius[0], center[3], half[3], extent[3], reach = 0;
        int beside = pick(3);
        e.center = narrow(combine(3 * size * uniform(), random_direction(), 0, random_direction()));
        for (k = 0; k < 3; k++) {
            vec axis = of(k == 0, k == 1, k == 2);
            extent[k] = sqrt(covariance(&e, axis, axis));
            half[k] = (double)float_of(size * log_uniform(1e-3, 10));
            reach += extent[k] + half[k];
        }
        for (k = 0; k < 3; k++) {
            double away = k == beside ? (pick(2) ? 1 : -1) * (extent[k] + half[k] + 1e-5 * (reach + 2 * size))
                                      : (2 * uniform() - 1) * (extent[k] + half[k]);
            center[k] = component(wide(e.center), k) + away;
        }
        record_ellipsoid(&e);
        record_vector(narrow(of(center[0], center[1], center[2])));
        record_vector(narrow(of(half[0], half[1], half[2])));
        that(!ggx_ellipsoid_hits_box(e, narrow(of(center[0], center[1], center[2])),
                                     narrow(of(half[0], half[1], half[2]))),
             "a box beside the bounding box is not hit");
    }
}

static void test_boxes_near(void) {
    test_bound false_hits = bound_of("ggx_ellipsoid_hits_box", "false_hits");
    long apart = 0, told = 0;
    int i, k;
    for (i = 0; i < test_few(100000); i++) {
        ggx_ellipsoid e = random_ellipsoid(1, 0.03);
        lobe_vec3 half = narrow(of(log_uniform(0.02, 1), log_uniform(0.02, 1), log_uniform(0.02, 1)));
        lobe_vec3 center;
        double off[3], exact;
        body b;
        for (k = 0; k < 3; k++) { /* so that the boxes around both meet */
            off[k] =
                (2 * uniform() - 1) * (sqrt(covariance(&e, unit_axis(k), unit_axis(k))) + component(wide(half), k));
        }
        center = narrow(of(off[0], off[1], off[2]));
        b = box_body(center, half);
        exact = body_distance(&e, &b, 1e-9);
        record_ellipsoid(&e);
        record_vector(center);
        record_vector(half);
        if (exact <= 1)
            that(ggx_ellipsoid_hits_box(e, center, half), "a box that the ellipsoid meets is hit");
        else {
            apart++;
            told += ggx_ellipsoid_hits_box(e, center, half);
        }
    }
    begin();
    within(&false_hits, share(told, apart), 0, 1);
    test_report(&false_hits);
}

/* A camera that looks anywhere from anywhere: what was inside is inside of the turned ellipsoid */
static void test_transform(void) {
    test_bound growth = stated("what an ellipsoid grows by as it is turned", 9);
    int i, k;
    for (i = 0; i < test_few(200000); i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-4), turned;
        double size;
        vec u = random_direction(), v = perpendicular(u), p, offset;
        lobe_vec3 view[3], eye = narrow(combine(log_uniform(1e-2, 1e4), random_direction(), 0, u));
        view[0] = narrow(u);
        view[1] = narrow(v);
        view[2] = narrow(cross(u, v));
        e.center = narrow(combine(log_uniform(1e-2, 1e4), random_direction(), 0, u));
        p = wide(e.center);
        u = random_direction();
        for (k = 0; k < 3; k++) p = combine(1, p, (1 - 1e-9) * (double)e.radius[k] * component(u, k), wide(e.axis[k]));
        offset = combine(1, p, -1, wide(eye));
        turned = ggx_ellipsoid_transform(e, view, eye);
        record_ellipsoid(&e);
        for (k = 0; k < 3; k++) record_vector(view[k]);
        record_vector(eye);
        if (stretched_squared(&e, p) > 1) continue;
        p = wide(narrow(of(dot(wide(view[0]), offset), dot(wide(view[1]), offset), dot(wide(view[2]), offset))));
        that(stretched_squared(&turned, p) <= 1, "what is in an ellipsoid is in the turned one");
        size = TEST_EPSILON * (extent_of(wide(turned.center)) + extent_of(wide(e.center)) + (double)e.radius[0]);
        if (size > 100 * TEST_EPSILON * least_radius(&e) && size < 0.1 * least_radius(&e)) {
            within(&growth, least_radius(&turned), least_radius(&e), size);
            that(least_radius(&turned) - least_radius(&e) > 7.5 * size, "grows by all coordinates");
        }
    }
    test_report(&growth);
}

static ggx_tile random_tile(void) {
    ggx_tile t;
    double x = 2 * uniform() - 1, y = 2 * uniform() - 1, size = log_uniform(0.01, 0.3);
    t.left = float_of(x);
    t.right = float_of(x + size);
    t.bottom = float_of(y);
    t.top = float_of(y + size);
    return t;
}

static void record_tile(ggx_tile t, float depth0, float depth1) {
    record((double)t.left);
    record((double)t.right);
    record((double)t.bottom);
    record((double)t.top);
    record((double)depth0);
    record((double)depth1);
}

static void test_tiles(void) {
    long touching = 0;
    int i;
    for (i = 0; i < test_few(200000); i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e3), 1e-3);
        ggx_tile t = random_tile();
        float depth0 = pick(8) ? float_of(log_uniform(1e-2, 1e3)) : 0;
        float depth1 = depth0 * (1 + float_of(log_uniform(1e-5, 10))) + (depth0 > 0 ? 0 : 1);
        body b = tile_body(t, (double)depth0, (double)depth1);
        int faces[3], count = 0, sx = pick(3), sy = pick(3), sz = pick(3), hit;
        float half_depth = depth0 + 0.5f * (depth1 - depth0), near_depth[2], far_depth[2];
        double x = sx == 0 ? (double)t.left : sx == 1 ? (double)t.right : 0, y, z;
        vec p;
        if (sx == 2) x = (double)t.left + uniform() * ((double)t.right - (double)t.left);
        y = sy == 0   ? (double)t.bottom
            : sy == 1 ? (double)t.top
                      : (double)t.bottom + uniform() * ((double)t.top - (double)t.bottom);
        z = sz == 0   ? (double)depth0
            : sz == 1 ? (double)depth1
                      : (double)depth0 + uniform() * ((double)depth1 - (double)depth0);
        if (sx < 2) faces[count++] = sx == 0;
        if (sy < 2) faces[count++] = 2 + (sy == 0);
        if (sz < 2) faces[count++] = 4 + (sz == 0);
        if (sx < 2) faces[0] = sx == 0 ? 1 : 0;
        p = of(x * z, y * z, z);
        touch(&e, &b, p, faces, count);
        record_ellipsoid(&e);
        record_tile(t, depth0, depth1);
        if (stretched_squared(&e, p) > 1) continue;
        touching++;
        that(ggx_stretched_hits_tile(ggx_stretch_ellipsoid(e), t, depth0, depth1), "a tile that is touched is hit");
        that(ggx_stretched_hits_frustum(ggx_stretch_ellipsoid(e), t, depth0, depth1),
             "a frustum that is touched is hit");
        that(ggx_ellipsoid_hits_sides(e, t), "the sides of a tile that is touched are hit");
        near_depth[0] = depth0;
        near_depth[1] = half_depth;
        far_depth[0] = half_depth;
        far_depth[1] = depth1;
        hit = ggx_stretched_hits_clusters(ggx_stretch_ellipsoid(e), t, near_depth, far_depth);
        that(z <= (double)half_depth ? hit & 1 : hit & 2, "a cluster that is touched is hit");
        far_depth[0] = depth1;
        far_depth[1] = half_depth;
        if (depth1 > half_depth)
            that(!(ggx_stretched_hits_clusters(ggx_stretch_ellipsoid(e), t, near_depth, far_depth) & 2),
                 "an empty cluster is not hit");
    }
    begin();
    that(touching > test_few(50000), "enough tiles are touched");
}

/* Those near the ellipsoid, by chance */
static void test_tiles_near(void) {
    test_bound false_hits = bound_of("ggx_stretched_hits_tile", "false_hits");
    test_bound both_hit = bound_of("ggx_ellipsoid_hits_sides", "false_hits");
    test_bound closer = bound_of("ggx_stretched_hits_frustum", "false_hits");
    long apart = 0, hits = 0, apart_by_both = 0, hits_both = 0, apart_closer = 0, hits_closer = 0;
    int i;
    for (i = 0; i < test_few(100000); i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(0.1, 3), 0.03);
        ggx_tile t = random_tile();
        float depth0 = float_of(log_uniform(0.5, 5)), depth1 = depth0 * (1 + float_of(log_uniform(1e-2, 1)));
        body b = tile_body(t, (double)depth0, (double)depth1);
        double z = (double)depth0 + uniform() * ((double)depth1 - (double)depth0), exact;
        int hit, close;
        e.center = narrow(combine(z, of((double)t.left, (double)t.top, 1), (double)e.radius[0] * 1.5 * cbrt(uniform()),
                                  random_direction()));
        exact = body_distance(&e, &b, 1e-9);
        hit = ggx_stretched_hits_tile(ggx_stretch_ellipsoid(e), t, depth0, depth1);
        record_ellipsoid(&e);
        record_tile(t, depth0, depth1);
        if (exact <= 1) that(hit, "a tile that the ellipsoid meets is hit");
        hits += hit;
        apart += hit && exact > 1;
        hit = hit && ggx_ellipsoid_hits_sides(e, t);
        if (exact <= 1) that(hit, "the sides of a tile that the ellipsoid meets are hit");
        hits_both += hit;
        apart_by_both += hit && exact > 1;
        close = hit && ggx_stretched_hits_frustum(ggx_stretch_ellipsoid(e), t, depth0, depth1);
        if (exact <= 1) that(close, "a frustum that the ellipsoid meets is hit");
        hits_closer += close;
        apart_closer += close && exact > 1;
    }
    begin();
    within(&false_hits, share(apart, hits), 0, 1);
    within(&both_hit, share(apart_by_both, hits_both), 0, 1);
    within(&closer, share(apart_closer, hits_closer), 0, 1);
    test_report(&false_hits);
    test_report(&both_hit);
    test_report(&closer);
}

/* A light far from the camera and all but a point: the tile that it lies in is hit, whatever rounding takes from terms
   that are many times its radius. */
static void test_tiles_far(void) {
    int i;
    for (i = 0; i < 50000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-7, 1e-2), 1e-3);
        double depth = log_uniform(1, 1e5), size = depth * 1e-7;
        ggx_tile t;
        ggx_stretched s;
        float depth0, depth1;
        vec c;
        e.center = narrow(of(depth * (pick(2) ? 1 : -1) * log_uniform(1e-3, 10),
                             depth * (pick(2) ? 1 : -1) * log_uniform(1e-3, 10), depth));
        c = wide(e.center);
        t.left = float_of(c.x / c.z - log_uniform(1e-7, 1e-3) * (1 + fabs(c.x / c.z)));
        t.right = float_of(c.x / c.z + log_uniform(1e-7, 1e-3) * (1 + fabs(c.x / c.z)));
        t.bottom = float_of(c.y / c.z - log_uniform(1e-7, 1e-3) * (1 + fabs(c.y / c.z)));
        t.top = float_of(c.y / c.z + log_uniform(1e-7, 1e-3) * (1 + fabs(c.y / c.z)));
        depth0 = float_of(depth - log_uniform(1, 1e3) * size);
        depth1 = float_of(depth + log_uniform(1, 1e3) * size);
        record_ellipsoid(&e);
        record_tile(t, depth0, depth1);
        s = ggx_stretch_ellipsoid(e);
        that(ggx_stretched_hits_tile(s, t, depth0, depth1), "the tile of a far light is hit");
        that(ggx_stretched_hits_frustum(s, t, depth0, depth1), "the frustum of a far light is hit");
        that(ggx_ellipsoid_hits_sides(e, t), "the sides of a far light's tile are hit");
        {
            double x = s.swapped ? c.y : c.x, y = s.swapped ? c.x : c.y, terms;
            terms = fabs((double)s.xx * x) + fabs((double)s.xy * y) + fabs((double)s.yy * y) +
                    fabs((double)s.xz * c.z) + fabs((double)s.yz * c.z) + fabs((double)s.zz * c.z);
            that(fabs((double)s.size / terms - 1) < 1e-5, "the size of the center's terms");
        }
    }
}

/* The sphere of the stretched space grows by all of its terms, and by no more; along depth, that is what a tile's test
   and a frustum's do. */
static void test_stretched_radius(void) {
    test_bound growth = bound_of("lobe_ggx_stretched_radius", "growth");
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-4, 1), 1e-2);
        ggx_tile t;
        ggx_stretched s;
        float depth = float_of(log_uniform(1e2, 1e5));
        double most = 0, got;
        t.left = float_of(2 * uniform() - 1);
        t.right = float_of(2 * uniform() - 1);
        t.bottom = float_of(2 * uniform() - 1);
        t.top = float_of(2 * uniform() - 1);
        e.center = narrow(combine(log_uniform(1e2, 1e5), random_direction(), 0, random_direction()));
        s = ggx_stretch_ellipsoid(e);
        t = lobe_ggx_swap(s, t);
        record_ellipsoid(&e);
        record_tile(t, 0, depth);
        for (k = 0; k < 4; k++) {
            double x = (double)(k & 1 ? t.left : t.right), y = (double)(k & 2 ? t.bottom : t.top);
            double terms = fabs((double)s.xx * x) + fabs((double)s.xy * y) + fabs((double)s.yy * y) +
                           fabs((double)s.xz) + fabs((double)s.yz) + fabs((double)s.zz);
            if (terms > most) most = terms;
        }
        got = (double)lobe_ggx_stretched_radius(s, t, depth) - 1;
        most = TEST_EPSILON * ((double)s.size + (double)depth * most);
        within(&growth, got, 1e-5, most + 2 * TEST_EPSILON);
        that(got >= 1e-5 + 31.9 * most - 2 * TEST_EPSILON, "the sphere grows by all terms");
    }
    test_report(&growth);
}

/* A sphere before or behind a tile, where it is touched along depth, and a little further */
static void test_tiles_in_depth(void) {
    int i;
    for (i = 0; i < 20000; i++) {
        float r = float_of(log_uniform(1e-2, 1)), depth0 = float_of(log_uniform(1, 10)), at;
        float depth1 = float_of((double)depth0 * log_uniform(1.01, 10));
        ggx_sphere ball;
        ggx_ellipsoid e;
        ggx_stretched s;
        ggx_tile t;
        int before = pick(2), k;
        t.left = t.bottom = -1;
        t.right = t.top = 1;
        ball.radius = r;
        for (k = 0; k < 2; k++) {
            double gap = (double)r * (k ? 1.0001 : 1) + (k ? 4e-6 : -1e-7) * 4 * (double)(depth1 + r);
            at = float_of(before ? (double)depth0 - gap : (double)depth1 + gap);
            ball.center = lobe_vector(0, 0, at);
            e = ggx_ellipsoid_of_sphere(ball);
            s = ggx_stretch_ellipsoid(e);
            record_ellipsoid(&e);
            record_tile(t, depth0, depth1);
            that(ggx_stretched_hits_tile(s, t, depth0, depth1) == !k, "a tile is hit in depth as far as stated");
            that(ggx_stretched_hits_frustum(s, t, depth0, depth1) == !k, "a frustum is hit in depth as far as stated");
        }
    }
}

/* The stretched distance's gradient, with the least radius as unit */
static void test_gradient(void) {
    test_bound error = stated("gradient, of its length at most", 1e-5);
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_ellipsoid e = random_ellipsoid(log_uniform(1e-2, 1e4), 1e-2);
        lobe_vec3 at = narrow(combine(1, random_direction(), 0, unit_axis(0)));
        vec wanted = of(0, 0, 0), got;
        float swap = e.radius[0];
        k = pick(3);
        e.radius[0] = e.radius[k];
        e.radius[k] = swap;
        for (k = 0; k < 3; k++) {
            double share = least_radius(&e) / (double)e.radius[k];
            wanted = combine(1, wanted, share * share * dot(wide(e.axis[k]), wide(at)), wide(e.axis[k]));
        }
        got = wide(lobe_ggx_gradient(lobe_ggx_metric_of(e), at));
        record_ellipsoid(&e);
        record_vector(at);
        within(&error, distance(got, wanted), 0, 1);
    }
    test_report(&error);
}

/* A sphere beside a box, where growth alone tells: by 2^-20 of distance, size and radius, whichever is the largest */
static void test_boxes_grow(void) {
    test_bound growth = bound_of("ggx_ellipsoid_hits_box", "growth");
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_sphere ball;
        double h = log_uniform(1, 1e3), across = log_uniform(1, 1e3), r = log_uniform(1, 1e3), low, high, unit;
        int along = pick(3), sign = pick(2) ? 1 : -1;
        lobe_vec3 half = narrow(combine(h, unit_axis(along), across, unit_axis((along + 1) % 3)));
        ball.radius = float_of(r);
        r = (double)ball.radius;
        h = component(wide(half), along);
        across = component(wide(half), (along + 1) % 3);
        ball.center = lobe_vector(0, 0, 0);
        low = h + r;
        high = low * 1.001;
        begin();
        record_vector(half);
        record(r);
        for (k = 0; k < 24; k++) {
            double middle = (low + high) / 2;
            if (ggx_ellipsoid_hits_box(ggx_ellipsoid_of_sphere(ball),
                                       narrow(combine(sign * middle, unit_axis(along), 0, unit_axis(0))), half))
                low = middle;
            else
                high = middle;
        }
        unit = TEST_EPSILON * (low + fmax(h, across) + r);
        within(&growth, low, h + r, unit);
        that(low >= h + r + 14.5 * unit, "a box grows as stated");
    }
    test_report(&growth);
}

/* The same of a half-space beside a sphere */
static void test_half_spaces_grow(void) {
    test_bound growth = bound_of("ggx_ellipsoid_hits_half_space", "growth");
    int i, k;
    for (i = 0; i < 20000; i++) {
        ggx_sphere ball;
        lobe_vec3 normal = narrow(combine(log_uniform(1e-3, 1e3), random_direction(), 0, unit_axis(0)));
        vec n = wide(normal);
        double low, high, start, terms;
        ball.radius = float_of(log_uniform(1e-3, 1e3));
        ball.center = narrow(combine(log_uniform(1e-3, 1e3), random_direction(), 0, n));
        start = low = dot(wide(ball.center), n) + (double)ball.radius * length(n);
        terms =
            (extent_of(wide(ball.center)) + (double)ball.radius) * (fabs(n.x) + fabs(n.y) + fabs(n.z)) + fabs(start);
        high = low + 100 * TEST_EPSILON * terms;
        begin();
        record_vector(normal);
        record_vector(ball.center);
        record((double)ball.radius);
        for (k = 0; k < 24; k++) {
            double middle = (low + high) / 2;
            if (ggx_ellipsoid_hits_half_space(ggx_ellipsoid_of_sphere(ball), normal, float_of(middle)))
                low = middle;
            else
                high = middle;
        }
        within(&growth, low, start, TEST_EPSILON * terms);
        that(low - start >= 6.5 * TEST_EPSILON * terms, "a half-space is hit as far as stated");
    }
    test_report(&growth);
}

/* A horizon across depth, across the image's axes, and a light far aside: the tile is kept as far as stated. */
static void test_horizons_grow(void) {
    test_bound growth = bound_of("ggx_tile_above", "growth");
    int i, k;
    for (i = 0; i < 20000; i++) {
        float depth = float_of(log_uniform(1, 1e3)), x = float_of(log_uniform(1e-2, 10)),
              y = float_of(log_uniform(1e-2, 10));
        lobe_vec3 normal = nearly_unit(random_direction()), place;
        vec n = wide(normal),
            corner = of((double)depth * (double)x * (n.x > 0 ? 1 : -1), (double)depth * (double)y * (n.y > 0 ? 1 : -1),
                        (double)depth),
            aside;
        double low = -1e-7, high, size, terms;
        ggx_tile t;
        t.right = x;
        t.left = -x;
        t.top = y;
        t.bottom = -y;
        aside = combine((double)depth * log_uniform(1e-2, 10), perpendicular(unit(n)), 1, corner);
        terms = fabs(aside.x) + fabs(aside.y) + fabs(aside.z);
        terms += fabs(corner.x * n.x) + fabs(corner.y * n.y) + fabs(corner.z * n.z);
        size = TEST_EPSILON * terms;
        high = 100 * size;
        begin();
        record_vector(normal);
        record_vector(narrow(aside));
        record_tile(t, depth, depth);
        for (k = 0; k < 24; k++) {
            double middle = (low + high) / 2;
            place = narrow(combine(middle, n, 1, aside));
            if (ggx_tile_above(place, normal, t, depth, depth))
                low = middle;
            else
                high = middle;
        }
        within(&growth, low, 0, size);
        that(low >= 14 * size, "a tile below the horizon by less than stated");
    }
    test_report(&growth);
}

/* A horizon through a tile's corner far away, and nearly across one axis of the image: the tile is kept. */
static void test_horizons_far(void) {
    int i;
    for (i = 0; i < 50000; i++) {
        float depth = float_of(log_uniform(1, 1e5)), x = float_of(log_uniform(1e-3, 10)),
              y = float_of(log_uniform(1e-3, 10));
        vec corner = of((double)depth * (double)x, (double)depth * (double)y, (double)depth), axis;
        ggx_tile t;
        lobe_vec3 normal, place;
        t.left = t.bottom = 0;
        t.right = x;
        t.top = y;
        axis = pick(2) ? of(1, 0, 0) : of(0, 1, 0);
        normal = nearly_unit(combine(1, axis, log_uniform(1e-6, 1), random_direction()));
        if (normal.x < 0 || normal.y < 0) continue; /* the corner is not the highest */
        place = narrow(combine(1, corner, 1e-4 * (double)depth * uniform(), perpendicular(wide(normal))));
        begin();
        record_vector(normal);
        record_vector(place);
        record_tile(t, depth, depth);
        if (dot(wide(normal), combine(1, corner, -1, wide(place))) >= 0)
            that(ggx_tile_above(place, normal, t, depth, depth), "a corner above a horizon far away");
    }
}

static void test_tile_above(void) {
    test_bound above = bound_of("ggx_tile_above", "slack");
    int i;
    for (i = 0; i < test_few(100000); i++) {
        ggx_tile t = random_tile();
        float depth0 = float_of(log_uniform(0.01, 100)), depth1 = depth0 * (1 + float_of(log_uniform(1e-3, 10)));
        lobe_vec3 n = nearly_unit(random_direction()), q;
        double best = -DBL_MAX, scale;
        int k, got;
        vec corner;
        q = narrow(of((double)depth1 * (2 * uniform() - 1), (double)depth1 * (2 * uniform() - 1),
                      (double)depth1 * uniform() * 2));
        for (k = 0; k < 8; k++) {
            double z = (double)(k & 1 ? depth0 : depth1);
            corner = of(z * (double)(k & 2 ? t.left : t.right), z * (double)(k & 4 ? t.bottom : t.top), z);
            if (i % 2 && pick(8) == 0) q = narrow(combine(1, corner, log_uniform(1e-3, 1), perpendicular(wide(n))));
        }
        for (k = 0; k < 8; k++) {
            double z = (double)(k & 1 ? depth0 : depth1);
            corner = of(z * (double)(k & 2 ? t.left : t.right), z * (double)(k & 4 ? t.bottom : t.top), z);
            best = fmax(best, dot(wide(n), combine(1, corner, -1, wide(q))));
        }
        begin();
        record_vector(q);
        record_vector(n);
        record_tile(t, depth0, depth1);
        got = ggx_tile_above(q, n, t, depth0, depth1);
        scale = TEST_EPSILON * (length(wide(q)) + 2.5 * (double)depth1);
        if (best >= 0) that(got, "a tile above the horizon is kept");
        if (best < -above.limit * scale) that(!got, "a tile below the horizon is not");
    }
}

/* ---- edges ---- */

static float wild(int low, int high) { /* any float of those exponents, sometimes 0 */
    if (pick(16) == 0) return 0;
    return float_of(ldexp(1 + uniform(), low + pick(high - low)));
}

static lobe_vec3 wild_axis(lobe_vec3 other) {
    int kind = pick(7);
    if (kind == 0) return other;
    if (kind == 1) return lobe_scale(other, -1);
    if (kind == 2) return narrow(perpendicular(unit(wide(other))));
    if (kind == 3) return narrow(unit_axis(pick(3)));
    if (kind == 4) return narrow(unit(combine(1, wide(other), log_uniform(1e-9, 1e-4), random_direction())));
    return nearly_unit(random_direction());
}

static int finite_vector(lobe_vec3 v) {
    return test_is_finite(v.x) && test_is_finite(v.y) && test_is_finite(v.z);
}

static int finite_ellipsoid(ggx_ellipsoid e) {
    int k, good = finite_vector(e.center);
    for (k = 0; k < 3; k++) {
        double size = length(wide(e.axis[k]));
        good = good && finite_vector(e.axis[k]) && size > 0.999999 && size < 1.000001;
        good = good && test_is_finite(e.radius[k]) && e.radius[k] > 0;
    }
    return good && fabs(dot(wide(e.axis[0]), wide(e.axis[1]))) < 1e-6 &&
           fabs(dot(wide(e.axis[0]), wide(e.axis[2]))) < 1e-6 && fabs(dot(wide(e.axis[1]), wide(e.axis[2]))) < 1e-6;
}

static float wild_sign(float x) {
    return pick(2) ? x : -x;
}

static void test_bound_edges(void) {
    int i, k;
    for (i = 0; i < test_draws(200000); i++) {
        light l;
        ggx_ellipsoid e;
        ggx_stretched s;
        ggx_tile t = random_tile();
        lobe_vec3 view[3], wo;
        float x, depth0 = wild(-30, 16), depth1 = depth0 + wild(-30, 15);
        vec axis = random_direction(), side = perpendicular(axis);
        l.position = lobe_vector(wild_sign(wild(-40, 16)), wild_sign(wild(-40, 16)), wild_sign(wild(-40, 16)));
        l.normal = wild_axis(lobe_vector(0, 1, 0));
        l.tangent = wild_axis(l.normal);
        l.wi = wild_axis(l.normal);
        wo = wild_axis(l.wi);
        l.alpha_x = wild(-140, 4);
        l.alpha_y = wild(-140, 4);
        l.flux = wild(-140, 59);
        l.fresnel = wild(-24, 0);
        l.delta = wild(-59, 20) + 1e-18f;
        l.xi = wild(-140, 0);
        record_light(&l);
        record_vector(wo);
        for (k = 0; k < VOLUMES; k++) {
            e = volume_of(&l, (volume)k);
            that(finite_ellipsoid(e), "a finite ellipsoid with an orthonormal frame");
        }
        e = volume_of(&l, (volume)pick(VOLUMES));
        view[0] = narrow(axis);
        view[1] = narrow(side);
        view[2] = narrow(cross(axis, side));
        e = ggx_ellipsoid_transform(e, view, wild_axis(wo));
        that(finite_ellipsoid(e), "finite ggx_ellipsoid_transform");
        that(finite_ellipsoid(ggx_bound_diffuse_ellipsoid(l.position, l.normal, l.flux, l.fresnel, l.delta, l.xi)) &&
                 test_is_finite(ggx_bound_diffuse(l.position, l.normal, l.flux, l.fresnel, l.delta, l.xi).radius),
             "finite diffuse bounds");
        s = ggx_stretch_ellipsoid(e);
        that(test_is_finite(s.xx) && test_is_finite(s.xy) && test_is_finite(s.xz) && test_is_finite(s.yy) &&
                 test_is_finite(s.yz) && test_is_finite(s.zz) && finite_vector(s.center) && test_is_finite(s.size),
             "finite ggx_stretch_ellipsoid");
        k = ggx_stretched_hits_tile(s, t, depth0, depth1);
        that(k == 0 || k == 1, "ggx_stretched_hits_tile is 0 or 1");
        that(ggx_ellipsoid_hits_box(e, e.center, lobe_vector(0, 0, 0)), "the ellipsoid's center is hit");
        x = ggx_brdf_cos(l.normal, l.wi, wo, l.alpha_x);
        that(test_is_finite(x) && x >= 0, "finite ggx_brdf_cos");
        x = ggx_brdf_cos_separable(l.normal, l.wi, wo, l.alpha_x);
        that(test_is_finite(x) && x >= 0, "finite ggx_brdf_cos_separable");
        x = ggx_brdf_cos_aniso(l.normal, l.tangent, l.wi, wo, l.alpha_x, l.alpha_y);
        that(test_is_finite(x) && x >= 0, "finite ggx_brdf_cos_aniso");
        x = ggx_ndf_aniso(wo, l.normal, l.tangent, l.alpha_x, l.alpha_y) + ggx_ndf(wo, l.normal, l.alpha_y);
        that(test_is_finite(x) && x >= 0, "finite distributions");
        x = ggx_estimate(l.flux, l.fresnel, l.delta, l.xi) + ggx_range(l.flux, l.delta, l.xi);
        that(test_is_finite(x) && x >= 0, "finite ggx_estimate and ggx_range");
    }
}

/* What the header says of single cases */
static void test_special_cases(void) {
    light l = tilted(50, 0.1), m;
    ggx_ellipsoid e, f;
    int k;
    begin();
    m = l; /* alpha 0 is alpha 1e-4, alpha 2 is 1 */
    m.alpha_x = m.alpha_y = 0;
    e = volume_of(&m, ELLIPSOID);
    m.alpha_x = m.alpha_y = 1e-4f;
    f = volume_of(&m, ELLIPSOID);
    that(e.radius[0] == f.radius[0] && e.center.x == f.center.x, "alpha 0 counts as 1e-4");
    that(ggx_ndf(l.normal, l.normal, 0) == ggx_ndf(l.normal, l.normal, 1e-4f), "alpha 0 counts as 1e-4 in the NDF");
    that(ggx_ndf(l.normal, l.normal, 2) == ggx_ndf(l.normal, l.normal, 1), "alpha 2 counts as 1");
    m = l;
    m.xi = 0;
    e = volume_of(&m, SPHEROID);
    m.xi = 0x1p-24f;
    f = volume_of(&m, SPHEROID);
    that(e.radius[0] == f.radius[0] && test_is_finite(e.radius[0]), "xi 0 counts as 2^-24");
    for (k = 0; k < VOLUMES; k++) { /* no light, no volume */
        m = l;
        m.flux = 0;
        e = volume_of(&m, (volume)k);
        that(e.radius[0] < 1e-9f && e.radius[1] < 1e-9f && e.radius[2] < 1e-9f, "no flux, no volume");
        that(least_radius(&e) > 0, "no radius of 0");
        m = l;
        m.wi = lobe_vector(-0.6f, 0, -0.8f);
        e = volume_of(&m, (volume)k);
        that(e.radius[0] < 1e-9f, "lit from below, no volume");
        m.wi = lobe_vector(1, 0, 0);
        e = volume_of(&m, (volume)k);
        that(e.radius[0] > 0.1f && test_is_finite(e.radius[0]), "lit at the horizon, a volume");
        m.wi = lobe_vector(0, 0, 1);
        e = volume_of(&m, (volume)k);
        that(e.radius[0] > 0.1f && test_is_finite(e.radius[0]), "lit head-on, a volume");
        e = volume_of(&l, (volume)k);
        that(stretched_squared(&e, l.q) <= 1, "the light itself is inside");
    }
    that(ggx_brdf_cos(l.normal, l.wi, lobe_vector(1, 0, 0), .1f) == 0, "nothing goes along the horizon");
    that(ggx_ndf(lobe_vector(1, 0, 0), l.normal, 1) == 0 &&
             ggx_ndf_aniso(lobe_vector(1, 0, 0), l.normal, lobe_vector(0, 1, 0), 1, 1) == 0,
         "no facets at the horizon");
    for (k = 0; k < 2; k++) { /* cosines above 1 count as 1 */
        float alpha = k ? 1e-4f : .5f;
        that(ggx_smith_g1(3, alpha) == 1 && ggx_smith_g2(3, .5f, alpha) == ggx_smith_g2(1, .5f, alpha) &&
                 ggx_smith_g2(.5f, 3, alpha) == ggx_smith_g2(.5f, 1, alpha),
             "masking of a cosine above 1");
        that(ggx_fresnel_max(.04f, 3) == ggx_fresnel_max(.04f, 1.00001f),
             "the largest Fresnel factor of a cosine above 1");
    }
    that(ggx_brdf_cos(l.normal, lobe_vector(1, 0, 0), l.wi, .1f) > 0, "light along the horizon has a limit");
    that(ggx_brdf_cos(l.normal, lobe_scale(l.normal, -1), l.wi, .1f) == 0, "no light from below");
    that(ggx_bound_diffuse(l.position, l.normal, 0, 1, 1, 1).radius > 0, "no radius of 0");
    e = volume_of(&l, SPHEROID);
    f = ggx_ellipsoid_of_sphere(ggx_bound_enclosing(e));
    that(f.radius[0] >= e.radius[0] && f.radius[0] < e.radius[0] * 1.00001f, "the enclosing sphere's radius");
}

const test_case ggx_bound_tests[] = {{"ggx_ndf", test_ndf},
                                     {"ggx_sharp", test_sharp},
                                     {"ggx_tangents_near", test_tangents_near},
                                     {"ggx_smith", test_smith},
                                     {"ggx_brdf", test_brdf},
                                     {"ggx_normalisation", test_normalisation},
                                     {"ggx_fresnel", test_fresnel},
                                     {"ggx_accept", test_accept},
                                     {"ggx_accept_mean", test_accept_mean},
                                     {"ggx_unbiased", test_unbiased},
                                     {"ggx_bound_spheroid", test_spheroid},
                                     {"ggx_bound_ellipsoid", test_ellipsoid},
                                     {"ggx_bound_ellipsoid_aniso", test_ellipsoid_aniso},
                                     {"ggx_bound_spheres", test_spheres},
                                     {"ggx_pad", test_pad},
                                     {"ggx_grazing_range", test_grazing_range},
                                     {"ggx_padding", test_padding},
                                     {"ggx_bound_volumes", test_volumes},
                                     {"ggx_tightness", test_tightness},
                                     {"ggx_bound_volumes_aniso", test_volumes_aniso},
                                     {"ggx_alphas_nearly_equal", test_alphas_nearly_equal},
                                     {"ggx_bound_diffuse", test_diffuse},
                                     {"ggx_boxes", test_boxes},
                                     {"ggx_boxes_beside", test_boxes_beside},
                                     {"ggx_thin_ellipsoids", test_thin_ellipsoids},
                                     {"ggx_boxes_near", test_boxes_near},
                                     {"ggx_transform", test_transform},
                                     {"ggx_tiles", test_tiles},
                                     {"ggx_tiles_near", test_tiles_near},
                                     {"ggx_tile_above", test_tile_above},
                                     {"ggx_tiles_far", test_tiles_far},
                                     {"ggx_stretched_radius", test_stretched_radius},
                                     {"ggx_tiles_in_depth", test_tiles_in_depth},
                                     {"ggx_gradient", test_gradient},
                                     {"ggx_boxes_grow", test_boxes_grow},
                                     {"ggx_half_spaces_grow", test_half_spaces_grow},
                                     {"ggx_horizons_grow", test_horizons_grow},
                                     {"ggx_horizons_far", test_horizons_far},
                                     {"ggx_edges", test_bound_edges},
                                     {"ggx_special_cases", test_special_cases},
                                     {0, 0}};
