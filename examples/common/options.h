/* options.h - the command line of an example. */
#ifndef OPTIONS_H
#define OPTIONS_H

typedef enum {
    OPTION_WHOLE,
    OPTION_REAL,
    OPTION_TEXT,
    OPTION_SIZE,
    OPTION_LIST,
    OPTION_REALS,
    OPTION_CHOICE,
    OPTION_PLACE
} option_kind;

enum { OPTIONS_MAX_LIST = 8 };

typedef struct {
    int width, height;
} option_size;

typedef struct {
    int count, value[OPTIONS_MAX_LIST]; /* as given */
} option_list;

typedef struct {
    int count;
    float value[OPTIONS_MAX_LIST];
} option_reals;

typedef struct {
    int given;
    float x, y, z;
} option_place;

/* What follows an option's name, and where it goes: that holds the default.

   kind     value             may be
   WHOLE    int *             low to high
   REAL     float *           low to high
   TEXT     const char **     anything but empty; there is no default where it points to null
   SIZE     option_size *     WxH, both low to high
   LIST     option_list *     whole numbers, each low to high, with commas between
   REALS    option_reals *    numbers, each low to high, with commas between
   CHOICE   int *             the index of one of `choices`, which null closes
   PLACE    option_place *    X,Y,Z, each low to high; there is no default where it is not given */
typedef struct {
    const char *name; /* and its value's: "--seed N" */
    option_kind kind;
    void *value;
    double low, high;
    const char *help; /* what it is */
    const char *const *choices;
} option;

/* Every example has them */
#define OPTION_OF_SIZE(size)                                                                                           \
    { "--size WxH", OPTION_SIZE, size, 16, 4096, "of each image in pixels", 0 }
#define OPTION_OF_SEED(seed)                                                                                           \
    { "--seed N", OPTION_WHOLE, seed, 0, 2147483647, "shifts every sample", 0 }
#define OPTION_OF_OUT(out)                                                                                             \
    { "--out PREFIX", OPTION_TEXT, out, 0, 0, "beginning of the names of what is written", 0 }

/* Reads the arguments. --help: prints usage to stdout and exits with 0; anything wrong: says what on stderr and exits
   with 2. `about` is the first line of the help, a null name closes the options. */
void options_read(const option *options, int argc, char **argv, const char *about);

#endif
