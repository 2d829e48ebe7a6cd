/*
 growth.h - time against size

 Subjects of one kind are timed at the same sizes, along one axis, on one thread. All subjects and sizes take turns, so
 that what else the machine does meets all of them; times are medians. An exponent is that of the power law through a
 subject's times, by least squares of logarithms.
*/
#ifndef GROWTH_H
#define GROWTH_H

#include "../../examples/common/progress.h"

enum { GROWTH_SIZES = 8, GROWTH_SUBJECTS = 4, GROWTH_MOST = 16 };

typedef struct {
    const char *title, *axis;                           /* of what; what grows: lights, pixels, texels, taps or VPLs */
    char fixed[128];                                    /* what does not */
    const char *subjects[GROWTH_SUBJECTS + 1];          /* closed by null */
    double sizes[GROWTH_SIZES + 1];                     /* closed by 0 */
    double shaded[GROWTH_SUBJECTS][GROWTH_SIZES];       /* lights per pixel; 0: not counted */
    void (*run)(void *context, int subject, int which); /* at which of the sizes */
    void *context;
    quartiles times[GROWTH_SUBJECTS][GROWTH_SIZES]; /* milliseconds; found by growth_measure */
} growth;

typedef struct {
    int quick, rounds; /* how often each is timed */
    growth measured[GROWTH_MOST];
    int count;
} growth_report;

/* Without subjects and sizes */
growth growth_of(const char *title, const char *axis, void (*run)(void *context, int subject, int which),
                 void *context);

/* Times, prints, and puts it into the report. */
void growth_measure(growth_report *to, growth *g);

/* The parts of the report */
void growth_shading(growth_report *to);
void growth_generation(growth_report *to);
void growth_culling(growth_report *to);
void growth_filter(growth_report *to);
void growth_pyramid(growth_report *to);

#endif
