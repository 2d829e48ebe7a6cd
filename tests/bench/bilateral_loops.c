/*
 bilateral_loops.c - one loop for each weight of bilateral.h, which must become vector code, and the paper's as printed
*/
#include "../../bilateral.h"
#include "asg_columns.h"

#define FROM &in->column[0][i], BENCH_COUNT
#define A lobe_in(FROM, LOBE_A)
#define B lobe_in(FROM, LOBE_B)
#define FIRST asg_in(FROM, ASG_A)
#define SECOND asg_in(FROM, ASG_B)
#define BETA in->column[UNIFORM_U][i]
#define OUT(k) out->column[k][i]

BENCH_LOOP(our_depth_weight, OUT(0) = bilateral_depth_weight(A.axis.x, B.axis.x, BETA);)
BENCH_LOOP(our_normal_weight, OUT(0) = bilateral_normal_weight(A.axis, B.axis, 1 / A.sharpness);)
BENCH_LOOP(our_gaussian_weight, OUT(0) = bilateral_gaussian_weight(A.axis.x, A.sharpness, B.axis.x, B.sharpness, BETA);)
BENCH_LOOP(our_sg_weight, OUT(0) = bilateral_sg_weight(A, B, BETA);)
BENCH_LOOP(our_sg_tap,
           OUT(0) = bilateral_sg_tap(0, bilateral_sg_prepare(A, BETA), bilateral_sg_prepare(B, BETA), BETA);)
BENCH_LOOP(our_asg_weight, OUT(0) = bilateral_asg_weight(FIRST, SECOND, 20);)
BENCH_LOOP(printed_sg_weight, {
    float sum = A.sharpness + B.sharpness;
    OUT(0) = powf(2 * sqrtf(A.sharpness * B.sharpness) / sum, BETA) *
             expf(BETA * A.sharpness * B.sharpness / sum * (lobe_dot(A.axis, B.axis) - 1));
})
BENCH_LOOP(printed_normal_weight, {
    lobe_vec3 d = lobe_sub(A.axis, B.axis);
    OUT(0) = expf(-lobe_dot(d, d) / (2 * (1 / A.sharpness)));
})
