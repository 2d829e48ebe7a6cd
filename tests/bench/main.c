/* The bench: speed beside error for every function, ours and the alternatives. */
#include "bench.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPETITIONS = 15, LOOPS = 2 * BENCH_FORMS };

static bench_input in;
static bench_output out;

static double seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static void draw(const bench_row *row) {
    int i, k;
    for (i = 0; i < BENCH_COUNT; i++) {
        float one[BENCH_INPUTS] = {0};
        row->draw(one);
        for (k = 0; k < BENCH_INPUTS; k++) in.column[k][i] = one[k];
    }
}

/* The largest and the root mean square error of each form; infinite when a result is not finite. */
static void measure_errors(const bench_row *row, double *largest, double *square) {
    int batch, i, k, f;
    for (batch = 0; batch < row->batches; batch++) {
        static double wanted[BENCH_COUNT][BENCH_OUTPUTS];
        draw(row);
        for (i = 0; i < BENCH_COUNT; i++) {
            float one[BENCH_INPUTS];
            for (k = 0; k < BENCH_INPUTS; k++) one[k] = in.column[k][i];
            row->exact(one, wanted[i]);
        }
        for (f = 0; row->form[f].name; f++) {
            row->form[f].vector(&in, &out);
            for (i = 0; i < BENCH_COUNT; i++) {
                float one[BENCH_OUTPUTS];
                double error;
                for (k = 0; k < BENCH_OUTPUTS; k++) one[k] = out.column[k][i];
                error = fabs(row->error(wanted[i], one));
                if (!(error <= largest[f])) largest[f] = error <= 1e30 ? error : HUGE_VAL; /* also when it is NaN */
                square[f] += error * error / (row->batches * (double)BENCH_COUNT);
            }
        }
    }
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Nanoseconds an element of each loop: form f scalar at 2 f, vector at 2 f + 1. */
static void measure_times(const bench_row *row, double *nanoseconds) {
    static double samples[LOOPS][REPETITIONS];
    int turns[LOOPS], repetition, loop, turn;
    for (repetition = -1; repetition < REPETITIONS; repetition++) { /* the first finds how often to run each loop */
        for (loop = 0; row->form[loop / 2].name; loop++) {
            bench_loop *run = loop % 2 ? row->form[loop / 2].vector : row->form[loop / 2].scalar;
            double started = seconds(), elapsed = 0;
            if (repetition < 0) {
                for (turns[loop] = 0; elapsed < 1e-3; elapsed = seconds() - started, turns[loop]++) run(&in, &out);
                continue;
            }
            for (turn = 0; turn < turns[loop]; turn++) run(&in, &out);
            elapsed = seconds() - started;
            samples[loop][repetition] = elapsed * 1e9 / ((double)turns[loop] * BENCH_COUNT);
        }
    }
    for (loop = 0; row->form[loop / 2].name; loop++) {
        qsort(samples[loop], REPETITIONS, sizeof(double), ascending);
        nanoseconds[loop] = samples[loop][REPETITIONS / 2];
    }
}

static void print(const bench_row *row) {
    double largest[BENCH_FORMS] = {0}, square[BENCH_FORMS] = {0}, ns[LOOPS];
    int f;
    measure_errors(row, largest, square);
    measure_times(row, ns);
    printf("%s: %s; errors in %s\n", row->function, row->inputs, row->unit);
    printf("  %-34s %9s %9s %7s %7s %10s %10s\n", "", "scalar ns", "vector ns", "ratio", "/ ours", "max error", "RMS");
    for (f = 0; row->form[f].name; f++) {
        printf("  %-34s %9.2f %9.3f %7.1f %7.2f %10.3g %10.3g\n", row->form[f].name, ns[2 * f], ns[2 * f + 1],
               ns[2 * f] / ns[2 * f + 1], ns[2 * f + 1] / ns[1], largest[f],
               largest[f] < HUGE_VAL ? sqrt(square[f]) : HUGE_VAL);
    }
    printf("\n");
    fflush(stdout);
}

static void usage(FILE *to) {
    fprintf(to,
            "usage: bench [NAME]\n"
            "  NAME  measure only the functions whose name contains it\n"
            "Nanoseconds are per element, in a loop of scalar and of vector code, medians of %d interleaved runs.\n",
            REPETITIONS);
}

int main(int argc, char **argv) {
    static const bench_row *const tables[] = {sg_bench, asg_bench, ggx_bound_bench, bilateral_bench};
    static const struct {
        const char *name;
        void (*print)(void);
    } others[] = {{"bilateral_filter", bilateral_filter_bench}, {"bilateral_figure4", bilateral_figure4}};
    const char *wanted = "";
    size_t table;
    int rows = 0, i;
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        }
        if (argv[i][0] == '-') {
            usage(stderr);
            return 2;
        }
        wanted = argv[i];
    }
    for (table = 0; table < sizeof tables / sizeof *tables; table++) {
        const bench_row *row;
        for (row = tables[table]; row->function; row++) {
            if (!strstr(row->function, wanted)) continue;
            test_random.state = 0;
            print(row);
            rows++;
        }
    }
    for (table = 0; table < sizeof others / sizeof *others; table++) {
        if (!strstr(others[table].name, wanted)) continue;
        test_random.state = 0;
        others[table].print();
        rows++;
    }
    if (!rows) {
        fprintf(stderr, "bench: no function's name contains '%s'\n", wanted);
        return 2;
    }
    return 0;
}
