// ggx_bound.glsl - GGX reflection, and the volumes that bound its light in stochastic light culling; the functions of
// ggx_bound.h, where each is explained. Needs sg.glsl.
//
// Conventions: alpha below 1e-4 counts as 1e-4, above 1 as 1. A virtual point light (VPL) lies on a surface; flux is
// the power that arrived there from wi, delta the radiance below which lights are left out at random, xi the light's
// one random number in (0, 1). A frame of a camera has x/z and y/z across the image and z > 0 the depth. Lengths are up
// to 1e5, powers up to 1e18. Errors are within 4 times those that ggx_bound.h states.

struct ggx_ellipsoid {
    float3 center;
    float3 axis[3]; // orthonormal, right-handed; the first is the light's mirror direction, or near it
    float3 radius;  // along each, positive
};

struct ggx_sphere {
    float3 center;
    float radius;
};

// The space in which an ellipsoid is a unit sphere. The matrix is upper triangular: of the camera's axes z is the only
// one that reaches the third.
struct ggx_stretched {
    float xx, xy, xz, yy, yz, zz;
    float3 center;
    float size;   // how large the terms of the center are: for rounding
    bool swapped; // rows and columns are in the order y, x, z
};

// A tile of the image: limits of x/z and y/z
struct ggx_tile {
    float left, right, bottom, top;
};

// ---- small numerics ----

float lobe_ggx_alpha(float alpha) {
    return clamp(alpha, 1e-4, 1.0);
}

// max |component|
float lobe_ggx_extent(float3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// |m|^2 / (a^2 (m.n)^2 + |n x m|^2): the GGX distribution is pi (a this)^-2
float lobe_ggx_lobe(float3 m, float3 normal, float alpha) {
    float3 across = cross(normal, m);
    float along = alpha * dot(m, normal);
    return dot(m, m) / max(along * along + dot(across, across), 1e-30);
}

// The two tangents of a surface: the given one made perpendicular to the normal, any if it is nearly the normal
void lobe_ggx_tangents(float3 normal, float3 tangent, out float3 x, out float3 y) {
    float3 beside, other, rest = tangent - normal * dot(tangent, normal);
    lobe_frame(normal, beside, other);
    rest = dot(rest, rest) > 1e-6 ? rest - normal * dot(rest, normal) : beside;
    x = lobe_normalize_or(rest, beside);
    y = cross(normal, x);
}

// The same as lobe_ggx_lobe for two widths
float lobe_ggx_lobe_aniso(float3 m, float3 normal, float3 tangent, float alpha_x, float alpha_y) {
    float3 tx, ty;
    lobe_ggx_tangents(normal, tangent, tx, ty);
    float x = dot(m, tx), y = dot(m, ty), along = dot(m, normal), ratio = alpha_x / alpha_y;
    return dot(m, m) / max(x * x / ratio + y * y * ratio + alpha_x * alpha_y * along * along, 1e-30);
}

// sqrt(cos^2 + a^2 sin^2)
float lobe_ggx_slope(float cos_theta, float alpha) {
    return sqrt(alpha * alpha + (1.0 - alpha) * (1.0 + alpha) * cos_theta * cos_theta);
}

// The same for a direction and two widths
float lobe_ggx_slope_aniso(float3 dir, float3 normal, float3 tangent, float alpha_x, float alpha_y) {
    float3 tx, ty;
    lobe_ggx_tangents(normal, tangent, tx, ty);
    float3 slope = float3(alpha_x * dot(dir, tx), alpha_y * dot(dir, ty), dot(dir, normal));
    return sqrt(dot(slope, slope));
}

// What the cosines and the slopes of both directions make of D / pi
float lobe_ggx_reflected(float density, float cos_i, float cos_o, float divisor) {
    float value = 0.159154943 * density * cos_o / max(divisor, 1e-30);
    return cos_i >= 0.0 && cos_o > 0.0 ? value : 0.0;
}

// ---- the BRDF ----

// The GGX distribution of half vectors
float ggx_ndf(float3 h, float3 normal, float alpha) {
    float a = lobe_ggx_alpha(alpha), peak = a * lobe_ggx_lobe(h, normal, a);
    return dot(h, normal) > 0.0 ? 0.318309886 * peak * peak : 0.0;
}

// The same with two widths, alpha_x along the tangent and alpha_y along normal x tangent
float ggx_ndf_aniso(float3 h, float3 normal, float3 tangent, float alpha_x, float alpha_y) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y);
    float lobe = lobe_ggx_lobe_aniso(h, normal, tangent, ax, ay);
    return dot(h, normal) > 0.0 ? ax * ay * 0.318309886 * lobe * lobe : 0.0;
}

