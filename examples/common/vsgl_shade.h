/* vsgl_shade.h - light of virtual SG lights reflected by surfaces, in closed form. */
#ifndef VSGL_SHADE_H
#define VSGL_SHADE_H

#include "shadow_map.h"
#include "vpl.h"

/* Radiance that each texel reflects to where it is seen from: shading if the texels are the camera's and the lights an
   RSM's, and the importance of an RSM's texels for the camera if the lights are those of its G-buffer. Without maps
   nothing is in shadow. The label is that of the progress line. */
void vsgl_shade(const vpl_map *map, const vsgl *lights, const shadow_map *maps, int light_count, vec3 *radiance,
                const char *label);

/* The same from a few of the lights, `picks` for each texel, chosen at random for it alone: an estimate with noise. */
void vsgl_shade_by_few(const vpl_map *map, const vsgl *lights, int light_count, int picks, unsigned seed,
                       vec3 *radiance);

#endif
