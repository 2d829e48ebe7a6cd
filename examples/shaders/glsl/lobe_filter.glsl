// lobe_filter.glsl - a cross bilateral filter of noisy glossy light: Eq. 1 of the paper, with Gaussians of the
// distance in the image and in depth

// Light, and 1 where something glossy is seen
layout(std430, binding = 0) readonly buffer noisy_buffer { vec4 noisy[]; };
layout(std430, binding = 1) readonly buffer prepared_buffer { vec4 prepared[]; };

bilateral_sg_part filter_part(vec4 packed, float amplitude, float tail) {
    bilateral_sg_part p;
    p.axis = packed.xyz;
    p.sharpness = packed.w;
    p.amplitude = amplitude;
    p.tail = tail;
    return p;
}

bilateral_asg filter_asg(vec4 x, vec4 y, vec4 z, float own_scale) {
    bilateral_asg p;
    p.x = x.xyz;
    p.y = y.xyz;
    p.z = z.xyz;
    p.sharpness_x = x.w;
    p.sharpness_y = y.w;
    p.own_exponent = z.w;
    p.own_scale = own_scale;
    return p;
}

bilateral_sg filter_sg(vec4 packed) {
    bilateral_sg p;
    p.axis = packed.xyz;
    p.width = packed.w;
    return p;
}

float filter_sg_mixture_product(vec4 i[5], int j) {
    float product = 0.0;
    vec4 amplitudes = prepared[j + 3], tails = prepared[j + 4];
    for (int m = 0; m < 3; m++) {
        if (amplitudes[m] <= 0.0) break;
        bilateral_sg_part other = filter_part(prepared[j + m], amplitudes[m], tails[m]);
        for (int l = 0; l < 3; l++) {
            if (i[3][l] <= 0.0) break;
            product += bilateral_sg_pair(filter_part(i[l], i[3][l], i[4][l]), other);
        }
    }
    return product;
}

// Weight of a pixel whose numbers begin at j, for one with the numbers i; the exponent is that of the distance
float filter_weight(vec4 i[5], int j, float kernel) {
    float exponent = kernel + bilateral_depth_exponent(i[4].w, prepared[j + 4].w);
    if (method == WEIGHT_NORMALS) return bilateral_normal_tap(exponent, i[0].xyz, prepared[j].xyz);
    if (method == WEIGHT_SG) return bilateral_sg_tap(exponent, filter_sg(i[0]), filter_sg(prepared[j]), parameter);
    if (method == WEIGHT_SG_MIXTURE)
        return bilateral_sg_mixture_tap(exponent, filter_sg_mixture_product(i, j), parameter);
    return bilateral_asg_tap(exponent, filter_asg(i[0], i[1], i[2], i[3].x),
                             filter_asg(prepared[j], prepared[j + 1], prepared[j + 2], prepared[j + 3].x), parameter);
}

// Filtered light of a pixel; what is not glossy stays as it is
vec3 lobe_filter(int x, int y) {
    int here = y * width + x;
    vec4 i[5];
    vec3 sum = vec3(0.0, 0.0, 0.0);
    float total = 0.0, falloff = -0.721347520 / kernel_variance;
    if (noisy[here].w <= 0.0) return noisy[here].xyz;
    for (int k = 0; k < 5; k++) i[k] = prepared[here * PREPARED_SIZE + k];
    for (int v = max(y - radius, 0); v <= min(y + radius, height - 1); v++) {
        for (int u = max(x - radius, 0); u <= min(x + radius, width - 1); u++) {
            int there = v * width + u;
            vec4 colour = noisy[there];
            if (colour.w <= 0.0) continue;
            float kernel = falloff * float((u - x) * (u - x) + (v - y) * (v - y));
            float weight = filter_weight(i, there * PREPARED_SIZE, kernel);
            sum += colour.xyz * weight;
            total += weight;
        }
    }
    return sum * (1.0 / total);
}
