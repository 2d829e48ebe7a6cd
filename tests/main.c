/* The unit-test executable: runs every test, or those whose name contains the argument. */
#include "test.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void usage(FILE *to) {
    fprintf(to, "usage: tests [--verbose] [--quick | --long] [--climb N] [--seed N] [--root DIR] [NAME]\n"
                "  NAME       run only the tests whose name contains it\n"
                "  --verbose  print the largest error seen beside each bound\n"
                "  --quick    a tenth of the draws, at most, where there are many: for slow machines\n"
                "  --long     search four hundred times longer for what exceeds a bounding volume\n"
                "  --climb    run each test N times more, each time drawn near the worst so far\n"
                "  --seed     draw other inputs (default: 0)\n"
                "  --root     where the headers are (default: .)\n");
}

int main(int argc, char **argv) {
    const char *wanted = "";
    int passed = 0, failed = 0, i;
    size_t table;
    test_files = argv[0];
    for (i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--help")) {
            usage(stdout);
            return 0;
        } else if (!strcmp(argv[i], "--verbose")) {
            test_verbose = 1;
        } else if (!strcmp(argv[i], "--long")) {
            test_repeat = 400;
        } else if (!strcmp(argv[i], "--climb") && i + 1 < argc) {
            test_rounds = atoi(argv[++i]);
            if (test_rounds < 1) {
                usage(stderr);
                return 2;
            }
        } else if (!strcmp(argv[i], "--quick")) {
            test_quick = 1;
            test_most = 10000;
        } else if (!strcmp(argv[i], "--seed") && i + 1 < argc) {
            test_seed = strtoull(argv[++i], NULL, 10) << 32;
        } else if (!strcmp(argv[i], "--root") && i + 1 < argc) {
            test_root = argv[++i];
        } else if (argv[i][0] == '-') {
            usage(stderr);
            return 2;
        } else {
            wanted = argv[i];
        }
    }
    for (table = 0; test_tables[table]; table++) {
        const test_case *test;
        for (test = test_tables[table]; test->name; test++) {
            if (!strstr(test->name, wanted)) continue;
            if (test_run(test))
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
