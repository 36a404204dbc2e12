#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "array_indexing_body.glsl"
void main() {
  use_arrays(uint(gl_VertexIndex));
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
