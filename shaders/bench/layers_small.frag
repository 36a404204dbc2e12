#version 450
// About 200 SPIR-V instructions.
#extension GL_GOOGLE_include_directive : require
#include "layers_body.glsl"

void main() {
  vec3 color = vec3(0.5);
  LAYER(0.25)
  result = vec4(color, 1.0);
}
