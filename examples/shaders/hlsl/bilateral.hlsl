// bilateral.glsl - weights of filters and upsamplers that know the reflection lobes; the functions of bilateral.h,
// where each is explained
//
// Conventions: a weight is in [0, 1], and 1 for equal pixels. Weights of lobes are q^beta of a similarity q. An
// "exponent" is one of base 2, at most 0: the logarithm of all that a tap's weight has beside its lobes. Prepare a
// pixel's lobe once, scale its depth by bilateral_scale, and use the functions called _tap for each tap. Errors are
// within 4 times those that bilateral.h states.

// A pixel's lobe for Eq. 12.
struct bilateral_sg {
    float3 axis;   // times bilateral_scale(1 / beta)
    float width; // 1 / sharpness
};

// One of a pixel's lobes for Eq. 11.
struct bilateral_sg_part {
    float3 axis;
    float sharpness, amplitude; // so that the mixture's product with itself integrates to 1
    float tail;                 // exp(-2 sharpness), 0 for a sharpness of 16 or more
};

// A pixel's lobe for Eq. 13.
struct bilateral_asg {
    float3 x, y, z;
    float sharpness_x, sharpness_y;
    float own_exponent, own_scale; // of the lobe's product with itself
};

// ---- private helpers ----

// x^n for n in 0 .. 15
float lobe_bilateral_power(float x, int n) {
    float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return ((n & 1) != 0 ? x : 1.0) * ((n & 2) != 0 ? x2 : 1.0) *
           (((n & 4) != 0 ? x4 : 1.0) * ((n & 8) != 0 ? x8 : 1.0));
}

// The overlap 4 ti tj / (ti + tj)^2 of two widths, given 1 / (ti + tj): 1 for equal ones
float lobe_bilateral_overlap(float ti, float tj, float inverse) {
    return min(4.00000191 * ((ti * inverse) * (tj * inverse)), 1.0);
}

float lobe_bilateral_squared(float3 a, float3 b) {
    float3 d = a - b;
    return dot(d, d);
}

// ---- weights of two pixels ----

// Similarity of two depths
float bilateral_depth_weight(float zi, float zj, float variance) {
    float d = min(abs(zi - zj) / sqrt(max(variance, 1e-30)), 1e15);
    return lobe_exp(-0.5 * d * d);
}

// Similarity of two normals
float bilateral_normal_weight(float3 ni, float3 nj, float variance) {
    return lobe_exp(-0.5 * lobe_chord_squared(ni, nj) / max(variance, 1e-30));
}

// Similarity of two guides that have a mean and a variance each
float bilateral_gaussian_weight(float mi, float vi, float mj, float vj, float beta) {
    float ti = clamp(vi, 1e-18, 1e15), tj = clamp(vj, 1e-18, 1e15), inverse = 1.0 / (ti + tj), d = mi - mj;
    return exp2(beta * (0.25 * log2(lobe_bilateral_overlap(ti, tj, inverse)) -
                        0.721347520 * min(d * d, 1e15) * inverse));
}

// ln of the integral of the product of two mixtures over 4 pi, amplitudes over e^top
float lobe_bilateral_log_product(sg_lobe i[4], int ni, float top_i, sg_lobe j[4], int nj, float top_j) {
    float top = -1e30, sum = 0.0;
    for (int l = 0; l < ni; l++) {
        for (int m = 0; m < nj; m++) {
            float log_loss, sharpness = lobe_product_sharpness(i[l], j[m], lobe_product_mean(i[l], j[m]), log_loss);
            float term = ((i[l].log_amplitude - top_i) + (j[m].log_amplitude - top_j)) +
                         (log_loss + lobe_log(lobe_phi(2.0 * sharpness)));
            float last = top;
            top = max(top, term);
            sum = sum * lobe_exp(last - top) + lobe_exp(term - top);
        }
    }
    return top + lobe_log(sum);
}

float lobe_bilateral_top(sg_lobe lobes[4], int count) {
    float top = -1e30;
    for (int l = 0; l < count; l++) top = max(top, lobes[l].log_amplitude);
    return top;
}

// Similarity of two sums of SGs, up to 4 each: Eq. 11
float bilateral_sg_mixture_weight(sg_lobe i[4], int ni, sg_lobe j[4], int nj, float beta) {
    float top_i = lobe_bilateral_top(i, ni), top_j = lobe_bilateral_top(j, nj);
    float own_i = lobe_bilateral_log_product(i, ni, top_i, i, ni, top_i);
    float own_j = lobe_bilateral_log_product(j, nj, top_j, j, nj, top_j);
    return lobe_exp(beta * min(lobe_bilateral_log_product(i, ni, top_i, j, nj, top_j) - 0.5 * (own_i + own_j), 0.0));
}

// ---- prepared forms ----

