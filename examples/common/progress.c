#include "progress.h"
#include <stdio.h>
#include <stdlib.h>
#ifdef _OPENMP
#include <omp.h>
#else
#include <time.h>
#endif

double progress_clock(void) {
#ifdef _OPENMP
    return omp_get_wtime() * 1e3;
#else
    return (double)clock() * 1e3 / CLOCKS_PER_SEC;
#endif
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double progress_median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[count / 2];
}

progress progress_begin(const char *label, int total) {
    progress p;
    p.label = label;
    p.done = 0;
    p.total = total;
    p.visible = 0;
    p.started = progress_clock();
    p.next = p.started + 1000;
    return p;
}

void progress_step(progress *p) {
#ifdef _OPENMP
#pragma omp critical(progress_line)
#endif
    {
        double now = progress_clock();
        p->done++;
        if (now > p->next) {
            p->next = now + 200;
            p->visible = 1;
            fprintf(stderr, "\r%s: %3.0f %%  ", p->label, 100.0 * p->done / p->total);
            fflush(stderr);
        }
    }
}

void progress_end(const progress *p) {
    if (p->visible) fprintf(stderr, "\r%60s\r", "");
}
