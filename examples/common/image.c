#include "image.h"
#include "fail.h"
#include "file.h"
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

image image_create(int width, int height) {
    image picture;
    picture.width = width;
    picture.height = height;
    picture.pixels = (vec3 *)allocate("images", (size_t)width * (size_t)height, sizeof *picture.pixels);
    return picture;
}

void image_free(image *picture) {
    free(picture->pixels);
    picture->pixels = NULL;
}

double image_rmse(const image *picture, const image *wanted) {
    int i, count = picture->width * picture->height;
    double sum = 0;
    for (i = 0; i < count; i++) {
        vec3 d = lobe_sub(picture->pixels[i], wanted->pixels[i]);
        sum += (double)lobe_dot(d, d);
    }
    return sqrt(sum / (3.0 * count));
}

double image_relative_error(const image *picture, const image *wanted) {
    int i, count = picture->width * picture->height;
    double difference = 0, total = 0;
    for (i = 0; i < count; i++) {
        vec3 d = lobe_sub(picture->pixels[i], wanted->pixels[i]);
        difference += (double)(fabsf(d.x) + fabsf(d.y) + fabsf(d.z));
        total += 3 * (double)lobe_mean(wanted->pixels[i]);
    }
    return total > 0 ? difference / total : 0;
}

/* In [0, 1] */
static float displayed(float radiance, float exposure) {
    float x = 1 - expf(-exposure * radiance);
    x = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
    return lobe_max(0, lobe_min(1, x));
}

static double squared_difference(float a, float b, float exposure) {
    double difference = (double)(displayed(a, exposure) - displayed(b, exposure));
    return difference * difference;
}

double image_psnr(const image *picture, const image *wanted, float exposure) {
    int i, count = picture->width * picture->height;
    double sum = 0;
    for (i = 0; i < count; i++) {
        vec3 a = picture->pixels[i], b = wanted->pixels[i];
        sum += squared_difference(a.x, b.x, exposure) + squared_difference(a.y, b.y, exposure) +
               squared_difference(a.z, b.z, exposure);
    }
    return -10 * log10(sum / (3.0 * count) + 1e-20);
}

void image_paste(image *target, const image *part, int x, int y) {
    int row;
    for (row = 0; row < part->height; row++)
        memcpy(target->pixels + (row + y) * target->width + x, part->pixels + row * part->width,
               (size_t)part->width * sizeof *part->pixels);
}

/* ---- PNG: one stored deflate block per row ---- */

typedef struct {
    FILE *file;
    unsigned crc, adler_a, adler_b;
    unsigned table[256];
} png;

static void put(png *p, unsigned value, int bytes, int checked) {
    while (bytes-- > 0) {
        unsigned byte = value >> (8 * bytes) & 255;
        putc((int)byte, p->file);
        if (checked) p->crc = p->table[(p->crc ^ byte) & 255] ^ p->crc >> 8;
    }
}

static void begin_chunk(png *p, unsigned size, unsigned name) {
    put(p, size, 4, 0);
    p->crc = 0xFFFFFFFFu;
    put(p, name, 4, 1);
}

static void end_chunk(png *p) {
    put(p, ~p->crc, 4, 0);
}

static unsigned encode(float radiance, float exposure) {
    return (unsigned)(255 * displayed(radiance, exposure) + 0.5f);
}

static void put_picture(png *p, const image *picture, float exposure) {
    const unsigned row_bytes = 1 + 3 * (unsigned)picture->width;
    unsigned i, k;
    int row, column;
    for (i = 0; i < 256; i++) {
        p->table[i] = i;
        for (k = 0; k < 8; k++) p->table[i] = p->table[i] & 1 ? 0xEDB88320u ^ p->table[i] >> 1 : p->table[i] >> 1;
    }
    p->adler_a = 1;
    p->adler_b = 0;
    put(p, 0x89504E47u, 4, 0);
    put(p, 0x0D0A1A0Au, 4, 0);
    begin_chunk(p, 13, 0x49484452u); /* IHDR */
    put(p, (unsigned)picture->width, 4, 1);
    put(p, (unsigned)picture->height, 4, 1);
    put(p, 0x08020000u, 4, 1); /* 8 bits, RGB */
    put(p, 0, 1, 1);
    end_chunk(p);
    for (row = 0; row < picture->height; row++) {
        /* a chunk per row; the first also opens the zlib stream, the last closes it */
        int first = row == 0, last = row == picture->height - 1;
        begin_chunk(p, row_bytes + 5 + (first ? 2u : 0u) + (last ? 4u : 0u), 0x49444154u); /* IDAT */
        if (first) put(p, 0x7801u, 2, 1);
        put(p, last ? 1 : 0, 1, 1);
        put(p, (row_bytes & 255) << 8 | row_bytes >> 8, 2, 1);
        put(p, (~row_bytes & 255) << 8 | (~row_bytes >> 8 & 255), 2, 1);
        put(p, 0, 1, 1); /* filter: none */
        p->adler_b = (p->adler_b + p->adler_a) % 65521;
        for (column = 0; column < picture->width; column++) {
            vec3 c = picture->pixels[row * picture->width + column];
            unsigned bytes[3];
            bytes[0] = encode(c.x, exposure);
            bytes[1] = encode(c.y, exposure);
            bytes[2] = encode(c.z, exposure);
            for (k = 0; k < 3; k++) {
                put(p, bytes[k], 1, 1);
                p->adler_a = (p->adler_a + bytes[k]) % 65521;
                p->adler_b = (p->adler_b + p->adler_a) % 65521;
            }
        }
        if (last) put(p, p->adler_b << 16 | p->adler_a, 4, 1);
        end_chunk(p);
    }
    begin_chunk(p, 0, 0x49454E44u); /* IEND */
    end_chunk(p);
}

static int finite_picture(const image *picture) {
    int i, count = picture->width * picture->height;
    for (i = 0; i < count; i++) {
        vec3 c = picture->pixels[i];
        if (!(fabsf(c.x) <= FLT_MAX && fabsf(c.y) <= FLT_MAX && fabsf(c.z) <= FLT_MAX)) return 0;
    }
    return 1;
}

const char *image_write_png(const char *path, const image *picture, float exposure) {
    const char *wrong;
    file f;
    png p;
    if (!finite_picture(picture)) return "the picture has a pixel that is not finite";
    wrong = file_begin(&f, path);
    if (wrong) return wrong;
    p.file = f.stream;
    put_picture(&p, picture, exposure);
    return file_end(&f);
}
