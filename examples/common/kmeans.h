/* kmeans.h - points to their nearest of given centres: the labelling of k-means, without iteration. */
#ifndef KMEANS_H
#define KMEANS_H

#include <stddef.h>

typedef struct {
    float at[3]; /* the last is 0 in an image */
    int label;
} kmeans_center;

typedef struct {
    float split; /* along the axis; the first half is not above it, the second not below */
    int axis;
} kmeans_node;

typedef struct {
    kmeans_center *centers;
    kmeans_node *nodes;
    int count;
} kmeans_tree;

/* A kd-tree over one centre or more, which it sorts. Takes 2 * count nodes, that stay as long as the tree is used. */
kmeans_tree kmeans_build(kmeans_center *centers, int count, kmeans_node *nodes);

/* Index in the tree's centres of one that is nearest to a point. A guess that is near makes it faster. */
int kmeans_nearest(const kmeans_tree *tree, const float point[3], int guess);

/* Labels every texel of an image with a nearest of the centres, which lie at centres of texels: columns[i] and rows[i]
   of label i. Exact, in time that grows with the texels alone. `scratch` takes 3 * width doubles. */
void kmeans_label_image(int *labels, int width, int height, const int *columns, const int *rows, int count,
                        double *scratch);

/* Sorts 0 .. texels - 1 by label into `order`; those of label i begin at begins[i] and end before begins[i + 1].
   Negative labels are left out. */
void kmeans_sort(const int *labels, int texels, int count, int *order, int *begins);

#endif
