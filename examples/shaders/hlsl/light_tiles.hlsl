// light_tiles.glsl - what the shaders of stochastic light culling share: parameters, pixels and lights

cbuffer parameters : register(b0) {
    float4 eye;
    float4 right; // of the camera, as the next two
    float4 up;
    float4 forward;
    float delta;  // radiance below which lights are left out at random
    float extent; // length that is added to each distance, as the hypotenuse
    int width;
    int height;
    int interleave; // edge of the squares of pixels each of which is of another subset, with lights of its own
    int edge;       // of a tile, in pixels of one subset
    int columns;    // of tiles in a subset
    int rows;
    int light_count;
    int most; // lights that a tile's list has room for
};

// Two float4 a pixel: position and depth along the camera's axis, 0 where nothing is; normal
StructuredBuffer<float4> surfaces : register(t1);

// Four float4 a light: position and flux; normal and alpha; wi and xi; colour, and 1 for a glossy one, 0 for a diffuse one
StructuredBuffer<float4> lights : register(t2);

struct vpl {
    float3 position, normal, wi, colour;
    float flux, alpha, xi;
    bool glossy;
};

vpl vpl_at(int k) {
    vpl l;
    l.position = lights[4 * k].xyz;
    l.flux = lights[4 * k].w;
    l.normal = lights[4 * k + 1].xyz;
    l.alpha = lights[4 * k + 1].w;
    l.wi = lights[4 * k + 2].xyz;
    l.xi = lights[4 * k + 2].w;
    l.colour = lights[4 * k + 3].xyz;
    l.glossy = lights[4 * k + 3].w > 0.0;
    return l;
}