// The share of facets that a direction sees
float ggx_smith_g1(float cos_theta, float alpha) {
    float c = clamp(cos_theta, 0.0, 1.0);
    return min(2.0 * c / (c + lobe_ggx_slope(c, lobe_ggx_alpha(alpha))), 1.0);
}

// The same with two widths
float ggx_smith_g1_aniso(float3 dir, float3 normal, float3 tangent, float alpha_x, float alpha_y) {
    float c = max(dot(dir, normal), 0.0);
    float slope = lobe_ggx_slope_aniso(dir, normal, tangent, lobe_ggx_alpha(alpha_x), lobe_ggx_alpha(alpha_y));
    return min(2.0 * c / max(c + slope, 1e-30), 1.0);
}

// The share of facets that two directions see, with heights correlated
float ggx_smith_g2(float cos_i, float cos_o, float alpha) {
    float a = lobe_ggx_alpha(alpha), ci = clamp(cos_i, 0.0, 1.0), co = clamp(cos_o, 0.0, 1.0);
    return min(2.0 * ci * co / max(co * lobe_ggx_slope(ci, a) + ci * lobe_ggx_slope(co, a), 1e-30), 1.0);
}

// The same with independent heights
float ggx_smith_g2_separable(float cos_i, float cos_o, float alpha) {
    return ggx_smith_g1(cos_i, alpha) * ggx_smith_g1(cos_o, alpha);
}

// The GGX BRDF times dot(wo, normal), height-correlated, without Fresnel's factor
float ggx_brdf_cos(float3 normal, float3 wi, float3 wo, float alpha) {
    float a = lobe_ggx_alpha(alpha), cos_i = dot(wi, normal), cos_o = dot(wo, normal);
    float peak = a * lobe_ggx_lobe(wi + wo, normal, a);
    float divisor = cos_o * lobe_ggx_slope(cos_i, a) + cos_i * lobe_ggx_slope(cos_o, a);
    return lobe_ggx_reflected(peak * peak, cos_i, cos_o, divisor);
}

// The same with the separable G2
float ggx_brdf_cos_separable(float3 normal, float3 wi, float3 wo, float alpha) {
    float a = lobe_ggx_alpha(alpha), cos_i = dot(wi, normal), cos_o = dot(wo, normal);
    float peak = a * lobe_ggx_lobe(wi + wo, normal, a);
    float divisor = 0.5 * (cos_i + lobe_ggx_slope(cos_i, a)) * (cos_o + lobe_ggx_slope(cos_o, a));
    return lobe_ggx_reflected(peak * peak, cos_i, cos_o, divisor);
}

// The same height-correlated with two widths, as in ggx_ndf_aniso
float ggx_brdf_cos_aniso(float3 normal, float3 tangent, float3 wi, float3 wo, float alpha_x, float alpha_y) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y);
    float cos_i = dot(wi, normal), cos_o = dot(wo, normal);
    float lobe = lobe_ggx_lobe_aniso(wi + wo, normal, tangent, ax, ay);
    float divisor = cos_o * lobe_ggx_slope_aniso(wi, normal, tangent, ax, ay) +
                    cos_i * lobe_ggx_slope_aniso(wo, normal, tangent, ax, ay);
    return lobe_ggx_reflected(ax * ay * lobe * lobe, cos_i, cos_o, divisor);
}

// Of a direction and the half vector of both
float ggx_cos_half(float3 wi, float3 wo) {
    float3 m = wi + wo;
    return 0.5 * sqrt(dot(m, m));
}

// Schlick's Fresnel factor
float ggx_fresnel(float f0, float cos_half) {
    float c = 1.0 - clamp(cos_half, 0.0, 1.0), c2 = c * c;
    return f0 + (1.0 - f0) * (c2 * c2 * c);
}

// The largest Schlick factor over all outgoing directions above the horizon, for the cosine of wi and the normal
float ggx_fresnel_max(float f0, float cos_theta) {
    float c = clamp(cos_theta - 5e-7, 0.0, 1.0), s = sqrt((1.0 - c) * (1.0 + c)); // rounded down
    return min(ggx_fresnel(f0, c / sqrt(2.0 + 2.0 * s)) + 1e-6, 1.0);
}

// ---- stochastic culling ----

