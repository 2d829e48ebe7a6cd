/* fis_quality.c - the study of fis.h's kernels at the bench's size. */
#include "../fis_study.h"
#include "fis_quality.h"

static const struct {
    const char *name;
    int kind;
} pdfs[] = {{"smooth", SMOOTH},         {"checkerboard noise", CHECKERBOARD},
            {"noise ^ 8", POWER},       {"noise like a bidirectional RSM's", BRSM},
            {"1/f", OCTAVES},           {"sparse caustic", SPARSE},
            {"noise and spike", SPIKE}, {"one row", ROW}};

float *fis_quality_image(int kind, const char **name) {
    if (kind >= (int)(sizeof pdfs / sizeof *pdfs)) return 0;
    *name = pdfs[kind].name;
    return make_image(pdfs[kind].kind, FIS_SIDE, FIS_SIDE, 7);
}

void fis_quality_of(int kind, fis_quality rows[FIS_METHODS]) {
    static study_kernel kernels[FIS_KERNELS];
    const char *name;
    float *importance = fis_quality_image(kind, &name), *power = make_power(importance, FIS_SIDE, FIS_SIDE);
    study s = study_begin(importance, power, FIS_SIDE, FIS_SIDE);
    int method;
    for (method = 0; method < STUDY_METHODS; method++) {
        study_quality q;
        study_kernels(&s, method, FIS_KERNELS, kernels);
        q = study_measure(&s, method, kernels, FIS_KERNELS);
        rows[method].method = study_method[method];
        rows[method].reads = q.reads;
        rows[method].rms = method == STUDY_SPLIT ? -1 : q.rms;
        rows[method].largest = q.largest;
        rows[method].gap = q.gap;
        rows[method].overlap = q.overlap;
        rows[method].firefly = q.firefly;
        rows[method].total = q.total;
    }
    study_end(&s);
    free(power);
    free(importance);
}

void fis_quality_flicker(double flicker[FIS_METHODS]) {
    study_flicker(FIS_SIDE, FIS_KERNELS, 24, flicker);
}
