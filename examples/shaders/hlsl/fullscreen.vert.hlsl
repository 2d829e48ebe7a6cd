
// One triangle that covers the picture
void main(uint vertex : SV_VertexID, out float4 position : SV_Position) {
    int corner = int(vertex);
    position = float4(float(4 * (corner & 1) - 1), float(4 * (corner >> 1) - 1), 0.0, 1.0);
}
