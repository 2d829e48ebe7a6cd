#include "fail.h"
#include <stdio.h>
#include <stdlib.h>

void give_up(const char *what, const char *why) {
    fprintf(stderr, "%s: %s: %s\n", program_name, what, why);
    exit(1);
}

void *allocate(const char *what, size_t count, size_t size) {
    void *memory = calloc(count ? count : 1, size);
    if (!memory) give_up(what, "not enough memory");
    return memory;
}
