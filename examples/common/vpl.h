/* vpl.h - virtual point lights: what an RSM or a G-buffer holds, from a traced one or from files. */
#ifndef VPL_H
#define VPL_H

#include "buffers.h"

/* A texel. One that nothing was hit in is all zero. */
typedef struct {
    vec3 position, normal;
    vec3 view;              /* towards where the texel is seen from: the light or the camera */
    vec3 diffuse, specular; /* what each component reflects: power in an RSM, reflectance in a G-buffer */
    float alpha;
} vpl;

typedef struct {
    vpl *texels; /* row by row from the top; to be freed */
    int width, height;
    vec3 center; /* positions are summed relative to it */
} vpl_map;

/* The weight of a texel, which is the PDF of paper 002 for a G-buffer and the simplest one for an RSM. */
static inline float vpl_weight(const vpl *t) {
    return lobe_mean(t->diffuse) + lobe_mean(t->specular);
}

/* Gives up when memory is short. vpl_map_fill replaces the texels by those of another buffer of the same size. */
vpl_map vpl_map_create(const buffer *from, vec3 center);
void vpl_map_fill(vpl_map *map, const buffer *from);

/* An RSM from PREFIX-position.pfm, -normal.pfm and -flux.pfm (3 channels each) and -alpha.pfm (1), all of one size.
   Position and normal are in world space, flux is the power that the texel reflects. The files do not say which
   component reflects it: texels of alpha 1 are diffuse, all others specular, towards the mirror direction of `light`;
   null is right where there are none. A flux of 0 means nothing hit. Gives up, with a message, on what cannot be read
   or is out of range. */
vpl_map vpl_map_read(const char *prefix, const vec3 *light);

#endif
