/* glossy_frame.h - frames of glossy scenes: what is seen, its guides, and its noisy light, for filters. */
#ifndef GLOSSY_FRAME_H
#define GLOSSY_FRAME_H

#include "buffers.h"
#include "lobe_filter.h"

/* ---- scenes: shapes, what they are made of, and the light that they are seen by ---- */

typedef struct {
    const char *name;
    scene (*build)(void);
    glossy (*look)(const surface *hit, int which);
    int which;
} subject;

glossy one_lobe(glossy_model model, float along, float across);

/* One model, a map of glossiness */
glossy look_tiles(const surface *hit, int which);

/* Two models side by side */
glossy look_models(const surface *hit, int which);

/* Brushed metal: grooves along x and z by turns on the floor, around the axis on the balls */
glossy look_brushed(const surface *hit, int which);

/* Three lobes each: other lobes on the floor's tiles, other shares of the same ones on the balls */
glossy look_layers(const surface *hit, int which);

/* One of three exponents, or all three in bands */
glossy look_phong(const surface *hit, int which);

/* One of three mixtures; one of three pairs of exponents, along and across grooves */
glossy look_mixture(const surface *hit, int which);
glossy look_stretched(const surface *hit, int which);

/* Which of two kinds the floor's tile is of */
int tile_of(const surface *hit);

/* ---- a frame ---- */

typedef struct {
    scene world;
    buffer seen;
    glossy *looks;
    guide *guides;
    int width, height;
} frame;

frame frame_of(const scene *world, const subject *what, int width, int height);
void frame_free(frame *f);

/* One bounce of specular light over its reflectance, by path tracing; the light itself of what is not glossy. Even: not at
   random. */
vec3 shade_pixel(const frame *f, int i, int samples, unsigned seed, int even);
image shade_frame(const frame *f, int samples, unsigned seed, int even, const char *label);

#endif
