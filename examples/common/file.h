/* file.h - files that are whole or absent. */
#ifndef FILE_H
#define FILE_H

#include <stdio.h>

/* Whether a file can be created at the path; leaves nothing behind. Returns null, or what is wrong. */
const char *file_check(const char *path);

typedef struct {
    FILE *stream; /* to write to */
    const char *path;
    char *part;
} file;

/* Opens a file under another name, which file_end turns into the path. Each returns null, or what went wrong: then
   there is no file, and what was at the path before still is. */
const char *file_begin(file *f, const char *path);
const char *file_end(file *f);

/* All bytes of a file, to be freed. At most `limit` of them. Returns null, or what went wrong: then there is nothing to
   free. */
const char *file_read(const char *path, size_t limit, unsigned char **bytes, size_t *count);

#endif
