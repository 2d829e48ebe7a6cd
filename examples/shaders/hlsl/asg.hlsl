// asg.glsl - anisotropic spherical Gaussians and the specular light of virtual SG lights; the functions of asg.h, where
// each is explained. They use those of sg.glsl.
//
// Conventions: an ASG is max(w.z, 0) exp(log_amplitude - sharpness_x (w.x)^2 - sharpness_y (w.y)^2), with x, y, z
// orthonormal. Near its axis an SG is an ASG of half its sharpness. Errors are within 4 times those that asg.h states.

struct asg_lobe {
    float3 x, y, z; // orthonormal; z is the axis
    float sharpness_x, sharpness_y;
    float log_amplitude;
};

static const int ASG_FORM_SG = 0;
static const int ASG_FORM_XU = 1;
static const int ASG_FORM_ACCURATE = 2;

// ---- small numerics ----

// e^x, at most e^78: the integral of a lobe times it is finite
float lobe_asg_exp(float x) {
    return min(lobe_exp(x), 7.5e33);
}

// A direction's components along a lobe's axes
float3 lobe_asg_components(asg_lobe a, float3 dir) {
    return float3(dot(a.x, dir), dot(a.y, dir), dot(a.z, dir));
}

// Both sharpnesses, each at most that
float2 lobe_asg_sharpness(asg_lobe a, float most) {
    return float2(min(a.sharpness_x, most), min(a.sharpness_y, most));
}

// ---- evaluate and integrate ----

// Value in a direction
float asg_eval(asg_lobe a, float3 dir) {
    float3 w = lobe_asg_components(a, dir);
    return max(w.z, 0.0) * lobe_exp(a.log_amplitude - (a.sharpness_x * (w.x * w.x) + a.sharpness_y * (w.y * w.y)));
}

// Integral over the sphere
float asg_integral(asg_lobe a) {
    float l = max(a.sharpness_x, a.sharpness_y), u = min(a.sharpness_x, a.sharpness_y), d = min(l - u, 1e9);
    float b = 1.0 + 0.27323954 * d * d / ((13.62806 + d * (1.851625 + d)) * (1.0 + 0.145226 * min(u, 1e15)));
    float narrow = lobe_phi(l), wide = b * lobe_phi(b * u);
    return 3.14159265 * lobe_asg_exp(a.log_amplitude) * (wide * sqrt(narrow / wide)); // narrow wide may vanish
}

// The papers' form of the same integral, for sharpness of 10 or more
float asg_integral_approx(asg_lobe a) {
    float least = max(min(a.sharpness_x, a.sharpness_y), 1e-4), most = max(max(a.sharpness_x, a.sharpness_y), 1e-4);
    return 3.14159265 * lobe_asg_exp(a.log_amplitude) / (least * sqrt(most / least)); // least most may overflow
}

// Xu's integral of the product of an ASG and an SG
float asg_sg_integral_xu(asg_lobe a, sg_lobe g) {
    float nu = min(0.5 * g.sharpness, 1e12);
    float2 l = lobe_asg_sharpness(a, 1e12), s = max(l + nu, float2(1e-4, 1e-4));
    float3 w = lobe_asg_components(a, g.axis);
    float inverse = 1.0 / (s.x * s.y), loss = nu * inverse * dot(l * s.yx, w.xy * w.xy);
    return 3.14159265 * lobe_asg_exp(a.log_amplitude + g.log_amplitude - loss) * sqrt(inverse) * max(w.z, 0.0);
}

