/* The bounds that headers state and their unit, as tests and bench read them. */
#include "test.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *test_root = ".";

int test_read_bound(const char *header, const char *function, const char *kind, test_bound *bound, int *of_model) {
    char path[1024], line[1024], prefix[128];
    FILE *file;
    int found = 0;
    memset(bound, 0, sizeof *bound);
    *of_model = 0;
    snprintf(bound->label, sizeof bound->label, "%s %s", function, kind);
    snprintf(prefix, sizeof prefix, "[bound %s %s ", function, kind);
    snprintf(path, sizeof path, "%s/%s", test_root, header);
    file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "cannot read %s: run from the project's root, or give it with --root\n", path);
        exit(2);
    }
    while (!found && fgets(line, sizeof line, file)) {
        const char *tag = strstr(line, prefix);
        if (!strncmp(line, "   Rounding:", 12) || !strncmp(line, "   Model:", 9)) *of_model = line[3] == 'M';
        if (tag) {
            int fields = sscanf(tag + strlen(prefix), "%lf over %lf %lf", &bound->limit, &bound->low, &bound->high);
            found = fields == 1 || fields == 3;
        }
    }
    fclose(file);
    return found;
}

double test_ulp(double value) {
    float magnitude = (float)fabs(value);
    if (magnitude < FLT_MIN) return (double)FLT_MIN * (double)FLT_EPSILON;
    return (double)nextafterf(magnitude, INFINITY) - (double)magnitude;
}
