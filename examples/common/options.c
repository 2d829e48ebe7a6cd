#include "options.h"
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void usage(FILE *to, const options *o, const char *program, const char *about) {
    int i;
    fprintf(to, "usage: %s [options]\n%s\n\n", program, about);
    fprintf(to, "  --size WxH       of each image in pixels, 16x16 to 4096x4096 (default %dx%d)\n", o->width,
            o->height);
    if (o->light_counts > 0) {
        fprintf(to, "  --lights N,...   numbers of lights to try, up to %d of them, 1 to 65536 (default ",
                OPTIONS_MAX_LIGHTS);
        for (i = 0; i < o->light_counts; i++) fprintf(to, "%s%d", i ? "," : "", o->lights[i]);
        fprintf(to, ")\n");
    }
    if (o->samples)
        fprintf(to, "  --samples N      samples per pixel of the reference, 2 to 1000000 (default %d)\n", o->samples);
    if (o->delta > 0)
        fprintf(to, "  --delta X        radiance below which lights are left out at random, 1e-9 to 1e9 (default %g)\n",
                (double)o->delta);
    if (o->tile)
        fprintf(to, "  --tile N         edge of a tile, in pixels of an interleaved image, 2 to 16 (default %d)\n",
                o->tile);
    if (!o->seedless) fprintf(to, "  --seed N         shifts every sample, 0 to 4294967295 (default %u)\n", o->seed);
    fprintf(to, "  --out PREFIX     beginning of the images' names (default %s)\n", o->out);
    fprintf(to, "  --help           prints this\n");
}

/* A whole number in [low, high] and the character after it; 0 if it is not one. */
static int number(const char *text, unsigned long low, unsigned long high, unsigned long *value, const char **rest) {
    char *end;
    if (*text < '0' || *text > '9') return 0;
    errno = 0;
    *value = strtoul(text, &end, 10);
    *rest = end;
    return errno == 0 && *value >= low && *value <= high;
}

static int read_size(options *o, const char *text) {
    unsigned long width, height;
    if (!number(text, 16, 4096, &width, &text) || *text != 'x') return 0;
    if (!number(text + 1, 16, 4096, &height, &text) || *text) return 0;
    o->width = (int)width;
    o->height = (int)height;
    return 1;
}

static int read_lights(options *o, const char *text) {
    unsigned long value;
    o->light_counts = 0;
    for (;; text++) {
        if (o->light_counts == OPTIONS_MAX_LIGHTS || !number(text, 1, 65536, &value, &text)) return 0;
        o->lights[o->light_counts++] = (int)value;
        if (!*text) return 1;
        if (*text != ',') return 0;
    }
}

static int read_delta(options *o, const char *text) {
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value >= 1e-9 && value <= 1e9)) return 0;
    o->delta = (float)value;
    return 1;
}

/* Whether the program has the option. */
static int known(const options *defaults, const char *name) {
    if (!strcmp(name, "--lights")) return defaults->light_counts > 0;
    if (!strcmp(name, "--samples")) return defaults->samples > 0;
    if (!strcmp(name, "--delta")) return defaults->delta > 0;
    if (!strcmp(name, "--tile")) return defaults->tile > 0;
    if (!strcmp(name, "--seed")) return !defaults->seedless;
    return !strcmp(name, "--size") || !strcmp(name, "--out");
}

void options_read(options *o, int argc, char **argv, const char *about) {
    const options defaults = *o;
    int i;
    for (i = 1; i < argc; i++) {
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL, *rest;
        unsigned long n = 0;
        int right = 0;
        if (!strcmp(name, "--help")) {
            usage(stdout, &defaults, argv[0], about);
            exit(0);
        } else if (!known(&defaults, name)) {
            fprintf(stderr, "%s: unknown argument '%s'\n", argv[0], name);
        } else if (!value) {
            fprintf(stderr, "%s: %s needs a value\n", argv[0], name);
        } else {
            if (!strcmp(name, "--size")) {
                right = read_size(o, value);
            } else if (!strcmp(name, "--lights")) {
                right = read_lights(o, value);
            } else if (!strcmp(name, "--samples")) {
                right = number(value, 2, 1000000, &n, &rest) && !*rest;
                o->samples = (int)n;
            } else if (!strcmp(name, "--seed")) {
                right = number(value, 0, UINT_MAX, &n, &rest) && !*rest;
                o->seed = (unsigned)n;
            } else if (!strcmp(name, "--tile")) {
                right = number(value, 2, 16, &n, &rest) && !*rest;
                o->tile = (int)n;
            } else if (!strcmp(name, "--delta")) {
                right = read_delta(o, value);
            } else {
                right = *value != 0;
                o->out = value;
            }
            if (!right) fprintf(stderr, "%s: bad value '%s' of %s\n", argv[0], value, name);
            i++;
        }
        if (!right) {
            usage(stderr, &defaults, argv[0], about);
            exit(2);
        }
    }
}
