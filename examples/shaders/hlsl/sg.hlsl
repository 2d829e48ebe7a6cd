// sg.glsl - spherical Gaussians and virtual spherical Gaussian lights; the functions of sg.h, where each is explained
//
// Conventions: an SG is G(w) = exp(log_amplitude + sharpness (dot(w, axis) - 1)). Directions have unit length and point
// away from the surface; wi points towards the incoming light. Errors are within 4 times those that sg.h states.

struct sg_lobe {
    float3 axis;
    float sharpness;
    float log_amplitude;
};

static const int VSGL_DIFFUSE = 0;
static const int VSGL_SPECULAR = 1;

// Power-weighted sums over virtual point lights: all linear, so they may be added, scaled and mipmapped.
struct vsgl_moments {
    float3 power[2];          // reflected power, diffuse and specular
    float3 direction[2];      // weight times mean emission direction
    float3 position;          // both weights times position relative to an origin
    float position_squared; // both weights times squared distance from that origin
};

// A cluster of virtual point lights that may be merged with others, at any sharpness and far from the origin.
struct vsgl_cluster {
    float3 power[2];        // reflected power, diffuse and specular
    sg_lobe direction[2]; // axis; weight times mean length; minus what that is short of the weight
    float3 origin;          // a position in the cluster
    float3 offset;          // of the mean position from it
    float spread;         // weight times variance of the position
};

// A virtual spherical Gaussian light. Radiant intensity of a component: intensity[k] * sg_eval(emission[k], w).
struct vsgl {
    float3 position;       // mean
    float variance;      // of the position, length squared
    sg_lobe emission[2]; // peak 1, diffuse and specular
    float3 intensity[2];   // peak radiant intensity
};

// ---- small numerics ----

// v / |v|, the fallback below 1e-18
float3 lobe_normalize_or(float3 v, float3 fallback) {
    float size = sqrt(dot(v, v));
    return size > 1e-18 ? v * (1.0 / size) : fallback;
}

// The mean of three channels: the scalar weight of a colour.
float lobe_mean(float3 colour) {
    return (colour.x + colour.y + colour.z) * 0.333333333;
}

// (2^r - 1) / r for |r| <= 1/2
float lobe_exp2_slope(float r) {
    float r2 = r * r;
    return (0.693147182 + 0.240226477 * r) +
           r2 * ((0.0555035956 + 0.00961850304 * r) + r2 * (0.00133909856 + 0.000153275338 * r));
}

// Finite for any x
float lobe_exp(float x) {
    return exp(min(x, 84.5));
}

// (1 - e^-x) / x for x >= 0; 1 at 0 and below. By e^-x = 2^whole (1 + r slope), so that nothing cancels.
float lobe_phi(float x) {
    float clamped = max(x, 1e-30), y = max(-1.44269504 * clamped, -127.0);
    float whole = floor(y + 0.5), r = y - whole, slope = lobe_exp2_slope(r);
    float power = asfloat(uint(int(whole) + 127) << 23);
    return power * slope * 1.44269504 + (1.0 - power * (1.0 - whole * slope)) / clamped;
}

// ln(1 + f) / f for -.293 <= f <= .415
float lobe_log_slope(float f) {
    float f2 = f * f;
    return 1.0 + f * ((-0.499999911 + 0.333339512 * f) +
                      f2 * ((-0.250017554 + 0.199620724 * f) +
                            f2 * ((-0.165705085 + 0.149179727 * f) + f2 * (-0.143075228 + 0.0873484462 * f))));
}

// ln x; at 0 that of 2^-126, and finite at infinity
float lobe_log(float x) {
    return log(clamp(x, 1.17549435e-38, 3e38));
}

// -ln(1 - x) / x for x in [0, 1]; 1 at 0. By 1 - x = 2^-m (1 + f)
float lobe_log1m_slope(float x) {
    float clamped = clamp(x, 1e-30, 0.999999940);
    int m = 127 - int((asuint(1.0 - clamped) + (0x3F800000u - 0x3F3504F3u)) >> 23);
    float f = float((1 << m) - 1) - clamped * float(1 << m);
    return (0.693147181 * float(m) - f * lobe_log_slope(f)) / clamped;
}