// What guides are multiplied by, so that minus the squared distance is the exponent of their weight
float bilateral_scale(float variance) {
    return sqrt(0.721347520 / max(variance, 1e-30));
}

// Logarithm of Eq. 3, of depths times bilateral_scale(variance)
float bilateral_depth_exponent(float zi, float zj) {
    float d = zi - zj;
    return -(d * d);
}

// A tap's weight with Eq. 4, of normals times bilateral_scale(variance)
float bilateral_normal_tap(float exponent, float3 ni, float3 nj) {
    return exp2(exponent - lobe_bilateral_squared(ni, nj));
}

// A lobe for bilateral_sg_tap and bilateral_sg_tap_power with this beta
bilateral_sg bilateral_sg_prepare(sg_lobe g, float beta) {
    bilateral_sg p;
    p.axis = g.axis * bilateral_scale(1.0 / beta);
    p.width = 1.0 / clamp(g.sharpness, 1e-15, 1e18);
    return p;
}

// A tap's weight with Eq. 12
float bilateral_sg_tap(float exponent, bilateral_sg i, bilateral_sg j, float beta) {
    float inverse = 1.0 / (i.width + j.width);
    float overlap = log2(lobe_bilateral_overlap(i.width, j.width, inverse));
    return exp2(exponent + (0.5 * beta * overlap - lobe_bilateral_squared(i.axis, j.axis) * inverse));
}

// The same for a beta of 2 to 30, without a logarithm
float bilateral_sg_tap_power(float exponent, bilateral_sg i, bilateral_sg j, int half_beta) {
    float inverse = 1.0 / (i.width + j.width), s = (i.width - j.width) * inverse;
    return lobe_bilateral_power(max(1.0 - s * s, 0.0), half_beta) *
           exp2(exponent - lobe_bilateral_squared(i.axis, j.axis) * inverse);
}

// Similarity of two SGs: Eq. 12
float bilateral_sg_weight(sg_lobe i, sg_lobe j, float beta) {
    return bilateral_sg_tap(0.0, bilateral_sg_prepare(i, beta), bilateral_sg_prepare(j, beta), beta);
}

// Integral of the product of one lobe of a pixel and one of another, in the unit of their mixtures: that of an SG of
// sharpness L = |la a + lb b|, all lengths times log2(e); where one has no tail, L is large or the integral nearly 0
float bilateral_sg_pair(bilateral_sg_part a, bilateral_sg_part b) {
    float sum = a.sharpness + b.sharpness;
    float lost = a.sharpness * b.sharpness * lobe_bilateral_squared(a.axis, b.axis);
    float size = sqrt(max(sum * sum - lost, 1e-8 * (sum * sum)));
    float inverse = a.tail * b.tail > 0.0 ? 1.38629436 * lobe_phi(1.38629436 * size) : 1.0 / size;
    return a.amplitude * b.amplitude * inverse * exp2(-lost / (size + sum));
}

// The lobes of a pixel, up to 4, for bilateral_sg_pair; the rest of the parts are of amplitude 0
void bilateral_sg_mixture_prepare(sg_lobe lobes[4], int count, out bilateral_sg_part parts[4]) {
    float top = lobe_bilateral_top(lobes, count), own = 0.0, scale;
    for (int l = 0; l < 4; l++) {
        float sharpness = l < count ? clamp(lobes[l].sharpness, 0.015625, 1e15) : 1.0;
        float3 axis = l < count ? lobes[l].axis : float3(0.0, 0.0, 1.0);
        parts[l].axis = lobe_normalize_or(axis, float3(0.0, 0.0, 1.0)) * 0.9999995; // so that L is not 0
        parts[l].sharpness = 1.44269504 * sharpness;
        parts[l].amplitude = l < count ? lobe_exp(lobes[l].log_amplitude - top) : 0.0;
        parts[l].tail = sharpness < 16.0 ? lobe_exp(-2.0 * sharpness) : 0.0;
    }
    for (int l = 0; l < count; l++) {
        for (int m = 0; m < count; m++) own += bilateral_sg_pair(parts[l], parts[m]);
    }
    scale = sqrt(1.000002 / own); // a little more: q of equal mixtures is to reach 1
    for (int l = 0; l < count; l++) parts[l].amplitude *= scale;
}

// A tap's weight with Eq. 11; product: sum of bilateral_sg_pair over all pairs of lobes
float bilateral_sg_mixture_tap(float exponent, float product, float beta) {
    return exp2(exponent + beta * log2(clamp(product, 1e-30, 1.0)));
}

asg_lobe lobe_bilateral_asg(bilateral_asg p) {
    asg_lobe a;
    a.x = p.x;
    a.y = p.y;
    a.z = p.z;
    a.sharpness_x = p.sharpness_x;
    a.sharpness_y = p.sharpness_y;
    a.log_amplitude = 0.0;
    return a;
}

