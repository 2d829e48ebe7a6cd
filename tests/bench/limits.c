/*
 limits.c - how much of the machine's peak the hot loops reach

 Peaks are measured in the same run, interleaved with the loops: multiply-adds and divisions by loops of nothing else,
 memory by a copy. A loop's operations are those that it does when it is compiled with a class for float that counts
 them (counted.h); a multiply-add is two. That leaves out minima, conversions and operations on bits, which vector code
 spends time on as well, and takes every operation for one that may be half a multiply-add: no loop reaches all of it.
*/
#include "tables.h"
#include "filter.h"
#include "fis_build.h"
#include <stdio.h>
#include <string.h>

enum { HOT = 14, MOST_LOOPS = 32 };

double bench_operations, bench_divisions;

/* By the names of their loops */
static const char *const hot[HOT] = {"our_eval",
                                     "our_integral",
                                     "our_product_integral",
                                     "our_product_integral_approx",
                                     "our_cosine",
                                     "our_ggx_lobe",
                                     "our_vsgl_diffuse_integral",
                                     "our_asg_sg_integral",
                                     "our_asg_sg_integral_xu",
                                     "our_asg_product_integral",
                                     "our_asg_vsgl_specular",
                                     "our_ggx_ndf",
                                     "our_ggx_brdf_cos",
                                     "our_ggx_bound_ellipsoid"};

static const bench_row *const tables[] = {sg_bench, asg_bench, ggx_bound_bench};

static const bench_form *form_of[HOT];
static bench_input in[HOT];
static bench_output out;
static int filters;

/* The first row that has the loop, and its inputs */
static void find(int k) {
    size_t table;
    for (table = 0; table < sizeof tables / sizeof *tables; table++) {
        const bench_row *row;
        for (row = tables[table]; row->function; row++) {
            const bench_form *form;
            for (form = row->form; form->name && !form_of[k]; form++) {
                if (strcmp(form->loop, hot[k])) continue;
                form_of[k] = form;
                test_random.state = 0;
                bench_draw(row, &in[k]);
            }
        }
    }
}

/* The loops, the filters, then both peaks; returns how many elements that were */
static double run_elements(int which) {
    static float values[FILTER_PEAK_LANES];
    if (which < HOT) {
        form_of[which]->vector(&in[which], &out);
        return BENCH_COUNT;
    }
    if (which < HOT + filters) return filter_run(which - HOT);
    (which == HOT + filters ? filter_peak_vector : division_peak_vector)(values);
    return FILTER_PEAK_OPERATIONS;
}

static void run(int which) {
    run_elements(which);
}

/* Operations and divisions of an element; none where they cannot be counted */
static int count(int which, double *operations, double *divisions) {
    double elements = 0;
    bench_operations = bench_divisions = 0;
    if (which >= HOT) {
        elements = filter_count(which - HOT);
    } else if (form_of[which]->counted) {
        form_of[which]->counted(&in[which], &out);
        elements = BENCH_COUNT;
    }
    if (!(elements > 0)) return 0;
    *operations = bench_operations / elements;
    *divisions = bench_divisions / elements;
    return 1;
}

static void print(const char *loop, const char *resource, const char *unit, double amount, quartiles ns, double peak) {
    const double fraction = amount / ns.median / peak;
    printf("  %-34s %-12s %8.1f %-5s %9.3f %5.1f %8.2f %7.1f\n", loop, resource, amount, unit, ns.median,
           bench_spread(ns), peak, 100 * fraction);
    csv_text(&bench_table[TABLE_LIMITS], loop);
    csv_text(&bench_table[TABLE_LIMITS], resource);
    csv_text(&bench_table[TABLE_LIMITS], unit);
    csv_number(&bench_table[TABLE_LIMITS], amount);
    csv_quartiles(&bench_table[TABLE_LIMITS], ns);
    csv_number(&bench_table[TABLE_LIMITS], peak);
    csv_number(&bench_table[TABLE_LIMITS], fraction);
    csv_row(&bench_table[TABLE_LIMITS]);
}

void limits_bench(void) {
    static const int channels[] = {1, 16};
    quartiles seconds[MOST_LOOPS];
    double multiply_adds, quotients;
    int k, loops, counted = 1;
    filters = filter_prepare();
    loops = HOT + filters;
    for (k = 0; k < HOT; k++) find(k);
    bench_times(run, loops + 2, seconds);
    multiply_adds = 2 * run_elements(loops) / seconds[loops].median * 1e-9;
    quotients = run_elements(loops + 1) / seconds[loops + 1].median * 1e-9;
    printf("limits: what hot loops reach of the machine's peak, measured in between\n");
    printf("  %-34s %-12s %8s %-5s %9s %5s %8s %7s\n", "", "resource", "amount", "", "ns", "+-%", "peak / ns", "%");
    for (k = 0; k < loops; k++) {
        const double scale = 1e9 / run_elements(k);
        quartiles ns;
        double operations, divisions;
        char name[64];
        if (!count(k, &operations, &divisions)) {
            counted = 0;
            continue;
        }
        ns.median = seconds[k].median * scale;
        ns.low = seconds[k].low * scale;
        ns.high = seconds[k].high * scale;
        snprintf(name, sizeof name, "%s", k < HOT ? form_of[k]->name : filter_name(k - HOT));
        print(name, "multiply-add", "flop", operations, ns, multiply_adds);
        if (divisions > 0) print(name, "division", "flop", divisions, ns, quotients);
    }
    if (!counted) {
        printf("  without a C++ compiler no operations are counted\n");
        csv_text(&bench_table[TABLE_LIMITS], "not counted: no C++ compiler");
        csv_text(&bench_table[TABLE_LIMITS], "multiply-add");
        csv_skip(&bench_table[TABLE_LIMITS], 7);
        csv_row(&bench_table[TABLE_LIMITS]);
    }
    for (k = 0; k < (int)(sizeof channels / sizeof *channels); k++) {
        const fis_build_limit l = fis_build_measure(channels[k]);
        char name[64];
        snprintf(name, sizeof name, "fis_build, %d channels", channels[k]);
        print(name, "memory", "byte", l.bytes, l.nanoseconds, l.peak);
    }
    printf("\n");
    fflush(stdout);
}
