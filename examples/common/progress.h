/* progress.h - wall time, its repetitions, and a progress line on stderr for work longer than a second. */
#ifndef PROGRESS_H
#define PROGRESS_H

/* Milliseconds since some moment. Without OpenMP it is the process's time, which is then the same but for idling. */
double progress_clock(void);

/* Of times, or others; each sorts them. */
double progress_median(double *values, int count);

typedef struct {
    double median, low, high;
} quartiles;

quartiles progress_quartiles(double *values, int count);

quartiles quartiles_scaled(quartiles s, double factor);

/* Times of one thing, until enough of them are known. Things that are compared take turns, so that what else the
   machine does meets all of them. */
enum { TIMING_MOST = 15 };

typedef struct {
    int count;
    double ms[TIMING_MOST], sum;
} timing;

void timing_add(timing *t, double ms);

/* Whether there are fewer than `least`, or fewer than `most` and room for another before `limit` milliseconds */
int timing_goes_on(const timing *t, int least, int most, double limit);

quartiles timing_quartiles(const timing *t);

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
