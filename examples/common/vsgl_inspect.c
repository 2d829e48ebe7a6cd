#include "vsgl_inspect.h"
#include "fail.h"
#include <stdlib.h>

enum { FINE = 4 };

double vsgl_power(const vsgl *light) {
    double sum = 0;
    int k;
    for (k = 0; k < 2; k++)
        sum += (double)lobe_mean(light->intensity[k]) * (double)sg_integral(light->emission[k].sharpness);
    return sum;
}

double light_set_power(const light_set *set) {
    double sum = 0;
    int i;
    for (i = 0; i < set->count; i++) sum += vsgl_power(&set->lights[i]);
    return sum;
}

/* The nearest of size + 1 lines of a grid over the image */
static int grid_line(double u, int size) {
    const double line = floor(u * size + 0.5);
    return line > 0 ? (line < size ? (int)line : size) : 0;
}

coverage light_set_coverage(const light_set *set, const float *pdf, int width, int height) {
    const int columns = FINE * width, rows = FINE * height;
    const size_t stride = (size_t)columns + 1;
    /* how often each point is covered, as differences along both axes: a cell is four entries */
    int *counts = (int *)allocate("coverage", stride * ((size_t)rows + 1), sizeof *counts);
    double gap = 0, overlap = 0, total = 0;
    coverage result;
    int i, x, y;
    for (i = 0; i < set->count; i++) {
        const int x0 = grid_line(set->cells[i].u0, columns), x1 = grid_line(set->cells[i].u1, columns);
        const int y0 = grid_line(set->cells[i].v0, rows), y1 = grid_line(set->cells[i].v1, rows);
        counts[(size_t)y0 * stride + (size_t)x0]++;
        counts[(size_t)y0 * stride + (size_t)x1]--;
        counts[(size_t)y1 * stride + (size_t)x0]--;
        counts[(size_t)y1 * stride + (size_t)x1]++;
    }
    for (y = 0; y < rows; y++) {
        int *row = counts + (size_t)y * stride, run = 0;
        for (x = 0; x < columns; x++) {
            const double p = (double)pdf[y / FINE * width + x / FINE];
            run += row[x];
            row[x] = run + (y ? row[x - (ptrdiff_t)stride] : 0);
            gap += row[x] == 0 ? p : 0;
            overlap += row[x] > 1 ? p : 0;
            total += p;
        }
    }
    free(counts);
    result.gap = gap / total;
    result.overlap = overlap / total;
    return result;
}

static void paint(image *picture, int x, int y, vec3 colour) {
    if (x >= 0 && x < picture->width && y >= 0 && y < picture->height) picture->pixels[y * picture->width + x] = colour;
}

static int pixel_of(double u, int size) {
    return (int)floor(u * size);
}

void light_set_draw(const light_set *set, const float *pdf, image *picture) {
    const vec3 red = {4, 0.02f, 0.02f}, orange = {0.9f, 0.25f, 0.01f};
    const int width = picture->width, height = picture->height;
    double mean = 0;
    int i, x, y;
    for (i = 0; i < width * height; i++) mean += (double)pdf[i] / (width * height);
    for (i = 0; i < width * height; i++) {
        const float p = (float)(0.15 * (double)pdf[i] / mean);
        picture->pixels[i] = lobe_vector(p, p, p);
    }
    for (y = 0; set->labels && y + 1 < height; y++) {
        for (x = 0; x + 1 < width; x++) {
            const int *label = set->labels + y * width + x;
            if (label[0] != label[1] || label[0] != label[width]) paint(picture, x, y, orange);
        }
    }
    for (i = 0; !set->labels && i < set->count; i++) {
        const fis_cell *cell = &set->cells[i];
        const int x0 = pixel_of(cell->u0, width), x1 = pixel_of(cell->u1, width);
        const int y0 = pixel_of(cell->v0, height), y1 = pixel_of(cell->v1, height);
        for (x = x0; x <= x1; x++) {
            paint(picture, x, y0, orange);
            paint(picture, x, y1, orange);
        }
        for (y = y0; y <= y1; y++) {
            paint(picture, x0, y, orange);
            paint(picture, x1, y, orange);
        }
    }
    for (i = 0; i < set->count; i++) {
        const int column = pixel_of((double)set->centers[i].u, width),
                  row = pixel_of((double)set->centers[i].v, height);
        for (y = row - 1; y <= row + 1; y++) {
            for (x = column - 1; x <= column + 1; x++) paint(picture, x, y, red);
        }
    }
}
