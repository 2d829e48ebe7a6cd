/* Prints a function whose domain was left, once until another one's is. */
#include <stdio.h>
#include <string.h>

void outside(const char *function) {
    static char last[64];
    if (!strcmp(last, function)) return;
    snprintf(last, sizeof last, "%s", function);
    printf("outside %s\n", function);
}
