/* How exact a device's own functions are, beside the C library's in double. */
#include "precision.h"
#include "../../examples/common/fail.h"
#include "../test.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FUNCTIONS = 6, GROUPS = 2048, COUNT = 64 * GROUPS };

/* In the order of precision.comp. Vulkan 1.1 allows ulps, of which one is up to 2 units: 3 + 2 |x| for exp and exp2, 3
   for log but 2^-21 from .5 to 2, 2 for inversesqrt, 2.5 for a quotient, and for sqrt what 1 / inversesqrt makes. In the
   headers sg.h states what an exponential or logarithm is off by; the others are made of operations that round to the
   nearest, by at most one unit each. */
static const struct {
    const char *name, *unit;
    double allowed;
    const char *stated; /* null: operations */
    int operations;
} functions[FUNCTIONS] = {{"exp", "(1 + |x|) 2^-24", 6, "lobe_exp2", 0},
                          {"exp2", "(1 + |x|) 2^-24", 6, "lobe_exp2", 0},
                          {"log", "max(1, |log x|) 2^-24", 8, "lobe_log", 0},
                          {"sqrt", "2^-24", 9, NULL, 1},
                          {"inversesqrt", "2^-24", 4, NULL, 2},
                          {"division", "2^-24", 5, NULL, 1}};

/* Inputs whose results are normal floats; of the exponentials, half of them near 0 */
static void draw(test_rng *rng, int function, int i, float number[2]) {
    number[0] = number[1] = 1;
    if (function < 2 && i % 2)
        number[0] = (float)(test_log_uniform(rng, 1e-8, 1) * (i % 4 == 1 ? 1 : -1));
    else if (function < 2)
        number[0] = (float)((function ? 126 : 87) * (2 * test_uniform(rng) - 1));
    else if (function == 2 && i % 2)
        number[0] = (float)(0.5 + 1.5 * test_uniform(rng));
    else if (function < 5)
        number[0] = (float)test_log_uniform(rng, 0x1p-126, 0x1p126);
    else {
        number[0] = (float)test_log_uniform(rng, 0x1p-60, 0x1p60);
        number[1] = (float)test_log_uniform(rng, 0x1p-60, 0x1p60);
    }
}

static double error_of(int function, const float number[2], double got) {
    double x = (double)number[0], wanted, unit;
    switch (function) {
    case 0:
        wanted = exp(x), unit = wanted * (1 + fabs(x));
        break;
    case 1:
        wanted = exp2(x), unit = wanted * (1 + fabs(x));
        break;
    case 2:
        wanted = log(x), unit = fmax(1, fabs(wanted));
        break;
    case 3:
        unit = wanted = sqrt(x);
        break;
    case 4:
        unit = wanted = 1 / sqrt(x);
        break;
    default:
        unit = wanted = x / (double)number[1];
        break;
    }
    return fabs(got - wanted) / (TEST_EPSILON * unit);
}

static double worst_of(gpu *device, const char *folder, const char *language, int function) {
    static const gpu_kind kinds[2] = {GPU_STORAGE, GPU_STORAGE};
    float *numbers = (float *)allocate("numbers", 2 * COUNT, sizeof *numbers);
    float *results = (float *)allocate("results", COUNT, sizeof *results);
    test_rng rng = {131};
    gpu_buffer *buffers[2];
    gpu_program *program;
    char path[1024];
    double worst = 0;
    int i;
    for (i = 0; i < COUNT; i++) draw(&rng, function, i, numbers + 2 * i);
    snprintf(path, sizeof path, "%s/%s", folder, language);
    program = gpu_compute_create(device, path, "precision", kinds, 2, function);
    buffers[0] = gpu_buffer_of(device, GPU_STORAGE, numbers, 2 * COUNT * sizeof *numbers);
    buffers[1] = gpu_buffer_create(device, GPU_STORAGE, COUNT * sizeof *results);
    gpu_run(program, buffers, GROUPS, 1, 1);
    gpu_buffer_read(buffers[1], results);
    for (i = 0; i < COUNT; i++) {
        double error = test_is_finite(results[i]) ? error_of(function, numbers + 2 * i, (double)results[i]) : 1e30;
        worst = fmax(worst, error);
    }
    gpu_buffer_free(buffers[0]);
    gpu_buffer_free(buffers[1]);
    gpu_program_free(program);
    free(numbers);
    free(results);
    return worst;
}

double precision_measure(gpu *device, const char *folder, int *failures) {
    double largest = 0;
    int i;
    for (i = 0; i < FUNCTIONS; i++) {
        const char *stated = functions[i].stated;
        double allowed = functions[i].allowed, ours = functions[i].operations;
        double worst = fmax(worst_of(device, folder, "glsl", i), worst_of(device, folder, "hlsl", i));
        if (stated) ours = test_bound_of("sg.h", stated, "rel").limit / (test_slack * TEST_EPSILON);
        printf("%s %s: %.2f %s, of %g that Vulkan allows; the header's C %.2f\n", worst > allowed ? "FAILED" : "ok    ",
               functions[i].name, worst, functions[i].unit, allowed, ours);
        *failures += worst > allowed;
        largest = fmax(largest, fmin(worst, allowed) / ours);
    }
    return largest;
}
