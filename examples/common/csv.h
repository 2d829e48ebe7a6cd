/* csv.h - tables of numbers as files: one line a row, commas between fields, the columns' names in the first. A table
   is in memory until its file is written. All give up on what is wrong. */
#ifndef CSV_H
#define CSV_H

#include "progress.h"
#include <stddef.h>

typedef struct {
    char *text;
    size_t length, room;
    int fields; /* of the row so far */
} csv;

/* `columns`: their names, commas between; null if fields of the first row name them. */
csv csv_begin(const char *columns);

/* The next field of the row. Commas in a text become semicolons. */
void csv_text(csv *table, const char *text);
void csv_count(csv *table, long count);
void csv_number(csv *table, double value);
void csv_error(csv *table, double value);        /* with more digits */
void csv_quartiles(csv *table, quartiles times); /* three fields */
void csv_skip(csv *table, int count);             /* there are no such numbers */

void csv_row(csv *table);

/* Writes the file, whose name is made as in output.h, says so, and frees the table. */
void csv_end(csv *table, const char *prefix, const char *rest, const char *what);

#endif
