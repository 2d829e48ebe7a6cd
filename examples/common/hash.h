/* hash.h - numbers that look random, each from one before it. */
#ifndef HASH_H
#define HASH_H

static inline unsigned hash_mix(unsigned x) {
    x = (x ^ (x >> 16)) * 0x7FEB352Du;
    x = (x ^ (x >> 15)) * 0x846CA68Bu;
    return x ^ (x >> 16);
}

#endif
