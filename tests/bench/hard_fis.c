/* hard_fis.c - hard cases of fis.h: PDFs without mass, of one texel, of a wide range, of one row */
#include "hard_cases.h"
#include "../fis_study.h"
#include "../../examples/common/fail.h"

typedef struct {
    float *image, *memory;
    double *sums;
    int width, height, texels;
    fis_pyramid pyramid;
    double total; /* in double */
} pdf;

/* An image of one value, to be changed, then built */
static pdf begin(int width, int height, float value) {
    pdf p;
    int i;
    p.width = width;
    p.height = height;
    p.texels = width * height;
    p.image = (float *)allocate("an image", (size_t)p.texels, sizeof *p.image);
    p.memory = (float *)allocate("a pyramid", fis_pyramid_size(width, height, 1), sizeof *p.memory);
    p.sums = (double *)allocate("sums", fis_split_size(width, height), sizeof *p.sums);
    p.total = 0;
    for (i = 0; i < p.texels; i++) p.image[i] = value;
    return p;
}

static void build(pdf *p) {
    int i;
    p->pyramid = fis_build_pdf(p->memory, p->image, p->width, p->height);
    for (i = 0; i < p->texels; i++) p->total += (double)p->image[i];
}

static void end(pdf *p) {
    free(p->sums);
    free(p->memory);
    free(p->image);
}

/* 4 to the top level times the top texel; as printed the texels are added in a row */
static void total(const char *name, const pdf *p, double wanted) {
    const fis_pyramid *q = &p->pyramid;
    float sum = 0;
    int i;
    for (i = 0; i < p->texels; i++) sum += p->image[i];
    hard_case_row_printed(hard_case_of("fis.h", "fis_build_pdf", "rel", name,
                                       ldexp((double)q->texels[q->offset[q->levels - 1]], 2 * (q->levels - 1)), wanted,
                                       wanted),
                          (double)sum);
}

/* The sample of a place, and its texel's density */
static fis_sample warp(const char *name, const pdf *p, float u, float v) {
    fis_point place;
    fis_sample s;
    double wanted;
    place.u = u;
    place.v = v;
    s = fis_warp(&p->pyramid, place);
    wanted = (double)p->image[(int)(s.v * (float)p->height) * p->width + (int)(s.u * (float)p->width)] * p->texels /
             p->total;
    hard_case_row(hard_case_of("fis.h", "fis_warp", "rel", name, (double)s.density, wanted, wanted));
    return s;
}

/* The share of the PDF in the kernel that is to hold 1 / n of it, where a level between the ends gives that */
static void solve(const char *name, const pdf *p, const fis_sample *s, int n) {
    const reference r = make_reference(p->image, p->width, p->height);
    double wanted = 1. / n, level = (double)fis_level(&p->pyramid, s, n, 1), low = HUGE_VAL, high = 0;
    int i;
    for (i = 0; i < 27; i++) { /* moved by 2^-23 of the image, and the level's last bit */
        double value = share(&r, (double)s->u + (i % 3 - 1) * 0x1p-23, (double)s->v + (i / 3 % 3 - 1) * 0x1p-23,
                             level + (i / 9 - 1) * test_ulp(level));
        low = fmin(low, value);
        high = fmax(high, value);
    }
    free_reference(r);
    hard_case_row(hard_case_of("fis.h", "fis_level", "residual", name, clamped(wanted, low, high), wanted, wanted));
}

/* The largest and the least mass of n cells of a PDF of one row */
static void split(const char *name, const pdf *p, int n) {
    static fis_cell cells[1024];
    const fis_split_table table = fis_split_build(p->sums, p->image, p->width, p->height);
    double unit = (p->width + p->height) * 0x1p-53 * p->total, worst = p->total / n;
    int i, x;
    fis_split(&table, n, cells);
    for (i = 0; i < n; i++) {
        double mass = 0, from = cells[i].u0 * p->width, to = cells[i].u1 * p->width;
        for (x = (int)from; x < p->width && x < to; x++)
            mass += (double)p->image[x] * (fmin(to, x + 1) - fmax(from, x)) * (cells[i].v1 - cells[i].v0);
        if (fabs(mass - p->total / n) > fabs(worst - p->total / n)) worst = mass;
    }
    hard_case_row(hard_case_of("fis.h", "fis_split", "total", name, worst, p->total / n, unit));
}

void hard_fis(void) {
    enum { SIDE = 512, ROW_TEXELS = 32768 };
    pdf p = begin(SIDE, SIDE, 0);
    fis_sample s;
    int i;
    build(&p);
    s = fis_warp(&p.pyramid, fis_lattice(3, 16));
    /* every texel counts as 1 */
    hard_case_row(hard_case_of("fis.h", "fis_warp", "rel", "PDF of zeros: density", (double)s.density, 1, 1));
    hard_case_row(hard_case_of(
        "fis.h", "fis_build_pdf", "rel", "PDF of zeros: total",
        ldexp((double)p.pyramid.texels[p.pyramid.offset[p.pyramid.levels - 1]], 2 * (p.pyramid.levels - 1)), p.texels,
        p.texels));
    end(&p);

    p = begin(SIDE, SIDE, 0);
    p.image[200 * SIDE + 77] = 3;
    build(&p);
    total("a spike of one texel: total", &p, p.total);
    warp("a spike of one texel: density", &p, 0.9f, 0.1f);
    end(&p);

    p = begin(SIDE, SIDE, 0);
    for (i = 0; i < p.texels; i++) p.image[i] = (float)(1e-15 * pow(10, 30. * (i % SIDE) / (SIDE - 1)));
    build(&p);
    total("values from 1e-15 to 1e15: total", &p, p.total);
    s = warp("values from 1e-15 to 1e15: density", &p, 1e-6f, 0.5f);
    solve("values from 1e-15 to 1e15: share of a kernel", &p, &s, 64);
    end(&p);

    p = begin(ROW_TEXELS, 1, 0);
    for (i = 0; i < p.texels; i++) p.image[i] = (float)(1 + i % 7) + 1 / 3.f;
    build(&p);
    total("32768 by 1: total", &p, p.total);
    s = warp("32768 by 1: density", &p, 0.3f, 0);
    solve("32768 by 1: share of a kernel", &p, &s, 1000);
    split("32768 by 1: mass of 1000 cells", &p, 1000);
    end(&p);
}
