/* The generator of the tests and the bench. */
#include "test.h"
#include <math.h>

test_rng test_random;
double (*test_redraw)(const test_rng *rng, double drawn);

double test_uniform(test_rng *rng) { /* splitmix64, Steele et al. 2014 */
    unsigned long long z = (rng->state += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    z ^= z >> 31;
    return test_redraw ? test_redraw(rng, (double)(z >> 11) * 0x1p-53) : (double)(z >> 11) * 0x1p-53;
}

double test_log_uniform(test_rng *rng, double low, double high) {
    return low * pow(high / low, test_uniform(rng));
}

void test_direction(test_rng *rng, double direction[3]) {
    double z = 2 * test_uniform(rng) - 1, phi = 6.283185307179586 * test_uniform(rng), r = sqrt(1 - z * z);
    direction[0] = r * cos(phi);
    direction[1] = r * sin(phi);
    direction[2] = z;
}
