#include "sg.hlsl"
#include "fis.hlsl"
#include "vsgl_moments.hlsl"

// Pyramids that fis_halve.comp has built
StructuredBuffer<float> pdf : register(t0);
StructuredBuffer<float4> moments : register(t1);

// As vsgl_unpack takes them
RWStructuredBuffer<float4> lights : register(u2);

cbuffer parameters : register(b3) {
    float4 center; // that positions were summed relative to
    int width;
    int height;
    int light_count;
    int method;
    int seed;
    float kernel_size; // in shares of a light
};

// Kernel size from the PDF at the centre: of its texel, read bilinearly; or in the kernel: as published, by fis_level
static const int METHOD_NEAREST = 0;
static const int METHOD_DENSITY = 1;
static const int METHOD_BISECTION = 2;
static const int METHOD_FAST = 3;

float fis_pdf_texel(fis_pyramid p, int x, int y, int level) {
    return pdf[fis_texel_index(p, x, y, level)];
}

float4 fis_texel(fis_pyramid p, int x, int y, int level, int plane) {
    return moments[4 * fis_texel_index(p, x, y, level) + plane];
}

float wrapped(float x) {
    return x < 1.0 ? x : x - 1.0;
}

// A point of the lattice, shifted by the seed
float2 lattice_point(int i) {
    float2 place = fis_lattice(i, light_count);
    float shift_u = float(uint(seed) * 0x9E3779B1u >> 8) / 16777216.0;
    float shift_v = float(uint(seed) * 0x85EBCA77u >> 8) / 16777216.0;
    return float2(wrapped(place.x + shift_u), wrapped(place.y + shift_v));
}

// The level of a light's kernel, and what makes its total of its mean
float kernel_level(fis_pyramid p, fis_sample s, out float scale) {
    float level;
    if (method == METHOD_NEAREST) {
        scale = fis_scale_density_nearest(p, s, light_count);
        return fis_level_density_nearest(p, s, light_count, kernel_size);
    }
    if (method == METHOD_DENSITY) {
        scale = fis_scale_density(p, s, light_count);
        return fis_level_density(p, s, light_count, kernel_size);
    }
    level = method == METHOD_BISECTION ? fis_level_bisect(p, s, light_count, kernel_size, 12)
                                       : fis_level(p, s, light_count, kernel_size);
    if (method == METHOD_FAST && level > 0.0 && level < float(p.levels - 1))
        scale = exp2(2.0 * level) / kernel_size; // the kernel holds its share of the PDF: no need to look
    else
        scale = fis_scale(p, s, level, light_count);
    return level;
}

[numthreads(64, 1, 1)]
void main(uint3 workgroup : SV_GroupID, uint3 thread : SV_DispatchThreadID, uint3 local_thread : SV_GroupThreadID, uint local_index : SV_GroupIndex) {
    int i = int(thread.x);
    fis_pyramid p;
    float scale;
    if (i >= light_count) return;
    p.width = width;
    p.height = height;
    p.levels = fis_levels(width, height);
    p.base = 0;
    fis_sample s = fis_warp(p, lattice_point(i));
    float level = kernel_level(p, s, scale);
    vsgl_moments m = vsgl_moments_unpack(fis_fetch(p, s.u, s.v, level, 0), fis_fetch(p, s.u, s.v, level, 1),
                                         fis_fetch(p, s.u, s.v, level, 2), fis_fetch(p, s.u, s.v, level, 3));
    vsgl v = vsgl_from_moments(vsgl_moments_scale(m, scale), center.xyz);
    lights[5 * i] = float4(v.position, v.variance);
    lights[5 * i + 1] = float4(v.emission[0].axis, v.emission[0].sharpness);
    lights[5 * i + 2] = float4(v.emission[1].axis, v.emission[1].sharpness);
    lights[5 * i + 3] = float4(v.intensity[0], v.emission[0].log_amplitude);
    lights[5 * i + 4] = float4(v.intensity[1], v.emission[1].log_amplitude);
}
