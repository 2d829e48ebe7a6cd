#version 450
// What the device's own functions make of numbers, for precision.c

layout(constant_id = 0) const int which = 0;
layout(std430, binding = 0) readonly buffer numbers_buffer { float numbers[]; };
layout(std430, binding = 1) buffer results_buffer { float results[]; };

layout(local_size_x = 64) in;
void main() {
    uint i = gl_GlobalInvocationID.x;
    float x = numbers[2u * i], y = numbers[2u * i + 1u];
    if (which == 0) results[i] = exp(x);
    if (which == 1) results[i] = exp2(x);
    if (which == 2) results[i] = log(x);
    if (which == 3) results[i] = sqrt(x);
    if (which == 4) results[i] = inversesqrt(x);
    if (which == 5) results[i] = x / y;
}
