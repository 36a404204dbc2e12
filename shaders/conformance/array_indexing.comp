#version 450
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "array_indexing_body.glsl"
void main() { use_arrays(gl_GlobalInvocationID.x); }
