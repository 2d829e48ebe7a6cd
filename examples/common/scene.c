#include "scene.h"

vec3 vec3_multiply(vec3 a, vec3 b) {
    return lobe_vector(a.x * b.x, a.y * b.y, a.z * b.z);
}

float vec3_length(vec3 a) {
    return sqrtf(lobe_dot(a, a));
}

vec3 vec3_normalize(vec3 a) {
    return lobe_scale(a, 1 / vec3_length(a));
}

void scene_frame(vec3 forward, vec3 *right, vec3 *up) {
    vec3 vertical = fabsf(forward.y) < 0.99f ? lobe_vector(0, 1, 0) : lobe_vector(0, 0, 1);
    *right = vec3_normalize(lobe_cross(forward, vertical));
    *up = lobe_cross(*right, forward);
}

/* ---- rays ---- */

/* Each function below returns the distance to its shape's front along the ray, beyond `start`, and the normal there;
   SCENE_FAR for a miss. */

static float hit_quad(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    float facing = -lobe_dot(d, s->normal), t, u, v;
    vec3 p;
    if (facing <= 0) return SCENE_FAR;
    t = lobe_dot(lobe_sub(o, s->center), s->normal) / facing;
    if (t <= start) return SCENE_FAR;
    p = lobe_sub(lobe_add(o, lobe_scale(d, t)), s->center);
    u = lobe_dot(p, s->edge_u) / lobe_dot(s->edge_u, s->edge_u);
    v = lobe_dot(p, s->edge_v) / lobe_dot(s->edge_v, s->edge_v);
    if (fabsf(u) > 1 || fabsf(v) > 1) return SCENE_FAR;
    *normal = s->normal;
    return t;
}

static float hit_box(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    float c = s->turn_cos, w = s->turn_sin, t0 = -SCENE_FAR, t1 = SCENE_FAR, side = 0;
    float origin[3], dir[3], half[3];
    vec3 p = lobe_sub(o, s->center);
    int axis, entered = 0;
    origin[0] = c * p.x - w * p.z;
    origin[1] = p.y;
    origin[2] = w * p.x + c * p.z;
    dir[0] = c * d.x - w * d.z;
    dir[1] = d.y;
    dir[2] = w * d.x + c * d.z;
    half[0] = s->half_size.x;
    half[1] = s->half_size.y;
    half[2] = s->half_size.z;
    for (axis = 0; axis < 3; axis++) {
        float sign = dir[axis] < 0 ? 1.0f : -1.0f, slope = fabsf(dir[axis]);
        float in, out;
        if (slope < 1e-12f) slope = 1e-12f;
        in = (sign * origin[axis] - half[axis]) / slope;
        out = (sign * origin[axis] + half[axis]) / slope;
        if (in > t0) {
            t0 = in;
            entered = axis;
            side = sign;
        }
        t1 = lobe_min(t1, out);
    }
    if (t0 >= t1 || t0 <= start) return SCENE_FAR;
    *normal = entered == 0   ? lobe_vector(side * c, 0, -side * w)
              : entered == 1 ? lobe_vector(0, side, 0)
                             : lobe_vector(side * w, 0, side * c);
    return t0;
}

static float hit_sphere(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    vec3 p = lobe_sub(o, s->center);
    float b = lobe_dot(p, d), c = lobe_dot(p, p) - s->radius * s->radius, discriminant = b * b - c, t;
    if (discriminant <= 0) return SCENE_FAR;
    t = -b - sqrtf(discriminant);
    if (t <= start) return SCENE_FAR;
    *normal = lobe_scale(lobe_add(p, lobe_scale(d, t)), 1 / s->radius);
    return t;
}

/* The wall of an upright cylinder seen from outside (side 1) or from inside (side -1). */
static float hit_wall(const shape *s, float radius, float side, vec3 o, vec3 d, float start, vec3 *normal) {
    float px = o.x - s->center.x, pz = o.z - s->center.z, a = d.x * d.x + d.z * d.z;
    float b = px * d.x + pz * d.z, c = px * px + pz * pz - radius * radius, discriminant = b * b - a * c, t, y;
    if (a < 1e-12f || discriminant <= 0) return SCENE_FAR;
    t = (-b - side * sqrtf(discriminant)) / a;
    y = o.y + t * d.y - s->center.y;
    if (t <= start || y < 0 || y > s->height) return SCENE_FAR;
    *normal = lobe_scale(lobe_vector(px + t * d.x, 0, pz + t * d.z), side / radius);
    return t;
}

