/* scene.h - a lit room of analytic shapes, and rays through it. y points up, lengths are metres. */
#ifndef SCENE_H
#define SCENE_H

#include "../../sg.h"

typedef lobe_vec3 vec3;

/* BRDF: diffuse / pi + specular * GGX, without a Fresnel term. A checkerboard of tiles alternates two finishes. */
typedef struct {
    vec3 diffuse, specular;
    float alpha;
} finish;

typedef struct {
    finish finishes[2];
    float tile; /* edge of a checkerboard tile in the xz plane; 0: finishes[0] everywhere */
} material;

/* Shapes show only their front: rays pass through a face from behind. */
typedef enum { SHAPE_QUAD, SHAPE_BOX, SHAPE_SPHERE, SHAPE_COLUMN, SHAPE_RING } shape_kind;

typedef struct {
    shape_kind kind;
    material look;
    vec3 center;              /* of quad, box and sphere; foot of the axis of column and ring */
    vec3 edge_u, edge_v;      /* quad: half edges */
    vec3 normal;              /* quad: of its front, along edge_u x edge_v */
    vec3 half_size;           /* box */
    float turn_cos, turn_sin; /* box: of its angle about y */
    float radius, height;     /* sphere, column, ring: outer radius */
    float inner_radius;       /* ring */
} shape;

typedef struct {
    vec3 position, target, intensity; /* peak radiant intensity, watts per steradian */
    float cone;                       /* half angle in radians; fades to 0 over its last fifth */
    float tangent;                    /* of the cone's half angle, and half the width of the image at distance 1 */
    vec3 right, up, forward;
} spot_light;

typedef struct {
    vec3 position, target;
    float field_of_view; /* vertical, radians */
} camera;

enum { SCENE_MAX_SHAPES = 16 };

typedef struct {
    shape shapes[SCENE_MAX_SHAPES];
    int count;
    spot_light spot;
    camera eye;
    vec3 center; /* positions are summed relative to it */
} scene;

/* What a ray hits. */
typedef struct {
    vec3 position, normal;
    finish look;
    float distance;
    int shape; /* index of it */
} surface;

/* The scene of the examples: a room with coloured walls, a glossy tiled floor and a metal ring under a spot light. */
scene scene_room(void);

/* A metal ring of that roughness on a diffuse floor, lit from the side so that a caustic falls inside of it. */
scene scene_ring(float alpha);

/* Two rows of columns on a marble floor, both of that roughness, in a hall with a low light. */
scene scene_colonnade(float alpha);

/* A room for reflections: walls that are shapes 0 to GALLERY_WALLS - 1, in that order, then spheres: three on the floor,
   or six that fill the picture. */
enum { GALLERY_FLOOR, GALLERY_CEILING, GALLERY_BACK, GALLERY_FRONT, GALLERY_LEFT, GALLERY_RIGHT, GALLERY_WALLS };
scene scene_gallery(void);
scene scene_spheres(void);

/* The nearest surface along a ray; 0 if there is none, and then only the distance is set, to SCENE_FAR. */
#define SCENE_FAR 1e30f
int scene_trace(const scene *world, vec3 origin, vec3 dir, surface *hit);

/* Distance to the nearest surface farther than `start`, SCENE_FAR if none. */
float scene_distance(const scene *world, vec3 origin, vec3 dir, float start);

/* Whether two points see each other. */
int scene_visible(const scene *world, vec3 a, vec3 normal_a, vec3 b, vec3 normal_b);

/* Radiant intensity of the spot light in a direction. */
vec3 spot_intensity(const spot_light *spot, vec3 dir);

/* Moves a spot light and turns it to what it is to light. */
void spot_aim(spot_light *spot, vec3 position, vec3 target);

/* Right, up and forward of a viewer who looks along a direction. */
void scene_frame(vec3 forward, vec3 *right, vec3 *up);

vec3 vec3_multiply(vec3 a, vec3 b);
vec3 vec3_normalize(vec3 a);
float vec3_length(vec3 a);

#endif
