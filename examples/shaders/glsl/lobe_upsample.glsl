// lobe_upsample.glsl - joint bilateral upsampling, in space, of glossy light for which one pixel of a
// cell has been shaded

// Light of the shaded pixels, and guides of all pixels
layout(std430, binding = 0) readonly buffer colours_buffer { vec4 colours[]; };
layout(std430, binding = 1) readonly buffer guides_buffer { vec4 guides[]; };

layout(std140, binding = 2) uniform parameters {
    int width;
    int height;
    int coarse_width;
    int coarse_height;
    int cell;   // edge in pixels
    int column; // of the shaded pixel in its cell
    int row;
    int method;      // WEIGHT_NORMALS, WEIGHT_SG or WEIGHT_ASG
    float parameter; // the variance of normals, or beta
    float depth_variance;
};

// How like the shaded pixels' surfaces are: i and j are where their guides begin
float upsample_likeness(int i, int j) {
    if (guides[j].w <= 0.0) return 0.0;
    float likeness = bilateral_depth_weight(guides[i].w, guides[j].w, depth_variance);
    if (method == WEIGHT_NORMALS) return likeness * bilateral_normal_weight(guides[i].xyz, guides[j].xyz, parameter);
    if (method == WEIGHT_SG)
        return likeness * bilateral_sg_weight(guide_lobe(guides[i + 1], 0.0), guide_lobe(guides[j + 1], 0.0),
                                              parameter);
    return likeness * bilateral_asg_weight(guide_asg(guides[i + 6], guides[i + 7]),
                                           guide_asg(guides[j + 6], guides[j + 7]), parameter);
}

// Light of a pixel by the four shaded ones around, and their total weight; 0 where nothing glossy is seen
vec4 lobe_upsample(int x, int y) {
    int here = (y * width + x) * GUIDE_SIZE, left, top;
    vec4 footprint, similarity, weight;
    vec3 sum = vec3(0.0, 0.0, 0.0);
    float total;
    if (guides[here].w <= 0.0) return vec4(0.0, 0.0, 0.0, 0.0);
    bilateral_footprint(clamp(float(x - column) / float(cell), 0.0, float(coarse_width - 1)),
                        clamp(float(y - row) / float(cell), 0.0, float(coarse_height - 1)), coarse_width,
                        coarse_height, left, top, footprint);
    for (int k = 0; k < 4; k++) {
        int u = (left + (k & 1)) * cell + column, v = (top + (k >> 1)) * cell + row;
        similarity[k] = footprint[k] > 0.0 ? upsample_likeness(here, (v * width + u) * GUIDE_SIZE) : 0.0;
    }
    total = bilateral_footprint_weights(footprint, similarity, weight);
    for (int k = 0; k < 4; k++) {
        if (weight[k] > 0.0) sum += colours[(top + (k >> 1)) * coarse_width + left + (k & 1)].xyz * weight[k];
    }
    return vec4(sum, total);
}
