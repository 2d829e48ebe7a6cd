// What fis.glsl leaves to its user, from the pool of the pyramids that the unit tests ask about: a PDF is a number a
// texel; an image is one plane of four channels after the other.

layout(std430, binding = 2) readonly buffer texels_buffer { float texels[]; };

float fis_pdf_texel(fis_pyramid p, int x, int y, int level) {
    return texels[fis_texel_index(p, x, y, level)];
}

vec4 fis_texel(fis_pyramid p, int x, int y, int level, int plane) {
    int start = p.base, first;
    p.base = 0;
    first = start + 4 * (plane * (fis_texel_index(p, 0, 0, p.levels - 1) + 1) + fis_texel_index(p, x, y, level));
    return vec4(texels[first], texels[first + 1], texels[first + 2], texels[first + 3]);
}
