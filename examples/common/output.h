/* output.h - what an example writes: files whose names begin with one prefix. All give up on what is wrong. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include "image.h"

enum { OUTPUT_NAME = 1024 };

/* prefix + rest */
void output_name(char path[OUTPUT_NAME], const char *prefix, const char *rest);

/* Whether it can be written, before the work begins; leaves nothing behind */
void output_check(const char *prefix, const char *rest);

/* image_write_png */
void output_picture(const char *prefix, const char *rest, const image *picture, float exposure);

#endif
