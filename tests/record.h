/*
 record.h - checks that print what was drawn: a test begins, records its input as it draws it, and checks

 Include sg.h first.
*/
#ifndef RECORD_H
#define RECORD_H

#include "test.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

static double input[48];
static int inputs;

static inline void begin(void) {
    inputs = 0;
}

static inline double record(double x) {
    if (inputs < COUNT(input)) input[inputs++] = x;
    return x;
}

static inline void record_vector(lobe_vec3 v) {
    record((double)v.x);
    record((double)v.y);
    record((double)v.z);
}

static inline void within(test_bound *bound, double got, double wanted, double unit) {
    test_within(bound, got, wanted, unit, input, inputs);
}

static inline void that(int condition, const char *what) {
    test_that(condition, what, input, inputs);
}

/* A bound that follows from others, or of a reference */
static inline test_bound stated(const char *label, double limit) {
    test_bound bound = {{0}, 0, 0, 0, 0};
    strncpy(bound.label, label, sizeof bound.label - 1);
    bound.limit = limit;
    return bound;
}

/* One of the first few whole numbers */
static inline int pick(int count) {
    return (int)(count * test_uniform(&test_random));
}

#endif
