/* Unit tests of the examples' readers and writers of images, on files made by hand. */
#include "test.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The reader's memory is counted, and may be refused. */
static size_t largest, allowed = (size_t)-1;

static void *counted(size_t size) {
    if (size > largest) largest = size;
    return size > allowed ? NULL : malloc(size);
}

#define malloc counted
#include "../examples/common/raster.c"
#undef malloc
#include "../examples/common/file.h"

/* ---- files by hand ---- */

enum { MOST_BYTES = 512 };

typedef struct {
    unsigned char at[MOST_BYTES];
    size_t count;
} content;

static void add(content *c, const char *bytes, size_t count) {
    memcpy(c->at + c->count, bytes, count);
    c->count += count;
}

/* A literal's bytes, zeros too */
#define ADD(c, literal) add(c, literal, sizeof(literal) - 1)

static content text(const char *start) {
    content c;
    memset(&c, 0, sizeof c);
    add(&c, start, strlen(start));
    return c;
}

/* Parses a copy that ends with its last byte, so that a sanitizer sees what reads on. */
static const char *parse(const content *c, size_t count, raster *r) {
    unsigned char *copy = (unsigned char *)malloc(count ? count : 1);
    const char *wrong;
    if (!copy) return "no memory for the test";
    memcpy(copy, c->at, count);
    wrong = raster_parse(copy, count, r);
    free(copy);
    return wrong;
}

#define RADIANCE "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n"

enum { GREY_LITTLE, GREY_BIG, COLOUR_LITTLE, COLOUR_BIG, FLAT, SCANLINES, OLD_RUNS, SAMPLES };

/* A valid file of each kind. PFM, whose lower row comes first: 1 2 / 3 4 in grey, 1 to 6 from the top in colour. */
static content sample(int kind) {
    content c = text("");
    switch (kind) {
    case GREY_LITTLE:
        c = text("Pf\n2 2\n-1.0\n");
        ADD(&c, "\0\0\x40\x40\0\0\x80\x40\0\0\x80\x3F\0\0\0\x40");
        break;
    case GREY_BIG:
        c = text("Pf 2 2 1\n");
        ADD(&c, "\x40\x40\0\0\x40\x80\0\0\x3F\x80\0\0\x40\0\0\0");
        break;
    case COLOUR_LITTLE:
        c = text("PF\n1 2\n-2.5e-1\n");
        ADD(&c, "\0\0\x80\x40\0\0\xA0\x40\0\0\xC0\x40\0\0\x80\x3F\0\0\0\x40\0\0\x40\x40");
        break;
    case COLOUR_BIG:
        c = text("PF\n1 2\n+3\n");
        ADD(&c, "\x40\x80\0\0\x40\xA0\0\0\x40\xC0\0\0\x3F\x80\0\0\x40\0\0\0\x40\x40\0\0");
        break;
    case FLAT: /* the exponent 129 is 1/128, 0 is black */
        c = text(RADIANCE "-Y 2 +X 3\n");
        ADD(&c, "\x80\x40\x20\x81\x02\x02\x09\x88\x10\x20\x30\0");
        ADD(&c, "\xFF\x01\x01\xFF\x01\x02\x03\x01\0\0\0\x80");
        break;
    case SCANLINES: /* red 128 all along, green 1 to 9, blue 5 then 7, exponent 129 but once 136 */
        c = text(RADIANCE "-Y 1 +X 9\n");
        ADD(&c, "\x02\x02\0\x09\x89\x80\x09\x01\x02\x03\x04\x05\x06\x07\x08\x09\x84\x05\x85\x07\x88\x81\x01\x88");
        break;
    case OLD_RUNS: /* 300 = 1 + 43 + 256 * 1, then 257 equal, 43 others */
        c = text(RADIANCE "-Y 2 +X 300\n");
        ADD(&c, "\x80\x40\x20\x81\x01\x01\x01\x2B\x01\x01\x01\x01");
        ADD(&c, "\x80\x40\x20\x81\x01\x01\x01\0\x01\x01\x01\x01\x40\x80\x20\x81\x01\x01\x01\x2A");
        break;
    }
    return c;
}

static void wanted_size(const raster *r, int width, int height, int channels) {
    double seen[3];
    seen[0] = r->width;
    seen[1] = r->height;
    seen[2] = r->channels;
    test_that(r->width == width && r->height == height && r->channels == channels, "size of the image", seen, 3);
}

