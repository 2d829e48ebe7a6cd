// What fis.glsl leaves to its user, from textures.

uniform highp sampler2D pdf_mips;
uniform highp sampler2DArray image_mips;

float fis_pdf_texel(fis_pyramid p, int x, int y, int level) {
    return texelFetch(pdf_mips, ivec2(x, y), level).x;
}

vec4 fis_texel(fis_pyramid p, int x, int y, int level, int plane) {
    return texelFetch(image_mips, ivec3(x, y, plane), level);
}