// A light's random number, (k + 1/2) 2^-23, from the upper 23 of 32 random bits
float ggx_xi(uint bits) {
    return (float((bits >> 9) & 0x7FFFFFu) + 0.5) * 1.1920929e-7;
}

// Of a light at a point; the radiant intensity is that of the largest channel
float ggx_accept_probability(float radiant_intensity, float distance_squared, float delta) {
    return min(radiant_intensity / max(delta * distance_squared, 1e-30), 1.0);
}

// What an accepted light counts: 1 / probability or 0
float ggx_accept_weight(float probability, float xi) {
    return probability > max(xi, 5.9604645e-8) ? 1.0 / max(probability, 5.9604645e-8) : 0.0;
}

// Radiance of a light at a point, or 0 where it is left out: unbiased over xi
float ggx_estimate(float radiant_intensity, float distance_squared, float delta, float xi) {
    float radiance = min(radiant_intensity / max(distance_squared, 1e-30), 1e30);
    float probability = ggx_accept_probability(radiant_intensity, distance_squared, delta);
    return probability > max(xi, 5.9604645e-8) ? max(radiance, delta) : 0.0;
}

// The distance within which a light is accepted, at most 1e12
float ggx_range(float radiant_intensity, float delta, float xi) {
    return sqrt(min(radiant_intensity / (max(delta, 1e-18) * max(xi, 5.9604645e-8)), 1e24));
}

// ---- bounding volumes ----

// Cosine and sine of incidence, each as it does not cancel
float lobe_ggx_cosine(float3 normal, float3 wi) {
    return clamp(dot(normal, wi), 0.0, 1.0);
}

float lobe_ggx_sine(float3 normal, float3 wi) {
    float3 across = cross(normal, wi);
    return min(sqrt(dot(across, across)), 1.0);
}

// The mirror direction u
float3 lobe_ggx_mirror(float3 normal, float3 wi) {
    return lobe_normalize_or(normal * (2.0 * dot(normal, wi)) - wi, normal);
}

// w: across the plane of incidence, or any perpendicular to u where normal x wi is mostly rounding. What rounding
// leaves along u is removed twice, since u's long axis would make it a large error.
float3 lobe_ggx_across(float3 normal, float3 wi, float3 u) {
    float3 across = cross(normal, wi), beside, other;
    lobe_frame(u, beside, other);
    across = dot(across, across) > 1e-10 ? across : beside;
    across -= u * dot(across, u);
    across -= u * dot(across, u);
    return lobe_normalize_or(across, beside);
}

// The range for a slope sqrt(c^2 + a^2 s^2); a wi below the horizon, by more than rounding, sends no light out
float lobe_ggx_range(float3 normal, float3 wi, float slope, float flux, float fresnel_max, float delta, float xi) {
    float c = dot(normal, wi), divisor = 6.28318531 * (max(c, 0.0) + slope - 8e-7);
    return ggx_range((c > -1e-6 ? flux * fresnel_max : 0.0) / divisor, delta, xi);
}

// Grows an ellipsoid on all sides by what rounding may take; extent: how far from the position it reaches
ggx_ellipsoid lobe_ggx_pad(ggx_ellipsoid e, float extent) {
    ggx_ellipsoid padded = e;
    float t = 4.76837158e-7 * extent + 1e-12, m = max(min(min(e.radius.x, e.radius.y), e.radius.z), t);
    padded.radius = sqrt((1.0 + t / m) * (e.radius * e.radius + m * t));
    return padded;
}

// The ellipsoid with its center on the mirror direction u, at `along` from the position; its third axis is w
ggx_ellipsoid lobe_ggx_ellipsoid_of(float3 position, float3 u, float3 w, float along, float3 radius) {
    ggx_ellipsoid e;
    e.center = position + u * along;
    e.axis[0] = u;
    e.axis[1] = cross(w, u);
    e.axis[2] = w;
    e.radius = radius;
    return lobe_ggx_pad(e, lobe_ggx_extent(position) + radius.x + abs(along));
}

// The paper's bound of the region where a light's GGX reflection is accepted
ggx_ellipsoid ggx_bound_spheroid(float3 position, float3 normal, float3 wi, float alpha, float flux, float fresnel_max,
                                 float delta, float xi) {
    float a = lobe_ggx_alpha(alpha), inverse = 0.5 / a, c = lobe_ggx_cosine(normal, wi);
    float r = lobe_ggx_range(normal, wi, lobe_ggx_slope(c, a), flux, fresnel_max, delta, xi);
    float3 u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u);
    return lobe_ggx_ellipsoid_of(position, u, w, (1.0 - a) * (1.0 + a) * inverse * r,
                                 float3((1.0 + a * a) * inverse * r, r, r));
}

