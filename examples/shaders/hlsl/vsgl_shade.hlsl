// vsgl_shade.glsl - light of virtual SG lights reflected by the surfaces of a G-buffer, in closed form

// Four float4 a pixel: position and alpha, normal, diffuse and specular reflectance. The last two are 0 where there is none.
StructuredBuffer<float4> surfaces : register(t0);
StructuredBuffer<float4> lights : register(t1);

// Of each light a map, which it is in the middle of: octahedral, row by row
StructuredBuffer<float> distances : register(t2);

cbuffer parameters : register(b3) {
    float4 eye;
    int width;
    int height;
    int light_count;
    int map_size; // edge of a shadow map; 0: nothing is in shadow
};

// Index of a map's texel in a direction of any length
int shadow_map_texel(float3 dir) {
    float scale = 1.0 / max(abs(dir.x) + abs(dir.y) + abs(dir.z), 1e-30), x = dir.x * scale, y = dir.y * scale;
    float u = dir.z < 0.0 ? (1.0 - abs(y)) * (x < 0.0 ? -1.0 : 1.0) : x;
    float v = dir.z < 0.0 ? (1.0 - abs(x)) * (y < 0.0 ? -1.0 : 1.0) : y;
    float size = float(map_size);
    return int(min((v * 0.5 + 0.5) * size, size - 1.0)) * map_size + int(min((u * 0.5 + 0.5) * size, size - 1.0));
}

// Whether a light sees a place; the bias grows with the slope
bool light_visible(int light, float3 light_position, float3 place, float3 normal) {
    if (map_size == 0) return true;
    float3 offset = place - light_position;
    float distance2 = max(dot(offset, offset), 1e-30), apart = sqrt(distance2);
    float cosine = max(-dot(offset, normal), 0.1 * apart); // times distance
    float bias = 0.5 * (1.7 / float(map_size)) * distance2 * (apart / cosine) + 0.01;
    return apart - bias <= distances[light * map_size * map_size + shadow_map_texel(offset)];
}

// Radiance that a pixel's surface reflects to the eye. Constant cosine and Fresnel reflectance over each light
float3 vsgl_shade(int pixel_index) {
    float3 place = surfaces[4 * pixel_index].xyz, normal = surfaces[4 * pixel_index + 1].xyz;
    float3 diffuse_reflectance = surfaces[4 * pixel_index + 2].xyz;
    float3 specular_reflectance = surfaces[4 * pixel_index + 3].xyz;
    float3 diffuse = float3(0.0, 0.0, 0.0), specular = float3(0.0, 0.0, 0.0);
    if (lobe_mean(diffuse_reflectance) + lobe_mean(specular_reflectance) <= 0.0) return diffuse;
    float alpha = surfaces[4 * pixel_index].w;
    float3 view = lobe_normalize_or(eye.xyz - place, normal);
    asg_lobe reflection = asg_ggx_lobe(normal, view, alpha);
    for (int light = 0; light < light_count; light++) {
        int first = light * VSGL_BUFFER_SIZE;
        vsgl v = vsgl_unpack(lights[first], lights[first + 1], lights[first + 2], lights[first + 3], lights[first + 4]);
        if (!light_visible(light, v.position, place, normal)) continue;
        for (int k = 0; k < 2; k++) {
            if (lobe_mean(v.intensity[k]) <= 0.0) continue;
            diffuse += v.intensity[k] * vsgl_diffuse(v, k, place, normal);
            specular += v.intensity[k] * asg_vsgl_specular(v, k, place, normal, view, alpha, reflection);
        }
    }
    return diffuse * diffuse_reflectance + specular * specular_reflectance;
}
