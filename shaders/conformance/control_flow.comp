#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer A { uint inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer R { uint results[]; };
layout(push_constant) uniform Push { uint op; };
#include "control_flow_body.glsl"
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= inputs.length()) return;
  // 99: another function in every invocation.
  results[i] = flow_dispatch(op == 99u ? (inputs[i] >> 7) % 13u : op, inputs[i]);
}