// d in (eps / 2, 1] for which the ellipsoid is about smallest; any d in that interval gives a bound
float lobe_ggx_tightness(float eps, float c2, float s) {
    float t = 4.5 * eps * s, root = sqrt(t * t + 120.0 * eps * c2);
    float q = 4.0 * (1.0 - eps * eps * eps) * s / max(t + root, 1e-30), q2 = q * q;
    return 1.0 / sqrt(sqrt(1.0 + q2 * q2));
}

// A tighter bound of the same region, with the spheroid's tip
ggx_ellipsoid ggx_bound_ellipsoid(float3 position, float3 normal, float3 wi, float alpha, float flux, float fresnel_max,
                                  float delta, float xi) {
    float a = lobe_ggx_alpha(alpha), a2 = a * a, eps = 2.0 * a2 / (1.0 + a2), e = (1.0 - a) * (1.0 + a) / (1.0 + a2);
    float c = lobe_ggx_cosine(normal, wi), s = lobe_ggx_sine(normal, wi), c2 = c * c, h = e * (s * s);
    float r = lobe_ggx_range(normal, wi, lobe_ggx_slope(c, a), flux, fresnel_max, delta, xi);
    float d = lobe_ggx_tightness(eps, c2, s), eta = sqrt(max(1.0 - d, 0.0));
    float k = 1.0 + h * (1.0 + eta) / (d / (1.0 + eta) + 2.0 * eta * c2);
    float g = 2.0 * d / ((2.0 * d - eps) * (1.0 + a2)), ru = 0.5 * (a + 1.0 / a) * g * r, side = sqrt(g) * r;
    float3 u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u);
    return lobe_ggx_ellipsoid_of(position, u, w, r / a - ru, float3(ru, side, side / sqrt(k)));
}

// Entries of the quadratic form uu U^2 + 2 ub U b + bb b^2 + (third axis)^2 <= 2 eps R U that bounds an anisotropic
// region, for one d; det = uu bb - ub^2
struct lobe_ggx_form {
    float uu, ub, bb, det;
};

lobe_ggx_form lobe_ggx_form_of(float d, float eps, float c2, float s, float c1, float l2) {
    lobe_ggx_form q;
    float eta = sqrt(max(1.0 - d, 0.0)), om = d / (1.0 + eta);
    float t = 0.5 * eps * (1.0 + eta) / (om + 2.0 * eta * c2), k = t * om * c1 * s, sg = d + k * om * c1 * s;
    q.uu = eps * (2.0 - eps / sg);
    q.ub = eps * (k / sg) * sqrt(l2);
    q.bb = 1.0 + t * (d / sg) * l2;
    q.det = q.uu + l2 * (eps * (t / sg)) * (2.0 * d - eps);
    return q;
}

// Falls with the ellipsoid's volume
float lobe_ggx_form_merit(lobe_ggx_form q) {
    float root = sqrt(q.bb);
    return q.det / (root * sqrt(root));
}

