/* Any bytes as an image file: refused, or an image whose every value is there. */
#include "../../examples/common/file.c"
#include "../../examples/common/raster.c"
#include <stdint.h>

static volatile unsigned seen; /* so that every value is read */

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count) {
    raster r;
    const unsigned char *values;
    unsigned sum = 0;
    size_t i, size;
    if (raster_parse(bytes, count, &r)) return 0;
    if (r.width < 1 || r.width > RASTER_MAX_SIDE || r.height < 1 || r.height > RASTER_MAX_SIDE) abort();
    if ((double)r.width * r.height > RASTER_MAX_TEXELS || (r.channels != 1 && r.channels != 3)) abort();
    values = (const unsigned char *)r.values;
    size = sizeof(float) * (size_t)r.width * (size_t)r.height * (size_t)r.channels;
    for (i = 0; i < size; i++) sum += values[i];
    seen = sum;
    free(r.values);
    return 0;
}