static void wanted_value(const raster *r, int index, float value) {
    double seen[3];
    seen[0] = index;
    seen[1] = (double)r->values[index];
    seen[2] = (double)value;
    test_that(r->values[index] == value, "index, value, value wanted", seen, 3);
}

/* Parses what must be valid; 0 if it is not */
static int accepted(const content *c, raster *r) {
    const char *wrong = parse(c, c->count, r);
    test_that(!wrong, wrong ? wrong : "", NULL, 0);
    return !wrong;
}

static void pfm_orders(void) {
    int kind, i;
    for (kind = GREY_LITTLE; kind <= COLOUR_BIG; kind++) {
        content c = sample(kind);
        int grey = kind <= GREY_BIG;
        raster r;
        if (!accepted(&c, &r)) continue;
        wanted_size(&r, grey ? 2 : 1, 2, grey ? 1 : 3);
        for (i = 0; i < (grey ? 4 : 6); i++) wanted_value(&r, i, (float)(i + 1));
        free(r.values);
    }
}

/* Only one space ends the header. */
static void pfm_spaces(void) {
    content c = text("Pf\r\n 1\t1 \n1 ");
    raster r;
    unsigned bits;
    ADD(&c, "\x20\x0A\x0D\x09");
    if (!accepted(&c, &r)) return;
    memcpy(&bits, r.values, sizeof bits);
    test_that(bits == 0x200A0D09u, "texels that look like spaces", NULL, 0);
    free(r.values);
}

static void radiance_flat(void) {
    static const float wanted[] = {1,        0.5f,     0.25f,     2,         2,           9, 0, 0, 0, 255 * 0x1p119f,
                                   0x1p119f, 0x1p119f, 0x1p-135f, 0x1p-134f, 0x1.8p-134f, 0, 0, 0};
    content c = sample(FLAT);
    raster r;
    int i;
    if (!accepted(&c, &r)) return;
    wanted_size(&r, 3, 2, 3);
    for (i = 0; i < 18; i++) {
        if (i < 12 || i > 14) wanted_value(&r, i, wanted[i]); /* denormal numbers may be flushed */
    }
    free(r.values);
}

static void radiance_scanlines(void) {
    content c = sample(SCANLINES);
    raster r;
    int x;
    if (!accepted(&c, &r)) return;
    wanted_size(&r, 9, 1, 3);
    for (x = 0; x < 9; x++) {
        float unit = x < 8 ? 0x1p-7f : 1;
        wanted_value(&r, 3 * x, 128 * unit);
        wanted_value(&r, 3 * x + 1, (float)(x + 1) * unit);
        wanted_value(&r, 3 * x + 2, (x < 4 ? 5 : 7) * unit);
    }
    free(r.values);
    c = text(RADIANCE "-Y 1 +X 128\n"); /* the longest runs: 128 bytes, 127 times the same */
    ADD(&c, "\x02\x02\0\x80\x80");
    for (x = 0; x < 128; x++) c.at[c.count++] = (unsigned char)x;
    ADD(&c, "\xFF\x07\x01\x08\xFF\x09\x01\x0A\xFF\x88\x81\x87");
    if (accepted(&c, &r)) {
        wanted_value(&r, 3 * 126, 126);
        wanted_value(&r, 3 * 126 + 1, 7);
        wanted_value(&r, 3 * 127, 63.5f);
        wanted_value(&r, 3 * 127 + 1, 4);
        free(r.values);
    }
    c = text(RADIANCE "-Y 1 +X 8\n"); /* flat, though it begins almost as runs do */
    ADD(&c, "\x02\x02\x80\x88\x01\x01\x01\x07");
    if (accepted(&c, &r)) {
        wanted_value(&r, 2, 128);
        wanted_value(&r, 23, 128);
        free(r.values);
    }
}

static void radiance_old_runs(void) {
    content c = sample(OLD_RUNS);
    raster r;
    int x;
    if (accepted(&c, &r)) {
        wanted_size(&r, 300, 2, 3);
        for (x = 0; x < 600; x++) {
            int other = x >= 300 + 257;
            wanted_value(&r, 3 * x, other ? 0.5f : 1);
            wanted_value(&r, 3 * x + 1, other ? 1 : 0.5f);
            wanted_value(&r, 3 * x + 2, 0.25f);
        }
        free(r.values);
    }
    c = text(RADIANCE "-Y 1 +X 32768\n"); /* the widest: 1 + 255 + 256 * 127 */
    ADD(&c, "\x02\x02\x7F\x88\x01\x01\x01\xFF\x01\x01\x01\x7F");
    if (accepted(&c, &r)) {
        wanted_size(&r, 32768, 1, 3);
        wanted_value(&r, 3 * 32767, 2);
        wanted_value(&r, 3 * 32767 + 2, 127);
        free(r.values);
    }
}

