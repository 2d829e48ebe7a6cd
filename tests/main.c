/* The unit-test executable: runs every test, or those whose name contains the argument. */
#include "test.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *root = ".";
static int verbose;
static int failures; /* of the running test */
int test_repeat = 1;

static void fail(const char *what, const double *inputs, int count) {
    int i;
    if (++failures > 5) return; /* the first few tell enough */
    printf("    FAILED %s; input", what);
    for (i = 0; i < count; i++) printf(" %a", inputs[i]);
    printf("\n");
}

test_bound test_bound_of(const char *header, const char *function, const char *kind) {
    test_bound bound;
    char path[1024], line[1024], prefix[128];
    FILE *file;
    int found = 0;
    memset(&bound, 0, sizeof bound);
    snprintf(bound.label, sizeof bound.label, "%s %s", function, kind);
    snprintf(prefix, sizeof prefix, "[bound %s %s ", function, kind);
    snprintf(path, sizeof path, "%s/%s", root, header);
    file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "tests: cannot read %s: run from the project's root, or give it with --root\n", path);
        exit(2);
    }
    while (!found && fgets(line, sizeof line, file)) {
        const char *tag = strstr(line, prefix);
        if (tag) {
            int fields = sscanf(tag + strlen(prefix), "%lf over %lf %lf", &bound.limit, &bound.low, &bound.high);
            found = fields == 1 || fields == 3;
        }
    }
    fclose(file);
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
    if (verbose) printf("    %-40s worst %-10.4g limit %.4g\n", bound->label, bound->worst, bound->limit);
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

static void usage(FILE *to) {
    fprintf(to, "usage: tests [--verbose] [--long] [--root DIR] [NAME]\n"
                "  NAME       run only the tests whose name contains it\n"
                "  --verbose  print the largest error seen beside each bound\n"
                "  --long     search four hundred times longer for what exceeds a bounding volume\n"
                "  --root     where the headers are (default: .)\n");
}

int main(int argc, char **argv) {
    const test_case *tables[6];
    const char *wanted = "";
    int passed = 0, failed = 0, i;
    size_t table;
    tables[0] = sg_tests;
    tables[1] = asg_tests;
    tables[2] = fis_tests;
    tables[3] = ggx_bound_tests;
    tables[4] = bilateral_tests;
    tables[5] = bilateral_asg_tests;
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        } else if (!strcmp(argv[i], "--verbose")) {
            verbose = 1;
        } else if (!strcmp(argv[i], "--long")) {
            test_repeat = 400;
        } else if (!strcmp(argv[i], "--root") && i + 1 < argc) {
            root = argv[++i];
        } else if (argv[i][0] == '-') {
            usage(stderr);
            return 2;
        } else {
            wanted = argv[i];
        }
    }
    for (table = 0; table < sizeof tables / sizeof *tables; table++) {
        const test_case *test;
        for (test = tables[table]; test->name; test++) {
            if (!strstr(test->name, wanted)) continue;
            failures = 0;
            test_random.state = 0;
            test->run();
            printf("%s %s\n", failures ? "FAILED" : "ok    ", test->name);
            fflush(stdout);
            if (failures)
                failed++;
            else
                passed++;
        }
    }
    if (passed + failed == 0) {
        fprintf(stderr, "tests: no test's name contains '%s'\n", wanted);
        return 2;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
