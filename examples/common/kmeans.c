#include "kmeans.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { LEAF = 6, DEPTH = 32 }; /* centres of a leaf at most, levels of a tree at most */

static void swap(kmeans_center *a, kmeans_center *b) {
    kmeans_center c = *a;
    *a = *b;
    *b = c;
}

/* Puts the centre in its place that belongs at `middle` along an axis, none greater before it and none less after. */
static void select_middle(kmeans_center *centers, int first, int last, int middle, int axis) {
    while (last - first > 1) {
        const float pivot = centers[first + (last - first) / 2].at[axis];
        int i = first, k = last - 1;
        while (i <= k) {
            while (centers[i].at[axis] < pivot) i++;
            while (centers[k].at[axis] > pivot) k--;
            if (i <= k) swap(&centers[i++], &centers[k--]);
        }
        if (middle <= k)
            last = k + 1;
        else if (middle >= i)
            first = i;
        else
            return;
    }
}

static int widest_axis(const kmeans_center *centers, int first, int last) {
    float widest = -1;
    int axis, i, found = 0;
    for (axis = 0; axis < 3; axis++) {
        float low = FLT_MAX, high = -FLT_MAX;
        for (i = first; i < last; i++) {
            low = centers[i].at[axis] < low ? centers[i].at[axis] : low;
            high = centers[i].at[axis] > high ? centers[i].at[axis] : high;
        }
        if (high - low > widest) {
            widest = high - low;
            found = axis;
        }
    }
    return found;
}

/* The halves of node i are nodes 2 i + 1 and 2 i + 2. */
static void build(kmeans_tree *tree, int node, int first, int last) {
    const int middle = first + (last - first) / 2;
    kmeans_node *n = &tree->nodes[node];
    if (last - first <= LEAF) return;
    n->axis = widest_axis(tree->centers, first, last);
    select_middle(tree->centers, first, last, middle, n->axis);
    n->split = tree->centers[middle].at[n->axis];
    build(tree, 2 * node + 1, first, middle);
    build(tree, 2 * node + 2, middle, last);
}

kmeans_tree kmeans_build(kmeans_center *centers, int count, kmeans_node *nodes) {
    kmeans_tree tree;
    tree.centers = centers;
    tree.nodes = nodes;
    tree.count = count;
    build(&tree, 0, 0, count);
    return tree;
}

static inline float squared_distance(const kmeans_center *c, const float point[3]) {
    const float x = c->at[0] - point[0], y = c->at[1] - point[1], z = c->at[2] - point[2];
    return x * x + y * y + z * z;
}

int kmeans_nearest(const kmeans_tree *tree, const float point[3], int guess) {
    struct {
        int node, first, last;
        float nearest; /* squared distance that nothing in there is below */
    } left[DEPTH];
    int lefts = 0, node = 0, first = 0, last = tree->count, best = guess, i;
    float smallest = squared_distance(&tree->centers[guess], point);
    for (;;) {
        while (last - first > LEAF) {
            const int middle = first + (last - first) / 2;
            const float offset = point[tree->nodes[node].axis] - tree->nodes[node].split;
            const int second = offset >= 0;
            if (offset * offset < smallest) {
                left[lefts].node = 2 * node + 2 - second;
                left[lefts].first = second ? first : middle;
                left[lefts].last = second ? middle : last;
                left[lefts++].nearest = offset * offset;
            }
            first = second ? middle : first;
            last = second ? last : middle;
            node = 2 * node + 1 + second;
        }
        for (i = first; i < last; i++) {
            const float squared = squared_distance(&tree->centers[i], point);
            best = squared < smallest ? i : best;
            smallest = squared < smallest ? squared : smallest;
        }
        do {
            if (lefts == 0) return best;
            lefts--;
        } while (!(left[lefts].nearest < smallest));
        node = left[lefts].node;
        first = left[lefts].first;
        last = left[lefts].last;
    }
}

/* The nearest centre of each texel's own column */
static void label_columns(int *labels, int width, int height, const int *columns, const int *rows, int count) {
    int i, x, y;
    memset(labels, -1, (size_t)width * (size_t)height * sizeof *labels);
    for (i = 0; i < count; i++) labels[(size_t)rows[i] * (size_t)width + (size_t)columns[i]] = i;
    for (y = 1; y < height; y++) {
        int *row = labels + (size_t)y * (size_t)width;
        for (x = 0; x < width; x++) row[x] = row[x] < 0 ? row[x - width] : row[x];
    }
    for (y = height - 2; y >= 0; y--) {
        int *row = labels + (size_t)y * (size_t)width;
        for (x = 0; x < width; x++) {
            const int above = row[x], below = row[x + width];
            if (below >= 0 && (above < 0 || rows[below] - y < y - rows[above])) row[x] = below;
        }
    }
}

/* From that the nearest of all: squared distances to the columns' own are parabolas along a row, and the lowest of
   them at each texel wins (Meijster et al. 2000; Felzenszwalb and Huttenlocher 2012). */
void kmeans_label_image(int *labels, int width, int height, const int *columns, const int *rows, int count,
                        double *scratch) {
    double *begins = scratch, *heights = scratch + width; /* where each parabola of the envelope is lowest from */
    int *winners = (int *)(scratch + 2 * width);          /* and its label */
    int x, y;
    label_columns(labels, width, height, columns, rows, count);
    for (y = 0; y < height; y++) {
        int *row = labels + (size_t)y * (size_t)width, top = -1, at = 0;
        for (x = 0; x < width; x++) {
            double down, lowest, begin = 0;
            if (row[x] < 0) continue;
            down = rows[row[x]] - y;
            lowest = down * down + (double)x * x; /* the part of (t - x)^2 + down^2 that does not fall with t */
            while (top >= 0) {
                begin = (lowest - heights[top]) / (2 * (x - columns[winners[top]]));
                if (begin > begins[top]) break;
                top--;
            }
            top++;
            begins[top] = top ? begin : -1;
            heights[top] = lowest;
            winners[top] = row[x];
        }
        for (x = 0; x < width; x++) {
            while (at < top && begins[at + 1] < x) at++;
            row[x] = winners[at];
        }
    }
}

void kmeans_sort(const int *labels, int texels, int count, int *order, int *begins) {
    int i, sum = 0;
    memset(begins, 0, ((size_t)count + 1) * sizeof *begins);
    for (i = 0; i < texels; i++) {
        if (labels[i] >= 0) begins[labels[i]]++;
    }
    for (i = 0; i <= count; i++) {
        const int size = begins[i];
        begins[i] = sum;
        sum += size;
    }
    for (i = 0; i < texels; i++) {
        if (labels[i] >= 0) order[begins[labels[i]]++] = i;
    }
    for (i = count; i > 0; i--) begins[i] = begins[i - 1];
    begins[0] = 0;
}
