// Moments as four vec4, all linear, so that they are the 16 channels of a pyramid.

vsgl_moments vsgl_moments_unpack(vec4 a, vec4 b, vec4 c, vec4 d) {
    vsgl_moments m;
    m.power[0] = a.xyz;
    m.power[1] = b.xyz;
    m.direction[0] = c.xyz;
    m.direction[1] = d.xyz;
    m.position = vec3(a.w, b.w, c.w);
    m.position_squared = d.w;
    return m;
}
