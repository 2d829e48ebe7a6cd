#include "options.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_default(const option *o) {
    const option_list *list = (const option_list *)o->value;
    const option_reals *reals = (const option_reals *)o->value;
    const option_size *size = (const option_size *)o->value;
    int i;
    switch (o->kind) {
    case OPTION_WHOLE:
        printf("(default %d)", *(const int *)o->value);
        break;
    case OPTION_REAL:
        printf("(default %g)", (double)*(const float *)o->value);
        break;
    case OPTION_TEXT:
        if (*(const char *const *)o->value) printf("(default %s)", *(const char *const *)o->value);
        break;
    case OPTION_SIZE:
        printf("(default %dx%d)", size->width, size->height);
        break;
    case OPTION_LIST:
        for (i = 0; i < list->count; i++) printf("%s%d", i ? "," : "(default ", list->value[i]);
        printf(")");
        break;
    case OPTION_REALS:
        for (i = 0; i < reals->count; i++) printf("%s%g", i ? "," : "(default ", (double)reals->value[i]);
        printf(")");
        break;
    case OPTION_CHOICE:
        printf("(default %s)", o->choices[*(const int *)o->value]);
        break;
    case OPTION_PLACE:
        break;
    }
}

static void print_range(const option *o) {
    int i;
    switch (o->kind) {
    case OPTION_WHOLE:
    case OPTION_REAL:
        printf(", %.10g to %.10g ", o->low, o->high);
        break;
    case OPTION_TEXT:
        printf(" ");
        break;
    case OPTION_SIZE:
        printf(", %gx%g to %gx%g ", o->low, o->low, o->high, o->high);
        break;
    case OPTION_PLACE:
        printf(", each %.10g to %.10g", o->low, o->high);
        break;
    case OPTION_LIST:
    case OPTION_REALS:
        printf(", up to %d of them, %.10g to %.10g ", OPTIONS_MAX_LIST, o->low, o->high);
        break;
    case OPTION_CHOICE:
        for (i = 0; o->choices[i]; i++) printf("%s%s", i ? ", " : ": ", o->choices[i]);
        printf(" ");
        break;
    }
}

static void usage(const option *options, const char *program, const char *about) {
    const option *o;
    int width = (int)strlen("--help");
    for (o = options; o->name; o++) width = (int)strlen(o->name) > width ? (int)strlen(o->name) : width;
    printf("usage: %s [options]\n%s\n\n", program, about);
    for (o = options; o->name; o++) {
        printf("  %-*s  %s", width, o->name, o->help);
        print_range(o);
        print_default(o);
        printf("\n");
    }
    printf("  %-*s  prints this\n", width, "--help");
}

/* A whole number in the option's range and the character after it; 0 if it is not one. */
static int whole(const option *o, const char **text, int *value) {
    char *end;
    unsigned long number;
    if (**text < '0' || **text > '9') return 0;
    errno = 0;
    number = strtoul(*text, &end, 10);
    if (errno != 0 || !((double)number >= o->low && (double)number <= o->high)) return 0;
    *value = (int)number;
    *text = end;
    return 1;
}

/* The same for a number that need not be whole. */
static int real(const option *o, const char **text, float *value) {
    char *end;
    double number = strtod(*text, &end);
    if (end == *text || !(number >= o->low && number <= o->high)) return 0;
    *value = (float)number;
    *text = end;
    return 1;
}

static int read_place(const option *o, const char *text) {
    option_place *place = (option_place *)o->value;
    if (!real(o, &text, &place->x) || *text++ != ',' || !real(o, &text, &place->y) || *text++ != ',') return 0;
    place->given = 1;
    return real(o, &text, &place->z) && !*text;
}

static int read_size(const option *o, const char *text) {
    option_size *size = (option_size *)o->value;
    if (!whole(o, &text, &size->width) || *text++ != 'x') return 0;
    return whole(o, &text, &size->height) && !*text;
}

static int read_list(const option *o, const char *text) {
    option_list *list = (option_list *)o->value;
    list->count = 0;
    for (;; text++) {
        if (list->count == OPTIONS_MAX_LIST || !whole(o, &text, &list->value[list->count++])) return 0;
        if (!*text) return 1;
        if (*text != ',') return 0;
    }
}

static int read_reals(const option *o, const char *text) {
    option_reals *list = (option_reals *)o->value;
    list->count = 0;
    for (;; text++) {
        if (list->count == OPTIONS_MAX_LIST || !real(o, &text, &list->value[list->count++])) return 0;
        if (!*text) return 1;
        if (*text != ',') return 0;
    }
}

static int read_choice(const option *o, const char *text) {
    int i;
    for (i = 0; o->choices[i]; i++) {
        if (strcmp(text, o->choices[i]) != 0) continue;
        *(int *)o->value = i;
        return 1;
    }
    return 0;
}

/* Whether the text is a value that the option takes */
static int read_value(const option *o, const char *text) {
    switch (o->kind) {
    case OPTION_WHOLE:
        return whole(o, &text, (int *)o->value) && !*text;
    case OPTION_REAL:
        return real(o, &text, (float *)o->value) && !*text;
    case OPTION_SIZE:
        return read_size(o, text);
    case OPTION_LIST:
        return read_list(o, text);
    case OPTION_REALS:
        return read_reals(o, text);
    case OPTION_CHOICE:
        return read_choice(o, text);
    case OPTION_PLACE:
        return read_place(o, text);
    case OPTION_TEXT:
        break;
    }
    *(const char **)o->value = text;
    return *text != 0;
}

static const option *find(const option *options, const char *name) {
    const option *o;
    const size_t length = strlen(name);
    for (o = options; o->name; o++) {
        if (strncmp(o->name, name, length) == 0 && o->name[length] == ' ') return o;
    }
    return NULL;
}

static void refuse(const char *program) {
    fprintf(stderr, "%s --help tells what there is\n", program);
    exit(2);
}

void options_read(const option *options, int argc, char **argv, const char *about) {
    int i;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") != 0) continue;
        usage(options, argv[0], about); /* before any default is replaced */
        exit(0);
    }
    for (i = 1; i < argc; i += 2) {
        const option *o = find(options, argv[i]);
        if (!o) {
            fprintf(stderr, "%s: unknown argument '%s'\n", argv[0], argv[i]);
            refuse(argv[0]);
        } else if (i + 1 == argc) {
            fprintf(stderr, "%s: %s needs a value\n", argv[0], argv[i]);
            refuse(argv[0]);
        } else if (!read_value(o, argv[i + 1])) {
            fprintf(stderr, "%s: bad value '%s' of %s\n", argv[0], argv[i + 1], argv[i]);
            refuse(argv[0]);
        }
    }
}
