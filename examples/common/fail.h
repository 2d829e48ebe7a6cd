/* fail.h - the end of a program that cannot go on. */
#ifndef FAIL_H
#define FAIL_H

#include <stddef.h>

/* Each example defines it: what its messages begin with. */
extern const char *const program_name;

/* Says on stderr what is wrong, and exits with 1. */
void give_up(const char *what, const char *why);

/* Zeroed memory, or the program gives up on `what`. */
void *allocate(const char *what, size_t count, size_t size);

#endif
