/* Pyramids of images and of PDFs: against texels. */
#include "growth.h"
#include "../../examples/common/fail.h"
#include "../../examples/common/hash.h"
#include "../../fis.h"
#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 5, SUBJECTS = 3, CHANNELS = 16 };
static const int edges[SIZES] = {128, 224, 400, 720, 1280};

typedef struct {
    float *image, *pyramid; /* for the largest with all channels */
} context;

static void run(void *of, int subject, int which) {
    const context *c = (context *)of;
    const int edge = edges[which];
    if (subject == 2)
        fis_build_pdf(c->pyramid, c->image, edge, edge);
    else
        fis_build(c->pyramid, c->image, edge, edge, subject ? CHANNELS : 1);
}

void growth_pyramid(growth_report *to) {
    const size_t most = (size_t)edges[SIZES - 1] * (size_t)edges[SIZES - 1] * CHANNELS;
    context c;
    growth g = growth_of("Pyramids", "texels", run, &c);
    size_t i;
    c.image = (float *)allocate("pyramid", most, sizeof *c.image);
    c.pyramid =
        (float *)allocate("pyramid", fis_pyramid_size(edges[SIZES - 1], edges[SIZES - 1], CHANNELS), sizeof *c.pyramid);
    for (i = 0; i < most; i++) c.image[i] = (float)(hash_mix((unsigned)i) >> 8) * 0x1p-24f;
    g.subjects[0] = "fis_build of 1 channel";
    g.subjects[1] = "fis_build of 16 channels";
    g.subjects[2] = "fis_build_pdf";
    for (i = 0; i < SIZES; i++) g.sizes[i] = edges[i] * edges[i];
    snprintf(g.fixed, sizeof g.fixed, "square images");
    growth_measure(to, &g);
    free(c.image);
    free(c.pyramid);
}
