/* The bench: speed beside error for every function, ours and the alternatives. */
#include "bench.h"
#include "tables.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/progress.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPETITIONS = 15, QUICK_REPETITIONS = 5, QUICK_COUNT = 256, MOST_JOBS = 64 };

const char *const program_name = "bench";
int bench_quick;

static bench_input in;
static bench_output out;

static double seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

void bench_draw(const bench_row *row, bench_input *inputs) {
    int i, k;
    for (i = 0; i < BENCH_COUNT; i++) {
        float one[BENCH_INPUTS] = {0};
        row->draw(one);
        for (k = 0; k < BENCH_INPUTS; k++) inputs->column[k][i] = one[k];
    }
}

/* The largest and the root mean square error of each form; infinite when a result is not finite. */
static void measure_errors(const bench_row *row, double *largest, double *rms) {
    const int batches = bench_quick ? 1 : row->batches, count = bench_quick ? QUICK_COUNT : BENCH_COUNT;
    int batch, i, k, f;
    for (batch = 0; batch < batches; batch++) {
        static double wanted[BENCH_COUNT][BENCH_OUTPUTS];
        bench_draw(row, &in);
        for (i = 0; i < count; i++) {
            float one[BENCH_INPUTS];
            for (k = 0; k < BENCH_INPUTS; k++) one[k] = in.column[k][i];
            row->exact(one, wanted[i]);
        }
        for (f = 0; row->form[f].name; f++) {
            row->form[f].vector(&in, &out);
            for (i = 0; i < count; i++) {
                float one[BENCH_OUTPUTS];
                double error;
                for (k = 0; k < BENCH_OUTPUTS; k++) one[k] = out.column[k][i];
                error = fabs(row->error(wanted[i], one));
                if (!(error <= largest[f])) largest[f] = error <= 1e30 ? error : HUGE_VAL; /* also when it is NaN */
                rms[f] += error * error / (batches * (double)count);
            }
        }
    }
    for (f = 0; row->form[f].name; f++) rms[f] = largest[f] < HUGE_VAL ? sqrt(rms[f]) : HUGE_VAL;
}

void bench_times(void (*run)(int which), int count, quartiles *times) {
    static double samples[BENCH_RUNS][REPETITIONS];
    const int repetitions = bench_quick ? QUICK_REPETITIONS : REPETITIONS;
    int turns[BENCH_RUNS], repetition, which, turn;
    for (repetition = -1; repetition < repetitions; repetition++) { /* the first finds how often to run each */
        for (which = 0; which < count; which++) {
            double started = seconds(), elapsed = 0;
            if (repetition < 0) {
                for (turns[which] = 0; elapsed < 1e-3; elapsed = seconds() - started, turns[which]++) run(which);
                continue;
            }
            for (turn = 0; turn < turns[which]; turn++) run(which);
            elapsed = seconds() - started;
            samples[which][repetition] = elapsed / turns[which];
        }
    }
    for (which = 0; which < count; which++) times[which] = progress_quartiles(samples[which], repetitions);
}

double bench_spread(quartiles t) {
    return 50 * (t.high - t.low) / t.median;
}

static const bench_row *timed;

/* Form f scalar is 2 f, vector 2 f + 1. */
static void run_loop(int loop) {
    (loop % 2 ? timed->form[loop / 2].vector : timed->form[loop / 2].scalar)(&in, &out);
}

void bench_function_row(const char *header, const char *function, const char *form, int ours, const char *inputs,
                        const char *unit) {
    csv_text(&bench_table[TABLE_FUNCTIONS], header);
    csv_text(&bench_table[TABLE_FUNCTIONS], function);
    csv_text(&bench_table[TABLE_FUNCTIONS], form);
    csv_number(&bench_table[TABLE_FUNCTIONS], ours);
    csv_text(&bench_table[TABLE_FUNCTIONS], inputs);
    csv_text(&bench_table[TABLE_FUNCTIONS], unit);
}

static void print(const char *header, const bench_row *row, const progress *line) {
    double largest[BENCH_FORMS] = {0}, rms[BENCH_FORMS] = {0}, scale = 1e9 / BENCH_COUNT;
    quartiles times[BENCH_RUNS];
    int f, forms = 0;
    while (row->form[forms].name) forms++;
    timed = row;
    measure_errors(row, largest, rms);
    bench_times(run_loop, 2 * forms, times);
    progress_end(line);
    printf("%s: %s; errors in %s\n", row->function, row->inputs, row->unit);
    printf("  %-34s %9s %9s %5s %7s %7s %10s %10s\n", "", "scalar ns", "vector ns", "+-%", "ratio", "/ ours",
           "max error", "RMS");
    for (f = 0; f < forms; f++) {
        const bench_form *form = &row->form[f];
        const quartiles scalar = times[2 * f], vector = times[2 * f + 1];
        printf("  %-34s %9.2f %9.3f %5.1f %7.1f %7.2f %10.3g %10.3g\n", form->name, scalar.median * scale,
               vector.median * scale, bench_spread(vector), scalar.median / vector.median,
               vector.median / times[1].median, largest[f], rms[f]);
        bench_function_row(header, row->function, form->name, !strncmp(form->loop, "our_", 4), row->inputs, row->unit);
        csv_error(&bench_table[TABLE_FUNCTIONS], largest[f]);
        csv_error(&bench_table[TABLE_FUNCTIONS], rms[f]);
        csv_quartiles(&bench_table[TABLE_FUNCTIONS], quartiles_scaled(scalar, scale));
        csv_quartiles(&bench_table[TABLE_FUNCTIONS], quartiles_scaled(vector, scale));
        csv_row(&bench_table[TABLE_FUNCTIONS]);
    }
    printf("\n");
    fflush(stdout);
}

