/* Runs the tests that a file names, one a line, until one fails: what a mutant of a header is judged by. */
#include "../test.h"
#include <stdio.h>
#include <string.h>
#include <time.h>

static const test_case *named(const char *name) {
    size_t table;
    const test_case *test;
    for (table = 0; test_tables[table]; table++)
        for (test = test_tables[table]; test->name; test++)
            if (!strcmp(test->name, name)) return test;
    return NULL;
}

int main(int argc, char **argv) {
    char name[128];
    FILE *names;
    int timed = argc == 3 && !strcmp(argv[1], "--time");
    if (argc != 2 + timed) {
        fprintf(stderr, "usage: run [--time] FILE\n"
                        "  FILE    names of tests, one a line; prints the first that fails\n"
                        "  --time  prints milliseconds and name of each that passes\n");
        return 2;
    }
    names = fopen(argv[1 + timed], "r");
    if (!names) {
        fprintf(stderr, "run: cannot read %s\n", argv[1 + timed]);
        return 2;
    }
    test_files = argv[0];
    test_quiet = 1;
    test_quick = 1;
    test_most = 10000;
    while (fgets(name, sizeof name, names)) {
        clock_t begun = clock();
        const test_case *test;
        name[strcspn(name, "\n")] = 0;
        test = named(name);
        if (!test) {
            fprintf(stderr, "run: no test %s\n", name);
            return 2;
        }
        if (test_run(test)) {
            printf("%s\n", name);
            return 1;
        }
        if (timed) printf("%.0f %s\n", (double)(clock() - begun) * 1e3 / CLOCKS_PER_SEC, name);
    }
    fclose(names);
    return 0;
}