// cos and sin of 2 pi v for v in [0, 1]; those of a GPU may be off by 5e-4
float2 lobe_turn(float v) {
    int quarter = int(4.0 * v + 0.5);
    float r = 4.0 * v - float(quarter), r2 = r * r;
    float s = r * (1.57079637 + r2 * (-0.645963490 + r2 * (0.0796800330 - 0.00460165786 * r2)));
    float c = 1.0 + r2 * (-1.23370051 + r2 * (0.253669232 + r2 * (-0.0208602883 + 0.000904021726 * r2)));
    if (quarter == 1) return float2(-s, c);
    if (quarter == 2) return float2(-c, -s);
    if (quarter == 3) return float2(s, -c);
    return float2(c, s);
}

// Two unit vectors perpendicular to a unit axis and to each other, after Duff et al. 2017
void lobe_frame(float3 axis, out float3 x, out float3 y) {
    float z = axis.z < 0.0 ? -1.0 : 1.0, s = -1.0 / (z + axis.z), t = axis.x * axis.y * s;
    x = float3(1.0 + z * axis.x * axis.x * s, z * t, -z * axis.x);
    y = float3(t, z + axis.y * axis.y * s, -axis.y);
}

// |a - b|^2 of unit vectors, insensitive to a difference of their lengths
float lobe_chord_squared(float3 a, float3 b) {
    float3 d = a - b;
    float along = dot(d, a + b);
    return max(dot(d, d) - 0.25 * along * along, 0.0);
}

// ---- evaluate and integrate ----

// Value in a direction
float sg_eval(sg_lobe g, float3 dir) {
    return lobe_exp(g.log_amplitude - 0.5 * g.sharpness * lobe_chord_squared(g.axis, dir));
}

// Integral of a unit-amplitude SG over the sphere
float sg_integral(float sharpness) {
    return 12.5663706 * lobe_phi(2.0 * sharpness);
}

// The SG with the same axis and sharpness whose integral is 1
sg_lobe sg_normalize(sg_lobe g) {
    sg_lobe result = g;
    result.log_amplitude = -lobe_log(sg_integral(g.sharpness));
    return result;
}

// A direction drawn in proportion to an SG, from u and v in [0, 1]
float3 sg_sample(sg_lobe g, float u, float v) {
    float reach = 2.0 * lobe_phi(2.0 * g.sharpness) * u, slope = lobe_log1m_slope(g.sharpness * reach);
    float t = min(reach * slope, 2.0);
    float2 turn = lobe_turn(v);
    float3 a, b;
    lobe_frame(g.axis, a, b);
    return g.axis * (1.0 - t) + (a * turn.x + b * turn.y) * sqrt(t * (2.0 - t));
}

// Density of sg_sample per solid angle
float sg_pdf(sg_lobe g, float3 dir) {
    return lobe_exp(-0.5 * g.sharpness * lobe_chord_squared(g.axis, dir)) / sg_integral(min(g.sharpness, 1e30));
}

// A lobe's sharpness as the product takes it
float lobe_sharpness(sg_lobe g) {
    return clamp(g.sharpness, 0.0, 1e30);
}

// The axis of a product, unnormalised: the mean of two axes, weighted by their sharpnesses
float3 lobe_product_mean(sg_lobe a, sg_lobe b) {
    float la = lobe_sharpness(a), lb = lobe_sharpness(b), difference = (la - lb) / max(la + lb, 1e-30);
    return 0.5 * ((a.axis + b.axis) + (a.axis - b.axis) * difference);
}

// Sharpness of a product from its mean axis, and log of what the misalignment costs (<= 0), without cancellation
float lobe_product_sharpness(sg_lobe a, sg_lobe b, float3 mean, out float log_loss) {
    float la = lobe_sharpness(a), lb = lobe_sharpness(b), sum = la + lb;
    float sharpness = sum * sqrt(dot(mean, mean)), chord2 = lobe_chord_squared(a.axis, b.axis);
    log_loss = -(la * chord2) * min(lb / max(sharpness + sum, 1e-30), 1.0);
    return sharpness;
}

