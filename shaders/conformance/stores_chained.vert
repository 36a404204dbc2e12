#version 450
// Reads what the draw before stored for another vertex and stores what follows from it. The first instance is the
// draw's number.
layout(location = 0) in vec4 in_position;
layout(location = 1) in vec4 in_color;
layout(std430, set = 0, binding = 0) buffer Counts { uint vertices, fragments, helpers, vertex[]; };
layout(location = 0) flat out vec4 out_color;
const uint kVertices = 6000;
void main() {
  uint draw = gl_InstanceIndex, i = gl_VertexIndex;
  uint before = draw == 0 ? i : vertex[(draw - 1) % 2 * kVertices + (kVertices - 1 - i)];
  vertex[draw % 2 * kVertices + i] = before * 3 + 1;
  gl_Position = in_position;
  out_color = in_color;
}
