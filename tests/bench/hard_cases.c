#include "bench.h"
int hard_cases_failed;
void hard_cases_bench(void) {
}
