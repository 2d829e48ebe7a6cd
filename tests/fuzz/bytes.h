/*
 bytes.h - arguments made of a fuzzer's bytes, and checks of what functions make of them

   bytes_begin(bytes, count);                         // whether arguments keep to the documented domain
   float alpha = bytes_float("alpha", 1e-4f, 1);      // any float of that domain; otherwise any bits at all
   bytes_check("ggx_ndf", value, 0, FLT_MAX);         // aborts in the domain, where value is not in that range

 Include the header under test first.
*/
#ifndef BYTES_H
#define BYTES_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint8_t *bytes_next, *bytes_end;
static int bytes_in_domain;
static volatile float bytes_seen; /* so that every result is computed */

static struct {
    const char *name;
    float value;
} bytes_taken[512];
static int bytes_taken_count;

static inline void bytes_begin(const uint8_t *bytes, size_t count) {
    bytes_next = bytes;
    bytes_end = bytes + count;
    bytes_taken_count = 0;
    bytes_in_domain = count > 0 && *bytes_next++ % 4;
}

static inline unsigned bytes_byte(void) {
    return bytes_next < bytes_end ? *bytes_next++ : 0;
}

static inline unsigned bytes_bits(void) {
    unsigned bits = bytes_byte();
    bits |= bytes_byte() << 8;
    bits |= bytes_byte() << 16;
    return bits | bytes_byte() << 24;
}

static inline int bytes_int(int low, int high) {
    return low + (int)((bytes_byte() | bytes_byte() << 8) % (unsigned)(high - low + 1));
}

static inline float bytes_record(const char *name, float value) {
    if (bytes_taken_count < (int)(sizeof bytes_taken / sizeof *bytes_taken)) {
        bytes_taken[bytes_taken_count].name = name;
        bytes_taken[bytes_taken_count++].value = value;
    }
    return value;
}

/* Any float of [low, high], each exponent about as often as another */
static inline float bytes_within(float low, float high) {
    unsigned bits = bytes_bits(), least, most;
    float value;
    memcpy(&value, &bits, sizeof value);
    if (value >= low && value <= high) return value;
    if (low < 0) return (float)((double)low + ((double)high - (double)low) * (bits / 4294967295.0));
    memcpy(&least, &low, sizeof least);
    memcpy(&most, &high, sizeof most);
    bits = least + bits % (most - least + 1);
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline float bytes_float(const char *name, float low, float high) {
    unsigned bits;
    float value;
    if (bytes_in_domain) return bytes_record(name, bytes_within(low, high));
    bits = bytes_bits();
    memcpy(&value, &bits, sizeof value);
    return bytes_record(name, value);
}

static inline void bytes_check(const char *function, float value, float low, float high) {
    int i;
    bytes_seen = value;
    if (!bytes_in_domain || (value >= low && value <= high)) return;
    fprintf(stderr, "%s: %a (%.9g) is not in [%.9g, %.9g]; of", function, (double)value, (double)value, (double)low,
            (double)high);
    for (i = 0; i < bytes_taken_count; i++)
        fprintf(stderr, " %s %a", bytes_taken[i].name, (double)bytes_taken[i].value);
    fprintf(stderr, "\n");
    abort();
}

static inline void bytes_check_finite(const char *function, float value) {
    bytes_check(function, value, -FLT_MAX, FLT_MAX);
}

#ifdef LOBE_SG_H

static inline lobe_vec3 bytes_vector(const char *name, float most) {
    lobe_vec3 v;
    v.x = bytes_float(name, -most, most);
    v.y = bytes_float(name, -most, most);
    v.z = bytes_float(name, -most, most);
    return v;
}

/* The same of components that are not negative: a colour */
static inline lobe_vec3 bytes_colour(const char *name, float most) {
    lobe_vec3 v;
    v.x = bytes_float(name, 0, most);
    v.y = bytes_float(name, 0, most);
    v.z = bytes_float(name, 0, most);
    return v;
}

/* Unit, often the last one, the opposite or a little off either; otherwise of any length */
static inline lobe_vec3 bytes_direction(const char *name) {
    static lobe_vec3 last;
    unsigned kind = bytes_byte();
    lobe_vec3 v;
    double size, x, y, z, off = 0;
    if (bytes_taken_count == 0) last = lobe_vector(0, 0, 1);
    if (!bytes_in_domain && kind < 128) return bytes_vector(name, 1);
    if (kind % 4 == 1) off = (double)bytes_within(0, 1e-2f);
    if (kind % 4 == 2) { /* all components by their bits, so small ones are as frequent as large ones */
        x = (double)bytes_within(0, 1) * (kind & 4 ? 1 : -1);
        y = (double)bytes_within(0, 1) * (kind & 8 ? 1 : -1);
        z = (double)bytes_within(0, 1) * (kind & 16 ? 1 : -1);
    } else {
        x = bytes_bits() / 2147483648.0 - 1;
        y = bytes_bits() / 2147483648.0 - 1;
        z = bytes_bits() / 2147483648.0 - 1;
    }
    if (kind % 4 == 1) {
        double sign = kind & 4 ? 1 : -1;
        x = sign * (double)last.x + off * x;
        y = sign * (double)last.y + off * y;
        z = sign * (double)last.z + off * z;
    }
    size = sqrt(x * x + y * y + z * z);
    v = size > 1e-30 ? lobe_vector((float)(x / size), (float)(y / size), (float)(z / size)) : lobe_vector(0, 0, 1);
    last = v;
    bytes_record(name, v.x);
    bytes_record(name, v.y);
    bytes_record(name, v.z);
    return v;
}

static inline void bytes_check_vector(const char *function, lobe_vec3 v, float most) {
    bytes_check(function, v.x, -most, most);
    bytes_check(function, v.y, -most, most);
    bytes_check(function, v.z, -most, most);
}

static inline void bytes_check_unit(const char *function, lobe_vec3 v) {
    bytes_check(function, v.x * v.x + v.y * v.y + v.z * v.z, 0.999997f, 1.000003f);
}

static inline sg_lobe bytes_sg(const char *name, float sharpness, float log_amplitude) {
    sg_lobe g;
    g.axis = bytes_direction(name);
    g.sharpness = bytes_float("sharpness", 0, sharpness);
    g.log_amplitude = bytes_float("log_amplitude", -log_amplitude, log_amplitude);
    return g;
}

static inline void bytes_check_sg(const char *function, sg_lobe g, float sharpness) {
    bytes_check_unit(function, g.axis);
    bytes_check(function, g.sharpness, 0, sharpness);
    bytes_check_finite(function, g.log_amplitude);
}

/* A light whose figures are within what points of light make, or any */
static inline vsgl bytes_vsgl(float variance) {
    vsgl v;
    int k;
    v.position = bytes_vector("position", 5e4f);
    v.variance = bytes_float("variance", 0, variance);
    for (k = 0; k < 2; k++) {
        v.emission[k] = bytes_sg("emission", 1e30f, 0);
        v.intensity[k] = bytes_colour("intensity", 1e18f);
    }
    return v;
}

#endif
#endif
