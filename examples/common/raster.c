#include "raster.h"
#include "file.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const bad_header = "its header is cut short or damaged";
static const char *const more_bytes = "it has more bytes than its texels take";

/* What is left of a file */
typedef struct {
    const unsigned char *at, *end;
} bytes_left;

static size_t left(const bytes_left *b) {
    return (size_t)(b->end - b->at);
}

static int is_space(int c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The next word, of at most size - 1 characters, and what ends it; 0 if there is none */
static int read_word(bytes_left *b, char *word, size_t size) {
    size_t length = 0;
    while (b->at < b->end && is_space(*b->at)) b->at++;
    while (b->at < b->end && !is_space(*b->at)) {
        if (length + 1 == size) return 0;
        word[length++] = (char)*b->at++;
    }
    word[length] = 0;
    if (b->at == b->end) return 0;
    b->at++; /* exactly one: the texels may begin with what looks like a space */
    return length > 0;
}

/* A line without its end; what is too long is cut */
static int read_line(bytes_left *b, char *line, size_t size) {
    size_t length = 0;
    while (b->at < b->end && *b->at != '\n') {
        if (length + 1 < size) line[length++] = (char)*b->at;
        b->at++;
    }
    line[length] = 0;
    if (b->at == b->end) return 0;
    b->at++;
    return 1;
}

/* A number of texels along a side; 0 if it is not one */
static int read_side(const char *word) {
    char *end;
    long side = strtol(word, &end, 10);
    return *word >= '0' && *word <= '9' && !*end && side <= RASTER_MAX_SIDE ? (int)side : 0;
}

/* The size of a raster that has no values yet */
static const char *read_size(raster *r, const char *width, const char *height, int channels) {
    r->values = NULL;
    r->width = read_side(width);
    r->height = read_side(height);
    r->channels = channels;
    if (r->width < 1 || r->height < 1) return "its header has no size from 1 x 1 to 32768 x 32768";
    if ((double)r->width * r->height > RASTER_MAX_TEXELS) return "it has more than 67108864 texels";
    return NULL;
}

static const char *make_room(raster *r) {
    r->values = (float *)malloc((size_t)r->width * (size_t)r->height * (size_t)r->channels * sizeof *r->values);
    return r->values ? NULL : "not enough memory";
}

/* -1 for little endian, 1 for big endian, 0 for what is no finite number other than 0. Letters are looked at, since a
   comparison with NaN or infinity is nothing to rely on with -ffast-math. */
static int read_scale(const char *word) {
    char *end;
    double scale;
    if (word[strspn(word, "+-.0123456789eE")]) return 0;
    errno = 0;
    scale = strtod(word, &end);
    return *end || errno ? 0 : (scale > 0) - (scale < 0);
}

static const char *parse_pfm(bytes_left *b, raster *r) {
    char kind[8], width[16], height[16], scale[64];
    const char *wrong;
    size_t floats, bytes, i;
    int row, k, order;
    if (!read_word(b, kind, sizeof kind) || !read_word(b, width, sizeof width) ||
        !read_word(b, height, sizeof height) || !read_word(b, scale, sizeof scale))
        return bad_header;
    if (kind[2]) return "it is neither PF nor Pf";
    order = read_scale(scale);
    if (!order) return "its header has no scale: a number other than 0";
    wrong = read_size(r, width, height, kind[1] == 'F' ? 3 : 1);
    if (wrong) return wrong;
    floats = (size_t)r->width * (size_t)r->channels;
    bytes = 4 * floats * (size_t)r->height;
    if (left(b) != bytes) return left(b) < bytes ? "it has fewer texels than its header says" : more_bytes;
    wrong = make_room(r);
    if (wrong) return wrong;
    for (row = r->height - 1; row >= 0; row--) { /* the last row comes first */
        float *values = r->values + (size_t)row * floats;
        for (i = 0; i < floats; i++) {
            unsigned bits = 0;
            for (k = 0; k < 4; k++) bits |= (unsigned)b->at[k] << (order < 0 ? 8 * k : 24 - 8 * k);
            memcpy(&values[i], &bits, sizeof bits);
            b->at += 4;
        }
    }
    return NULL;
}

/* One component of a scanline: runs of one byte, and of bytes as they are */
static int read_component(bytes_left *b, unsigned char *row, int width) {
    int x = 0;
    while (x < width) {
        int run, same;
        if (left(b) < 2) return 0;
        run = *b->at++;
        same = run > 128;
        if (same) run -= 128;
        if (run == 0 || run > width - x || (!same && left(b) < (size_t)run)) return 0;
        for (; run > 0; run--, x++) {
            row[4 * x] = *b->at;
            if (!same) b->at++;
        }
        if (same) b->at++;
    }
    return 1;
}

/* One row of red, green, blue and exponent bytes; 0 if the file does not hold it */
static int read_scanline(bytes_left *b, unsigned char *row, int width) {
    int x = 0, k, shift = 0; /* runs follow each other as the bytes of one length, low first */
    if (width >= 8 && width < 32768 && left(b) >= 4 && b->at[0] == 2 && b->at[1] == 2 && b->at[2] < 128) {
        if ((b->at[2] << 8 | b->at[3]) != width) return 0;
        b->at += 4;
        for (k = 0; k < 4; k++) {
            if (!read_component(b, row + k, width)) return 0;
        }
        return 1;
    }
    while (x < width) {
        if (left(b) < 4) return 0;
        if (b->at[0] == 1 && b->at[1] == 1 && b->at[2] == 1) { /* the last texel again, in the old way */
            int run = b->at[3] << shift;
            if (x == 0 || shift > 8 || run > width - x) return 0;
            for (; run > 0; run--, x++) memcpy(row + 4 * x, row + 4 * (x - 1), 4);
            shift += 8;
        } else {
            memcpy(row + 4 * x++, b->at, 4);
            shift = 0;
        }
        b->at += 4;
    }
    return 1;
}

static void decode_row(const unsigned char *row, int width, float *values) {
    int x, k;
    for (x = 0; x < width; x++) {
        const float scale = row[4 * x + 3] ? ldexpf(1, row[4 * x + 3] - (128 + 8)) : 0;
        for (k = 0; k < 3; k++) values[3 * x + k] = (float)row[4 * x + k] * scale;
    }
}

/* All rows into the raster; where it has no room yet, only whether they are there and nothing else is. A few bytes may
   stand for many texels, so that the size of the file does not tell. */
static const char *read_scanlines(bytes_left b, raster *r, unsigned char *row) {
    int y;
    for (y = 0; y < r->height; y++) {
        if (!read_scanline(&b, row, r->width)) return "its texels are cut short or damaged";
        if (r->values) decode_row(row, r->width, r->values + (size_t)y * (size_t)r->width * 3);
    }
    return left(&b) ? more_bytes : NULL;
}

static const char *parse_radiance(bytes_left *b, raster *r) {
    char line[256], first[8], second[8], height[16], width[16], rest[2];
    unsigned char *row;
    const char *wrong;
    int known = 0;
    do { /* variables, up to an empty line */
        if (!read_line(b, line, sizeof line)) return bad_header;
        if (strncmp(line, "FORMAT=", 7) == 0) known = strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    } while (line[0]);
    if (!known) return "its format is not 32-bit_rle_rgbe";
    if (!read_line(b, line, sizeof line)) return bad_header;
    if (sscanf(line, "%7s %15s %7s %15s%1s", first, height, second, width, rest) != 4 || strcmp(first, "-Y") != 0 ||
        strcmp(second, "+X") != 0)
        return "its size is not '-Y height +X width'";
    wrong = read_size(r, width, height, 3);
    if (wrong) return wrong;
    row = (unsigned char *)malloc((size_t)r->width * 4);
    if (!row) return "not enough memory";
    wrong = read_scanlines(*b, r, row);
    if (!wrong) wrong = make_room(r);
    if (!wrong) wrong = read_scanlines(*b, r, row);
    free(row);
    return wrong;
}

const char *raster_parse(const unsigned char *bytes, size_t count, raster *result) {
    bytes_left b;
    b.at = bytes;
    b.end = bytes + count;
    if (count >= 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f')) return parse_pfm(&b, result);
    if (count >= 2 && bytes[0] == '#' && bytes[1] == '?') return parse_radiance(&b, result);
    return "it is neither PFM nor Radiance HDR";
}

const char *raster_read(const char *path, raster *result) {
    unsigned char *bytes;
    size_t count;
    const char *wrong = file_read(path, (size_t)RASTER_MAX_TEXELS * 12 + 4096, &bytes, &count);
    if (wrong) return wrong;
    wrong = raster_parse(bytes, count, result);
    free(bytes);
    return wrong;
}

int raster_in_range(float value, float low, float high) {
    unsigned bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits & 0x7FFFFFFFu) < 0x7F800000u && value >= low && value <= high;
}

const char *raster_write(const char *path, const raster *picture) {
    file f;
    const char *wrong = file_begin(&f, path);
    const size_t floats = (size_t)picture->width * (size_t)picture->channels;
    int row, k;
    size_t i;
    if (wrong) return wrong;
    fprintf(f.stream, "%s\n%d %d\n-1.0\n", picture->channels == 3 ? "PF" : "Pf", picture->width, picture->height);
    for (row = picture->height - 1; row >= 0; row--) {
        for (i = 0; i < floats; i++) {
            unsigned bits;
            memcpy(&bits, &picture->values[(size_t)row * floats + i], sizeof bits);
            for (k = 0; k < 4; k++) putc((int)(bits >> 8 * k & 255), f.stream);
        }
    }
    return file_end(&f);
}
