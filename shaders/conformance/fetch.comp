#version 450
// Fetches every texel of a texture and asks for its size.
layout(local_size_x = 8, local_size_y = 4) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(std430, set = 0, binding = 1) writeonly buffer Out { ivec2 size; ivec2 padding; vec4 texels[]; };
void main() {
  ivec2 extent = textureSize(image, 0);
  ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p == ivec2(0)) size = extent;
  if (p.x < extent.x && p.y < extent.y) texels[p.y * extent.x + p.x] = texelFetch(image, p, 0);
}