/* The flat top of a column or ring. */
static float hit_top(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    float t, x, z, r2;
    if (d.y >= 0) return SCENE_FAR;
    t = (s->center.y + s->height - o.y) / d.y;
    x = o.x + t * d.x - s->center.x;
    z = o.z + t * d.z - s->center.z;
    r2 = x * x + z * z;
    if (t <= start || r2 > s->radius * s->radius || r2 < s->inner_radius * s->inner_radius) return SCENE_FAR;
    *normal = lobe_vector(0, 1, 0);
    return t;
}

static float hit_round(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    vec3 n;
    float best = hit_wall(s, s->radius, 1, o, d, start, normal), t = hit_top(s, o, d, start, &n);
    if (t < best) {
        best = t;
        *normal = n;
    }
    if (s->inner_radius > 0) {
        t = hit_wall(s, s->inner_radius, -1, o, d, start, &n);
        if (t < best) {
            best = t;
            *normal = n;
        }
    }
    return best;
}

static float hit_shape(const shape *s, vec3 o, vec3 d, float start, vec3 *normal) {
    switch (s->kind) {
    case SHAPE_QUAD:
        return hit_quad(s, o, d, start, normal);
    case SHAPE_BOX:
        return hit_box(s, o, d, start, normal);
    case SHAPE_SPHERE:
        return hit_sphere(s, o, d, start, normal);
    case SHAPE_COLUMN:
    case SHAPE_RING:
        return hit_round(s, o, d, start, normal);
    }
    return SCENE_FAR;
}

/* Index of the nearest shape, -1 if none. */
static int nearest(const scene *world, vec3 o, vec3 d, float start, float *distance, vec3 *normal) {
    int i, found = -1;
    *distance = SCENE_FAR;
    for (i = 0; i < world->count; i++) {
        vec3 n;
        float t = hit_shape(&world->shapes[i], o, d, start, &n);
        if (t < *distance) {
            *distance = t;
            *normal = n;
            found = i;
        }
    }
    return found;
}

int scene_trace(const scene *world, vec3 origin, vec3 dir, surface *hit) {
    const material *look;
    int which = nearest(world, origin, dir, 0, &hit->distance, &hit->normal), tile = 0;
    if (which < 0) return 0;
    look = &world->shapes[which].look;
    hit->shape = which;
    hit->position = lobe_add(origin, lobe_scale(dir, hit->distance));
    if (look->tile > 0) {
        int column = (int)floorf(hit->position.x / look->tile), row = (int)floorf(hit->position.z / look->tile);
        tile = (column + row) & 1;
    }
    hit->look = look->finishes[tile];
    return 1;
}

float scene_distance(const scene *world, vec3 origin, vec3 dir, float start) {
    float distance;
    vec3 normal;
    nearest(world, origin, dir, start, &distance, &normal);
    return distance;
}

int scene_visible(const scene *world, vec3 a, vec3 normal_a, vec3 b, vec3 normal_b) {
    const float lift = 1e-4f; /* above what floats lose in a room of metres */
    vec3 from = lobe_add(a, lobe_scale(normal_a, lift)), to = lobe_add(b, lobe_scale(normal_b, lift)), unused;
    vec3 offset = lobe_sub(to, from);
    float distance = vec3_length(offset);
    int i;
    offset = lobe_scale(offset, 1 / distance);
    for (i = 0; i < world->count; i++) {
        if (hit_shape(&world->shapes[i], from, offset, 0, &unused) < distance) return 0;
    }
    return 1;
}

vec3 spot_intensity(const spot_light *spot, vec3 dir) {
    float angle = acosf(lobe_min(lobe_dot(dir, spot->forward), 1));
    float fade = lobe_max(0, lobe_min(1, (spot->cone - angle) / (0.2f * spot->cone)));
    return lobe_scale(spot->intensity, fade * fade * (3 - 2 * fade));
}

/* ---- the room ---- */

static material plain(vec3 diffuse, float specular, float alpha) {
    material look;
    look.finishes[0].diffuse = diffuse;
    look.finishes[0].specular = lobe_vector(specular, specular, specular);
    look.finishes[0].alpha = alpha;
    look.finishes[1] = look.finishes[0];
    look.tile = 0;
    return look;
}

static shape *add(scene *world, shape_kind kind, material look, vec3 center) {
    shape *s = &world->shapes[world->count++];
    s->kind = kind;
    s->look = look;
    s->center = center;
    return s;
}

static void add_quad(scene *world, material look, vec3 center, vec3 edge_u, vec3 edge_v) {
    shape *s = add(world, SHAPE_QUAD, look, center);
    s->edge_u = edge_u;
    s->edge_v = edge_v;
    s->normal = vec3_normalize(lobe_cross(edge_u, edge_v));
}

