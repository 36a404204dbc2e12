#version 450
// Samples a texture at each coordinate, at level of detail 0.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(std430, set = 0, binding = 1) readonly buffer In { vec2 coordinates[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Out { vec4 texels[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= coordinates.length()) return;
  texels[i] = textureLod(image, coordinates[i], 0.0);
}
