/* csv.c - the bench's files */
#include "csv.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/file.h"
#include <stdlib.h>
#include <string.h>

enum { PATH = 1024 };

#define TIMES(name) name "_ns," name "_ns_low," name "_ns_high"

static const struct {
    const char *name, *columns;
} kinds[CSV_FILES] = {
    {"functions.csv", "header,function,form,ours,inputs,unit,max_error,rms_error," TIMES("scalar") "," TIMES("vector")},
    {"fis.csv", "pdf,method,ours," TIMES("level") ",texels,level_rms,level_max,gap,overlap,brightest,total"},
    {"limits.csv", "loop,resource,unit,amount," TIMES("loop") ",peak,fraction"},
    {"hard_cases.csv", "function,case,got,wanted,error,unit,limit,printed_got,printed_error"}};

static struct {
    char path[PATH];
    file out;
    int begun, fields; /* of the row */
} files[CSV_FILES];
static int writing;

/* What an early end leaves unfinished */
static void drop(void) {
    int k;
    for (k = 0; k < CSV_FILES; k++) {
        if (!files[k].begun) continue;
        fclose(files[k].out.stream);
        remove(files[k].out.part);
    }
}

void csv_begin(const char *folder) {
    int k;
    if (!folder) return;
    writing = 1;
    atexit(drop);
    for (k = 0; k < CSV_FILES; k++) {
        const char *wrong;
        if (strlen(folder) + strlen(kinds[k].name) + 2 > PATH) give_up(folder, "the path is too long");
        strcpy(files[k].path, folder);
        strcat(files[k].path, "/");
        strcat(files[k].path, kinds[k].name);
        wrong = file_check(files[k].path);
        if (wrong) give_up(files[k].path, wrong);
    }
}

/* Where the next field goes; null where none is written */
static FILE *next(csv_file f) {
    if (!writing) return NULL;
    if (!files[f].begun) {
        const char *wrong = file_begin(&files[f].out, files[f].path);
        if (wrong) give_up(files[f].path, wrong);
        fprintf(files[f].out.stream, "%s\n", kinds[f].columns);
        files[f].begun = 1;
    }
    if (files[f].fields++ > 0) fputc(',', files[f].out.stream);
    return files[f].out.stream;
}

void csv_text(csv_file f, const char *text) {
    FILE *to = next(f);
    if (!to) return;
    for (; *text; text++) fputc(*text == ',' ? ';' : *text == '"' ? '\'' : *text, to);
}

void csv_number(csv_file f, double number) {
    FILE *to = next(f);
    if (to) fprintf(to, "%.6g", number);
}

void csv_error(csv_file f, double error) {
    FILE *to = next(f);
    if (to) fprintf(to, "%.9g", error);
}

void csv_times(csv_file f, bench_time seconds, double scale) {
    csv_number(f, seconds.median * scale);
    csv_number(f, seconds.low * scale);
    csv_number(f, seconds.high * scale);
}

void csv_none(csv_file f, int count) {
    for (; count > 0; count--) next(f);
}

void csv_end_row(csv_file f) {
    if (!writing) return;
    fputc('\n', files[f].out.stream);
    files[f].fields = 0;
}

void csv_end(void) {
    int k;
    for (k = 0; k < CSV_FILES; k++) {
        const char *wrong = files[k].begun ? file_end(&files[k].out) : NULL;
        files[k].begun = 0;
        if (wrong) give_up(files[k].path, wrong);
    }
}
