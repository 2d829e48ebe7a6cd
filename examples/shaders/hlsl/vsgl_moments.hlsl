// Moments as four float4, all linear, so that they are the 16 channels of a pyramid.

vsgl_moments vsgl_moments_unpack(float4 a, float4 b, float4 c, float4 d) {
    vsgl_moments m;
    m.power[0] = a.xyz;
    m.power[1] = b.xyz;
    m.direction[0] = c.xyz;
    m.direction[1] = d.xyz;
    m.position = float3(a.w, b.w, c.w);
    m.position_squared = d.w;
    return m;
}