// A lobe for bilateral_asg_tap, any beta
bilateral_asg bilateral_asg_prepare(asg_lobe a) {
    bilateral_asg p;
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(a, a));
    float square, mean = lobe_asg_clamped_mean(m, square);
    p.x = a.x;
    p.y = a.y;
    p.z = a.z;
    p.sharpness_x = a.sharpness_x;
    p.sharpness_y = a.sharpness_y;
    p.own_scale = 1.00001 / (mean * sqrt(square)); // a little more: q of equal lobes is to reach 1
    p.own_exponent = 0.5 * m.tau;
    return p;
}

// A tap's weight with Eq. 13
float bilateral_asg_tap(float exponent, bilateral_asg i, bilateral_asg j, float beta) {
    lobe_asg_means m = lobe_asg_means_of(lobe_asg_pair_of(lobe_bilateral_asg(i), lobe_bilateral_asg(j)));
    float square, mean = lobe_asg_clamped_mean(m, square);
    float ratio = max(mean * mean * square * (i.own_scale * j.own_scale), 1.17549435e-38);
    float similar = 0.5 * log2(ratio) + 1.44269504 * (m.tau - (i.own_exponent + j.own_exponent));
    return exp2(exponent + beta * min(similar, 0.0));
}

// Similarity of two ASGs: Eq. 13
float bilateral_asg_weight(asg_lobe i, asg_lobe j, float beta) {
    return bilateral_asg_tap(0.0, bilateral_asg_prepare(i), bilateral_asg_prepare(j), beta);
}

// ---- several lobes as one ----

// ln of a lobe's integral
float lobe_bilateral_log_energy(sg_lobe g) {
    return g.log_amplitude + lobe_log(sg_integral(lobe_sharpness(g)));
}

// Several lobes, up to 4, as one of the same integral and mean direction
sg_lobe bilateral_merge(sg_lobe lobes[4], int count) {
    sg_lobe sum, merged, brightest = lobes[0];
    float top = lobe_bilateral_log_energy(brightest), total = 0.0;
    for (int l = 1; l < count; l++) {
        float energy = lobe_bilateral_log_energy(lobes[l]);
        if (energy > top) {
            top = energy;
            brightest = lobes[l];
        }
    }
    float whole = sg_integral(lobe_sharpness(brightest));
    sum.axis = lobes[0].axis;
    sum.sharpness = 0.0;
    sum.log_amplitude = 0.0;
    for (int l = 0; l < count; l++) {
        float sharpness = lobe_sharpness(lobes[l]);
        float energy = lobe_exp(lobes[l].log_amplitude - brightest.log_amplitude) * (sg_integral(sharpness) / whole);
        sg_lobe part;
        part.axis = lobes[l].axis;
        part.log_amplitude = -energy / (sharpness + 1.0);
        part.sharpness = sharpness * -part.log_amplitude;
        sum = sg_product(sum, part);
        total += energy;
    }
    merged.axis = sum.axis;
    merged.sharpness = lobe_cluster_sharpness(sum);
    merged.log_amplitude = brightest.log_amplitude + lobe_log(total * (whole / sg_integral(merged.sharpness)));
    return merged;
}

// ---- upsampling and reprojection ----

// The 2 x 2 taps of bilinear interpolation around a place in pixels of an image, whose centres are at whole numbers:
// the first one's pixel, and weights, 0 outside the image
void bilateral_footprint(float x, float y, int width, int height, out int left, out int top, out float4 weight) {
    float2 place = clamp(float2(x, y), float2(-1.0, -1.0), float2(float(width), float(height)));
    float2 first = floor(place + float2(1.0, 1.0)) - float2(1.0, 1.0), far = max(place - first, float2(0.0, 0.0));
    float2 near = float2(1.0, 1.0) - far;
    left = int(first.x);
    top = int(first.y);
    near.x = left >= 0 && left < width ? near.x : 0.0;
    near.y = top >= 0 && top < height ? near.y : 0.0;
    far.x = left + 1 < width ? far.x : 0.0;
    far.y = top + 1 < height ? far.y : 0.0;
    weight = float4(near.x * near.y, far.x * near.y, near.x * far.y, far.x * far.y);
}

// Their joint bilateral weights, given what each tap's similarity is; returns the sum before it is made 1
float bilateral_footprint_weights(float4 footprint, float4 similarity, out float4 weight) {
    float4 product = footprint * similarity;
    float total = (product.x + product.y) + (product.z + product.w);
    weight = product * (1.0 / max(total, 1e-30));
    return total;
}

// How much of a pixel the reprojected image should make up, of at most so many samples
float bilateral_history_share(float total, float count, float most) {
    float old = max(total, 0.0) * max(min(count, most), 0.0);
    return old / (old + 1.0);
}
