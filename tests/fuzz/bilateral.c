/* Any arguments of bilateral.h's functions: finite and in range in the documented domain, no harm outside of it. */
#include "../../bilateral.h"
#include "bytes.h"

enum { MOST = 300, PLANES = 18, LOBES = 3 };

static asg_lobe any_asg(const char *name) {
    asg_lobe a;
    a.z = bytes_direction(name);
    lobe_frame(a.z, &a.x, &a.y);
    if (!bytes_in_domain) a.x = bytes_direction(name);
    a.sharpness_x = bytes_float("sharpness_x", 0, 1e30f);
    a.sharpness_y = bytes_float("sharpness_y", 0, 1e30f);
    a.log_amplitude = bytes_float("log_amplitude", -1e30f, 1e30f);
    return a;
}

static float any_beta(void) {
    return bytes_float("beta", 1e-3f, 1e3f);
}

static void guides(void) {
    float zi = bytes_float("zi", -1e18f, 1e18f), zj = bytes_float("zj", -1e18f, 1e18f), beta = any_beta();
    float vi = bytes_float("vi", 0, 1e30f), vj = bytes_float("vj", 0, 1e30f);
    float variance = bytes_float("variance", 1e-45f, 1e30f), exponent = bytes_float("exponent", -FLT_MAX, 0);
    lobe_vec3 ni = bytes_direction("ni"), nj = bytes_direction("nj");
    float scale = bilateral_scale(variance), weight;
    bytes_check("bilateral_depth_weight", bilateral_depth_weight(zi, zj, variance), 0, 1);
    bytes_check("bilateral_normal_weight", bilateral_normal_weight(ni, nj, variance), 0, 1);
    weight = bilateral_gaussian_weight(zi, vi, zj, vj, beta);
    bytes_check("bilateral_gaussian_weight", weight, 0, 1);
    bytes_check("bilateral_gaussian_weight the other way", bilateral_gaussian_weight(zj, vj, zi, vi, beta), weight,
                weight);
    bytes_check("bilateral_gaussian_weight of equals", bilateral_gaussian_weight(zi, vi, zi, vi, beta), 1, 1);
    bytes_check("bilateral_scale", scale, 0, FLT_MAX);
    bytes_check("bilateral_depth_exponent", bilateral_depth_exponent(zi, zj), -FLT_MAX, 0);
    bytes_check("bilateral_normal_tap", bilateral_normal_tap(exponent, lobe_scale(ni, scale), lobe_scale(nj, scale)), 0,
                1);
}

