#version 450
#extension GL_GOOGLE_include_directive : require
layout(location = 0) flat out vec4 out_color;
layout(push_constant) uniform Push { uint op; };
#include "control_flow_body.glsl"
void main() {
  // Triangle i covers exactly pixel (i % 64, i / 64) of a 64 x 64 image.
  int pixel = gl_VertexIndex / 3, corner = gl_VertexIndex % 3;
  vec2 p = vec2(pixel & 63, pixel >> 6) + vec2((corner & 1) * 2, corner & 2);
  gl_Position = vec4(p / 32.0 - 1.0, 0.0, 1.0);
  uint x = uint(pixel) * 3u;
  uint r = flow_dispatch(op == 99u ? (x >> 2) % 13u : op, x);
  out_color = vec4(float(r & 65535u), float(r >> 16), 0.0, 1.0);
}
