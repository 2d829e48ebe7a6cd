/*
 counted.h - compiles a file of loops so that they count their floating-point operations

 Included ahead of a file of loops that is compiled as C++, this makes float a class. Sums, products, quotients and
 square roots of it count one each, the last two as divisions too; comparisons, signs, conversions and the bits' operations none. Constants that the
 compiler computes are none either. The C library's functions count nothing but sqrtf: loops that call others are not
 asked.
*/
#ifndef COUNTED_H
#define COUNTED_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

extern "C" double bench_operations, bench_divisions;

struct counted {
    float value;
    counted() = default;
    counted(float x) : value(x) {
    }
    counted(double x) : value((float)x) {
    }
    counted(int x) : value((float)x) {
    }
    counted(unsigned x) : value((float)x) {
    }
    explicit operator int() const {
        return (int)value;
    }
    explicit operator float() const {
        return value;
    }
    explicit operator double() const {
        return (double)value;
    }
};

#define COUNTED_OPERATOR(sign, divisions)                                                                              \
    inline counted operator sign(counted a, counted b) {                                                               \
        bench_operations++, bench_divisions += divisions;                                                              \
        return counted(a.value sign b.value);                                                                          \
    }                                                                                                                  \
    inline counted &operator sign##=(counted &a, counted b) {                                                          \
        return a = a sign b;                                                                                           \
    }
COUNTED_OPERATOR(+, 0)
COUNTED_OPERATOR(-, 0)
COUNTED_OPERATOR(*, 0)
COUNTED_OPERATOR(/, 1)

#define COUNTED_COMPARISON(sign)                                                                                       \
    inline int operator sign(counted a, counted b) {                                                                   \
        return a.value sign b.value;                                                                                   \
    }
COUNTED_COMPARISON(<)
COUNTED_COMPARISON(>)
COUNTED_COMPARISON(<=)
COUNTED_COMPARISON(>=)

inline counted operator-(counted a) {
    return counted(-a.value);
}

inline counted sqrtf(counted x) {
    bench_divisions++;
    bench_operations++;
    return counted(::sqrtf(x.value));
}

#define COUNTED_FUNCTION(name)                                                                                         \
    inline counted name(counted x) {                                                                                   \
        return counted(::name(x.value));                                                                               \
    }
COUNTED_FUNCTION(fabsf)
COUNTED_FUNCTION(expf)
COUNTED_FUNCTION(expm1f)
COUNTED_FUNCTION(logf)
COUNTED_FUNCTION(sinf)
COUNTED_FUNCTION(cosf)
COUNTED_FUNCTION(asinf)
COUNTED_FUNCTION(acosf)
COUNTED_FUNCTION(erff)
COUNTED_FUNCTION(erfcf)

inline counted copysignf(counted a, counted b) {
    return counted(::copysignf(a.value, b.value));
}
inline counted powf(counted a, counted b) {
    return counted(::powf(a.value, b.value));
}

/* sg.h declares sqrtf anew where this is defined, as what float no longer is. */
#undef __GLIBC__
#define float counted
#define restrict __restrict

#endif
