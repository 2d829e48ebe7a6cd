/* hard_cases.c - the table of hard cases */
#include "hard_cases.h"
#include "tables.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

int hard_cases_failed;

static int finite_number(double x) {
    return fabs(x) <= 1e300;
}

static double error_of(const hard_case *c, double got) {
    double error = fabs(got - c->wanted);
    if (c->error == HARD_LOGARITHM) error = fabs(log(got / c->wanted));
    if (c->error == HARD_AT_MOST) error = fmax(got - c->wanted, 0);
    error /= c->unit;
    return finite_number(got) && finite_number(error) ? error : HUGE_VAL;
}

static void print(const hard_case *c, const double *printed) {
    const double error = error_of(c, c->got);
    double limit = c->limit;
    int failed;
    if (c->header) {
        test_bound bound;
        int of_model;
        if (!test_read_bound(c->header, c->function, c->kind, &bound, &of_model)) {
            printf("  %s has no tag '[bound %s...]'\n", c->header, bound.label);
            hard_cases_failed++;
            return;
        }
        limit = bound.limit;
    }
    failed = !(error <= limit);
    hard_cases_failed += failed;
    printf("  %-26s %-46s %12.6g %12.6g %10.3g %9.3g %-13s", c->function, c->name, c->got, c->wanted, error, limit,
           c->kind);
    if (printed && *printed == *printed)
        printf(" %12.6g %10.3g", *printed, error_of(c, *printed));
    else
        printf(" %12s %10s", printed ? "nan" : "", printed ? "inf" : ""); /* without the sign that a NaN may have */
    printf("%s\n", failed ? " FAILED" : "");
    csv_text(&bench_table[TABLE_HARD_CASES], c->function);
    csv_text(&bench_table[TABLE_HARD_CASES], c->name);
    csv_error(&bench_table[TABLE_HARD_CASES], c->got);
    csv_error(&bench_table[TABLE_HARD_CASES], c->wanted);
    csv_error(&bench_table[TABLE_HARD_CASES], error);
    csv_text(&bench_table[TABLE_HARD_CASES], c->kind);
    csv_error(&bench_table[TABLE_HARD_CASES], limit);
    if (printed) {
        if (*printed == *printed)
            csv_error(&bench_table[TABLE_HARD_CASES], *printed);
        else
            csv_text(&bench_table[TABLE_HARD_CASES], "nan");
        csv_error(&bench_table[TABLE_HARD_CASES], error_of(c, *printed));
    } else {
        csv_skip(&bench_table[TABLE_HARD_CASES], 2);
    }
    csv_row(&bench_table[TABLE_HARD_CASES]);
}

void hard_case_row(hard_case c) {
    print(&c, NULL);
}

void hard_case_row_printed(hard_case c, double printed) {
    print(&c, &printed);
}

hard_case hard_case_of(const char *header, const char *function, const char *kind, const char *name, double got,
                       double wanted, double unit) {
    hard_case c;
    c.header = header;
    c.function = function;
    c.kind = kind;
    c.name = name;
    c.got = got;
    c.wanted = wanted;
    c.unit = unit;
    c.limit = 0;
    c.error = HARD_DIFFERENCE;
    return c;
}

hard_case hard_case_within(const char *function, const char *unit, double limit, const char *name, double got,
                           double wanted) {
    hard_case c = hard_case_of(NULL, function, unit, name, got, wanted, 1);
    c.limit = limit;
    return c;
}

bench_input hard_in;
bench_output hard_out;

void hard_put(int column, lobe_vec3 v) {
    hard_in.column[column][0] = v.x;
    hard_in.column[column + 1][0] = v.y;
    hard_in.column[column + 2][0] = v.z;
}

void hard_cases_bench(void) {
    printf(
        "hard_cases: errors in the unit of the header's bound; printed: the formula as printed, in float with libm\n");
    printf("  %-26s %-46s %12s %12s %10s %9s %-13s %12s %10s\n", "", "", "got", "wanted", "error", "limit", "unit",
           "printed", "error");
    hard_sg();
    hard_asg();
    hard_ggx_bound();
    hard_fis();
    printf("\n");
    fflush(stdout);
}
