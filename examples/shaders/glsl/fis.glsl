// fis.glsl - filtered importance sampling of 2D images; the functions of fis.h, where each is explained
//
// Conventions: u and v in [0, 1] run over the width and height of the image, texel (x, y) has its centre at
// u = (x + 0.5) / width. A level has half of the size of the one below, rounded up. Its texels are sums over 4^level of
// those of the image, where texels beyond the border count as 0: fis_halve.comp makes them. Errors are within 4 times
// those that fis.h states.
//
// You write the two functions that read texels, after this file. From buffers, level 0 first, of 16 channels say:
//
//    float fis_pdf_texel(fis_pyramid p, int x, int y, int level) { return pdf[fis_texel_index(p, x, y, level)]; }
//    vec4 fis_texel(fis_pyramid p, int x, int y, int level, int plane) {
//        return image[4 * fis_texel_index(p, x, y, level) + plane];
//    }
//
// From textures with mips, whose sizes are the pyramid's where width and height are powers of two:
//
//    float fis_pdf_texel(fis_pyramid p, int x, int y, int level) { return texelFetch(pdf, ivec2(x, y), level).x; }
//    vec4 fis_texel(fis_pyramid p, int x, int y, int level, int plane) {
//        return texelFetch(image, ivec3(x, y, plane), level);
//    }

struct fis_pyramid {
    int width;
    int height;
    int levels; // fis_levels(width, height)
    int base;   // yours: where its texels start, if there are several pyramids
};

struct fis_sample {
    float u;         // kernel centre
    float v;
    float density;   // PDF of its texel over the PDF's mean
    float share[16]; // of the PDF's total, in the texel of each level that it lies in
};

float fis_pdf_texel(fis_pyramid p, int x, int y, int level);
vec4 fis_texel(fis_pyramid p, int x, int y, int level, int plane); // channels 4 plane to 4 plane + 3

// ---- small numerics ----

// 4^level
float lobe_fis_area(int level) {
    return float(1 << 2 * level);
}

// 4^level between two levels too; a GPU's exp2 is good for small numbers only
float lobe_fis_kernel_area(float level) {
    int whole = int(level);
    return lobe_fis_area(whole) * exp2(2.0 * (level - float(whole)));
}

// 2^-level
float lobe_fis_shrink(int level) {
    return uintBitsToFloat(uint(127 - level) << 23);
}

// ceil(size / 2^level)
int lobe_fis_size(int size, int level) {
    return ((size - 1) >> level) + 1;
}

// ---- pyramids ----

// Number of levels of a pyramid
int fis_levels(int width, int height) {
    int levels = 1;
    while (levels < 16 && (lobe_fis_size(width, levels - 1) > 1 || lobe_fis_size(height, levels - 1) > 1)) levels += 1;
    return levels;
}

// The place of a texel in a pyramid that lies level by level in a buffer, in texels
int fis_texel_index(fis_pyramid p, int x, int y, int level) {
    int index = p.base + y * lobe_fis_size(p.width, level) + x;
    for (int below = 0; below < level; below++) index += lobe_fis_size(p.width, below) * lobe_fis_size(p.height, below);
    return index;
}

// x, or 0 where it is NaN or not below 2^96 in magnitude: for level 0 of an image
float lobe_fis_clean(float x) {
    return (floatBitsToUint(x) & 0x7FFFFFFFu) < 0x6F800000u ? x : 0.0;
}

// x, or 0 where it is not in [2^-96, 2^96): for level 0 of a PDF
float lobe_fis_clean_pdf(float x) {
    return floatBitsToUint(x) - 0x0F800000u < 0x60000000u ? x : 0.0;
}

// The PDF's total
float lobe_fis_total(fis_pyramid pdf) {
    return fis_pdf_texel(pdf, 0, 0, pdf.levels - 1) * lobe_fis_area(pdf.levels - 1);
}

// The four texels around a position and where it lies between their centres
struct lobe_fis_taps {
    int left;
    int top;
    int right;
    int bottom;
    float x;
    float y;
};

lobe_fis_taps lobe_fis_locate(fis_pyramid p, float u, float v, int level) {
    lobe_fis_taps taps;
    int width = lobe_fis_size(p.width, level), height = lobe_fis_size(p.height, level);
    float scale = lobe_fis_shrink(level);
    float x = clamp(u * float(p.width) * scale - 0.5, 0.0, float(width - 1));
    float y = clamp(v * float(p.height) * scale - 0.5, 0.0, float(height - 1));
    taps.left = int(x);
    taps.top = int(y);
    taps.right = min(taps.left + 1, width - 1);
    taps.bottom = min(taps.top + 1, height - 1);
    taps.x = x - float(taps.left);
    taps.y = y - float(taps.top);
    return taps;
}

// Unlike mix it leaves two equal numbers as they are.
float lobe_fis_mix(float a, float b, float t) {
    return a + (b - a) * t;
}

