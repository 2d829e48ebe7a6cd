// light_shade.glsl - a pixel's irradiance from the lights that its tile has kept

StructuredBuffer<uint> tiles : register(t5);
StructuredBuffer<uint> entries : register(t6);

// Of one light, per unit of its colour, by chance as it is accepted
float light_irradiance(vpl l, float3 position, float3 normal) {
    float3 offset = position - l.position;
    float squared = dot(offset, offset);
    float3 wo = offset * (1.0 / sqrt(max(squared, 1e-30)));
    float value = l.glossy ? ggx_brdf_cos(l.normal, l.wi, wo, l.alpha) : 0.318309886 * max(dot(wo, l.normal), 0.0);
    return ggx_estimate(l.flux * value, squared + extent * extent, delta, l.xi) * max(-dot(wo, normal), 0.0);
}

float3 light_shade(int x, int y) {
    float3 sum = float3(0.0, 0.0, 0.0);
    float4 surface = surfaces[2 * (y * width + x)];
    if (surface.w <= 0.0) return sum;
    float3 normal = surfaces[2 * (y * width + x) + 1].xyz;
    int subset = y % interleave * interleave + x % interleave;
    int tile = (subset * rows + y / interleave / edge) * columns + x / interleave / edge;
    int count = min(int(tiles[2 * tile]), most), cluster = surface.w > asfloat(tiles[2 * tile + 1]) ? 2 : 1;
    for (int i = 0; i < count; i++) {
        int entry = int(entries[tile * most + i]);
        if ((entry & cluster) == 0) continue;
        vpl l = vpl_at(entry / 4);
        sum += l.colour * light_irradiance(l, surface.xyz, normal);
    }
    return sum;
}
