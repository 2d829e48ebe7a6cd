/*
 test.h - the unit tests' harness

 A test is a function that makes checks. It fails when any of its checks does. A failed check prints its
 input as %a, what it got, what it wanted and the error in the bound's unit.

 Bounds are read from the header under test, so that a comment and its assertion cannot disagree:

   [bound sg_integral ulp 3 over 0x1p-126 0x1p100]       limit 3, low 0x1p-126, high 0x1p100
   [bound sg_eval conditioned 8]                         low and high 0
*/
#ifndef TEST_H
#define TEST_H

typedef struct {
    const char *name;
    void (*run)(void);
} test_case;

typedef struct {
    char label[96]; /* "sg_integral ulp" */
    double limit, low, high;
    double worst; /* largest error seen, in the bound's unit */
} test_bound;

/* The tag of one function and kind in a header; a missing tag fails the test and gives a limit of 0. */
test_bound test_bound_of(const char *header, const char *function, const char *kind);

/* The same as the header has it; returns whether it has. of_model: the tag is one of a model, not of rounding. */
int test_read_bound(const char *header, const char *function, const char *kind, test_bound *bound, int *of_model);

/* Fails when |got - wanted| > limit * unit, or when got is not finite. The inputs are printed on failure. */
void test_within(test_bound *bound, double got, double wanted, double unit, const double *inputs, int count);

/* A plain check: condition, what it says, and the inputs to print when it does not hold. */
void test_that(int condition, const char *what, const double *inputs, int count);

/* Prints the largest error seen beside the bound (with --verbose) */
void test_report(const test_bound *bound);

/* Neither infinite nor NaN; by its bits, since the suite also runs with -ffast-math. */
int test_is_finite(float value);

/* The units: spacing of floats at a value, and 2^-24. */
double test_ulp(double value);
#define TEST_EPSILON 0x1p-24

/* Fixed-seed generator: uniform in [0, 1), log-uniform in [low, high], uniform direction. */
typedef struct {
    unsigned long long state;
} test_rng;
double test_uniform(test_rng *rng);
double test_log_uniform(test_rng *rng, double low, double high);
void test_direction(test_rng *rng, double direction[3]);

/* Runs one test and prints how it went; returns how many of its checks failed. */
int test_run(const test_case *test);

extern const char *test_root; /* where the headers are */
extern int test_verbose, test_quiet, test_quick;
extern unsigned long long test_seed;
extern int test_least, test_most;

/* The count, but within these: shaders are asked about as often for each function. */
int test_draws(int count);

/* The count, or a tenth of it with --quick: where draws are slow, or many but none of shaders. */
int test_few(int count);

extern double test_slack; /* what limits of rounding are multiplied by: 1, more for shaders */

/* How often random searches are to be repeated: 1, many with --long. */
extern int test_repeat;

/* What climb.c runs a test again for, this often: each bound is attacked from the worst of its draws. A check without
   inputs is one of all draws together and left out. */
extern int test_rounds;
void test_climb(const test_case *test);
void test_climbed(const test_bound *bound, double error);

/* What is drawn in place of a number, while that search goes on; null otherwise. */
extern double (*test_redraw)(const test_rng *rng, double drawn);

/* A generator that starts anew with each test, so that a test draws the same alone as among others. */
extern test_rng test_random;

/* How the names of files that tests write begin: they are beside the executable, and removed. */
extern const char *test_files;

/* One table per header, and one for the examples' files; closed by a null name. All of them, closed by null. */
extern const test_case sg_tests[];
extern const test_case asg_tests[];
extern const test_case fis_tests[];
extern const test_case ggx_bound_tests[];
extern const test_case bilateral_tests[];
extern const test_case bilateral_asg_tests[];
extern const test_case raster_tests[];
extern const test_case *const test_tables[];

#endif