// The product of two SGs, which is an SG
sg_lobe sg_product(sg_lobe a, sg_lobe b) {
    sg_lobe g;
    float3 mean = lobe_product_mean(a, b);
    float log_loss;
    g.sharpness = lobe_product_sharpness(a, b, mean, log_loss);
    g.log_amplitude = a.log_amplitude + b.log_amplitude + log_loss;
    g.axis = lobe_normalize_or(mean, a.axis);
    return g;
}

// Integral of the product of two SGs over the sphere
float sg_product_integral(sg_lobe a, sg_lobe b) {
    float log_loss, sharpness = lobe_product_sharpness(a, b, lobe_product_mean(a, b), log_loss);
    return lobe_exp(a.log_amplitude + b.log_amplitude + log_loss) * sg_integral(sharpness);
}

// The same after Iwasaki, without a square root; the sum of sharpnesses should be 10 or more
float sg_product_integral_approx(sg_lobe a, sg_lobe b) {
    float inverse = 0.5 / max(a.sharpness + b.sharpness, 1e-8);
    float loss = lobe_chord_squared(a.axis, b.axis) * (a.sharpness * min(b.sharpness * inverse, 1.0));
    return 12.5663706 * inverse * min(lobe_exp(a.log_amplitude + b.log_amplitude - loss), 5e29);
}

// An SG blurred by a normalised SG kernel of sharpness kappa
sg_lobe sg_convolve(sg_lobe g, float kappa) {
    float sharpness = max(g.sharpness, 0.0), ratio = sharpness / max(kappa, 1e-8);
    sg_lobe result = g;
    result.sharpness = sharpness / (1.0 + ratio);
    result.log_amplitude = g.log_amplitude - lobe_log(1.0 + ratio);
    return result;
}

// The clamped cosine's mean over an SG, for the cosine of axis and normal: a fit to 3.1e-5
float lobe_cosine_mean(float sharpness, float cosine) {
    float l = clamp(sharpness, 0.0, 1e18), l2 = l * l, x = min(abs(cosine), 1.0) * l, above = clamp(cosine, 0.0, 1.0);
    float w = sqrt(l2 + 10.080625), z = sqrt((l - x) * (l + x) + 13.883076);
    float u = 3.175 / w, u2 = u * u, r = 1.0 / z, v = sqrt(r), y2 = min(x * (x * r), 100.0);
    float q1 = 1.25318596 + r * (-0.700925667 + r * 3.07821469);
    float q2 = -0.21428287 + r * (-0.126762269 + r * 1.92073004);
    float q3 = 0.0295007156 + r * (-0.063974765 - r * 0.312272612);
    float q4 = -0.00220048637 + r * 0.0151185746;
    float exponent = x * (x / (w + z)) + y2 * (q2 + y2 * q4) + v * (x * (q1 + y2 * q3));
    float peak = (0.39893968 - u * 0.0436513933) + u2 * (0.107626766 + u * 0.0196575116);
    float slope = (-0.31499975 + u * 0.503122666) +
                  u2 * ((-0.341972456 + u * 0.444359873) + u2 * (-0.313914669 + u * 0.0817299432));
    float short_by = u * (3.175 / (w + l)), loss = short_by + (short_by - 1.0) * (u * slope);
    if (l < 0.1) // Legendre's expansion
        return 0.25 + l * (cosine * (0.166666667 - 0.0111111111 * l2) + l * (0.03125 * (cosine * cosine) - 0.0104166667));
    return peak * v * lobe_exp(-exponent) + (above - above * loss);
}

// The same by a shorter fit, to 4.5e-4
float lobe_cosine_mean_approx(float sharpness, float cosine) {
    float l = clamp(sharpness, 0.0, 1e18), x = min(abs(cosine), 1.0) * l;
    float h = (l + 2.57784986) / (l * (l + 2.49227571) + 7.00595474), h2 = h * h, v = sqrt(h), y2 = x * (x * h);
    float even = ((-1.31730588 - h * 0.65896567) + h2 * (4.65359893 - h * 7.03151852)) +
                 y2 * ((-0.648479621 + h * 0.7934065) - y2 * 0.110719097);
    float odd = (-1.76199382 + h * 0.447495883) + y2 * (0.299139938 - h * 1.17481288);
    float mean = l * h * (1.0 + h * (-1.03907259 + h * (5.65793909 - h * 9.70163327)));
    return v * exp2(max(even + v * (x * odd), -127.0)) + mean * max(cosine, 0.0);
}