// Bilinear lookup of a PDF
float lobe_fis_bilinear(fis_pyramid pdf, float u, float v, int level) {
    lobe_fis_taps taps = lobe_fis_locate(pdf, u, v, level);
    float a = fis_pdf_texel(pdf, taps.left, taps.top, level), b = fis_pdf_texel(pdf, taps.right, taps.top, level);
    float c = fis_pdf_texel(pdf, taps.left, taps.bottom, level), d = fis_pdf_texel(pdf, taps.right, taps.bottom, level);
    return lobe_fis_mix(lobe_fis_mix(a, b, taps.x), lobe_fis_mix(c, d, taps.x), taps.y);
}

// Bilinear lookup of four channels
vec4 lobe_fis_bilinear_plane(fis_pyramid p, float u, float v, int level, int plane) {
    lobe_fis_taps taps = lobe_fis_locate(p, u, v, level);
    vec4 a = fis_texel(p, taps.left, taps.top, level, plane), b = fis_texel(p, taps.right, taps.top, level, plane);
    vec4 c = fis_texel(p, taps.left, taps.bottom, level, plane);
    vec4 d = fis_texel(p, taps.right, taps.bottom, level, plane);
    vec4 above = a + (b - a) * taps.x, below = c + (d - c) * taps.x;
    return above + (below - above) * taps.y;
}

// Trilinear lookup: the mean around a position of the four channels of a plane
vec4 fis_fetch(fis_pyramid p, float u, float v, float level, int plane) {
    float clamped = clamp(level, 0.0, float(p.levels - 1));
    int fine = int(clamped), coarse = min(fine + 1, p.levels - 1);
    vec4 a = lobe_fis_bilinear_plane(p, u, v, fine, plane), b = lobe_fis_bilinear_plane(p, u, v, coarse, plane);
    return a + (b - a) * (clamped - float(fine));
}

// ---- samples ----

// Point of the Fibonacci lattice, 0 <= i < n: by integers, since floats have no room for an i above 2^24
vec2 fis_lattice(int i, int n) {
    uint whole = uint(i), high = whole >> 16, low = whole & 0xFFFFu;
    uint carry = low * 0x7F4Au + high * 0x7C15u + (low * 0x7C15u >> 16);
    uint fraction = whole * 0x9E3779B9u + high * 0x7F4Au + (carry >> 16);
    uint rest = 2u * whole + 1u, divisor = 2u * uint(n), quotient = 0u;
    for (int digit = 0; digit < 25; digit++) { // long division; the rest stays below the divisor, twice it may not fit
        bool fits = rest >= divisor - rest;
        quotient = 2u * quotient + (fits ? 1u : 0u);
        rest = fits ? rest - (divisor - rest) : 2u * rest;
    }
    return vec2(float(min((quotient + 1u) >> 1, 0xFFFFFFu)), float(fraction >> 8)) * (1.0 / 16777216.0);
}

// Which of two masses a number in [0, 1) falls into; the number becomes its position in there.
bool lobe_fis_choose(inout float number, float first, float second) {
    float mass = number * (first + second);
    bool chosen = mass >= first;
    float skipped = chosen ? first : 0.0, kept = chosen ? second : first;
    number = clamp((mass - skipped) / kept, 0.0, 0.99999994);
    return chosen;
}

// Turns a uniform point into a position with the PDF's probability
fis_sample fis_warp(fis_pyramid pdf, vec2 place) {
    fis_sample s;
    float u = clamp(place.x, 0.0, 0.99999994), v = clamp(place.y, 0.0, 0.99999994);
    float total = lobe_fis_total(pdf), margin;
    int x = 0, y = 0;
    for (int level = 15; level >= 0; level--) s.share[level] = level == pdf.levels - 1 ? 1.0 : 0.0;
    for (int level = pdf.levels - 2; level >= 0; level--) {
        x *= 2;
        y *= 2;
        bool right = x + 1 < lobe_fis_size(pdf.width, level), below = y + 1 < lobe_fis_size(pdf.height, level);
        float a = fis_pdf_texel(pdf, x, y, level), b = 0.0, c = 0.0, d = 0.0;
        if (right) b = fis_pdf_texel(pdf, x + 1, y, level);
        if (below) c = fis_pdf_texel(pdf, x, y + 1, level);
        if (right && below) d = fis_pdf_texel(pdf, x + 1, y + 1, level);
        below = lobe_fis_choose(v, a + b, c + d);
        a = below ? c : a;
        b = below ? d : b;
        right = lobe_fis_choose(u, a, b);
        x += right ? 1 : 0;
        y += below ? 1 : 0;
        s.share[level] = (right ? b : a) / total * lobe_fis_area(level);
    }
    margin = float(pdf.width) * (1.0 / 2097152.0);
    s.u = (float(x) + clamp(u, margin, 1.0 - margin)) / float(pdf.width);
    margin = float(pdf.height) * (1.0 / 2097152.0);
    s.v = (float(y) + clamp(v, margin, 1.0 - margin)) / float(pdf.height);
    s.density = s.share[0] * (float(pdf.width) * float(pdf.height));
    return s;
}

