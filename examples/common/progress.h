/* progress.h - wall time, and a progress line on stderr for work longer than a second. */
#ifndef PROGRESS_H
#define PROGRESS_H

/* Milliseconds since some moment. Without OpenMP it is the process's time, which is then the same but for idling. */
double progress_clock(void);

/* Of times, or others; sorts them. */
double progress_median(double *values, int count);

typedef struct {
    const char *label;
    int done, total, visible;
    double started, next; /* when the line is to be shown again */
} progress;

progress progress_begin(const char *label, int total);

/* One more of the total is done; may be called from any thread. */
void progress_step(progress *p);

/* Wipes the line if it was shown. */
void progress_end(const progress *p);

#endif
