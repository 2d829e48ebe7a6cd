/* filter_loops.c - the loops of filter.h: ours, which must become vector code, and the papers' as printed */
#include "filter.h"

#define AT(k, x) in->plane[k][x]
#define VECTOR(k, x) lobe_vector(AT(k, x), AT((k) + 1, x), AT((k) + 2, x))

/* One tap for each pixel of the row: the body sets the weight w of pixels i and j. In a function of its own, since gcc
   jams the loops of two taps into one, which takes twice as long. */
#ifdef __GNUC__
#define NOT_INLINE __attribute__((noinline))
#else
#define NOT_INLINE
#endif
#define FILTER_LOOP(name, ...)                                                                                         \
    static NOT_INLINE void name(const filter_image *restrict in, float exponent, float factor, int first, int offset,  \
                                float beta, filter_sums *restrict out) {                                               \
        int x;                                                                                                         \
        (void)exponent, (void)factor, (void)beta;                                                                      \
        for (x = 0; x < FILTER_ROW; x++) {                                                                             \
            const int i = first + x, j = i + offset;                                                                   \
            float w;                                                                                                   \
            __VA_ARGS__                                                                                                \
            out->sum[0][i] += w * AT(PLANE_COLOUR, j);                                                                 \
            out->sum[1][i] += w * AT(PLANE_COLOUR + 1, j);                                                             \
            out->sum[2][i] += w * AT(PLANE_COLOUR + 2, j);                                                             \
            out->sum[3][i] += w;                                                                                       \
        }                                                                                                              \
    }                                                                                                                  \
    BENCH_FUNCTION(name)                                                                                               \
    (const filter_image *restrict in, const filter_kernel *restrict kernel, int first, float beta,                     \
     filter_sums *restrict out) {                                                                                      \
        int t;                                                                                                         \
        for (t = 0; t < FILTER_TAPS; t++) {                                                                            \
            name(in, kernel->exponent[t], kernel->factor[t], first, kernel->offset[t], beta, out);                     \
        }                                                                                                              \
    }

static inline bilateral_sg sg_at(const filter_image *restrict in, int x) {
    bilateral_sg p;
    p.axis = VECTOR(PLANE_SG, x);
    p.width = AT(PLANE_SG + 3, x);
    return p;
}

/* ---- ours: a tap at a time ---- */

#define EXPONENT (exponent + bilateral_depth_exponent(AT(PLANE_DEPTH, i), AT(PLANE_DEPTH, j)))

FILTER_LOOP(our_eq4, w = bilateral_normal_tap(EXPONENT, VECTOR(PLANE_NORMAL, i), VECTOR(PLANE_NORMAL, j));)
FILTER_LOOP(our_eq12_even, w = bilateral_sg_tap_power(EXPONENT, sg_at(in, i), sg_at(in, j), FILTER_BETA / 2);)
FILTER_LOOP(our_eq12, w = bilateral_sg_tap(EXPONENT, sg_at(in, i), sg_at(in, j), beta);)

/* ---- ours: a row of weights, summed for one pixel of each pair or for both ---- */

typedef void row_weights(int count, const float *const *i, const float *const *j, float beta, float *weight);

static void mixture_row(int count, const float *const *i, const float *const *j, float beta, float *weight) {
    bilateral_sg_mixture_taps(count, FILTER_LOBES, i, j, beta, weight);
}

static inline void filter_rows(const filter_image *restrict in, const filter_kernel *restrict kernel, int first,
                               float beta, filter_sums *restrict out, row_weights *weigh, int plane, int planes,
                               int both) {
    const float *lobes_i[6 * FILTER_LOBES], *lobes_j[6 * FILTER_LOBES], *colours_i[3], *colours_j[3];
    float *sums_i[4], *sums_j[4], weight[FILTER_ROW];
    int t, x, k;
    for (t = 0; t < (both ? FILTER_TAPS / 2 : FILTER_TAPS); t++) {
        const int other = first + kernel->offset[t];
        for (x = 0; x < FILTER_ROW; x++) {
            weight[x] =
                kernel->exponent[t] + bilateral_depth_exponent(AT(PLANE_DEPTH, first + x), AT(PLANE_DEPTH, other + x));
        }
        for (k = 0; k < planes; k++) {
            lobes_i[k] = &AT(plane + k, first);
            lobes_j[k] = &AT(plane + k, other);
        }
        weigh(FILTER_ROW, lobes_i, lobes_j, beta, weight);
        if (!both) {
            for (x = 0; x < FILTER_ROW; x++) {
                out->sum[0][first + x] += weight[x] * AT(PLANE_COLOUR, other + x);
                out->sum[1][first + x] += weight[x] * AT(PLANE_COLOUR + 1, other + x);
                out->sum[2][first + x] += weight[x] * AT(PLANE_COLOUR + 2, other + x);
                out->sum[3][first + x] += weight[x];
            }
            continue;
        }
        for (k = 0; k < 3; k++) {
            colours_i[k] = &AT(PLANE_COLOUR + k, first);
            colours_j[k] = &AT(PLANE_COLOUR + k, other);
        }
        for (k = 0; k < 4; k++) {
            sums_i[k] = &out->sum[k][first];
            sums_j[k] = &out->sum[k][other];
        }
        bilateral_pairs_add(FILTER_ROW, weight, 3, colours_i, colours_j, sums_i, sums_j);
    }
}

