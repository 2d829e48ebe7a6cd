/* How the costs of the examples' pipelines grow: time against size, on one thread. */
#include "growth.h"
#include "../../examples/common/csv.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/output.h"
#include <stdio.h>
#include <string.h>

enum { FULL_ROUNDS = 9, QUICK_ROUNDS = 3 };

const char *const program_name = "growth";

static void usage(FILE *to) {
    fprintf(
        to,
        "usage: growth [--quick] [--csv FILE]\n"
        "  --csv FILE  writes the times there too\n"
        "  --quick     times each %d times, not %d, and less of it\n"
        "  --help      prints this\n"
        "Times the examples' pipelines on one thread, against sizes over two decades and more. Printed are medians,\n"
        "quartiles, the exponent of the power law through the medians (least squares of logarithms), and how far\n"
        "off it they are at most. Takes 400 MB of memory.\n",
        QUICK_ROUNDS, FULL_ROUNDS);
}

static void add_rows(csv *table, const growth *g) {
    int subject, i;
    for (subject = 0; g->subjects[subject]; subject++) {
        for (i = 0; g->sizes[i] > 0; i++) {
            csv_text(table, g->subjects[subject]);
            csv_text(table, g->axis);
            csv_count(table, (long)g->sizes[i]);
            csv_quartiles(table, g->times[subject][i]);
            if (g->shaded[subject][i] > 0)
                csv_error(table, g->shaded[subject][i]);
            else
                csv_skip(table, 1);
            csv_text(table, g->fixed);
            csv_row(table);
        }
    }
}

static void write_csv(const char *path, const growth_report *report) {
    csv table = csv_begin("pipeline,axis,count,time_ms,time_ms_low,time_ms_high,shaded,fixed");
    int i;
    for (i = 0; i < report->count; i++) add_rows(&table, &report->measured[i]);
    printf("\n");
    csv_end(&table, path, "", "the tables above");
}

static int refuse(const char *why, const char *what) {
    fprintf(stderr, "growth: %s '%s'\n", why, what);
    usage(stderr);
    return 2;
}

int main(int argc, char **argv) {
    static growth_report report;
    const char *path = NULL;
    int i;
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        }
        if (!strcmp(argv[i], "--quick")) {
            report.quick = 1;
        } else if (!strcmp(argv[i], "--csv")) {
            if (i + 1 == argc || !argv[i + 1][0]) return refuse("the name of a file is missing after", argv[i]);
            path = argv[++i];
        } else {
            return refuse("unknown argument", argv[i]);
        }
    }
    if (path) output_check(path, "");
    report.rounds = report.quick ? QUICK_ROUNDS : FULL_ROUNDS;
    growth_shading(&report);
    growth_generation(&report);
    growth_culling(&report);
    growth_filter(&report);
    growth_pyramid(&report);
    if (path) write_csv(path, &report);
    return 0;
}