/* ---- what is refused ---- */

static void check_refused(const content *c, size_t count, const char *reason, double number) {
    raster r;
    const char *wrong = parse(c, count, &r);
    char what[160];
    snprintf(what, sizeof what, "refused because '%s': got '%s', file %.40s", reason, wrong ? wrong : "accepted",
             (const char *)c->at);
    test_that(wrong && strstr(wrong, reason), what, &number, 1);
    if (!wrong) free(r.values);
}

static void truncated(void) {
    int kind;
    for (kind = 0; kind < SAMPLES; kind++) {
        const size_t texels = kind <= GREY_BIG ? 16 : 24;
        content c = sample(kind);
        const char *wrong;
        raster r;
        size_t count;
        for (count = 0; count < c.count; count++) {
            const char *reason = count < 2 ? "neither" : "cut short";
            double length = (double)count;
            if (kind <= COLOUR_BIG && count + texels >= c.count) reason = "fewer texels";
            check_refused(&c, count, reason, length);
            /* the same with what is missing behind it: whoever reads on finds a valid file, and that it is not all */
            wrong = raster_parse(c.at, count, &r);
            test_that(wrong && strstr(wrong, reason), "read beyond the end, length", &length, 1);
        }
        if (accepted(&c, &r)) free(r.values);
        ADD(&c, "\n");
        check_refused(&c, c.count, "more bytes", kind);
    }
}

static void damaged_headers(void) {
    static const struct {
        const char *start, *reason;
    } files[] = {
        {"", "neither PFM nor"},
        {"P", "neither PFM nor"},
        {"#", "neither PFM nor"},
        {"P6\n1 1\n-1.0\n....", "neither PFM nor"},
        {"pf\n1 1\n-1.0\n....", "neither PFM nor"},
        {"PF4\n1 1\n-1.0\n................", "neither PF nor Pf"},
        {"PfPfPfPf\n1 1\n-1.0\n....", "header is cut short or damaged"},
        {"Pf\n0 1\n-1.0\n....", "no size"},
        {"Pf\n1 0\n-1.0\n....", "no size"},
        {"Pf\n-1 1\n-1.0\n....", "no size"},
        {"Pf\n+1 1\n-1.0\n....", "no size"},
        {"Pf\n1x 1\n-1.0\n....", "no size"},
        {"Pf\n1.0 1\n-1.0\n....", "no size"},
        {"Pf\n0x1 1\n-1.0\n....", "no size"},
        {"Pf\n32769 1\n-1.0\n....", "no size"},
        {"Pf\n4294967297 1\n-1.0\n....", "no size"},
        {"Pf\n999999999999999 1\n-1.0\n....", "no size"},
        {"Pf\n9999999999999999 1\n-1.0\n....", "header is cut short or damaged"},
        {"Pf\n18446744073709551617 1\n-1.0\n....", "header is cut short or damaged"},
        {"PF\n32768 32768\n-1.0\n....", "more than 67108864"},
        {"PF\n32768 2049\n-1.0\n....", "more than 67108864"},
        {"PF\n32768 2048\n-1.0\n....", "fewer texels"},
        {"Pf\n1 1\n0\n....", "no scale"},
        {"Pf\n1 1\n-0.0\n....", "no scale"},
        {"Pf\n1 1\nnan\n....", "no scale"},
        {"Pf\n1 1\n-inf\n....", "no scale"},
        {"Pf\n1 1\n1e999\n....", "no scale"},
        {"Pf\n1 1\n-1e-999\n....", "no scale"},
        {"Pf\n1 1\n-\n....", "no scale"},
        {"Pf\n1 1\n1.0.0\n....", "no scale"},
        {"Pf\n1 1\nscale\n....", "no scale"},
        {"#?RADIANCE\n\n-Y 1 +X 1\n....", "its format is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n....", "its format is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nFORMAT=\n\n-Y 1 +X 1\n....", "its format is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 1 +X 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 -X 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+X 1 -Y 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1\n+X 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 1\n....", "no size"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X -1\n....", "no size"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 1\n....", "no size"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999999999999999 +X 1\n....", "its size is not"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2049 +X 32768\n....", "more than 67108864"},
    };
    size_t i;
    for (i = 0; i < sizeof files / sizeof *files; i++) {
        content c = text(files[i].start);
        check_refused(&c, c.count, files[i].reason, (double)i);
    }
}

