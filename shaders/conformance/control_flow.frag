#version 450
#extension GL_GOOGLE_include_directive : require
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 out_color;
layout(push_constant) uniform Push { uint op; };
#include "control_flow_body.glsl"
void main() {
  uint x = uint(gl_FragCoord.x) + uint(gl_FragCoord.y) * 64u;
  uint r = flow_dispatch(op == 99u ? (x >> 2) % 13u : op, x);
  if (x % 17u == 3u) discard;
  out_color = vec4(float(r & 65535u), float(r >> 16), in_color.xy);
}