// Integral of an SG times max(dot(w, normal), 0) over the sphere
float sg_cosine_integral(sg_lobe g, float3 normal) {
    return lobe_exp(g.log_amplitude) * sg_integral(g.sharpness) * lobe_cosine_mean(g.sharpness, dot(g.axis, normal));
}

// The same by a shorter fit
float sg_cosine_integral_approx(sg_lobe g, float3 normal) {
    return lobe_exp(g.log_amplitude) * sg_integral(g.sharpness) *
           lobe_cosine_mean_approx(g.sharpness, dot(g.axis, normal));
}

// Toksvig: length of the mean direction of a normalised SG
float sg_mean_length(float sharpness) {
    float clamped = max(sharpness, 0.0);
    return clamped / (clamped + 1.0);
}

// Its inverse, at most 2^25
float sg_sharpness_from_mean_length(float mean_length) {
    float clamped = clamp(mean_length, 0.0, 1.0);
    return clamped / max(1.0 - clamped, 2.98023224e-8);
}

// ---- reflection lobes ----

// The Lambert reflection lobe as a normalised SG of sharpness 2
sg_lobe sg_diffuse_lobe(float3 normal) {
    sg_lobe g;
    g.axis = normal;
    g.sharpness = 2.0;
    g.log_amplitude = -1.12624444;
    return g;
}

// Reflection lobe of a microfacet BRDF, peak 1, from the SG sharpness of its normal distribution
sg_lobe sg_reflection_lobe(float3 normal, float3 wi, float half_sharpness) {
    sg_lobe g;
    float cos_theta = dot(wi, normal);
    g.axis = lobe_normalize_or(normal * (2.0 * cos_theta) - wi, normal);
    g.sharpness = min(max(half_sharpness, 0.0) / (4.0 * max(abs(cos_theta), 1e-4)), 1e30);
    g.log_amplitude = 0.0;
    return g;
}

// sg_reflection_lobe for GGX of an alpha, which counts as at least 1e-4
sg_lobe sg_ggx_lobe(float3 normal, float3 wi, float alpha) {
    float clamped = max(alpha, 1e-4);
    return sg_reflection_lobe(normal, wi, 2.0 / (clamped * clamped));
}

// For Beckmann: the same curvature at the peak
sg_lobe sg_beckmann_lobe(float3 normal, float3 wi, float alpha) {
    return sg_ggx_lobe(normal, wi, alpha);
}

// For a Blinn-Phong exponent
sg_lobe sg_phong_lobe(float3 normal, float3 wi, float exponent) {
    return sg_reflection_lobe(normal, wi, exponent);
}

// ---- virtual spherical Gaussian lights ----

// The sums of one virtual point light; the offset is its position relative to an origin nearby
vsgl_moments vsgl_moments_from_vpl(float3 offset, float3 normal, float3 wi, float3 diffuse, float3 specular, float alpha) {
    vsgl_moments m;
    float wd = lobe_mean(diffuse), ws = lobe_mean(specular);
    sg_lobe lobe = sg_ggx_lobe(normal, wi, alpha);
    m.power[VSGL_DIFFUSE] = diffuse;
    m.power[VSGL_SPECULAR] = specular;
    m.direction[VSGL_DIFFUSE] = normal * (wd * sg_mean_length(2.0));
    m.direction[VSGL_SPECULAR] = lobe.axis * (ws * sg_mean_length(lobe.sharpness));
    m.position = offset * (wd + ws);
    m.position_squared = dot(offset, offset) * (wd + ws);
    return m;
}

