#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "array_indexing_body.glsl"
layout(location = 0) in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  use_arrays(uint(gl_FragCoord.x));
  out_color = in_color;
}