void spot_aim(spot_light *spot, vec3 position, vec3 target) {
    spot->position = position;
    spot->target = target;
    spot->forward = vec3_normalize(lobe_sub(target, position));
    scene_frame(spot->forward, &spot->right, &spot->up);
}

static void aim(scene *world, vec3 position, vec3 target, float intensity, float cone) {
    world->spot.intensity = lobe_vector(intensity, 0.93f * intensity, 0.83f * intensity);
    world->spot.cone = cone;
    world->spot.tangent = tanf(cone);
    spot_aim(&world->spot, position, target);
}

scene scene_room(void) {
    scene world;
    shape *s;
    material floor_look = plain(lobe_vector(0.35f, 0.33f, 0.3f), 0.35f, 0.13f), gold;
    const vec3 x = {2, 0, 0}, y = {0, 1.25f, 0}, z = {0, 0, 2};
    memset(&world, 0, sizeof world);
    world.center = lobe_vector(0, 1, 0);

    floor_look.finishes[1] = plain(lobe_vector(0.55f, 0.52f, 0.48f), 0.15f, 0.35f).finishes[0];
    floor_look.tile = 0.5f;
    add_quad(&world, floor_look, lobe_vector(0, 0, 0), z, x);
    add_quad(&world, plain(lobe_vector(0.7f, 0.7f, 0.7f), 0, 1), lobe_vector(0, 2.5f, 0), x, z);
    add_quad(&world, plain(lobe_vector(0.7f, 0.7f, 0.7f), 0, 1), lobe_vector(0, 1.25f, -2), x, y);
    add_quad(&world, plain(lobe_vector(0.75f, 0.1f, 0.07f), 0, 1), lobe_vector(-2, 1.25f, 0), y, z);
    add_quad(&world, plain(lobe_vector(0.12f, 0.5f, 0.12f), 0, 1), lobe_vector(2, 1.25f, 0), z, y);

    gold = plain(lobe_vector(0, 0, 0), 0, 0.16f);
    gold.finishes[0].specular = lobe_vector(0.95f, 0.72f, 0.35f);
    s = add(&world, SHAPE_RING, gold, lobe_vector(-0.3f, 0, 0.75f));
    s->radius = 0.68f;
    s->inner_radius = 0.65f;
    s->height = 0.3f;

    s = add(&world, SHAPE_COLUMN, plain(lobe_vector(0.6f, 0.6f, 0.62f), 0.15f, 0.3f), lobe_vector(-0.95f, 0, -1.2f));
    s->radius = 0.22f;
    s->height = 1.7f;

    s = add(&world, SHAPE_BOX, plain(lobe_vector(0.65f, 0.65f, 0.65f), 0.1f, 0.4f), lobe_vector(0.75f, 0.5f, -0.9f));
    s->half_size = lobe_vector(0.38f, 0.5f, 0.38f);
    s->turn_cos = cosf(0.4f);
    s->turn_sin = sinf(0.4f);

    s = add(&world, SHAPE_SPHERE, plain(lobe_vector(0.1f, 0.1f, 0.12f), 0.6f, 0.15f), lobe_vector(1.1f, 0.35f, 0.35f));
    s->radius = 0.35f;

    aim(&world, lobe_vector(1.6f, 1.7f, 1.7f), lobe_vector(-0.9f, 0.2f, 0.3f), 30, 0.5f);
    world.eye.position = lobe_vector(0.1f, 2.2f, 4.1f);
    world.eye.target = lobe_vector(0, 0.62f, 0);
    world.eye.field_of_view = 0.78f;
    return world;
}

scene scene_ring(float alpha) {
    scene world;
    shape *s;
    const vec3 x = {3, 0, 0}, y = {0, 1.5f, 0}, z = {0, 0, 3};
    material metal = plain(lobe_vector(0, 0, 0), 0, alpha);
    memset(&world, 0, sizeof world);
    metal.finishes[0].specular = lobe_vector(0.95f, 0.75f, 0.4f);
    add_quad(&world, plain(lobe_vector(0.7f, 0.68f, 0.65f), 0, 1), lobe_vector(0, 0, 0), z, x);
    add_quad(&world, plain(lobe_vector(0.5f, 0.55f, 0.65f), 0, 1), lobe_vector(0, 1.5f, -3), x, y);
    s = add(&world, SHAPE_RING, metal, lobe_vector(0, 0, 0));
    s->radius = 1.05f;
    s->inner_radius = 1;
    s->height = 0.6f;
    aim(&world, lobe_vector(2.1f, 2.9f, 0.7f), lobe_vector(-0.3f, 0.25f, -0.1f), 40, 0.32f);
    world.eye.position = lobe_vector(0.3f, 2.3f, 2.7f);
    world.eye.target = lobe_vector(0, 0.05f, -0.1f);
    world.eye.field_of_view = 0.75f;
    return world;
}