static void damaged_scanlines(void) {
    static const struct {
        const char *size, *texels;
        size_t count;
    } files[] = {
#define FILE_OF(size, texels) {size, texels, sizeof(texels) - 1}
        FILE_OF("-Y 1 +X 8\n", "\x02\x02\0\x09\x88\x01\x88\x01\x88\x01\x88\x01"), /* length of another width */
        FILE_OF("-Y 1 +X 8\n", "\x02\x02\0\x08\x89\x01\x88\x01\x88\x01\x88\x01"), /* run too long */
        FILE_OF("-Y 1 +X 8\n", "\x02\x02\0\x08\x84\x01\x85\x01\x88\x01\x88\x01\x88\x01"),
        FILE_OF("-Y 1 +X 8\n", "\x02\x02\0\x08\x0A\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A\x88\x01\x88\x01\x88\x01"),
        FILE_OF("-Y 1 +X 8\n", "\x02\x02\0\x08\0\x88\x01\x88\x01\x88\x01\x88\x01"), /* run of none */
        FILE_OF("-Y 1 +X 3\n", "\x01\x01\x01\x02\x80\x80\x80\x80\x80\x80\x80\x80"), /* nothing to repeat */
        FILE_OF("-Y 2 +X 1\n", "\x80\x80\x80\x80\x01\x01\x01\x01"),                 /* nor from the row above */
        FILE_OF("-Y 1 +X 3\n", "\x80\x80\x80\x80\x01\x01\x01\x03"),                 /* too many */
        FILE_OF("-Y 1 +X 3\n", "\x80\x80\x80\x80\x01\x01\x01\0\x01\x01\x01\x01\x80\x80\x80\x80"),
        FILE_OF("-Y 1 +X 3\n",
                "\x80\x80\x80\x80\x01\x01\x01\0\x01\x01\x01\0\x01\x01\x01\0\x80\x80\x80\x80\x80\x80\x80\x80"),
#undef FILE_OF
    };
    size_t i;
    for (i = 0; i < sizeof files / sizeof *files; i++) {
        content c = text(RADIANCE);
        add(&c, files[i].size, strlen(files[i].size));
        add(&c, files[i].texels, files[i].count);
        check_refused(&c, c.count, "texels are cut short or damaged", (double)i);
    }
}

/* What a header promises takes no memory before it is seen to be there. */
static void memory(void) {
    static const char *const promises[] = {"PF\n32768 2048\n-1.0\n", "Pf\n8192 8192\n1.0\n",
                                           RADIANCE "-Y 2048 +X 32768\n", RADIANCE "-Y 32768 +X 2048\n"};
    int i, kind;
    for (i = 0; i < 4; i++) {
        content c = text(promises[i]);
        double taken;
        ADD(&c, "\x80\x80\x80\x80\x01\x01\x01\xFF\x01\x01\x01\x7F\x80\x80\x80\x80\x01\x01\x01\xFF\x01\x01\x01\x7F");
        largest = 0;
        check_refused(&c, c.count, i < 2 ? "fewer texels" : "cut short or damaged", i);
        taken = (double)largest;
        test_that(largest <= 4 * 32768, "one row at most; bytes taken", &taken, 1);
    }
    for (kind = 0; kind < SAMPLES; kind++) {
        content c = sample(kind);
        allowed = 0;
        check_refused(&c, c.count, "not enough memory", kind);
        allowed = 12; /* a row, but not all of the values */
        if (kind == FLAT) check_refused(&c, c.count, "not enough memory", kind);
        allowed = (size_t)-1;
    }
}

/* ---- mutations ---- */

static void mutate(content *c) {
    size_t at = (size_t)((double)c->count * test_uniform(&test_random)), count = c->count - at, room;
    unsigned char byte = (unsigned char)(256 * test_uniform(&test_random));
    switch ((int)(6 * test_uniform(&test_random))) {
    case 0:
        c->at[at] = byte;
        break;
    case 1:
        c->at[at] ^= (unsigned char)(1 << (byte & 7));
        break;
    case 2: /* a digit more, or less, where the size is */
        while (at + 1 < c->count && (c->at[at] < '0' || c->at[at] > '9')) at++;
        c->at[at] = (unsigned char)('0' + byte % 10);
        break;
    case 3:
        c->count = at;
        break;
    case 4: /* some bytes twice */
        room = MOST_BYTES - c->count;
        if (count > 16) count = 16;
        if (count > room) count = room;
        memmove(c->at + at + count, c->at + at, c->count - at);
        c->count += count;
        break;
    case 5: /* some are missing */
        if (count > 1 + (byte & 7u)) count = 1 + (byte & 7u);
        memmove(c->at + at, c->at + at + count, c->count - at - count);
        c->count -= count;
        break;
    }
}

