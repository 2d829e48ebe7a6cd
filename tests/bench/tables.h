/* tables.h - what the bench writes as files besides printing it */
#ifndef TABLES_H
#define TABLES_H

#include "../../examples/common/csv.h"

enum { TABLE_FUNCTIONS, TABLE_FIS, TABLE_LIMITS, TABLE_HARD_CASES, TABLES };

extern csv bench_table[TABLES];

/* Gives up when files cannot be written there; null for no files. */
void tables_begin(const char *folder);

/* Writes the tables that have rows, and leaves the files of others as they were. */
void tables_end(const char *folder);

#endif