// The same for an anisotropic NDF; tangent and alphas as in ggx_ndf_aniso
ggx_ellipsoid ggx_bound_ellipsoid_aniso(float3 position, float3 normal, float3 tangent, float3 wi, float alpha_x, float alpha_y,
                                        float flux, float fresnel_max, float delta, float xi) {
    float ax = lobe_ggx_alpha(alpha_x), ay = lobe_ggx_alpha(alpha_y);
    float3 tx, ty, u = lobe_ggx_mirror(normal, wi), w = lobe_ggx_across(normal, wi, u), v = cross(w, u);
    float c = lobe_ggx_cosine(normal, wi), s = lobe_ggx_sine(normal, wi), c2 = c * c;
    float range_slope = lobe_ggx_slope_aniso(wi, normal, tangent, ax, ay);
    float r = lobe_ggx_range(normal, wi, range_slope, flux, fresnel_max, delta, xi) / sqrt(ax * ay);
    // X in the frame of the plane of incidence
    lobe_ggx_tangents(normal, tangent, tx, ty);
    float2 turn = float2(dot(w, ty), -dot(w, tx));
    float xx = (1.0 - ax) * (1.0 + ax) / (ax * ax), yy = (1.0 - ay) * (1.0 + ay) / (ay * ay);
    float x11 = xx * turn.x * turn.x + yy * turn.y * turn.y, x22 = xx * turn.y * turn.y + yy * turn.x * turn.x;
    float x12 = (yy - xx) * turn.y * turn.x;
    // the spheroid that it contains, and the rest, the smaller part of which would cancel
    float b = x11 * c2 + x22, difference = x11 * c2 - x22;
    float kappa = 2.0 * xx * yy / max(b + sqrt(difference * difference + 4.0 * c2 * x12 * x12), 1e-30);
    float c1 = sqrt(max(x11 - kappa, 0.0)), c2_rest = sqrt(max(x22 - kappa * c2, 0.0));
    if (c1 > c2_rest)
        c2_rest = clamp(x12 / max(c1, 1e-30), -c1, c1);
    else
        c1 = clamp(x12 / max(c2_rest, 1e-30), -c2_rest, c2_rest);
    // the quadratic form in U and along (c1 c, c2), for the best of three d
    float eps = 2.0 / (2.0 + kappa), ev = c1 * c, ew = c2_rest, l2 = ev * ev + ew * ew;
    float d = lobe_ggx_tightness(eps, c2, s), least = min(1.25 * eps, d);
    lobe_ggx_form q = lobe_ggx_form_of(d, eps, c2, s, c1, l2);
    lobe_ggx_form second = lobe_ggx_form_of(max(0.8 * d, least), eps, c2, s, c1, l2);
    lobe_ggx_form third = lobe_ggx_form_of(max(0.5 * d, least), eps, c2, s, c1, l2);
    if (lobe_ggx_form_merit(second) > lobe_ggx_form_merit(q)) q = second;
    if (lobe_ggx_form_merit(third) > lobe_ggx_form_merit(q)) q = third;
    // its center and level, and its axes by one Jacobi rotation; the smaller eigenvalue as a quotient
    float along = r - eps * r * (q.bb / q.det), aside = -eps * r * (q.ub / q.det), level = eps * r * sqrt(q.bb / q.det);
    float apart = 0.5 * (q.bb - q.uu), root = sqrt(apart * apart + q.ub * q.ub);
    float larger = 0.5 * (q.uu + q.bb) + root, smaller = q.det / larger;
    bool upright = apart >= 0.0;
    float slope = (upright ? q.ub : -q.ub) / max(abs(apart) + root, 1e-30);
    float cosine = 1.0 / sqrt(1.0 + slope * slope), sine = slope * cosine, size = 1.0 / sqrt(max(l2, 1e-30));
    ev = l2 > 1e-20 ? ev * size : 1.0;
    ew = l2 > 1e-20 ? ew * size : 0.0;
    float3 beside = v * ev + w * ew;
    ggx_ellipsoid e;
    e.center = position + (u * along + beside * aside);
    e.axis[0] = u * cosine + beside * sine;
    e.axis[1] = beside * cosine - u * sine;
    e.axis[2] = w * ev - v * ew;
    e.radius = level / sqrt(float3(upright ? smaller : larger, upright ? larger : smaller, 1.0));
    return lobe_ggx_pad(e, lobe_ggx_extent(position) + e.radius.x + e.radius.y + abs(along) + abs(aside));
}

// The sphere around the light with which the paper compares
ggx_sphere ggx_bound_sphere(float3 position, float3 normal, float3 wi, float alpha, float flux, float fresnel_max,
                            float delta, float xi) {
    ggx_sphere s;
    float a = lobe_ggx_alpha(alpha), slope = lobe_ggx_slope(lobe_ggx_cosine(normal, wi), a);
    float r = lobe_ggx_range(normal, wi, slope, flux, fresnel_max, delta, xi) / a;
    s.center = position;
    s.radius = r + (4.76837158e-7 * (lobe_ggx_extent(position) + r) + 1e-12);
    return s;
}

// The sphere around an ellipsoid, with the same center
ggx_sphere ggx_bound_enclosing(ggx_ellipsoid e) {
    ggx_sphere s;
    s.center = e.center;
    s.radius = max(max(e.radius.x, e.radius.y), e.radius.z) * 1.000001;
    return s;
}

// The range of a Lambert surface along its normal
float lobe_ggx_diffuse_range(float flux, float albedo, float delta, float xi) {
    return ggx_range(flux * albedo * 0.318309886, delta, xi);
}

