/* options.h - the command line of an example. */
#ifndef OPTIONS_H
#define OPTIONS_H

enum { OPTIONS_MAX_LIGHTS = 8 };

typedef struct {
    int width, height;
    int lights[OPTIONS_MAX_LIGHTS], light_counts; /* numbers of lights to try, ascending as given */
    unsigned seed;
    int samples;
    const char *out;
    int seedless; /* 1: nothing is random, and there is no --seed */
    float delta;  /* radiance below which lights are left out at random */
    int tile;     /* edge of the squares of pixels for which lights are culled */
} options;

/* A program that gives no default for the number of lights, the samples, delta or the tile has no such option.

   Reads the arguments into o, which holds the defaults. --help: prints usage to stdout and exits with 0; anything
   wrong: says what on stderr, with the usage, and exits with 2. `about` is the first line of the help. */
void options_read(options *o, int argc, char **argv, const char *about);

#endif
