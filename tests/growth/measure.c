#include "growth.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_ROUNDS = 15 };

/* Milliseconds: what takes less is run several times in a row */
#define SHORTEST 2.0

static int count_subjects(const growth *g) {
    int count = 0;
    while (g->subjects[count]) count++;
    return count;
}

static int count_sizes(const growth *g) {
    int count = 0;
    while (g->sizes[count] > 0) count++;
    return count;
}

/* ---- times ---- */

static double time_runs(const growth *g, int subject, int which, int runs) {
    const double started = progress_clock();
    int i;
    for (i = 0; i < runs; i++) g->run(g->context, subject, which);
    return (progress_clock() - started) / runs;
}

static int find_runs(const growth *g, int subject, int which) {
    double elapsed = time_runs(g, subject, which, 1); /* touches the memory */
    int runs = 1;
    while (elapsed < SHORTEST && runs < 1 << 20) {
        runs *= 2;
        elapsed = runs * time_runs(g, subject, which, runs);
    }
    return runs;
}

static void find_times(const growth_report *to, growth *g) {
    static double samples[GROWTH_SUBJECTS][GROWTH_SIZES][MOST_ROUNDS];
    const int subjects = count_subjects(g), sizes = count_sizes(g);
    int runs[GROWTH_SUBJECTS][GROWTH_SIZES], round, subject, i;
    progress line = progress_begin(g->title, (to->rounds + 1) * subjects * sizes);
    for (round = -1; round < to->rounds; round++) {
        for (i = 0; i < sizes; i++) {
            for (subject = 0; subject < subjects; subject++) {
                if (round < 0)
                    runs[subject][i] = find_runs(g, subject, i);
                else
                    samples[subject][i][round] = time_runs(g, subject, i, runs[subject][i]);
                progress_step(&line);
            }
        }
    }
    progress_end(&line);
    for (subject = 0; subject < subjects; subject++) {
        for (i = 0; i < sizes; i++) g->times[subject][i] = progress_quartiles(samples[subject][i], to->rounds);
    }
}

/* ---- the power law ---- */

typedef struct {
    double exponent, departure; /* the largest, relative */
} power_law;

static power_law fit(const double *sizes, const double *values, int count) {
    double x = 0, y = 0, xx = 0, xy = 0;
    power_law law = {0, 0};
    int i;
    for (i = 0; i < count; i++) {
        x += log(sizes[i]) / count;
        y += log(values[i]) / count;
    }
    for (i = 0; i < count; i++) {
        xx += (log(sizes[i]) - x) * (log(sizes[i]) - x);
        xy += (log(sizes[i]) - x) * (log(values[i]) - y);
    }
    law.exponent = xy / xx;
    for (i = 0; i < count; i++) {
        const double off = log(values[i]) - y - law.exponent * (log(sizes[i]) - x);
        law.departure = fmax(law.departure, exp(fabs(off)) - 1);
    }
    return law;
}

/* ---- the table ---- */

static void print_laws(const growth *g) {
    const int subjects = count_subjects(g), sizes = count_sizes(g);
    power_law laws[GROWTH_SUBJECTS], shaded[GROWTH_SUBJECTS] = {{0, 0}};
    int subject, i;
    for (subject = 0; subject < subjects; subject++) {
        double medians[GROWTH_SIZES] = {0};
        for (i = 0; i < sizes; i++) medians[i] = g->times[subject][i].median;
        laws[subject] = fit(g->sizes, medians, sizes);
        if (g->shaded[subject][0] > 0) shaded[subject] = fit(g->sizes, g->shaded[subject], sizes);
    }
    printf("exponent");
    for (subject = 0; subject < subjects; subject++) {
        printf("  %9.3f%18s", laws[subject].exponent, "");
        if (g->shaded[subject][0] > 0) printf(" %8.3f", shaded[subject].exponent);
    }
    printf("\noff by %%");
    for (subject = 0; subject < subjects; subject++) {
        printf("  %9.1f%18s", 100 * laws[subject].departure, "");
        if (g->shaded[subject][0] > 0) printf(" %8.1f", 100 * shaded[subject].departure);
    }
    printf("\n");
}

static void print_table(const growth *g) {
    int subject, i;
    printf("\n%s against %s; %s\n%8s", g->title, g->axis, g->fixed, "");
    for (subject = 0; g->subjects[subject]; subject++)
        printf("  %*s", g->shaded[subject][0] > 0 ? 36 : 27, g->subjects[subject]);
    printf("\n%8s", g->axis);
    for (subject = 0; g->subjects[subject]; subject++)
        printf("  %9s %17s%s", "ms", "quartiles", g->shaded[subject][0] > 0 ? "  VPLs/px" : "");
    printf("\n");
    for (i = 0; g->sizes[i] > 0; i++) {
        printf("%8.0f", g->sizes[i]);
        for (subject = 0; g->subjects[subject]; subject++) {
            const quartiles *t = &g->times[subject][i];
            printf("  %9.4g %8.4g %8.4g", t->median, t->low, t->high);
            if (g->shaded[subject][0] > 0) printf(" %8.2f", g->shaded[subject][i]);
        }
        printf("\n");
    }
    print_laws(g);
    fflush(stdout);
}

growth growth_of(const char *title, const char *axis, void (*run)(void *context, int subject, int which),
                 void *context) {
    growth g;
    memset(&g, 0, sizeof g);
    g.title = title;
    g.axis = axis;
    g.run = run;
    g.context = context;
    return g;
}

void growth_measure(growth_report *to, growth *g) {
    find_times(to, g);
    print_table(g);
    to->measured[to->count++] = *g;
}