static void pairs(void) {
    sg_lobe i[LOBES], j[LOBES], merged;
    asg_lobe a, b;
    float beta = any_beta(), exponent = bytes_float("exponent", -FLT_MAX, 0), weight, product = 0;
    bilateral_sg_part parts_i[LOBES], parts_j[LOBES];
    bilateral_sg pi, pj;
    int ni = bytes_int(1, LOBES), nj = bytes_int(1, LOBES), l, m;
    for (l = 0; l < ni; l++) i[l] = bytes_sg("i", 1e30f, 1e30f);
    for (l = 0; l < nj; l++) j[l] = bytes_sg("j", 1e30f, 1e30f);
    weight = bilateral_sg_weight(i[0], j[0], beta);
    bytes_check("bilateral_sg_weight", weight, 0, 1);
    bytes_check("bilateral_sg_weight the other way", bilateral_sg_weight(j[0], i[0], beta), weight, weight);
    bytes_check("bilateral_sg_weight of equals", bilateral_sg_weight(i[0], i[0], beta), 1, 1);
    pi = bilateral_sg_prepare(i[0], beta);
    pj = bilateral_sg_prepare(j[0], beta);
    bytes_check("bilateral_sg_tap", bilateral_sg_tap(exponent, pi, pj, beta), 0, 1);
    l = bytes_int(1, 15);
    pi = bilateral_sg_prepare(i[0], (float)(2 * l));
    pj = bilateral_sg_prepare(j[0], (float)(2 * l));
    bytes_check("bilateral_sg_tap_power", bilateral_sg_tap_power(exponent, pi, pj, l), 0, 1);
    weight = bilateral_sg_mixture_weight(i, ni, j, nj, beta);
    bytes_check("bilateral_sg_mixture_weight", weight, 0, 1);
    bytes_check("bilateral_sg_mixture_weight of equals", bilateral_sg_mixture_weight(i, ni, i, ni, beta), 1, 1);
    bilateral_sg_mixture_prepare(i, ni, parts_i);
    bilateral_sg_mixture_prepare(j, nj, parts_j);
    for (l = 0; l < ni; l++) {
        for (m = 0; m < nj; m++) {
            float pair = bilateral_sg_pair(parts_i[l], parts_j[m]);
            bytes_check_finite("bilateral_sg_pair", pair);
            product += pair;
        }
    }
    bytes_check("bilateral_sg_mixture_tap", bilateral_sg_mixture_tap(exponent, product, beta), 0, 1);
    merged = bilateral_merge(i, ni);
    bytes_check_sg("bilateral_merge", merged, 1e18f);
    a = any_asg("a");
    b = any_asg("b");
    weight = bilateral_asg_weight(a, b, beta);
    bytes_check("bilateral_asg_weight", weight, 0, 1);
    bytes_check("bilateral_asg_weight of equals", bilateral_asg_weight(a, a, beta), 1, 1);
    bytes_check("bilateral_asg_tap",
                bilateral_asg_tap(exponent, bilateral_asg_prepare(a), bilateral_asg_prepare(b), beta), 0, 1);
}

/* Rows of exactly the memory that they take, of a few pixels over and over */
static float *row(int count) {
    float *values = (float *)malloc((size_t)count * sizeof *values);
    if (!values) abort();
    memset(values, 0, (size_t)count * sizeof *values);
    return values;
}