// Integral of the product of an ASG and an SG over the sphere: a saddlepoint, and a split at the horizon
float asg_sg_integral(asg_lobe a, sg_lobe g) {
    float nu = min(0.5 * g.sharpness, 1e15), nu1 = nu + 0.9009611;
    float2 l = lobe_asg_sharpness(a, 1e12), s = l + nu1, weight = s.yx * (1.0 / (s.x * s.y)), r = nu1 * weight;
    float3 w = nu * lobe_asg_components(a, g.axis);
    float2 rw = r * w.xy;
    // tau, and its distance from nu without a difference of the two
    float d = 0.25 + 0.25 * (r.x + r.y), radius = sqrt(d * d + (dot(rw, rw) + w.z * w.z)), tau = d + radius;
    float reach = radius + nu, inverse = 1.0 / (tau * reach), t = reach * inverse;
    float away = dot(l * weight * (1.0 + r), w.xy * w.xy), shift = d + (d * d - away) * (tau * inverse);
    // 1 / (l + tau), the means there and their squares
    float2 along = l + tau;
    float axy = 1.0 / (along.x * along.y);
    float2 p = along.yx * axy, m = w.xy * p, m2 = m * m;
    float mz = w.z * t, mz2 = mz * mz;
    float sum = 0.5 * (p.x + p.y + t), excess = sum + (m2.x + m2.y) + (mz2 - 1.0);
    float k2 = tau * dot(0.5 * p + 2.0 * m2, p) + (0.5 * t + 2.0 * mz2); // over t
    float exponent = shift * shift * t - dot(l * m, w.xy) * t +
                     excess * min(tau, 1e6) * (1.0 - 0.41055794 * k2) * (0.8921123 * sum - 0.592386 * excess);
    // mean |z| of a normal deviate of mean side over its deviation, and what part of it lies above the horizon
    float side = 1.41421356 * w.z * (t * sqrt(tau)), beside = abs(side);
    float close = max(1.0 - 0.259302 * beside, 0.0), close2 = close * close;
    float tail = close2 * close2 * (0.8032341 - 0.239188 * beside);
    float mean = (1.0 + 0.03304771 * t * k2) * (1.41421356 * abs(mz) + t * sqrt(tau) * tail);
    float split = side * (2.554556 + (mz2 + 0.598075 * t) * (-0.826906 + 1.124705 * beside));
    // 1 / (1 + e^-split) = e^min(split, 0) / (1 + e^-|split|)
    exponent += min(split, 0.0);
    return 3.14159265 * lobe_asg_exp(a.log_amplitude + g.log_amplitude + exponent) * (mean * sqrt(axy / k2)) /
           ((1.0 + lobe_exp(-abs(split))) * max(5e-16 * g.sharpness, 1.0));
}

// The SG that stands for an ASG: same axis, same peak, same integral where both are sharp
sg_lobe asg_isotropic(asg_lobe a) {
    sg_lobe g;
    float most = max(max(a.sharpness_x, a.sharpness_y), 1e-30);
    g.axis = a.z;
    g.sharpness = 2.0 * most * sqrt(min(a.sharpness_x, a.sharpness_y) / most);
    g.log_amplitude = a.log_amplitude;
    return g;
}

// The simplest form of an ASG's integral with an SG that errs by at most the tolerance, over the aligned integral
int asg_sg_form(asg_lobe a, float light_sharpness, float tolerance) {
    float least = clamp(min(a.sharpness_x, a.sharpness_y), 1e-6, 1e12);
    float most = clamp(max(a.sharpness_x, a.sharpness_y), 1e-6, 1e12);
    float nu = clamp(0.5 * light_sharpness, 1e-6, 1e12), mean = sqrt(least) * sqrt(most);
    float inverse = 1.0 / (mean + nu), wide = (least + nu) * inverse;
    float peak = sqrt(wide * ((most + nu) * inverse)) - 1.0, ratio = sqrt(most / least) * wide - 1.0;
    float share = nu / (least + nu), back = lobe_exp(-least);
    float curved = max(0.65 * share * (1.0 - share), 0.14 * share) / least + 1.05 * back * (1.0 + back * (1.0 + back));
    float sg = max(peak, 0.0) + max(ratio / (ratio + 2.5), 0.0) + curved;
    float xu = (0.24 + 0.36 * share + 0.4 * back) / nu + 0.32 * back / sqrt(nu);
    if (sg <= tolerance) return ASG_FORM_SG;
    return xu <= tolerance ? ASG_FORM_XU : ASG_FORM_ACCURATE;
}

// Of the summed quadratic forms Q of two lobes: det(Q + tau I) = ((tau + trace) tau + m2) tau + det, and its adjugate's
struct lobe_asg_pair {
    float trace, m2, det;
    float quad_a, quad_b;                 // za' Q za, zb' Q zb
    float adj_aa, adj_bb, adj_ab, cosine; // za' adj(Q) za ..., za.zb
};

