/* vsgl_shade.h - light of virtual SG lights reflected by surfaces, in closed form. */
#ifndef VSGL_SHADE_H
#define VSGL_SHADE_H

#include "shadow_map.h"
#include "vpl.h"

/* A shadow map at the mean of each light. Its own extent does not shade it. */
void vsgl_shadow_maps(const scene *world, const vsgl *lights, int count, shadow_map *maps);

/* Radiance that each texel reflects to where it is seen from: shading if the texels are the camera's and the lights an
   RSM's, and the importance of an RSM's texels for the camera if the lights are those of its G-buffer. Without maps
   nothing is in shadow. The label is that of the progress line. */
void vsgl_shade(const vpl_map *map, const vsgl *lights, const shadow_map *maps, int light_count, vec3 *radiance,
                const char *label);

/* Interleaved sampling: the lights are divided among each `side` by `side` texels, as the seed draws. An estimate of
   the same, and its mean over such a block has little of its noise. */
void vsgl_shade_interleaved(const vpl_map *map, const vsgl *lights, int light_count, int side, unsigned seed,
                            vec3 *radiance, const char *label);

#endif
