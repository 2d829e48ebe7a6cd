/*
 bench.h - speed beside error

 A row is one function on one kind of input: ours and what a user would otherwise write, as loops over planar arrays.
 Each loop is compiled twice, as vector code and as scalar code (the file of loops with BENCH_SCALAR and the
 compiler's vectorisers off), with the same flags otherwise. All forms of a row run on the same inputs, interleaved;
 times are medians, errors those of the timed loops against references in double.
*/
#ifndef BENCH_H
#define BENCH_H

#include "../../examples/common/progress.h"
#include "../test.h"

enum { BENCH_COUNT = 4096, BENCH_INPUTS = 24, BENCH_OUTPUTS = 8, BENCH_FORMS = 12, BENCH_RUNS = 40 };

/* Column by column; what a column holds is the row's own matter. */
typedef struct {
    float column[BENCH_INPUTS][BENCH_COUNT];
} bench_input;

typedef struct {
    float column[BENCH_OUTPUTS][BENCH_COUNT];
} bench_output;

typedef void bench_loop(const bench_input *restrict in, bench_output *restrict out);

typedef struct {
    const char *name;
    const char *loop; /* what is ours begins with our_ */
    bench_loop *scalar, *vector, *counted;
} bench_form;

typedef struct {
    const char *function;
    const char *inputs, *unit;                               /* printed: what is drawn, what errors are measured in */
    int batches;                                             /* of BENCH_COUNT inputs each, for the errors */
    void (*draw)(float in[BENCH_INPUTS]);                    /* one input, from test_random */
    void (*exact)(const float *in, double *wanted);          /* what it gives, BENCH_OUTPUTS numbers at most */
    double (*error)(const double *wanted, const float *out); /* in the unit */
    bench_form form[BENCH_FORMS];                            /* ours first; closed by a null name */
} bench_row;

/* One table per header, closed by a null function. */
extern const bench_row sg_bench[];
extern const bench_row asg_bench[];
extern const bench_row ggx_bound_bench[];
extern const bench_row bilateral_bench[];

/* What is no loop over columns: a table of its own. */
void fis_level_bench(void);
void fis_flicker_bench(void);
void fis_build_bench(void);
void bilateral_filter_bench(void);
void bilateral_figure4(void);
void limits_bench(void);
void hard_cases_bench(void);
extern int hard_cases_failed;

/* Seconds of run(0) to run(count - 1), interleaved; count is at most BENCH_RUNS. */
void bench_times(void (*run)(int which), int count, quartiles *seconds);

/* Half the distance between the quartiles, in percent of the median */
double bench_spread(quartiles seconds);

/* Inputs of a row for each element */
void bench_draw(const bench_row *row, bench_input *inputs);

/* The first fields of a row of functions.csv */
void bench_function_row(const char *header, const char *function, const char *form, int ours, const char *inputs,
                        const char *unit);

/* Fewer repetitions and batches */
extern int bench_quick;

/* The third counts its floating-point operations, where a C++ compiler is there to make it do so (counted.h). */
#ifdef BENCH_HAS_COUNTED
#define BENCH_COUNTED(name) name##_counted
#else
#define BENCH_COUNTED(name) 0
#endif
#define BENCH_DECLARE(name) bench_loop name##_scalar, name##_vector, name##_counted
#define BENCH_FORM(text, name)                                                                                         \
    { text, #name, name##_scalar, name##_vector, BENCH_COUNTED(name) }

/* In files of loops: defines the loop whose body sets out for the i-th element of in. */
#if defined(__cplusplus)
#define BENCH_NAME(name) name##_counted
#elif defined(BENCH_SCALAR)
#define BENCH_NAME(name) name##_scalar
#else
#define BENCH_NAME(name) name##_vector
#endif
#ifdef __cplusplus
#define BENCH_FUNCTION(name) extern "C" void BENCH_NAME(name)
#else
#define BENCH_FUNCTION(name) void BENCH_NAME(name)
#endif
#define BENCH_LOOP(name, ...)                                                                                          \
    BENCH_FUNCTION(name)(const bench_input *restrict in, bench_output *restrict out) {                                 \
        int i;                                                                                                         \
        for (i = 0; i < BENCH_COUNT; i++) {                                                                            \
            __VA_ARGS__                                                                                                \
        }                                                                                                              \
    }

#endif