scene scene_colonnade(float alpha) {
    scene world;
    shape *s;
    const vec3 x = {5, 0, 0}, y = {0, 1.6f, 0}, z = {0, 0, 4};
    const material plaster = plain(lobe_vector(0.65f, 0.62f, 0.58f), 0, 1);
    material marble = plain(lobe_vector(0.25f, 0.24f, 0.22f), 0.5f, alpha);
    int i;
    memset(&world, 0, sizeof world);
    world.center = lobe_vector(0, 1, 0);
    add_quad(&world, marble, lobe_vector(0, 0, 1.5f), z, x);
    add_quad(&world, plaster, lobe_vector(0, 3.2f, 1.5f), x, z);
    add_quad(&world, plain(lobe_vector(0.6f, 0.62f, 0.68f), 0, 1), lobe_vector(0, 1.6f, -2.5f), x, y);
    add_quad(&world, plain(lobe_vector(0.65f, 0.55f, 0.5f), 0, 1), lobe_vector(-5, 1.6f, 1.5f), y, z);
    marble.finishes[0].diffuse = lobe_vector(0.5f, 0.5f, 0.48f);
    for (i = 0; i < 8; i++) {
        s = add(&world, SHAPE_COLUMN, marble, lobe_vector(-3.6f + 2.2f * (float)(i / 2), 0, i % 2 ? -1.2f : 0.7f));
        s->radius = 0.28f;
        s->height = 3.2f;
    }
    aim(&world, lobe_vector(4.8f, 1.7f, 1.9f), lobe_vector(-1.6f, 0.1f, -0.5f), 150, 0.3f);
    world.eye.position = lobe_vector(3.9f, 1.9f, 4.2f);
    world.eye.target = lobe_vector(-0.9f, 1.1f, -0.4f);
    world.eye.field_of_view = 0.8f;
    return world;
}

static scene gallery_walls(void) {
    scene world;
    const material white = plain(lobe_vector(0.5f, 0.5f, 0.5f), 0.5f, 0.3f);
    const vec3 x = {2, 0, 0}, y = {0, 1.25f, 0}, z = {0, 0, 2};
    memset(&world, 0, sizeof world);
    world.center = lobe_vector(0, 1, 0);
    add_quad(&world, white, lobe_vector(0, 0, 0), z, x);
    add_quad(&world, white, lobe_vector(0, 2.5f, 0), x, z);
    add_quad(&world, white, lobe_vector(0, 1.25f, -2), x, y);
    add_quad(&world, white, lobe_vector(0, 1.25f, 2), y, x);
    add_quad(&world, white, lobe_vector(-2, 1.25f, 0), y, z);
    add_quad(&world, white, lobe_vector(2, 1.25f, 0), z, y);
    aim(&world, lobe_vector(0, 2.4f, 0), lobe_vector(0, 0, 0), 10, 0.8f);
    return world;
}

static void add_ball(scene *world, float radius, vec3 center) {
    add(world, SHAPE_SPHERE, plain(lobe_vector(0.3f, 0.3f, 0.3f), 0.7f, 0.2f), center)->radius = radius;
}

scene scene_gallery(void) {
    scene world = gallery_walls();
    add_ball(&world, 0.42f, lobe_vector(-0.95f, 0.42f, -0.35f));
    add_ball(&world, 0.36f, lobe_vector(0, 0.36f, -0.1f));
    add_ball(&world, 0.3f, lobe_vector(0.85f, 0.3f, 0.1f));
    world.eye.position = lobe_vector(0.1f, 1.55f, 3.1f);
    world.eye.target = lobe_vector(0, 0.25f, 0.1f);
    world.eye.field_of_view = 0.65f;
    return world;
}

scene scene_spheres(void) {
    scene world = gallery_walls();
    int i;
    for (i = 0; i < 6; i++)
        add_ball(&world, 0.34f, lobe_vector((float)(i % 3 - 1) * 0.7f, 1.25f + (i < 3 ? 0.36f : -0.36f), 0));
    world.eye.position = lobe_vector(0, 1.25f, 3.2f);
    world.eye.target = lobe_vector(0, 1.25f, 0);
    world.eye.field_of_view = 0.5f;
    return world;
}
