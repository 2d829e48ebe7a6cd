/* tables.c - the bench's files */
#include "tables.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/output.h"
#include <string.h>

#define TIMES(name) name "_ns," name "_ns_low," name "_ns_high"

static const struct {
    const char *name, *columns, *what;
} kinds[TABLES] = {
    {"/functions.csv", "header,function,form,ours,inputs,unit,max_error,rms_error," TIMES("scalar") "," TIMES("vector"),
     "functions"},
    {"/fis.csv", "pdf,method,ours," TIMES("level") ",texels,level_rms,level_max,gap,overlap,brightest,total",
     "kernels"},
    {"/limits.csv", "loop,resource,unit,amount," TIMES("loop") ",peak,fraction", "distance to the machine's limits"},
    {"/hard_cases.csv", "function,case,got,wanted,error,unit,limit,printed_got,printed_error", "hard cases"}};

csv bench_table[TABLES];

void tables_begin(const char *folder) {
    int k;
    if (folder && strlen(folder) + 32 > OUTPUT_NAME) give_up(folder, "the path is too long");
    for (k = 0; k < TABLES; k++) {
        bench_table[k] = csv_begin(kinds[k].columns);
        if (folder) output_check(folder, kinds[k].name);
    }
}

void tables_end(const char *folder) {
    int k;
    for (k = 0; folder && k < TABLES; k++) {
        if (bench_table[k].length > strlen(kinds[k].columns) + 1)
            csv_end(&bench_table[k], folder, kinds[k].name, kinds[k].what);
    }
}
