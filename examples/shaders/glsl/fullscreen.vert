#version 450

// One triangle that covers the picture
void main() {
    int corner = int(gl_VertexIndex);
    gl_Position = vec4(float(4 * (corner & 1) - 1), float(4 * (corner >> 1) - 1), 0.0, 1.0);
}
