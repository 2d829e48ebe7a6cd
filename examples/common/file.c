#include "file.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* path + ".part", to be freed; null when memory is short */
static char *part_name(const char *path) {
    char *name = (char *)malloc(strlen(path) + 6);
    if (name) {
        strcpy(name, path);
        strcat(name, ".part");
    }
    return name;
}

const char *file_check(const char *path) {
    const char *wrong = NULL;
    char *part = part_name(path);
    FILE *stream;
    if (!part) return "not enough memory";
    stream = fopen(part, "wb");
    if (stream) {
        fclose(stream);
        remove(part);
        stream = fopen(path, "r+b"); /* an existing file, or directory, must be one that can be replaced */
        if (stream)
            fclose(stream);
        else if (errno != ENOENT)
            wrong = strerror(errno);
    } else {
        wrong = strerror(errno);
    }
    free(part);
    return wrong;
}

const char *file_begin(file *f, const char *path) {
    const char *wrong;
    f->path = path;
    f->part = part_name(path);
    if (!f->part) return "not enough memory";
    f->stream = fopen(f->part, "wb");
    if (f->stream) return NULL;
    wrong = strerror(errno);
    free(f->part);
    return wrong;
}

const char *file_end(file *f) {
    const char *wrong = ferror(f->stream) ? strerror(errno) : NULL;
    if (fclose(f->stream) != 0 && !wrong) wrong = strerror(errno);
    if (!wrong && rename(f->part, f->path) != 0) {
        remove(f->path); /* some systems do not rename onto an existing file */
        if (rename(f->part, f->path) != 0) wrong = strerror(errno);
    }
    if (wrong) remove(f->part);
    free(f->part);
    return wrong;
}

const char *file_read(const char *path, size_t limit, unsigned char **bytes, size_t *count) {
    const char *wrong = NULL;
    size_t room = 1 << 16;
    FILE *stream = fopen(path, "rb");
    if (!stream) return strerror(errno);
    *bytes = (unsigned char *)malloc(room);
    *count = 0;
    errno = 0;
    while (*bytes) {
        unsigned char *more;
        *count += fread(*bytes + *count, 1, room - *count, stream);
        if (*count < room) break; /* the end, or an error */
        if (room > limit) break;
        more = (unsigned char *)realloc(*bytes, room * 2);
        if (!more) free(*bytes);
        *bytes = more;
        room *= 2;
    }
    if (!*bytes)
        wrong = "not enough memory";
    else if (ferror(stream)) /* a directory, for one */
        wrong = errno ? strerror(errno) : "cannot be read";
    else if (*count > limit)
        wrong = "the file is too large";
    if (wrong) free(*bytes);
    fclose(stream);
    return wrong;
}
