#include "../../../fis.h"
#include "../../../examples/common/fail.h"
#include "../../../examples/common/gpu_shade.h"
#include "../../../examples/common/vsgl_generate.h"
#include "../../../examples/common/vsgl_shade.h"
#include "pipelines.h"
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 157, HEIGHT = 115, RSM_SIZE = 128, COUNT = 192 }; /* no multiples of a workgroup's 8 */

static light_set generate_lights(const scene *world) {
    buffer seen = buffer_rsm(world, RSM_SIZE);
    vpl_map rsm = vpl_map_create(&seen, world->center);
    float *flux = (float *)allocate("PDF", RSM_SIZE * RSM_SIZE, sizeof *flux);
    generator g = generator_create(RSM_SIZE, RSM_SIZE, COUNT);
    light_set set = light_set_create(COUNT);
    int i;
    for (i = 0; i < RSM_SIZE * RSM_SIZE; i++) flux[i] = vpl_weight(&rsm.texels[i]);
    vsgl_generate(&g, &rsm, flux, METHOD_FAST, 1, 1, &set);
    generator_free(&g);
    free(flux);
    free(rsm.texels);
    buffer_free(&seen);
    return set;
}

static void compare(gpu *device, const char *folder, const scene *world, const char *name, float exposure) {
    static const char *const stages[2] = {"compute", "fragment"};
    light_set set = generate_lights(world);
    buffer seen = buffer_camera(world, WIDTH, HEIGHT);
    vpl_map view = vpl_map_create(&seen, world->center);
    shadow_map *maps = (shadow_map *)allocate("shadow maps", COUNT, sizeof *maps);
    image wanted = image_create(WIDTH, HEIGHT), got = image_create(WIDTH, HEIGHT);
    int shadows, stage;
    set.lights[0].variance = 0;                        /* a point light */
    set.lights[1].intensity[0] = lobe_vector(0, 0, 0); /* a component that is left out */
    set.lights[1].emission[0].sharpness = NAN;
    vsgl_shadow_maps(world, set.lights, COUNT, maps);
    for (shadows = 0; shadows < 2; shadows++) {
        const shadow_map *used = shadows ? maps : NULL;
        gpu_shade *s = gpu_shade_create(device, folder, &view, world->eye.position, set.lights, used, COUNT);
        vsgl_shade(&view, set.lights, used, COUNT, wanted.pixels, "CPU");
        for (stage = 0; stage < 2; stage++) {
            char what[128];
            gpu_shade_run(s, (gpu_stage)stage, got.pixels);
            snprintf(what, sizeof what, "VSGL shading of the %s, %s shadows, %s", name, shadows ? "with" : "without",
                     stages[stage]);
            pipeline_picture(what, &got, &wanted, exposure);
        }
        gpu_shade_free(s);
    }
    image_free(&wanted);
    image_free(&got);
    free(maps);
    free(view.texels);
    buffer_free(&seen);
    light_set_free(&set);
}

void pipeline_shade(gpu *device, const char *folder) {
    const scene room = scene_room(), ring = scene_ring(0.1f);
    compare(device, folder, &room, "room", 2.2f);
    compare(device, folder, &ring, "ring", 0.6f);
}
