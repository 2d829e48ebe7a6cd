// fis_halve.glsl - one channel of a texel of a pyramid's level, from the level below
//
// The includer declares `texels`: level by level from 0 on, row by row, channels interleaved, as fis_build leaves them.

const int FIS_CLEAN = 0;     // level 0 of an image, cleaned as fis_build does
const int FIS_CLEAN_PDF = 1; // of a PDF, as fis_build_pdf does
const int FIS_HALVE = 2;
const int FIS_FILL = 3; // a PDF whose top texel is 0 becomes uniform, a level at a time, the top last

layout(std140, binding = 1) uniform parameters {
    int width; // of level 0
    int height;
    int channels;
    int level; // to be made
    int mode;
    int plane; // that is drawn: four channels
};

int fis_number(int x, int y, int at_level, int channel) {
    fis_pyramid p;
    p.width = width;
    p.height = height;
    p.levels = 0;
    p.base = 0;
    return fis_texel_index(p, x, y, at_level) * channels + channel;
}

// How many texels of the image one of a level covers, in one direction
float fis_covered(int x, int size) {
    return float(min((x + 1) << level, size) - (x << level));
}

float fis_made(int x, int y, int channel) {
    if (mode == FIS_FILL) {
        float uniform_mean = fis_covered(x, width) * lobe_fis_shrink(level) * fis_covered(y, height) * lobe_fis_shrink(level);
        return texels[fis_number(0, 0, fis_levels(width, height) - 1, 0)] > 0.0 ? texels[fis_number(x, y, level, 0)]
                                                                                 : uniform_mean;
    }
    if (mode != FIS_HALVE) {
        float value = texels[fis_number(x, y, 0, channel)];
        return mode == FIS_CLEAN ? lobe_fis_clean(value) : lobe_fis_clean_pdf(value);
    }
    int below = level - 1, left = 2 * x, top = 2 * y;
    bool right = left + 1 < lobe_fis_size(width, below), bottom = top + 1 < lobe_fis_size(height, below);
    float a = texels[fis_number(left, top, below, channel)], b = 0.0, c = 0.0, d = 0.0;
    if (right) b = texels[fis_number(left + 1, top, below, channel)];
    if (bottom) c = texels[fis_number(left, top + 1, below, channel)];
    if (right && bottom) d = texels[fis_number(left + 1, top + 1, below, channel)];
    return 0.25 * ((a + c) + (b + d));
}