// ---- kernel sizes ----

// Share of the PDF's total in the kernel of an integer level
float lobe_fis_share(fis_pyramid pdf, fis_sample s, int level) {
    return lobe_fis_bilinear(pdf, s.u, s.v, level) / lobe_fis_total(pdf) * lobe_fis_area(level);
}

// The root t in [0, 1] of 4^t (a + t (b - a)) = 1, where a < 1 <= 4 b
float lobe_fis_root(float a, float b) {
    float slope = b - a + 1.25, squared = slope * slope - 2.0 * (1.0 - a);
    float t = 2.0 * (1.0 - a) / (slope + sqrt(max(squared, 0.0)));
    for (int i = 0; i < 3; i++) {
        float power = exp2(-2.0 * t), value = a + t * (b - a) - power;
        slope = b - a + 1.38629436 * power;
        squared = slope * slope + 3.84362411 * value * power;
        t -= 2.0 * value / (slope + sqrt(max(squared, 0.0)) + 1e-20);
    }
    return clamp(t, 0.0, 1.0);
}

// Level of the kernel that holds k / n of the PDF's total: fast
float fis_level(fis_pyramid pdf, fis_sample s, int n, float k) {
    float wanted = k / float(n), below, above;
    int top = pdf.levels - 1, low = 0, high;
    while (low < top && s.share[low + 1] < wanted) low += 1;
    high = low;
    below = lobe_fis_share(pdf, s, low);
    above = below;
    while (below >= wanted) {
        if (low == 0) return 0.0;
        high = low;
        above = below;
        low -= 1;
        below = lobe_fis_share(pdf, s, low);
    }
    while (above < wanted) {
        if (high == top) return float(top);
        low = high;
        below = above;
        high += 1;
        above = lobe_fis_share(pdf, s, high);
    }
    return float(low) + lobe_fis_root(below / wanted, 0.25 * above / wanted);
}

// Trilinear lookup of the PDF over its total
float lobe_fis_relative(fis_pyramid pdf, fis_sample s, float level) {
    float clamped = clamp(level, 0.0, float(pdf.levels - 1));
    int fine = int(clamped), coarse = min(fine + 1, pdf.levels - 1);
    float a = lobe_fis_bilinear(pdf, s.u, s.v, fine), b = lobe_fis_bilinear(pdf, s.u, s.v, coarse);
    return lobe_fis_mix(a, b, clamped - float(fine)) / lobe_fis_total(pdf);
}

// The same by bisection, as published: with 12 iterations
float fis_level_bisect(fis_pyramid pdf, fis_sample s, int n, float k, int iterations) {
    float low = 0.0, high = float(pdf.levels - 1), wanted = k / float(n);
    for (int i = 0; i < iterations; i++) {
        float level = 0.5 * (low + high);
        bool small = lobe_fis_kernel_area(level) * lobe_fis_relative(pdf, s, level) < wanted;
        low = small ? level : low;
        high = small ? high : level;
    }
    return 0.5 * (low + high);
}

float lobe_fis_texels(fis_pyramid p) {
    return float(p.width) * float(p.height);
}

// Kernel size where the PDF is p over its mean
float lobe_fis_density_level(fis_pyramid pdf, float p, int n, float k) {
    float area = lobe_fis_texels(pdf) * (k / max(float(n) * p, k));
    return area > 1.0 ? 0.5 * log2(area) : 0.0;
}

// Kernel size from the PDF at the centre, read bilinearly
float fis_level_density(fis_pyramid pdf, fis_sample s, int n, float k) {
    return lobe_fis_density_level(pdf, lobe_fis_share(pdf, s, 0) * lobe_fis_texels(pdf), n, k);
}

// The same from the PDF of the sample's texel
float fis_level_density_nearest(fis_pyramid pdf, fis_sample s, int n, float k) {
    return lobe_fis_density_level(pdf, s.density, n, k);
}

// ---- from means to totals ----

// The factor that makes a kernel's total of a fetched mean; the level is fis_level's or fis_level_bisect's
float fis_scale(fis_pyramid pdf, fis_sample s, float level, int n) {
    float mean = lobe_fis_relative(pdf, s, level);
    return mean > 1e-36 ? 1.0 / (float(n) * mean) : 0.0;
}

// The factor where the PDF is p over its mean
float lobe_fis_density_scale(fis_pyramid pdf, float p, int n) {
    return lobe_fis_texels(pdf) / max(float(n) * p, 1.0);
}

// The same factor from the PDF at the centre, read bilinearly
float fis_scale_density(fis_pyramid pdf, fis_sample s, int n) {
    return lobe_fis_density_scale(pdf, lobe_fis_share(pdf, s, 0) * lobe_fis_texels(pdf), n);
}

// The same factor from the PDF of the sample's texel
float fis_scale_density_nearest(fis_pyramid pdf, fis_sample s, int n) {
    return lobe_fis_density_scale(pdf, s.density, n);
}
