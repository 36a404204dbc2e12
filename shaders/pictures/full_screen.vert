// One triangle that covers the screen, made of gl_VertexIndex alone. The centre is (0, 0), y is up, the height is 2.
#version 450
layout(push_constant) uniform Push {
  vec2 size;  // pixels
} push;
layout(location = 0) out vec2 place;

void main() {
  vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0;
  gl_Position = vec4(corner, 0.5, 1.0);
  place = vec2(corner.x * push.size.x / push.size.y, -corner.y);
}
