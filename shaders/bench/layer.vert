// A full-screen layer at a depth of its own.
#version 450
layout(push_constant) uniform Push {
  vec4 tint;
  float depth;
} push;
layout(location = 0) out vec2 place;

void main() {
  vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0;
  gl_Position = vec4(corner, push.depth, 1.0);
  place = corner;
}
