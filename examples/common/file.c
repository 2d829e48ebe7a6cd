#include "file.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* What went wrong last; a stream's error may be too old for errno to know. */
static const char *reason(const char *otherwise) {
    return errno ? strerror(errno) : otherwise;
}

/* path + ".part", to be freed; null when memory is short */
static char *part_name(const char *path) {
    char *name = (char *)malloc(strlen(path) + 6);
    if (name) {
        strcpy(name, path);
        strcat(name, ".part");
    }
    return name;
}

static void drop_part(file *f) {
    remove(f->part);
    free(f->part);
}

const char *file_begin(file *f, const char *path) {
    const char *wrong = NULL;
    FILE *before;
    f->path = path;
    f->part = part_name(path);
    if (!f->part) return "not enough memory";
    errno = 0;
    f->stream = fopen(f->part, "wb");
    if (!f->stream) {
        wrong = reason("cannot be created");
        free(f->part);
        return wrong;
    }
    before = fopen(path, "r+b"); /* what is there must be a file that may be replaced, and no directory */
    if (before)
        fclose(before);
    else if (errno != ENOENT)
        wrong = reason("cannot be replaced");
    if (wrong) {
        fclose(f->stream);
        drop_part(f);
    }
    errno = 0;
    return wrong;
}

const char *file_end(file *f) {
    const char *wrong = ferror(f->stream) ? reason("cannot be written") : NULL;
    if (fclose(f->stream) != 0 && !wrong) wrong = reason("cannot be written");
    if (!wrong && rename(f->part, f->path) != 0) {
        remove(f->path); /* some systems do not rename onto an existing file */
        if (rename(f->part, f->path) != 0) wrong = reason("cannot be renamed");
    }
    if (wrong)
        drop_part(f);
    else
        free(f->part);
    return wrong;
}

const char *file_check(const char *path) {
    file f;
    const char *wrong = file_begin(&f, path);
    if (wrong) return wrong;
    fclose(f.stream);
    drop_part(&f);
    return NULL;
}

const char *file_read(const char *path, size_t limit, unsigned char **bytes, size_t *count) {
    const char *wrong = NULL;
    size_t room = 1 << 16;
    FILE *stream;
    errno = 0;
    stream = fopen(path, "rb");
    if (!stream) return reason("cannot be opened");
    *bytes = (unsigned char *)malloc(room);
    *count = 0;
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
        wrong = reason("cannot be read");
    else if (*count > limit)
        wrong = "the file is too large";
    if (wrong) free(*bytes);
    fclose(stream);
    return wrong;
}