static void rows(void) {
    float *i[PLANES], *j[PLANES], *sums[PLANES], *more[PLANES], *weight, beta = any_beta();
    int count = bytes_int(1, MOST), which = bytes_int(0, 2), lobes = bytes_int(1, LOBES), channels = bytes_int(1, 3);
    int planes = which == 0 ? 4 : which == 1 ? 6 * lobes : 13, plane, x, p, k;
    weight = row(count);
    for (plane = 0; plane < PLANES; plane++) {
        i[plane] = row(count);
        j[plane] = row(count);
        sums[plane] = row(count);
        more[plane] = row(count);
    }
    for (x = 0; x < count; x++) {
        if (x >= 4) { /* again a pixel of the first */
            for (plane = 0; plane < planes; plane++) {
                i[plane][x] = i[plane][x % 3];
                j[plane][x] = j[plane][x % 4];
            }
            weight[x] = weight[x % 4];
            continue;
        }
        weight[x] = bytes_float("exponent", -FLT_MAX, 0);
        for (p = 0; p < 2; p++) {
            float **to = p ? j : i;
            if (!bytes_in_domain) {
                for (plane = 0; plane < planes; plane++) to[plane][x] = bytes_float("plane", 0, 0);
            } else if (which == 0) {
                bilateral_sg s = bilateral_sg_prepare(bytes_sg("lobe", 1e30f, 1e30f), beta);
                float fields[] = {s.axis.x, s.axis.y, s.axis.z, s.width};
                for (plane = 0; plane < planes; plane++) to[plane][x] = fields[plane];
            } else if (which == 1) {
                sg_lobe lobe[LOBES];
                bilateral_sg_part part[LOBES];
                for (k = 0; k < lobes; k++) lobe[k] = bytes_sg("lobe", 1e30f, 1e30f);
                bilateral_sg_mixture_prepare(lobe, lobes, part);
                for (k = 0; k < lobes; k++) {
                    float fields[] = {part[k].axis.x,    part[k].axis.y,    part[k].axis.z,
                                      part[k].sharpness, part[k].amplitude, part[k].tail};
                    for (plane = 0; plane < 6; plane++) to[6 * k + plane][x] = fields[plane];
                }
            } else {
                bilateral_asg s = bilateral_asg_prepare(any_asg("lobe"));
                float fields[] = {s.x.x, s.x.y, s.x.z,         s.y.x,         s.y.y,          s.y.z,      s.z.x,
                                  s.z.y, s.z.z, s.sharpness_x, s.sharpness_y, s.own_exponent, s.own_scale};
                for (plane = 0; plane < planes; plane++) to[plane][x] = fields[plane];
            }
        }
    }
    if (which == 0) bilateral_sg_taps(count, (const float *const *)i, (const float *const *)j, beta, weight);
    if (which == 1)
        bilateral_sg_mixture_taps(count, lobes, (const float *const *)i, (const float *const *)j, beta, weight);
    if (which == 2) bilateral_asg_taps(count, (const float *const *)i, (const float *const *)j, beta, weight);
    for (x = 0; x < count; x++) bytes_check("a row's weight", weight[x], 0, 1);
    for (plane = 0; plane < channels; plane++) {
        for (x = 0; x < count; x++) {
            i[plane][x] = bytes_in_domain ? 1 : i[plane][x];
            j[plane][x] = bytes_in_domain ? 2 : j[plane][x];
        }
    }
    bilateral_pairs_add(count, weight, channels, (const float *const *)i, (const float *const *)j, sums, more);
    for (x = 0; x < count; x++) {
        bytes_check("bilateral_pairs_add", sums[0][x], 2 * weight[x], 2 * weight[x]);
        bytes_check("bilateral_pairs_add", more[channels - 1][x], weight[x], weight[x]);
        bytes_check("bilateral_pairs_add", more[channels][x], weight[x], weight[x]);
    }
    for (plane = 0; plane < PLANES; plane++) {
        free(i[plane]);
        free(j[plane]);
        free(sums[plane]);
        free(more[plane]);
    }
    free(weight);
}

static void footprints(void) {
    float x = bytes_float("x", -FLT_MAX, FLT_MAX), y = bytes_float("y", -FLT_MAX, FLT_MAX);
    float footprint[4], similarity[4], weight[4], total, sum = 0;
    float count = bytes_float("count", 0, FLT_MAX), most = bytes_float("most", 0, 1e6f);
    int width = 1 + (int)(bytes_bits() % 1048576u), height = 1 + (int)(bytes_bits() % 1048576u), left, top, k;
    bilateral_footprint(x, y, width, height, &left, &top, footprint);
    bytes_check("bilateral_footprint's left", (float)left, -1, (float)width);
    bytes_check("bilateral_footprint's top", (float)top, -1, (float)height);
    for (k = 0; k < 4; k++) {
        int column = left + (k & 1), line = top + (k >> 1);
        bytes_check("bilateral_footprint", footprint[k], 0, 1);
        if (column < 0 || column >= width || line < 0 || line >= height)
            bytes_check("bilateral_footprint outside", footprint[k], 0, 0);
        sum += footprint[k];
        similarity[k] = bytes_float("similarity", 0, 1);
    }
    bytes_check("the sum of bilateral_footprint", sum, 0, 1.000001f);
    total = bilateral_footprint_weights(footprint, similarity, weight);
    bytes_check("bilateral_footprint_weights", total, 0, 1.000001f);
    for (k = 0; k < 4; k++) bytes_check("bilateral_footprint_weights", weight[k], 0, 1.000001f);
    bytes_check("bilateral_history_share", bilateral_history_share(total, count, most), 0, 1 - 0x1p-24f);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    unsigned which;
    bytes_begin(bytes, count);
    which = bytes_byte() % 4;
    if (which == 0) guides();
    if (which == 1) pairs();
    if (which == 2) rows();
    if (which == 3) footprints();
    return 0;
}