static int in_range(const raster *r) {
    return r->width >= 1 && r->width <= RASTER_MAX_SIDE && r->height >= 1 && r->height <= RASTER_MAX_SIDE &&
           (double)r->width * r->height <= RASTER_MAX_TEXELS && (r->channels == 1 || r->channels == 3);
}

static void mutated(void) {
    double results[3] = {0, 0, 0}, turn; /* the last: the sum of all bytes */
    for (turn = 0; turn < 50000; turn++) {
        content c = sample((int)(SAMPLES * test_uniform(&test_random)));
        int changes = 1 + (int)(3 * test_uniform(&test_random));
        raster r;
        while (changes-- > 0 && c.count > 0) mutate(&c);
        if (parse(&c, c.count, &r)) {
            results[0]++;
        } else {
            const unsigned char *bytes = (const unsigned char *)r.values;
            unsigned sum = 0;
            size_t i,
                count = in_range(&r) ? sizeof(float) * (size_t)r.width * (size_t)r.height * (size_t)r.channels : 0;
            test_that(count > 0, "size of a mutated image", &turn, 1);
            for (i = 0; i < count; i++) sum += bytes[i]; /* a sanitizer sees what is not there */
            results[2] += sum;
            results[1]++;
            free(r.values);
        }
    }
    test_that(results[0] > 5000 && results[1] > 5000 && results[2] > 0, "enough refused and accepted", results, 3);
}

/* ---- files ---- */

static const char *file_name(const char *suffix) {
    static char name[1024];
    snprintf(name, sizeof name, "%s%s", test_files, suffix);
    return name;
}

static int exists(const char *name) {
    FILE *stream = fopen(name, "rb");
    if (stream) fclose(stream);
    return stream != NULL;
}

/* Any bits come back as they were: infinities, NaN with what it carries, denormal numbers, -0. */
static void round_trip(void) {
    static const int sizes[][2] = {{1, 1}, {3, 2}, {7, 5}, {64, 33}, {1, 300}};
    static const unsigned special[] = {0x7FC12345u, 0xFF800001u, 0x7F800000u, 0xFF800000u, 0x80000000u, 0x00000001u};
    int i, channels;
    for (i = 0; i < 5; i++) {
        for (channels = 1; channels <= 3; channels += 2) {
            size_t count = (size_t)(sizes[i][0] * sizes[i][1] * channels), k;
            raster written = {NULL, 0, 0, 0}, read = {NULL, 0, 0, 0};
            const char *wrong;
            double size = i;
            written.width = sizes[i][0];
            written.height = sizes[i][1];
            written.channels = channels;
            written.values = (float *)malloc(count * sizeof(float));
            for (k = 0; k < count; k++) {
                unsigned bits = k < 6 ? special[k] : (unsigned)(4294967296.0 * test_uniform(&test_random));
                memcpy(&written.values[k], &bits, sizeof bits);
            }
            wrong = raster_write(file_name(".pfm"), &written);
            test_that(!wrong, "written", &size, 1);
            wrong = raster_read(file_name(".pfm"), &read);
            test_that(!wrong, "read", &size, 1);
            if (!wrong) {
                wanted_size(&read, sizes[i][0], sizes[i][1], channels);
                test_that(memcmp(read.values, written.values, count * sizeof(float)) == 0, "the same bits", &size, 1);
                free(read.values);
            }
            free(written.values);
        }
    }
    remove(file_name(".pfm"));
}

/* The writer's bytes, beside those by hand */
static void written_bytes(void) {
    float values[4] = {1, 2, 3, 4};
    content wanted = sample(GREY_LITTLE);
    unsigned char *bytes;
    size_t count;
    raster r = {NULL, 2, 2, 1};
    r.values = values;
    test_that(!raster_write(file_name(".pfm"), &r), "written", NULL, 0);
    if (file_read(file_name(".pfm"), 1000, &bytes, &count)) {
        test_that(0, "read", NULL, 0);
        return;
    }
    test_that(count == wanted.count && memcmp(bytes, wanted.at, count) == 0, "bytes of a PFM file", NULL, 0);
    free(bytes);
    remove(file_name(".pfm"));
}