// The paper's bound of the region where a light's Lambert reflection is accepted: the smallest sphere
ggx_sphere ggx_bound_diffuse(float3 position, float3 normal, float flux, float albedo, float delta, float xi) {
    ggx_sphere s;
    float r = lobe_ggx_diffuse_range(flux, albedo, delta, xi);
    s.center = position + normal * (0.438691338 * r);
    s.radius = 0.620403239 * r + 4.76837158e-7 * (lobe_ggx_extent(position) + 2.0 * r) + 1e-12;
    return s;
}

// The smallest ellipsoid of revolution around the same region
ggx_ellipsoid ggx_bound_diffuse_ellipsoid(float3 position, float3 normal, float flux, float albedo, float delta, float xi) {
    float r = lobe_ggx_diffuse_range(flux, albedo, delta, xi);
    float3 x, y;
    lobe_frame(normal, x, y);
    return lobe_ggx_ellipsoid_of(position, normal, cross(normal, x), 0.4556264 * r,
                                 float3(0.5443738, 0.6246771, 0.6246771) * r);
}

// ---- tests against boxes and tiles ----

// A sphere for the functions below
ggx_ellipsoid ggx_ellipsoid_of_sphere(ggx_sphere s) {
    ggx_ellipsoid e;
    e.center = s.center;
    e.axis[0] = float3(1.0, 0.0, 0.0);
    e.axis[1] = float3(0.0, 1.0, 0.0);
    e.axis[2] = float3(0.0, 0.0, 1.0);
    e.radius = float3(s.radius, s.radius, s.radius);
    return e;
}

// M p for a matrix of three rows
float3 lobe_ggx_turn(float3 rows[3], float3 p) {
    return float3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
}

// An ellipsoid seen from a camera: view has its right, up and forward, eye its position
ggx_ellipsoid ggx_ellipsoid_transform(ggx_ellipsoid e, float3 view[3], float3 eye) {
    ggx_ellipsoid t;
    t.center = lobe_ggx_turn(view, e.center - eye);
    t.axis[0] = lobe_ggx_turn(view, e.axis[0]);
    t.axis[1] = lobe_ggx_turn(view, e.axis[1]);
    t.axis[2] = lobe_ggx_turn(view, e.axis[2]);
    t.radius = e.radius;
    return lobe_ggx_pad(t, lobe_ggx_extent(t.center) + lobe_ggx_extent(e.center) + ggx_bound_enclosing(e).radius);
}

// How far an ellipsoid extends from its center along a direction, times the direction's length
float ggx_ellipsoid_reach(ggx_ellipsoid e, float3 direction) {
    float3 reach = e.radius * lobe_ggx_turn(e.axis, direction);
    return sqrt(dot(reach, reach));
}

// Whether an ellipsoid has points with dot(p, normal) >= offset
bool ggx_ellipsoid_hits_half_space(ggx_ellipsoid e, float3 normal, float offset) {
    float size = lobe_ggx_extent(e.center) + ggx_bound_enclosing(e).radius;
    float slack = 4.76837158e-7 * (size * (abs(normal.x) + abs(normal.y) + abs(normal.z)) + abs(offset));
    return dot(e.center, normal) + ggx_ellipsoid_reach(e, normal) + slack >= offset;
}

// Whether the plane across a direction surely parts an ellipsoid and a box at an offset from its center
bool lobe_ggx_parted(ggx_ellipsoid e, float3 direction, float3 offset, float3 half_size, float slack) {
    float3 size = abs(direction);
    return abs(dot(direction, offset)) >
           dot(size, half_size) + ggx_ellipsoid_reach(e, direction) + slack * (size.x + size.y + size.z);
}

// Whether an ellipsoid meets a box along the coordinate axes
bool ggx_ellipsoid_hits_box(ggx_ellipsoid e, float3 box_center, float3 half_size) {
    float3 offset = box_center - e.center, low = offset - half_size, high = offset + half_size;
    float size = lobe_ggx_extent(offset) + lobe_ggx_extent(half_size) + ggx_bound_enclosing(e).radius;
    float slack = 9.53674316e-7 * size;
    if (lobe_ggx_parted(e, float3(1.0, 0.0, 0.0), offset, half_size, slack) ||
        lobe_ggx_parted(e, float3(0.0, 1.0, 0.0), offset, half_size, slack) ||
        lobe_ggx_parted(e, float3(0.0, 0.0, 1.0), offset, half_size, slack))
        return false;
    // the ellipsoid's metric sum axis axis' / radius^2, up to a factor, and by it the nearest point of the box: three
    // rounds of descent along each coordinate in turn, as far as the box allows
    float3 weight = min(min(e.radius.x, e.radius.y), e.radius.z) / e.radius;
    float3 a = e.axis[0] * weight.x, b = e.axis[1] * weight.y, c = e.axis[2] * weight.z;
    float3 mx = a * a.x + b * b.x + c * c.x, my = a * a.y + b * b.y + c * c.y, mz = a * a.z + b * b.z + c * c.z;
    float3 p = clamp(float3(0.0, 0.0, 0.0), low, high);
    for (int k = 0; k < 3; k++) {
        p.x = clamp(-dot(mx.yz, p.yz) / max(mx.x, 1e-30), low.x, high.x);
        p.y = clamp(-dot(my.xz, p.xz) / max(my.y, 1e-30), low.y, high.y);
        p.z = clamp(-dot(mz.xy, p.xy) / max(mz.z, 1e-30), low.z, high.z);
    }
    return !lobe_ggx_parted(e, float3(dot(mx, p), dot(my, p), dot(mz, p)), offset, half_size, slack);
}