static void usage(FILE *to) {
    fprintf(
        to,
        "usage: bench [--csv FOLDER] [--quick] [--root DIR] [NAME]\n"
        "  NAME     measure only the functions whose name contains it; tables of their own are fis_level,\n"
        "           fis_flicker, fis_build, bilateral_filter, bilateral_figure4, limits and hard_cases\n"
        "  --csv    write what is measured into FOLDER too: functions.csv, fis.csv, limits.csv, hard_cases.csv\n"
        "  --quick  fewer repetitions, and errors of fewer inputs\n"
        "  --root   where the headers are, whose bounds hard_cases reads (default: .)\n"
        "Nanoseconds are per element, in a loop of scalar and of vector code, medians of %d interleaved runs (%d with\n"
        "--quick); +-%% is half the distance between the quartiles of vector code, over the median.\n",
        REPETITIONS, QUICK_REPETITIONS);
}

static int wrong_use(void) {
    usage(stderr);
    return 2;
}

/* What is measured: a row, or a table of its own */
typedef struct {
    const char *header; /* of the row */
    const bench_row *row;
    void (*print)(void);
} job;

static job jobs[MOST_JOBS];
static int job_count;

static void add_job(const char *wanted, const char *name, const char *header, const bench_row *row,
                    void (*print_table)(void)) {
    job *j = &jobs[job_count];
    if (!strstr(name, wanted) || job_count == MOST_JOBS) return;
    j->header = header;
    j->row = row;
    j->print = print_table;
    job_count++;
}

static void find_jobs(const char *wanted) {
    static const struct {
        const char *header;
        const bench_row *rows;
    } tables[] = {
        {"sg.h", sg_bench}, {"asg.h", asg_bench}, {"ggx_bound.h", ggx_bound_bench}, {"bilateral.h", bilateral_bench}};
    size_t table;
    for (table = 0; table < sizeof tables / sizeof *tables; table++) {
        const bench_row *row;
        for (row = tables[table].rows; row->function; row++)
            add_job(wanted, row->function, tables[table].header, row, NULL);
    }
    add_job(wanted, "fis_level", NULL, NULL, fis_level_bench);
    add_job(wanted, "fis_flicker", NULL, NULL, fis_flicker_bench);
    add_job(wanted, "fis_build", NULL, NULL, fis_build_bench);
    add_job(wanted, "bilateral_filter", NULL, NULL, bilateral_filter_bench);
    add_job(wanted, "bilateral_figure4", NULL, NULL, bilateral_figure4);
    add_job(wanted, "limits", NULL, NULL, limits_bench);
    add_job(wanted, "hard_cases", NULL, NULL, hard_cases_bench);
}

int main(int argc, char **argv) {
    const char *wanted = "", *folder = NULL;
    progress line;
    int i;
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        }
        if (!strcmp(argv[i], "--quick"))
            bench_quick = 1;
        else if (!strcmp(argv[i], "--csv") && i + 1 < argc)
            folder = argv[++i];
        else if (!strcmp(argv[i], "--root") && i + 1 < argc)
            test_root = argv[++i];
        else if (argv[i][0] == '-')
            return wrong_use();
        else
            wanted = argv[i];
    }
    find_jobs(wanted);
    if (!job_count) {
        fprintf(stderr, "bench: no function's name contains '%s'\n", wanted);
        return 2;
    }
    if (jobs[job_count - 1].print == hard_cases_bench) { /* says now if there are no headers to read bounds from */
        test_bound bound;
        int of_model;
        test_read_bound("sg.h", "sg_eval", "conditioned", &bound, &of_model);
    }
    tables_begin(folder);
    line = progress_begin("bench", job_count);
    for (i = 0; i < job_count; i++) {
        test_random.state = 0;
        if (jobs[i].row) {
            print(jobs[i].header, jobs[i].row, &line);
        } else {
            progress_end(&line);
            jobs[i].print();
        }
        progress_step(&line);
    }
    progress_end(&line);
    tables_end(folder);
    return hard_cases_failed > 0;
}
