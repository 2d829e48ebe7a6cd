/*
 hard_cases.h - named inputs where formulas as printed break, each beside a reference in double

 A row's unit is that of the header's bound, and its limit the bound itself, read from the header.
*/
#ifndef HARD_CASES_H
#define HARD_CASES_H

#include "../../sg.h"
#include "bench.h"

/* What the error is, in units: the difference, that of the logarithms, or how far a value is above the one wanted */
typedef enum { HARD_DIFFERENCE, HARD_LOGARITHM, HARD_AT_MOST } hard_error;

typedef struct {
    const char *header, *function, *kind; /* the bound's tag; without a header the kind is the unit alone */
    const char *name;
    double got, wanted, unit;
    double limit; /* without a header */
    hard_error error;
} hard_case;

/* The row of a case; of one with the formula as printed in float, too. */
void hard_case_row(hard_case c);
void hard_case_row_printed(hard_case c, double printed);

hard_case hard_case_of(const char *header, const char *function, const char *kind, const char *name, double got,
                       double wanted, double unit);

/* Where no tag says it */
hard_case hard_case_within(const char *function, const char *unit, double limit, const char *name, double got,
                           double wanted);

/* One element for a loop of the bench, where printed forms are */
extern bench_input hard_in;
extern bench_output hard_out;
void hard_put(int column, lobe_vec3 v);

void hard_sg(void);
void hard_ggx_bound(void);
void hard_fis(void);
void hard_asg(void);

#endif