// All of them sums of positive terms, in an order that exchanging the lobes does not change
lobe_asg_pair lobe_asg_pair_of(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k;
    float2 la = lobe_asg_sharpness(a, 1e9), lb = lobe_asg_sharpness(b, 1e9);
    float3 x = lobe_asg_components(b, a.x), y = lobe_asg_components(b, a.y), z = lobe_asg_components(b, a.z);
    float3 x2 = x * x, y2 = y * y, z2 = z * z;
    float sine = x2.y + y2.x, cosine = x2.x + y2.y, l12 = la.x * la.y, l34 = lb.x * lb.y;
    float2 straight = la * lb, crossed = la * lb.yx;
    k.trace = (la.x + la.y) + (lb.x + lb.y);
    k.quad_a = lb.x * z2.x + lb.y * z2.y;
    k.quad_b = la.x * x2.z + la.y * y2.z;
    k.det = l12 * k.quad_a + l34 * k.quad_b;
    k.m2 = (l12 + l34) + 0.5 * ((straight.x * (sine + (z2.x + x2.z)) + straight.y * (sine + (z2.y + y2.z))) +
                                (crossed.x * (cosine + (z2.y + x2.z)) + crossed.y * (cosine + (z2.x + y2.z))));
    k.adj_aa = ((l12 + l34 * z2.z) + (straight.x * y2.x + straight.y * x2.y)) + (crossed.x * y2.y + crossed.y * x2.x);
    k.adj_bb = ((l34 + l12 * z2.z) + (straight.x * x2.y + straight.y * y2.x)) + (crossed.x * x2.x + crossed.y * y2.y);
    k.adj_ab = k.m2 * z.z + ((straight.x * (z.x * x.z * x.x) + straight.y * (z.y * y.z * y.y)) +
                             (crossed.y * (z.x * y.z * y.x) + crossed.x * (z.y * x.z * x.y)));
    k.cosine = z.z;
    return k;
}

// Of the product as a density: tau, and the means of za.w zb.w, (za.w)^2 and (zb.w)^2
struct lobe_asg_means {
    float tau, ab, aa, bb, scale;
};

// Moments of the Bingham density at a saddlepoint tau, which is one step of Halley's
lobe_asg_means lobe_asg_means_of(lobe_asg_pair k) {
    lobe_asg_means m;
    float inverse = 1.0 / (k.m2 + 1.0), rest = k.m2 - k.trace, tau = 1.321882 - k.det * inverse;
    float bend = tau + (k.trace - 1.5);
    float value = inverse * ((bend * tau + rest) * tau + (k.det - 0.5 * k.m2));
    float slope = inverse * ((tau + 2.0 * bend) * tau + rest);
    bend = inverse * (2.0 * tau + bend);
    tau -= value * slope / (slope * slope - value * bend);
    float d = max((1.5 * tau + k.trace) * tau + 0.5 * k.m2, 0.1 + 1e-5 * k.m2);
    float e3 = 0.125 / d, e2 = clamp(2.0 * e3 * (k.trace + 3.0 * tau), 0.0, 0.333333333);
    float g0 = e3 * (-5.7050055 + 20.2053852 * e2);
    float g1 = (0.6530841 + e3 * 24.4494396) + e2 * (8.625987 - 21.598515 * e2 - e3 * 72.7179849);
    float g2 = (0.2046798 - e3 * 23.1662322) + e2 * (-8.492826 + 13.444353 * e2 + e3 * 88.421949);
    float g = 4.0 * e3 * (g1 + g2), u = g2 * e3;
    float v = tau * (k.trace + tau) * g + (g0 + (2.0 * tau * u - g2 * e2));
    u = 2.0 * u - tau * g;
    m.tau = tau;
    m.ab = v * k.cosine + g * k.adj_ab;
    m.aa = v + (u * k.quad_a + g * k.adj_aa);
    m.bb = v + (u * k.quad_b + g * k.adj_bb);
    m.scale = d - 2.0 * d * e2;
    return m;
}

// The mean of max(za.w, 0) max(zb.w, 0) by the arc-cosine kernel; square: e^-tau of what its root is to be times
float lobe_asg_clamped_mean(lobe_asg_means m, out float square) {
    float c = m.ab, size = abs(c), whole = max(m.aa * m.bb, 1e-30), root = sqrt(whole);
    float apart = max((root - c) * (root + c), 0.0), area = whole + size * (1.5707963 * root + 0.4292037 * size);
    float inverse = 1.0 / (area * m.scale);
    square = area * inverse;
    return min(0.5 * max(c, 0.0) + 0.159154943 * (apart * sqrt(apart)) * (m.scale * inverse), 2.0);
}

