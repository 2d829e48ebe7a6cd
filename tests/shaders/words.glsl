// What the unit tests ask: each invocation reads its words, calls the function that is being asked for, and writes
// words. calls.awk adds the rest.

layout(std430, binding = 0) readonly buffer questions_buffer { uint questions[]; };
layout(std430, binding = 1) buffer answers_buffer { uint answers[]; };

uint next_uint(inout uint at) {
    uint word = questions[at];
    at += 1u;
    return word;
}

int next_int(inout uint at) {
    return int(next_uint(at));
}

bool next_bool(inout uint at) {
    return next_uint(at) != 0u;
}

float next_float(inout uint at) {
    return uintBitsToFloat(next_uint(at));
}

vec2 next_vec2(inout uint at) {
    vec2 v;
    v.x = next_float(at);
    v.y = next_float(at);
    return v;
}

vec3 next_vec3(inout uint at) {
    vec3 v;
    v.xy = next_vec2(at);
    v.z = next_float(at);
    return v;
}

vec4 next_vec4(inout uint at) {
    vec4 v;
    v.xyz = next_vec3(at);
    v.w = next_float(at);
    return v;
}

void put_uint(inout uint to, uint word) {
    answers[to] = word;
    to += 1u;
}

void put_int(inout uint to, int number) {
    put_uint(to, uint(number));
}

void put_bool(inout uint to, bool yes) {
    put_uint(to, yes ? 1u : 0u);
}

void put_float(inout uint to, float number) {
    put_uint(to, floatBitsToUint(number));
}

void put_vec2(inout uint to, vec2 v) {
    put_float(to, v.x);
    put_float(to, v.y);
}

void put_vec3(inout uint to, vec3 v) {
    put_vec2(to, v.xy);
    put_float(to, v.z);
}

void put_vec4(inout uint to, vec4 v) {
    put_vec3(to, v.xyz);
    put_float(to, v.w);
}