/* The folder that the tests' files are in */
static const char *folder_name(void) {
    static char name[1024];
    char *slash;
    snprintf(name, sizeof name, "%s", test_files);
    slash = strrchr(name, '/');
    if (!slash) return ".";
    *slash = 0;
    return name;
}

static void files_read(void) {
    unsigned char *bytes = NULL;
    size_t count = 0, i, size;
    raster r;
    test_that(file_read(file_name("-missing"), 1000, &bytes, &count) != NULL, "a missing file", NULL, 0);
    test_that(file_read(folder_name(), 1000, &bytes, &count) != NULL, "a directory", NULL, 0);
    test_that(raster_read(file_name("-missing"), &r) != NULL, "a missing image", NULL, 0);
    test_that(raster_read(folder_name(), &r) != NULL, "a directory for an image", NULL, 0);
    for (size = 65535; size <= 65537; size++) { /* about the size of the first buffer */
        FILE *stream = fopen(file_name(".bin"), "wb");
        int whole = 0;
        double input = (double)size;
        for (i = 0; i < size && stream; i++) putc((int)(i % 251), stream);
        if (stream) fclose(stream);
        if (!file_read(file_name(".bin"), size, &bytes, &count)) {
            for (i = 0; i < count && bytes[i] == i % 251; i++) continue;
            whole = i == size;
            free(bytes);
        }
        test_that(whole, "all bytes of a file", &input, 1);
        test_that(file_read(file_name(".bin"), size - 1, &bytes, &count) != NULL, "a byte too many", &input, 1);
    }
    remove(file_name(".bin"));
}

/* What a file is, in one letter; 0 if there is none */
static int letter(const char *name) {
    FILE *stream = fopen(name, "rb");
    int first = stream ? getc(stream) : 0;
    if (stream) fclose(stream);
    return first;
}

static void files_written(void) {
    char part[1100];
    file f;
    test_that(!file_check(file_name(".bin")), "a file that may be written", NULL, 0);
    test_that(!exists(file_name(".bin")) && !exists(file_name(".bin.part")), "a check leaves nothing", NULL, 0);
    test_that(!file_begin(&f, file_name(".bin")), "begun", NULL, 0);
    putc('a', f.stream);
    test_that(!exists(file_name(".bin")), "absent until whole", NULL, 0);
    test_that(!file_end(&f), "ended", NULL, 0);
    test_that(letter(file_name(".bin")) == 'a' && !exists(file_name(".bin.part")), "whole", NULL, 0);
    test_that(!file_check(file_name(".bin")) && letter(file_name(".bin")) == 'a', "a check keeps what is", NULL, 0);
    test_that(!file_begin(&f, file_name(".bin")), "begun again", NULL, 0);
    putc('b', f.stream);
    test_that(letter(file_name(".bin")) == 'a', "the old one until the new is whole", NULL, 0);
    test_that(!file_end(&f), "ended again", NULL, 0);
    test_that(letter(file_name(".bin")) == 'b', "replaced", NULL, 0);
    remove(file_name(".bin"));
    test_that(file_begin(&f, file_name("-missing/a")) != NULL, "a folder that is not there", NULL, 0);
    test_that(file_begin(&f, folder_name()) != NULL, "a directory is not replaced", NULL, 0);
    test_that(file_check(folder_name()) != NULL, "nor said to be", NULL, 0);
    snprintf(part, sizeof part, "%s.part", folder_name());
    test_that(!exists(part), "nothing left of that", NULL, 0);
}

const test_case raster_tests[] = {{"raster_pfm_orders", pfm_orders},
                                  {"raster_pfm_spaces", pfm_spaces},
                                  {"raster_radiance_flat", radiance_flat},
                                  {"raster_radiance_scanlines", radiance_scanlines},
                                  {"raster_radiance_old_runs", radiance_old_runs},
                                  {"raster_truncated", truncated},
                                  {"raster_damaged_headers", damaged_headers},
                                  {"raster_damaged_scanlines", damaged_scanlines},
                                  {"raster_memory", memory},
                                  {"raster_mutated", mutated},
                                  {"raster_round_trip", round_trip},
                                  {"raster_written_bytes", written_bytes},
                                  {"file_read", files_read},
                                  {"file_written", files_written},
                                  {NULL, NULL}};