// Integral of the product of two ASGs over the sphere
float asg_product_integral(asg_lobe a, asg_lobe b) {
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(a, b));
    float square, mean = lobe_asg_clamped_mean(m, square);
    return 3.14159265 * mean * sqrt(square) * lobe_asg_exp((a.log_amplitude + b.log_amplitude) + m.tau);
}

// Xu's integral of the product of two ASGs, its smallest eigenvalue by Laguerre's steps
float asg_product_integral_xu(asg_lobe a, asg_lobe b) {
    lobe_asg_pair k = lobe_asg_pair_of(a, b);
    float low = 0.0, inverse = 1.0 / (k.m2 + 1.0), gap;
    for (int i = 0; i < 2; i++) {
        float p = inverse * (((k.trace - low) * low - k.m2) * low + k.det);
        float p1 = inverse * (k.m2 - (2.0 * k.trace - 3.0 * low) * low), p2 = inverse * (k.trace - 3.0 * low);
        low += 3.0 * p / (p1 + 2.0 * sqrt(max(p1 * p1 - 3.0 * p * p2, 0.0)) + 1e-30);
        low = clamp(low, 0.0, 0.333333333 * k.trace);
    }
    gap = max(k.m2 - (2.0 * k.trace - 3.0 * low) * low, 1e-8); // product of the other two, less low each
    return 3.14159265 * lobe_asg_exp(a.log_amplitude + b.log_amplitude - low) / sqrt(gap) *
           clamp((k.adj_ab - low * (k.trace - low) * k.cosine) / gap, 0.0, 1.0);
}

// An ASG blurred by a normalised SG kernel of sharpness kappa
asg_lobe asg_convolve(asg_lobe a, float kappa) {
    asg_lobe result = a;
    float scale = 2.0 / max(kappa, 1e-8), rx = a.sharpness_x * scale, ry = a.sharpness_y * scale;
    result.sharpness_x = a.sharpness_x / (1.0 + rx);
    result.sharpness_y = a.sharpness_y / (1.0 + ry);
    result.log_amplitude = a.log_amplitude - 0.5 * (lobe_log(1.0 + rx) + lobe_log(1.0 + ry));
    return result;
}

// ---- reflection lobes ----

// Frame of a reflection lobe: z the mirror direction, y perpendicular to it and to the normal, x on the normal's side
asg_lobe lobe_asg_mirror(float3 normal, float3 wi, float cos_theta) {
    asg_lobe a;
    float3 u, v;
    a.z = lobe_normalize_or(normal * (2.0 * cos_theta) - wi, normal);
    lobe_frame(a.z, u, v);
    float2 turn = float2(dot(normal, u), dot(normal, v));
    float size = sqrt(dot(turn, turn));
    turn = size > 1e-15 ? turn * (1.0 / size) : float2(1.0, 0.0);
    a.x = u * turn.x + v * turn.y;
    a.y = v * turn.x - u * turn.y;
    a.sharpness_x = 0.0;
    a.sharpness_y = 0.0;
    a.log_amplitude = 0.0;
    return a;
}

// 1 / alpha^2 of a roughness
float lobe_asg_half_sharpness(float alpha) {
    float inverse = 1.0 / max(alpha, 1e-4);
    return inverse * inverse;
}

// Reflection lobe of an isotropic microfacet BRDF, peak 1, from h of a distribution like exp(-h sin^2) of half vectors
asg_lobe asg_reflection_lobe(float3 normal, float3 wi, float half_sharpness) {
    float cos_theta = dot(wi, normal), across = 1.0 / max(abs(cos_theta), 1e-4);
    asg_lobe a = lobe_asg_mirror(normal, wi, cos_theta);
    a.sharpness_x = 0.25 * half_sharpness;
    a.sharpness_y = a.sharpness_x * across * across;
    return a;
}

