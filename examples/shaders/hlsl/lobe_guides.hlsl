// lobe_guides.glsl - what filters know of a pixel, in buffers

// By which of a pixel's guides neighbours are weighed: Eq. 4, 12, 11 and 13 of the paper
static const int WEIGHT_NORMALS = 0;
static const int WEIGHT_SG = 1;
static const int WEIGHT_SG_MIXTURE = 2;
static const int WEIGHT_ASG = 3;

// vec4s a pixel. Guides: normal and depth, 0 where there is nothing; the lobe's axis and sharpness; the same of three
// lobes; their logarithms of amplitudes and their count; the ASG's x and its sharpness there; z and that along y.
static const int GUIDE_SIZE = 8;

// Prepared: up to four vectors with a number each, and three numbers and the depth
static const int PREPARED_SIZE = 5;

sg_lobe guide_lobe(float4 packed, float log_amplitude) {
    sg_lobe g;
    g.axis = packed.xyz;
    g.sharpness = packed.w;
    g.log_amplitude = log_amplitude;
    return g;
}

asg_lobe guide_asg(float4 x, float4 z) {
    asg_lobe a;
    a.x = x.xyz;
    a.y = cross(z.xyz, x.xyz);
    a.z = z.xyz;
    a.sharpness_x = x.w;
    a.sharpness_y = z.w;
    a.log_amplitude = 0.0;
    return a;
}