#define ROW_FILTER(name, weigh, plane, planes, both)                                                                   \
    BENCH_FUNCTION(name)                                                                                               \
    (const filter_image *restrict in, const filter_kernel *restrict kernel, int first, float beta,                     \
     filter_sums *restrict out) {                                                                                      \
        filter_rows(in, kernel, first, beta, out, weigh, plane, planes, both);                                         \
    }

ROW_FILTER(eq12_rows, bilateral_sg_taps, PLANE_SG, 4, 0)
ROW_FILTER(eq12_pairs, bilateral_sg_taps, PLANE_SG, 4, 1)
ROW_FILTER(eq11_rows, mixture_row, PLANE_MIXTURE, 6 * FILTER_LOBES, 0)
ROW_FILTER(eq11_pairs, mixture_row, PLANE_MIXTURE, 6 * FILTER_LOBES, 1)
ROW_FILTER(eq13_rows, bilateral_asg_taps, PLANE_ASG, 13, 0)
ROW_FILTER(eq13_pairs, bilateral_asg_taps, PLANE_ASG, 13, 1)

/* ---- as printed, with the C library's functions ---- */

static inline float gauss(float squared, float variance) {
    return expf(-squared / (2 * variance));
}

static inline float squared_distance(lobe_vec3 a, lobe_vec3 b) {
    lobe_vec3 d = lobe_sub(a, b);
    return lobe_dot(d, d);
}

#define PRINTED_DEPTH                                                                                                  \
    gauss((AT(PLANE_RAW_DEPTH, i) - AT(PLANE_RAW_DEPTH, j)) * (AT(PLANE_RAW_DEPTH, i) - AT(PLANE_RAW_DEPTH, j)),       \
          FILTER_DEPTH_VARIANCE)
#define RAW_AXIS(x) VECTOR(PLANE_RAW_AXIS, x)

FILTER_LOOP(printed_eq4,
            w = factor * PRINTED_DEPTH * gauss(squared_distance(RAW_AXIS(i), RAW_AXIS(j)), FILTER_NORMAL_VARIANCE);)
FILTER_LOOP(printed_eq12, {
    float li = AT(PLANE_RAW_SHARPNESS, i), lj = AT(PLANE_RAW_SHARPNESS, j), sum = li + lj;
    w = factor * PRINTED_DEPTH * powf(2 * sqrtf(li * lj) / sum, beta) *
        expf(beta * li * lj / sum * (lobe_dot(RAW_AXIS(i), RAW_AXIS(j)) - 1));
})

/* Eq. 11's product of mixtures; sharpness and amplitude of a lobe from the first's, as filter.c draws them */
static inline float printed_product(lobe_vec3 a, float la, lobe_vec3 b, float lb) {
    float sum = 0;
    int l, m;
    for (l = 0; l < FILTER_LOBES; l++) {
        for (m = 0; m < FILTER_LOBES; m++) {
            float first = la * (float)(1 << 2 * l), second = lb * (float)(1 << 2 * m);
            lobe_vec3 both = lobe_add(lobe_scale(a, first), lobe_scale(b, second));
            float size = sqrtf(lobe_dot(both, both));
            sum += (float)(1 << (l + m)) * (expf(size - first - second) - expf(-size - first - second)) / size;
        }
    }
    return sum;
}

FILTER_LOOP(printed_eq11, {
    lobe_vec3 a = RAW_AXIS(i), b = RAW_AXIS(j);
    float la = AT(PLANE_RAW_SHARPNESS, i), lb = AT(PLANE_RAW_SHARPNESS, j);
    w = factor * PRINTED_DEPTH *
        powf(printed_product(a, la, b, lb) / sqrtf(printed_product(a, la, a, la) * printed_product(b, lb, b, lb)),
             beta);
})

/* ---- the machine's peaks ---- */

#define PEAK_LOOP(name, next)                                                                                          \
    BENCH_FUNCTION(name)(float *values) {                                                                              \
        float v[FILTER_PEAK_LANES];                                                                                    \
        int i, step;                                                                                                   \
        for (i = 0; i < FILTER_PEAK_LANES; i++) v[i] = values[i];                                                      \
        for (step = 0; step < FILTER_PEAK_STEPS; step++) {                                                             \
            for (i = 0; i < FILTER_PEAK_LANES; i++) v[i] = next;                                                       \
        }                                                                                                              \
        for (i = 0; i < FILTER_PEAK_LANES; i++) values[i] = v[i];                                                      \
    }

PEAK_LOOP(filter_peak, v[i] * 0.999f + 0.001f)
PEAK_LOOP(division_peak, 1.5f / (v[i] + 1))
