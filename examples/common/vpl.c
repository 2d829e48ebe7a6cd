#include "vpl.h"
#include "fail.h"
#include "raster.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static vpl_map allocate_map(int width, int height) {
    vpl_map map;
    memset(&map, 0, sizeof map);
    map.texels = (vpl *)allocate("texels", (size_t)width * (size_t)height, sizeof *map.texels);
    map.width = width;
    map.height = height;
    return map;
}

void vpl_map_fill(vpl_map *map, const buffer *from) {
    int i;
    memset(map->texels, 0, (size_t)map->width * (size_t)map->height * sizeof *map->texels);
    for (i = 0; i < map->width * map->height; i++) {
        const texel *t = &from->texels[i];
        vpl *v = &map->texels[i];
        if (!t->valid) continue;
        v->position = t->hit.position;
        v->normal = t->hit.normal;
        v->view = t->view;
        v->diffuse = vec3_multiply(t->flux, t->hit.look.diffuse);
        v->specular = vec3_multiply(t->flux, t->hit.look.specular);
        v->alpha = t->hit.look.alpha;
    }
}

vpl_map vpl_map_create(const buffer *from, vec3 center) {
    vpl_map map = allocate_map(from->width, from->height);
    map.center = center;
    vpl_map_fill(&map, from);
    return map;
}

/* ---- from files ---- */

enum { POSITION, NORMAL, FLUX, ALPHA, PARTS };
static const char *const part_names[PARTS] = {"position", "normal", "flux", "alpha"};

/* What products and squares of are far from the range of floats */
static const float lows[PARTS] = {-1e5f, -1e5f, 0, 0}, highs[PARTS] = {1e5f, 1e5f, 1e15f, 1};
static const char *const ranges[PARTS] = {
    "it has a value that is not in [-1e5, 1e5]", "it has a value that is not in [-1e5, 1e5]",
    "it has a value that is not in [0, 1e15]", "it has a value that is not in [0, 1]"};

static void part_path(char *path, size_t size, const char *prefix, int part) {
    if (snprintf(path, size, "%s-%s.pfm", prefix, part_names[part]) >= (int)size) give_up(prefix, "name too long");
}

static void read_part(raster *r, const char *prefix, int part, const raster *first) {
    char path[1024];
    const char *wrong;
    size_t i, count;
    part_path(path, sizeof path, prefix, part);
    wrong = raster_read(path, r);
    if (wrong) give_up(path, wrong);
    if (r->channels != (part == ALPHA ? 1 : 3)) give_up(path, part == ALPHA ? "it is not Pf" : "it is not PF");
    if (r->width != first->width || r->height != first->height) give_up(path, "it is not as large as the position");
    count = (size_t)r->width * (size_t)r->height * (size_t)r->channels;
    for (i = 0; i < count; i++) {
        if (!raster_in_range(r->values[i], lows[part], highs[part])) give_up(path, ranges[part]);
    }
}

static vec3 triple(const raster *r, size_t i) {
    return lobe_vector(r->values[3 * i], r->values[3 * i + 1], r->values[3 * i + 2]);
}

vpl_map vpl_map_read(const char *prefix, const vec3 *light) {
    raster parts[PARTS];
    vpl_map map;
    size_t i, count, lit = 0;
    double sums[3] = {0, 0, 0};
    char path[1024];
    int part;
    for (part = 0; part < PARTS; part++) read_part(&parts[part], prefix, part, part ? &parts[0] : &parts[part]);
    map = allocate_map(parts[0].width, parts[0].height);
    count = (size_t)map.width * (size_t)map.height;
    for (i = 0; i < count; i++) {
        vpl *v = &map.texels[i];
        const vec3 flux = triple(&parts[FLUX], i), normal = triple(&parts[NORMAL], i);
        if (!(lobe_mean(flux) > 0)) continue;
        v->position = triple(&parts[POSITION], i);
        v->normal = lobe_normalize_or(normal, lobe_vector(0, 0, 1));
        v->view = v->normal;
        v->alpha = parts[ALPHA].values[i];
        if (!(lobe_dot(normal, normal) > 1e-12f)) {
            part_path(path, sizeof path, prefix, NORMAL);
            give_up(path, "it has no direction in a texel whose flux is not 0");
        }
        if (v->alpha < 1 && !light) {
            part_path(path, sizeof path, prefix, ALPHA);
            give_up(path, "it has texels below 1, which are specular: --light must tell where the light is");
        }
        if (v->alpha < 1) {
            v->view = lobe_normalize_or(lobe_sub(*light, v->position), v->normal);
            v->specular = flux;
        } else {
            v->diffuse = flux;
        }
        sums[0] += (double)v->position.x;
        sums[1] += (double)v->position.y;
        sums[2] += (double)v->position.z;
        lit++;
    }
    if (lit)
        map.center =
            lobe_vector((float)(sums[0] / (double)lit), (float)(sums[1] / (double)lit), (float)(sums[2] / (double)lit));
    for (part = 0; part < PARTS; part++) free(parts[part].values);
    return map;
}
