/*
 csv.h - what the bench writes besides its tables: files that are whole or absent

 A row is its fields in order. Without a folder nothing is written.
*/
#ifndef CSV_H
#define CSV_H

#include "bench.h"

typedef enum { CSV_FUNCTIONS, CSV_FIS, CSV_LIMITS, CSV_HARD_CASES, CSV_FILES } csv_file;

/* Gives up with a message when the files cannot be written there; null for no files. */
void csv_begin(const char *folder);

void csv_text(csv_file f, const char *text); /* a comma becomes a semicolon */
void csv_number(csv_file f, double number);
void csv_error(csv_file f, double error);
void csv_times(csv_file f, bench_time seconds, double scale); /* median, quartiles */
void csv_none(csv_file f, int count);
void csv_end_row(csv_file f);

/* Renames what has rows to its name, and leaves files without rows as they were. */
void csv_end(void);

#endif
