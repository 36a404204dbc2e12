#version 450
// About 5,000 SPIR-V instructions.
#extension GL_GOOGLE_include_directive : require
#include "layers_body.glsl"

#define FIVE(k) LAYER(k) LAYER(k * 1.1) LAYER(k * 1.3) LAYER(k * 1.7) LAYER(k * 1.9)

void main() {
  vec3 color = vec3(0.5);
  FIVE(0.25) FIVE(0.5) FIVE(0.75) FIVE(1.0) FIVE(1.25) FIVE(1.5)
  result = vec4(color, 1.0);
}
