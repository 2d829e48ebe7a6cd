#include "progress.h"
#include <stdio.h>
#ifdef _OPENMP
#    include <omp.h>
#else
#    include <time.h>
#endif

double progress_clock(void) {
#ifdef _OPENMP
    return omp_get_wtime() * 1e3;
#else
    return (double)clock() * 1e3 / CLOCKS_PER_SEC;
#endif
}

progress progress_begin(const char *label, int total) {
    progress p;
    p.label = label;
    p.done = 0;
    p.total = total;
    p.started = progress_clock();
    p.shown = p.started + 800; /* first shown a second after the beginning */
    return p;
}

void progress_step(progress *p) {
#ifdef _OPENMP
#    pragma omp critical(progress_line)
#endif
    {
        double now = progress_clock();
        p->done++;
        if (now - p->shown > 200) {
            p->shown = now;
            fprintf(stderr, "\r%s: %3d %%  ", p->label, 100 * p->done / p->total);
            fflush(stderr);
        }
    }
}

double progress_end(progress *p) {
    if (p->shown < progress_clock() && p->shown != p->started + 800) fprintf(stderr, "\r%*s\r", 60, "");
    return progress_clock() - p->started;
}
