/*
 shader.h - lets the unit tests of the headers judge the shaders

 calls.awk wraps each function that a shader has too. A wrapper calls the header's function, writes down the words of
 the arguments and, where the GPU has answered them, returns its answer instead. So a test is run again and again: its
 questions are collected, the GPU answers them all at once, and what the test says in the end is about the answers.
*/
#ifndef SHADER_H
#define SHADER_H

#include "../../fis.h"
#include <stddef.h>

/* A call begins; its arguments follow, some of them arrays of which the shader takes a fixed number; when all are there
   it looks for the answer; and its results follow, which are replaced by the answer's. */
void shader_begin(int function, const char *name, int in_words, int out_words);
void shader_in(const void *argument, size_t size);
void shader_in_some(const void *elements, size_t size, int count, int most);
void shader_in_pyramid(const fis_pyramid *pdf);    /* its texels go into the pool of them, if they are not there */
void shader_in_planes(const fis_pyramid *pyramid); /* the same by planes of four channels */
void shader_find(void);
void shader_out(void *result, size_t size);
void shader_out_some(void *elements, size_t size, int count, int most);

/* Memory has other texels now. */
void shader_renew(void);

static inline fis_pyramid shader_fis_build(float *memory, const float *image, int width, int height, int channels) {
    shader_renew();
    return fis_build(memory, image, width, height, channels);
}
#define fis_build shader_fis_build

static inline fis_pyramid shader_fis_build_pdf(float *memory, const float *image, int width, int height) {
    shader_renew();
    return fis_build_pdf(memory, image, width, height);
}
#define fis_build_pdf shader_fis_build_pdf

#endif
