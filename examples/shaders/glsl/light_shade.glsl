// light_shade.glsl - a pixel's irradiance from the lights that its tile has kept

layout(std430, binding = 5) readonly buffer tiles_buffer { uint tiles[]; };
layout(std430, binding = 6) readonly buffer entries_buffer { uint entries[]; };

// Of one light, per unit of its colour, by chance as it is accepted
float light_irradiance(vpl l, vec3 position, vec3 normal) {
    vec3 offset = position - l.position;
    float squared = dot(offset, offset);
    vec3 wo = offset * (1.0 / sqrt(max(squared, 1e-30)));
    float value = l.glossy ? ggx_brdf_cos(l.normal, l.wi, wo, l.alpha) : 0.318309886 * max(dot(wo, l.normal), 0.0);
    return ggx_estimate(l.flux * value, squared + extent * extent, delta, l.xi) * max(-dot(wo, normal), 0.0);
}

vec3 light_shade(int x, int y) {
    vec3 sum = vec3(0.0, 0.0, 0.0);
    vec4 surface = surfaces[2 * (y * width + x)];
    if (surface.w <= 0.0) return sum;
    vec3 normal = surfaces[2 * (y * width + x) + 1].xyz;
    int subset = y % interleave * interleave + x % interleave;
    int tile = (subset * rows + y / interleave / edge) * columns + x / interleave / edge;
    int count = min(int(tiles[2 * tile]), most), cluster = surface.w > uintBitsToFloat(tiles[2 * tile + 1]) ? 2 : 1;
    for (int i = 0; i < count; i++) {
        int entry = int(entries[tile * most + i]);
        if ((entry & cluster) == 0) continue;
        vpl l = vpl_at(entry / 4);
        sum += l.colour * light_irradiance(l, surface.xyz, normal);
    }
    return sum;
}
