// lobe_parameters.glsl - of lobe_prepare.comp and of lobe_filter.glsl

cbuffer parameters : register(b2) {
    int width;
    int height;
    int method;      // WEIGHT_NORMALS, ...
    float parameter; // the variance of normals, or beta
    float depth_variance;
    int radius;
    float kernel_variance; // in squared pixels
};
