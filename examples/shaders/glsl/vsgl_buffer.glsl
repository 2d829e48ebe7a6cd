// A light in a buffer of vec4: five of them.

const int VSGL_BUFFER_SIZE = 5;

vsgl vsgl_unpack(vec4 a, vec4 b, vec4 c, vec4 d, vec4 e) {
    vsgl v;
    v.position = a.xyz;
    v.variance = a.w;
    v.emission[0].axis = b.xyz;
    v.emission[0].sharpness = b.w;
    v.emission[1].axis = c.xyz;
    v.emission[1].sharpness = c.w;
    v.intensity[0] = d.xyz;
    v.emission[0].log_amplitude = d.w;
    v.intensity[1] = e.xyz;
    v.emission[1].log_amplitude = e.w;
    return v;
}
