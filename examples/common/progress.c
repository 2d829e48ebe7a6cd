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
    return progress_quartiles(values, count).median;
}

/* Of sorted values, between two of them by the share of the way */
static double quantile(const double *values, int count, double share) {
    const double at = share * (count - 1);
    const int i = (int)at, next = i + 1 < count ? i + 1 : i;
    return values[i] + (at - i) * (values[next] - values[i]);
}

quartiles progress_quartiles(double *values, int count) {
    quartiles s;
    qsort(values, (size_t)count, sizeof *values, ascending);
    s.median = quantile(values, count, 0.5);
    s.low = quantile(values, count, 0.25);
    s.high = quantile(values, count, 0.75);
    return s;
}

quartiles quartiles_scaled(quartiles s, double factor) {
    s.median *= factor;
    s.low *= factor;
    s.high *= factor;
    return s;
}

void timing_add(timing *t, double ms) {
    t->ms[t->count++] = ms;
    t->sum += ms;
}

int timing_goes_on(const timing *t, int least, int most, double limit) {
    return t->count < least || (t->count < most && t->sum * (t->count + 1) < limit * t->count);
}

quartiles timing_quartiles(const timing *t) {
    timing sorted = *t;
    return progress_quartiles(sorted.ms, sorted.count);
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