// The space of an ellipsoid, in the camera's frame, in which it is a unit sphere
ggx_stretched ggx_stretch_ellipsoid(ggx_ellipsoid e) {
    ggx_stretched s;
    float3 x = float3(e.axis[0].x, e.axis[1].x, e.axis[2].x) / e.radius;
    float3 y = float3(e.axis[0].y, e.axis[1].y, e.axis[2].y) / e.radius;
    float3 z = float3(e.axis[0].z, e.axis[1].z, e.axis[2].z) / e.radius;
    s.swapped = dot(x, x) <= dot(y, y);
    float3 p = s.swapped ? y : x, q = s.swapped ? x : y, c = s.swapped ? e.center.yxz : e.center, beside, other;
    s.xx = sqrt(dot(p, p));
    p *= 1.0 / s.xx;
    s.xy = dot(p, q);
    q -= p * s.xy;
    float twice = dot(p, q);
    s.xy += twice;
    q -= p * twice;
    s.yy = sqrt(dot(q, q));
    lobe_frame(p, beside, other);
    q = lobe_normalize_or(q, beside);
    s.xz = dot(p, z);
    s.yz = dot(q, z);
    s.zz = abs(dot(cross(p, q), z));
    s.center = float3(s.xx * c.x + s.xy * c.y + s.xz * c.z, s.yy * c.y + s.yz * c.z, s.zz * c.z);
    s.size = s.xx * abs(c.x) + (abs(s.xy) + s.yy) * abs(c.y) + (abs(s.xz) + abs(s.yz) + s.zz) * abs(c.z);
    return s;
}

// Where a ray of the camera, of x/z and y/z in the stretched space's order, is at depth 1 there
float3 lobe_ggx_ray(ggx_stretched s, float x, float y) {
    return float3(s.xx * x + s.xy * y + s.xz, s.yy * y + s.yz, s.zz);
}

// A tile with its sides in the stretched space's order
ggx_tile lobe_ggx_swap(ggx_stretched s, ggx_tile tile) {
    ggx_tile t;
    t.left = s.swapped ? tile.bottom : tile.left;
    t.right = s.swapped ? tile.top : tile.right;
    t.bottom = s.swapped ? tile.left : tile.bottom;
    t.top = s.swapped ? tile.right : tile.top;
    return t;
}

// The sphere's radius, with 2^-19 of the sum of the terms that make coordinates of it and of a frustum to that depth; the
// tile as lobe_ggx_swap has it
float lobe_ggx_stretched_radius(ggx_stretched s, ggx_tile t, float depth) {
    float wide = max(abs(t.left), abs(t.right)), high = max(abs(t.bottom), abs(t.top));
    float terms = s.xx * wide + (abs(s.xy) + s.yy) * high + abs(s.xz) + abs(s.yz) + s.zz;
    return 1.00001 + 1.90734863e-6 * (s.size + depth * terms);
}

// How far a number is outside of [low, high]
float lobe_ggx_outside(float low, float high, float x) {
    return max(max(low - x, x - high), 0.0);
}

