/* The unit tests' harness: bounds, checks, one test's run. */
#include "test.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *test_root = ".";
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
    char path[1024], line[1024], prefix[128];
    FILE *file;
    int found = 0, of_model = 0;
    memset(&bound, 0, sizeof bound);
    snprintf(bound.label, sizeof bound.label, "%s %s", function, kind);
    snprintf(prefix, sizeof prefix, "[bound %s %s ", function, kind);
    snprintf(path, sizeof path, "%s/%s", test_root, header);
    file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "tests: cannot read %s: run from the project's root, or give it with --root\n", path);
        exit(2);
    }
    while (!found && fgets(line, sizeof line, file)) {
        const char *tag = strstr(line, prefix);
        if (!strncmp(line, "   Rounding:", 12) || !strncmp(line, "   Model:", 9)) of_model = line[3] == 'M';
        if (tag) {
            int fields = sscanf(tag + strlen(prefix), "%lf over %lf %lf", &bound.limit, &bound.low, &bound.high);
            found = fields == 1 || fields == 3;
        }
    }
    fclose(file);
    if (!of_model) bound.limit *= test_slack;
    if (!found) {
        printf("    %s has no tag '%s...]'\n", header, prefix);
        failures++;
    }
    return bound;
}

void test_within(test_bound *bound, double got, double wanted, double unit, const double *inputs, int count) {
    double error = fabs(got - wanted) / unit;
    if (error > bound->worst) bound->worst = error;
    if (!(error <= bound->limit)) { /* also when it is NaN */
        char what[256];
        snprintf(what, sizeof what, "%s: got %a (%.9g), wanted %a (%.9g), error %.4g, limit %.4g", bound->label, got,
                 got, wanted, wanted, error, bound->limit);
        fail(what, inputs, count);
    }
}

void test_that(int condition, const char *what, const double *inputs, int count) {
    if (!condition) fail(what, inputs, count);
}

void test_report(const test_bound *bound) {
    if (test_verbose && !test_quiet)
        printf("    %-40s worst %-10.4g limit %.4g\n", bound->label, bound->worst, bound->limit);
}

double test_ulp(double value) {
    float magnitude = (float)fabs(value);
    if (magnitude < FLT_MIN) return (double)FLT_MIN * (double)FLT_EPSILON;
    return (double)nextafterf(magnitude, INFINITY) - (double)magnitude;
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
    if (!test_quiet) printf("%s %s\n", failures ? "FAILED" : "ok    ", test->name);
    fflush(stdout);
    return failures;
}
