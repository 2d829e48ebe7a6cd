/* The unit tests' harness: bounds, checks, one test's run. */
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int test_verbose, test_quiet, test_quick;
int test_repeat = 1;
double test_slack = 1;
int test_least, test_most = 1 << 30;
unsigned long long test_seed;
const char *test_files;
static int failures; /* of the running test */

const test_case *const test_tables[] = {sg_tests,        asg_tests,           fis_tests,    ggx_bound_tests,
                                        bilateral_tests, bilateral_asg_tests, raster_tests, NULL};

static void fail(const char *what, const double *inputs, int count) {
    int i;
    if (++failures > 5 || test_quiet) return; /* the first few tell enough */
    printf("    FAILED %s; input", what);
    for (i = 0; i < count; i++) printf(" %a", inputs[i]);
    printf("\n");
}

test_bound test_bound_of(const char *header, const char *function, const char *kind) {
    test_bound bound;
    int of_model, found = test_read_bound(header, function, kind, &bound, &of_model);
    if (!of_model) bound.limit *= test_slack;
    if (!found) {
        printf("    %s has no tag '[bound %s...]'\n", header, bound.label);
        failures++;
    }
    return bound;
}

void test_within(test_bound *bound, double got, double wanted, double unit, const double *inputs, int count) {
    double error = fabs(got - wanted) / unit;
    if (test_redraw) {
        if (!count) return; /* of all draws together, which a climb makes unlike */
        test_climbed(bound, error);
    }
    if (error > bound->worst) bound->worst = error;
    if (!(error <= bound->limit)) { /* also when it is NaN */
        char what[256];
        snprintf(what, sizeof what, "%s: got %a (%.9g), wanted %a (%.9g), error %.4g, limit %.4g", bound->label, got,
                 got, wanted, wanted, error, bound->limit);
        fail(what, inputs, count);
    }
}

void test_that(int condition, const char *what, const double *inputs, int count) {
    if (!condition && (count || !test_redraw)) fail(what, inputs, count);
}

void test_report(const test_bound *bound) {
    if (test_verbose && !test_quiet && !test_redraw)
        printf("    %-40s worst %-10.4g limit %.4g\n", bound->label, bound->worst, bound->limit);
}

int test_is_finite(float value) {
    unsigned bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits & 0x7F800000u) != 0x7F800000u;
}

int test_draws(int count) {
    return count < test_least ? test_least : count < test_most ? count : test_most;
}

int test_few(int count) {
    return test_quick ? (count + 9) / 10 : count;
}

int test_run(const test_case *test) {
    failures = 0;
    test_random.state = test_seed;
    test->run();
    if (test_rounds) test_climb(test);
    if (!test_quiet) printf("%s %s\n", failures ? "FAILED" : "ok    ", test->name);
    fflush(stdout);
    return failures;
}