// Whether an ellipsoid meets the part of a tile's frustum between two depths
bool ggx_stretched_hits_tile(ggx_stretched s, ggx_tile tile, float depth0, float depth1) {
    ggx_tile t = lobe_ggx_swap(s, tile);
    float x0 = s.xx * t.left + min(s.xy * t.bottom, s.xy * t.top) + s.xz;
    float x1 = s.xx * t.right + max(s.xy * t.bottom, s.xy * t.top) + s.xz;
    float y0 = s.yy * t.bottom + s.yz, y1 = s.yy * t.top + s.yz;
    float x = lobe_ggx_outside(min(x0 * depth0, x0 * depth1), max(x1 * depth0, x1 * depth1), s.center.x);
    float y = lobe_ggx_outside(min(y0 * depth0, y0 * depth1), max(y1 * depth0, y1 * depth1), s.center.y);
    float z = lobe_ggx_outside(s.zz * depth0, s.zz * depth1, s.center.z);
    float radius = lobe_ggx_stretched_radius(s, t, depth1);
    return x * x + y * y + z * z <= radius * radius;
}

// Whether an ellipsoid in the camera's frame reaches inside of each of the four sides of a tile's frustum
bool ggx_ellipsoid_hits_sides(ggx_ellipsoid e, ggx_tile tile) {
    return ggx_ellipsoid_hits_half_space(e, float3(1.0, 0.0, -tile.left), 0.0) &&
           ggx_ellipsoid_hits_half_space(e, float3(-1.0, 0.0, tile.right), 0.0) &&
           ggx_ellipsoid_hits_half_space(e, float3(0.0, 1.0, -tile.bottom), 0.0) &&
           ggx_ellipsoid_hits_half_space(e, float3(0.0, -1.0, tile.top), 0.0);
}

// The point of a tile's frustum that is lowest along a direction of the stretched space, relative to the ellipsoid; the
// tile as lobe_ggx_swap has it
float3 lobe_ggx_support(ggx_stretched s, ggx_tile t, float depth0, float depth1, float3 q) {
    float gx = s.xx * q.x, gy = s.xy * q.x + s.yy * q.y, gz = s.xz * q.x + s.yz * q.y + s.zz * q.z;
    float x = gx > 0.0 ? t.left : t.right, y = gy > 0.0 ? t.bottom : t.top;
    float z = gx * x + gy * y + gz > 0.0 ? depth0 : depth1;
    return z * lobe_ggx_ray(s, x, y) - s.center;
}

// Moves a point of the frustum towards another, to where the line is nearest to the ellipsoid's center
float3 lobe_ggx_nearer(float3 q, float3 other) {
    float3 step_to = other - q;
    return q + step_to * min(max(-dot(q, step_to), 0.0) / max(dot(step_to, step_to), 1e-30), 1.0);
}

// The same test of an ellipsoid and a tile, closer: for what ggx_stretched_hits_tile and ggx_ellipsoid_hits_sides let
// through
bool ggx_stretched_hits_frustum(ggx_stretched s, ggx_tile tile, float depth0, float depth1) {
    ggx_tile t = lobe_ggx_swap(s, tile);
    float3 ray = lobe_ggx_ray(s, 0.5 * (t.left + t.right), 0.5 * (t.bottom + t.top));
    float3 q = 0.5 * (depth0 + depth1) * ray - s.center;
    float radius = lobe_ggx_stretched_radius(s, t, depth1);
    for (int k = 0; k < 3; k++) {
        float3 lowest = lobe_ggx_support(s, t, depth0, depth1, q);
        if (dot(q, lowest) > radius * sqrt(dot(q, q))) return false;
        q = lobe_ggx_nearer(q, lowest);
    }
    return true;
}

// ggx_stretched_hits_tile for a tile of two depth clusters, each with its least and largest depth: 1 for the first, 2
// for the second, 3 for both, 0 for neither; least above largest: empty
int ggx_stretched_hits_clusters(ggx_stretched s, ggx_tile tile, float2 near_depth, float2 far_depth) {
    bool first = near_depth.x <= near_depth.y && ggx_stretched_hits_tile(s, tile, near_depth.x, near_depth.y);
    bool second = far_depth.x <= far_depth.y && ggx_stretched_hits_tile(s, tile, far_depth.x, far_depth.y);
    return (first ? 1 : 0) + (second ? 2 : 0);
}

// Whether part of a tile's frustum between two depths is above a light's horizon, where alone it shines; position and
// normal in the camera's frame
bool ggx_tile_above(float3 position, float3 normal, ggx_tile tile, float depth0, float depth1) {
    float x = max(normal.x * tile.left, normal.x * tile.right);
    float y = max(normal.y * tile.bottom, normal.y * tile.top), slope = x + y + normal.z;
    float terms = abs(position.x) + abs(position.y) + abs(position.z) + depth1 * (abs(x) + abs(y) + abs(normal.z));
    return max(slope * depth0, slope * depth1) + 9.53674316e-7 * terms >= dot(position, normal);
}
