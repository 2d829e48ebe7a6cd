/* progress.h - wall time, and a progress line on stderr for work longer than a second. */
#ifndef PROGRESS_H
#define PROGRESS_H

/* Milliseconds since some moment. Without OpenMP it is the process's time, which is then the same but for idling. */
double progress_clock(void);

typedef struct {
    const char *label;
    int done, total;
    double started, shown;
} progress;

progress progress_begin(const char *label, int total);

/* One more of the total is done; may be called from any thread. Returns nothing and costs little. */
void progress_step(progress *p);

/* Wipes the line if one was shown; returns the milliseconds since the beginning. */
double progress_end(progress *p);

#endif
