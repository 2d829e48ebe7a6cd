#include "raster.h"
#include "file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is left of a file */
typedef struct {
    const unsigned char *at, *end;
} bytes_left;

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

static const char *make_room(raster *r, int width, int height, int channels) {
    if (width < 1 || height < 1) return "its header has no size from 1 x 1 to 32768 x 32768";
    if ((double)width * height > RASTER_MAX_TEXELS) return "it has more than 67108864 texels";
    r->width = width;
    r->height = height;
    r->channels = channels;
    r->values = (float *)malloc((size_t)width * (size_t)height * (size_t)channels * sizeof *r->values);
    return r->values ? NULL : "not enough memory";
}

static const char *parse_pfm(bytes_left *b, raster *r) {
    char kind[8], width[16], height[16], scale[64], *end;
    int row, little, most, channels;
    const char *wrong;
    size_t floats, i, k;
    double factor;
    if (!read_word(b, kind, sizeof kind) || !read_word(b, width, sizeof width) ||
        !read_word(b, height, sizeof height) || !read_word(b, scale, sizeof scale))
        return "its header is cut short";
    channels = strcmp(kind, "PF") == 0 ? 3 : strcmp(kind, "Pf") == 0 ? 1 : 0;
    if (!channels) return "it is neither PF nor Pf";
    factor = strtod(scale, &end);
    if (*end || !(fabs(factor) > 0)) return "its header has no scale: a number other than 0";
    floats = (size_t)read_side(width) * (size_t)channels;
    if (floats && read_side(height) && (size_t)(b->end - b->at) / floats / 4 < (size_t)read_side(height))
        return "it has fewer texels than its header says";
    wrong = make_room(r, read_side(width), read_side(height), channels);
    if (wrong) return wrong;
    little = factor < 0;
    for (row = r->height - 1; row >= 0; row--) { /* the last row comes first */
        float *values = r->values + (size_t)row * floats;
        for (i = 0; i < floats; i++) {
            unsigned bits = 0;
            for (k = 0; k < 4; k++) bits |= (unsigned)b->at[k] << (little ? 8 * k : 24 - 8 * k);
            memcpy(&values[i], &bits, sizeof bits);
            b->at += 4;
        }
    }
    most = b->at < b->end;
    if (most) {
        free(r->values);
        return "it has more texels than its header says";
    }
    return NULL;
}

/* One row of red, green, blue and exponent bytes, into `row`; 0 if the file does not hold it */
static int read_scanline(bytes_left *b, unsigned char *row, int width) {
    int x = 0, k, shift = 0;
    if (width >= 8 && width < 32768 && b->end - b->at >= 4 && b->at[0] == 2 && b->at[1] == 2 && b->at[2] < 128) {
        if ((b->at[2] << 8 | b->at[3]) != width) return 0;
        b->at += 4;
        for (k = 0; k < 4; k++) { /* one component after the other */
            for (x = 0; x < width;) {
                int run, same;
                if (b->end - b->at < 2) return 0;
                run = *b->at++;
                same = run > 128;
                run = same ? run - 128 : run;
                if (run == 0 || run > width - x || (!same && b->end - b->at < run)) return 0;
                for (; run > 0; run--, x++) {
                    row[4 * x + k] = *b->at;
                    if (!same) b->at++;
                }
                if (same) b->at++;
            }
        }
        return 1;
    }
    while (x < width) {
        int run, i;
        if (b->end - b->at < 4) return 0;
        if (b->at[0] == 1 && b->at[1] == 1 && b->at[2] == 1) { /* the last texel again, in the old way */
            if (x == 0 || shift > 16) return 0;
            run = b->at[3] << shift;
            if (run > width - x) return 0;
            for (i = 0; i < run; i++, x++) memcpy(row + 4 * x, row + 4 * (x - 1), 4);
            shift += 8;
        } else {
            memcpy(row + 4 * x++, b->at, 4);
            shift = 0;
        }
        b->at += 4;
    }
    return 1;
}

static const char *parse_radiance(bytes_left *b, raster *r) {
    char line[256], first[8], second[8], height[16], width[16], rest[2];
    unsigned char *row;
    const char *wrong;
    int known = 0, x, y, k;
    do { /* variables, up to an empty line */
        if (!read_line(b, line, sizeof line)) return "its header is cut short";
        if (strncmp(line, "FORMAT=", 7) == 0) known = strcmp(line, "FORMAT=32-bit_rle_rgbe") == 0;
    } while (line[0]);
    if (!known) return "its format is not 32-bit_rle_rgbe";
    if (!read_line(b, line, sizeof line)) return "its header is cut short";
    if (sscanf(line, "%7s %15s %7s %15s%1s", first, height, second, width, rest) != 4 || strcmp(first, "-Y") != 0 ||
        strcmp(second, "+X") != 0)
        return "its size is not '-Y height +X width'";
    /* a run of 127 of one component takes two bytes at best, or a scanline of the old way four */
    if (b->end - b->at < 4 * (ptrdiff_t)read_side(height)) return "it has fewer texels than its header says";
    wrong = make_room(r, read_side(width), read_side(height), 3);
    if (wrong) return wrong;
    row = (unsigned char *)malloc((size_t)r->width * 4);
    for (y = 0; y < r->height && row; y++) {
        float *values = r->values + (size_t)y * (size_t)r->width * 3;
        if (!read_scanline(b, row, r->width)) {
            wrong = "its texels are cut short or damaged";
            break;
        }
        for (x = 0; x < r->width; x++) {
            float scale = row[4 * x + 3] ? ldexpf(1, row[4 * x + 3] - (128 + 8)) : 0;
            for (k = 0; k < 3; k++) values[3 * x + k] = (float)row[4 * x + k] * scale;
        }
    }
    if (!row) wrong = "not enough memory";
    free(row);
    if (wrong) free(r->values);
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