// Entry by entry
vsgl_moments vsgl_moments_add(vsgl_moments a, vsgl_moments b) {
    vsgl_moments m;
    m.power[0] = a.power[0] + b.power[0];
    m.power[1] = a.power[1] + b.power[1];
    m.direction[0] = a.direction[0] + b.direction[0];
    m.direction[1] = a.direction[1] + b.direction[1];
    m.position = a.position + b.position;
    m.position_squared = a.position_squared + b.position_squared;
    return m;
}

// Entry by entry
vsgl_moments vsgl_moments_scale(vsgl_moments m, float s) {
    vsgl_moments scaled;
    scaled.power[0] = m.power[0] * s;
    scaled.power[1] = m.power[1] * s;
    scaled.direction[0] = m.direction[0] * s;
    scaled.direction[1] = m.direction[1] * s;
    scaled.position = m.position * s;
    scaled.position_squared = m.position_squared * s;
    return scaled;
}

// One component's lobe
sg_lobe lobe_vsgl_emission(float3 power, float3 direction) {
    sg_lobe g;
    float3 mean = direction * (1.0 / max(lobe_mean(power), 1e-30));
    g.axis = lobe_normalize_or(mean, float3(0.0, 0.0, 1.0));
    g.sharpness = sg_sharpness_from_mean_length(min(sqrt(dot(mean, mean)), 1.0));
    g.log_amplitude = 0.0;
    return g;
}

// The virtual SG light of a cluster from its sums; the origin is that of the positions
vsgl vsgl_from_moments(vsgl_moments m, float3 origin) {
    vsgl v;
    float inverse = 1.0 / max(lobe_mean(m.power[0]) + lobe_mean(m.power[1]), 1e-30);
    float3 mean = m.position * inverse;
    v.position = origin + mean;
    v.variance = max(m.position_squared * inverse - dot(mean, mean), 0.0);
    v.emission[0] = lobe_vsgl_emission(m.power[0], m.direction[0]);
    v.emission[1] = lobe_vsgl_emission(m.power[1], m.direction[1]);
    v.intensity[0] = m.power[0] * (1.0 / sg_integral(v.emission[0].sharpness));
    v.intensity[1] = m.power[1] * (1.0 / sg_integral(v.emission[1].sharpness));
    return v;
}

// The cluster of one virtual point light; its position may be far from 0
vsgl_cluster vsgl_cluster_from_vpl(float3 position, float3 normal, float3 wi, float3 diffuse, float3 specular, float alpha) {
    vsgl_cluster c;
    sg_lobe lobe = sg_ggx_lobe(normal, wi, alpha);
    float dd = lobe_mean(diffuse) / 3.0, ds = lobe_mean(specular) / (lobe.sharpness + 1.0);
    c.power[VSGL_DIFFUSE] = diffuse;
    c.power[VSGL_SPECULAR] = specular;
    c.direction[VSGL_DIFFUSE].axis = normal;
    c.direction[VSGL_DIFFUSE].sharpness = 2.0 * dd;
    c.direction[VSGL_DIFFUSE].log_amplitude = -dd;
    c.direction[VSGL_SPECULAR].axis = lobe.axis;
    c.direction[VSGL_SPECULAR].sharpness = lobe.sharpness * ds;
    c.direction[VSGL_SPECULAR].log_amplitude = -ds;
    c.origin = position;
    c.offset = float3(0.0, 0.0, 0.0);
    c.spread = 0.0;
    return c;
}

// The union of two clusters
vsgl_cluster vsgl_cluster_merge(vsgl_cluster a, vsgl_cluster b) {
    vsgl_cluster c;
    float wa = lobe_mean(a.power[0]) + lobe_mean(a.power[1]), wb = lobe_mean(b.power[0]) + lobe_mean(b.power[1]);
    float inverse = 1.0 / max(wa + wb, 1e-30);
    bool first = wa >= wb;
    float3 apart = (b.origin - a.origin) + (b.offset - a.offset);
    c.power[0] = a.power[0] + b.power[0];
    c.power[1] = a.power[1] + b.power[1];
    c.direction[0] = sg_product(a.direction[0], b.direction[0]);
    c.direction[1] = sg_product(a.direction[1], b.direction[1]);
    c.origin = first ? a.origin : b.origin;
    c.offset = (first ? a.offset : b.offset) + apart * ((first ? wb : -wa) * inverse);
    c.spread = a.spread + b.spread + wa * (wb * inverse) * dot(apart, apart);
    return c;
}

