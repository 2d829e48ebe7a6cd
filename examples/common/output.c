#include "output.h"
#include "fail.h"
#include "file.h"
#include <stdio.h>

void output_name(char path[OUTPUT_NAME], const char *prefix, const char *rest) {
    if (snprintf(path, OUTPUT_NAME, "%s%s", prefix, rest) >= OUTPUT_NAME) give_up(prefix, "name too long");
}

void output_check(const char *prefix, const char *rest) {
    char path[OUTPUT_NAME];
    const char *wrong;
    output_name(path, prefix, rest);
    wrong = file_check(path);
    if (wrong) give_up(path, wrong);
}

void output_picture(const char *prefix, const char *rest, const image *picture, float exposure) {
    char path[OUTPUT_NAME];
    const char *wrong;
    output_name(path, prefix, rest);
    wrong = image_write_png(path, picture, exposure);
    if (wrong) give_up(path, wrong);
}
