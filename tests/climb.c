/*
 climb.c - a search for what exceeds a bound, through the numbers that a test draws

 A test runs again and again, and most of what it draws is what led to the largest error so far, somewhat changed: so
 bounds are attacked, not sampled. A draw is all numbers between two checks of a bound; which of the test's bounds it is
 for is told by the one checked before. Each bound is climbed to from three sides, as most have many summits.
*/
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NUMBERS = 640, SUMMITS = 192, SIDES = 3 };

typedef struct {
    char label[96], before[96]; /* the bound, and the one checked before its numbers were drawn */
    double share, limit;        /* the error over the limit, and that */
    double number[NUMBERS];
    int count, side;
} summit;

int test_rounds;
static summit summits[SUMMITS];
static double number[NUMBERS]; /* of the draw that goes on */
static char before[96];
static int known, count, side, drawing;
static const summit *from; /* what this draw is near, or null */
static double each, step;  /* chance that a number is changed, and how much */
static test_rng chance;

static void begin_draw(void) {
    int i, choices = 0;
    from = NULL;
    count = 0;
    drawing = 1;
    side = (int)(SIDES * test_uniform(&chance));
    if (test_uniform(&chance) < 0.1) return;
    for (i = 0; i < known; i++) {
        if (summits[i].count && !strcmp(summits[i].before, before) && test_uniform(&chance) * ++choices < 1)
            from = summits + i;
    }
    if (!from) return;
    side = from->side;
    step = test_log_uniform(&chance, 1e-5, 1);
    each = test_uniform(&chance) < 0.5 ? 1.0 / from->count : 0.6 * test_uniform(&chance);
}

static double redraw(const test_rng *rng, double drawn) {
    if (rng == &chance) return drawn;
    if (!drawing) begin_draw();
    if (from && count < from->count) {
        double old = from->number[count];
        if (test_uniform(&chance) >= each)
            drawn = old;
        else if (test_uniform(&chance) < 0.9)
            drawn = old + step * (drawn + test_uniform(&chance) - 1);
        drawn = fmin(drawn - floor(drawn), 1 - 0x1p-53);
    }
    if (count < NUMBERS) number[count] = drawn;
    if (count <= NUMBERS) count++; /* a test without bounds draws on and on */
    return drawn;
}

void test_climbed(const test_bound *bound, double error) {
    int i = 0;

    while (i < known &&
           (summits[i].side != side || strcmp(summits[i].label, bound->label) || strcmp(summits[i].before, before)))
        i++;
    if (i == known && known < SUMMITS) {
        memset(summits + known, 0, sizeof *summits);
        memcpy(summits[known].label, bound->label, sizeof bound->label);
        memcpy(summits[known].before, before, sizeof before);
        summits[known].side = side;
        summits[known].limit = bound->limit;
        summits[known++].share = -1;
    }
    if (i < known && error / bound->limit > summits[i].share) {
        summits[i].share = error / bound->limit;
        summits[i].count = count <= NUMBERS ? count : 0; /* longer draws are not climbed from */
        memcpy(summits[i].number, number, (size_t)summits[i].count * sizeof *number);
    }
    memcpy(before, bound->label, sizeof before);
    drawing = 0;
}

/* Runs a test as often as is wanted, each time with another seed. */
void test_climb(const test_case *test) {
    const unsigned long long seed = test_seed;
    int i, k, round;
    known = drawing = 0;
    before[0] = 0;
    chance.state = ~seed;
    test_redraw = redraw;
    for (round = 0; round < test_rounds; round++) {
        test_seed += 1ull << 32;
        test_random.state = test_seed;
        test->run();
    }
    test_redraw = NULL;
    test_seed = seed;
    for (i = 0; i < known && test_verbose; i++) {
        double worst = summits[i].share;
        int first = 1;
        for (k = 0; k < known; k++) {
            if (strcmp(summits[i].label, summits[k].label)) continue;
            worst = fmax(worst, summits[k].share);
            first &= k >= i;
        }
        if (first)
            printf("    climb to %-31s worst %-10.4g limit %.4g\n", summits[i].label, worst * summits[i].limit,
                   summits[i].limit);
    }
}