// Toksvig's r / (1 - r) from both, each times the weight
float lobe_cluster_sharpness(sg_lobe direction) {
    return min(direction.sharpness / max(-direction.log_amplitude, 1e-37), 1e18);
}

// The virtual SG light of a cluster
vsgl vsgl_from_cluster(vsgl_cluster c) {
    vsgl v;
    v.position = c.origin + c.offset;
    v.variance = c.spread / max(lobe_mean(c.power[0]) + lobe_mean(c.power[1]), 1e-30);
    v.emission[0].axis = c.direction[0].axis;
    v.emission[1].axis = c.direction[1].axis;
    v.emission[0].sharpness = lobe_cluster_sharpness(c.direction[0]);
    v.emission[1].sharpness = lobe_cluster_sharpness(c.direction[1]);
    v.emission[0].log_amplitude = 0.0;
    v.emission[1].log_amplitude = 0.0;
    v.intensity[0] = c.power[0] * (1.0 / sg_integral(v.emission[0].sharpness));
    v.intensity[1] = c.power[1] * (1.0 / sg_integral(v.emission[1].sharpness));
    return v;
}

// The incoming lobe but for its factor inverse_variance / (2 pi)
sg_lobe lobe_vsgl_incoming(vsgl v, int component, float3 place, out float inverse_variance) {
    sg_lobe g;
    float3 offset = v.position - place, back = -v.emission[component].axis;
    float squared = dot(offset, offset), inverse = 1.0 / sqrt(max(squared, 1e-30));
    float sharpness = v.emission[component].sharpness, weight = min(v.variance * sharpness, 1e18);
    float chord2 = lobe_chord_squared(offset * inverse, back);
    float3 pull = offset * (squared * inverse) + back * weight;
    float size = sqrt(dot(pull, pull));
    inverse_variance = 1.0 / max(v.variance, 1e-20);
    g.axis = lobe_normalize_or(pull, back);
    g.sharpness = size * inverse_variance;
    g.log_amplitude = -(sharpness * chord2) * min(squared / max(size + squared + weight, 1e-30), 1.0);
    return g;
}

// Radiance that arrives at a point from one component of a light, over v.intensity[component]
sg_lobe vsgl_incoming_lobe(vsgl v, int component, float3 place) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, inverse_variance);
    g.log_amplitude += lobe_log(inverse_variance * 0.159154943);
    return g;
}

// Light of an incoming lobe reflected by a white Lambert surface that it meets head-on
float lobe_vsgl_flux(sg_lobe g, float inverse_variance) {
    return 0.636619772 * lobe_exp(g.log_amplitude) * min(inverse_variance * lobe_phi(2.0 * g.sharpness), 1e30);
}

// Light of one component reflected by a Lambert surface, over v.intensity[component] and albedo: constant cosine
float vsgl_diffuse(vsgl v, int component, float3 place, float3 normal) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, inverse_variance);
    return lobe_vsgl_flux(g, inverse_variance) * max(dot(g.axis, normal), 0.0);
}

// The same with the cosine integrated over the lobe
float vsgl_diffuse_integral(vsgl v, int component, float3 place, float3 normal) {
    float inverse_variance;
    sg_lobe g = lobe_vsgl_incoming(v, component, place, inverse_variance);
    return lobe_vsgl_flux(g, inverse_variance) * lobe_cosine_mean(g.sharpness, dot(g.axis, normal));
}

// ---- virtual spherical lights ----

// The solid angle of a virtual spherical light seen from a point, as an SG whose integral is half of it
sg_lobe vsl_lobe(float3 center, float radius, float3 place) {
    sg_lobe g;
    float3 offset = center - place;
    float sine2 = min(radius * radius / max(dot(offset, offset), 1e-30), 1.0);
    g.axis = lobe_normalize_or(offset, float3(0.0, 0.0, 1.0));
    g.sharpness = 2.0 * (1.0 + sqrt(1.0 - sine2)) / max(sine2, 4e-18);
    g.log_amplitude = 0.0;
    return g;
}