// The same of an anisotropic one; the tangent is perpendicular to the normal; x becomes the lobe's wider axis
asg_lobe asg_reflection_lobe_aniso(float3 normal, float3 tangent, float3 wi, float half_sharpness_x, float half_sharpness_y) {
    float cos_theta = dot(wi, normal), stretch = 1.0 / max(abs(cos_theta), 1e-4);
    asg_lobe a = lobe_asg_mirror(normal, wi, cos_theta), turned = a;
    float3 along = cross(a.y, normal), bitangent = cross(normal, tangent);
    float2 g = 0.5 * sqrt(float2(half_sharpness_x, half_sharpness_y));
    float2 px = g * float2(dot(along, tangent), dot(along, bitangent));
    float2 py = g * float2(dot(a.y, tangent), dot(a.y, bitangent)) * stretch;
    float spread = 0.5 * dot(px - py, px + py), mixed = dot(px, py), radius = sqrt(spread * spread + mixed * mixed);
    float largest = 0.5 * (dot(px, px) + dot(py, py)) + radius, area = g.x * stretch * g.y;
    float2 turn = spread > 0.0 ? float2(mixed, radius + spread) : float2(radius - spread, mixed);
    float size = sqrt(dot(turn, turn));
    turn = size > 1e-15 ? turn * (1.0 / size) : float2(1.0, 0.0);
    turned.x = a.x * turn.x - a.y * turn.y;
    turned.y = a.x * turn.y + a.y * turn.x;
    turned.sharpness_x = area * (area / max(max(largest, area), 1e-30)); // determinant: area^2
    turned.sharpness_y = largest;
    return turned;
}

// For GGX of an alpha, which counts as at least 1e-4
asg_lobe asg_ggx_lobe(float3 normal, float3 wi, float alpha) {
    return asg_reflection_lobe(normal, wi, lobe_asg_half_sharpness(alpha));
}

// For anisotropic GGX; the tangent is the direction of alpha_x
asg_lobe asg_ggx_lobe_aniso(float3 normal, float3 tangent, float3 wi, float alpha_x, float alpha_y) {
    return asg_reflection_lobe_aniso(normal, tangent, wi, lobe_asg_half_sharpness(alpha_x),
                                     lobe_asg_half_sharpness(alpha_y));
}

// For Beckmann: the same curvature at the peak
asg_lobe asg_beckmann_lobe(float3 normal, float3 wi, float alpha) {
    return asg_ggx_lobe(normal, wi, alpha);
}

// For anisotropic Beckmann
asg_lobe asg_beckmann_lobe_aniso(float3 normal, float3 tangent, float3 wi, float alpha_x, float alpha_y) {
    return asg_ggx_lobe_aniso(normal, tangent, wi, alpha_x, alpha_y);
}

// For Ward's BRDF, without its 1 / sqrt(cos cos)
asg_lobe asg_ward_lobe(float3 normal, float3 tangent, float3 wi, float alpha_x, float alpha_y) {
    return asg_ggx_lobe_aniso(normal, tangent, wi, alpha_x, alpha_y);
}

// For a Blinn-Phong exponent
asg_lobe asg_phong_lobe(float3 normal, float3 wi, float exponent) {
    return asg_reflection_lobe(normal, wi, 0.5 * exponent);
}

// For Ashikhmin and Shirley's exponents along the tangent (x) and across
asg_lobe asg_ashikhmin_lobe(float3 normal, float3 tangent, float3 wi, float exponent_x, float exponent_y) {
    return asg_reflection_lobe_aniso(normal, tangent, wi, 0.5 * exponent_x, 0.5 * exponent_y);
}

// ---- virtual spherical Gaussian lights ----

// Light of one component of a virtual SG light reflected by a GGX surface, per unit of its intensity and of Fresnel
// reflectance; reflection is asg_ggx_lobe(normal, wi, alpha), once for all lights
float asg_vsgl_specular(vsgl v, int component, float3 place, float3 normal, float3 wi, float alpha, asg_lobe reflection) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, inverse_variance);
    float nu = 0.5 * g.sharpness, lx = reflection.sharpness_x, ly = reflection.sharpness_y;
    float ix = 1.0 / sqrt(max(lx + nu, 0.1)), iy = 1.0 / sqrt(max(ly + nu, 0.1));
    float3 w = lobe_asg_components(reflection, g.axis);
    float loss = lx * (nu * ix * ix) * (w.x * w.x) + ly * (nu * iy * iy) * (w.y * w.y);
    float value = min(lobe_exp(g.log_amplitude + reflection.log_amplitude - loss), 2.2e4);
    float clamped = max(alpha, 1e-4), a2 = clamped * clamped;
    float ci = max(dot(wi, normal), 0.0), co = max(dot(g.axis, normal), 0.0);
    float smith = co * sqrt(a2 + (1.0 - a2) * ci * ci) + ci * sqrt(a2 + (1.0 - a2) * co * co);
    return value * (0.0795774715 * inverse_variance * ix * iy) * max(w.z, 0.0) * co / (a2 * max(smith, 1e-20));
}
