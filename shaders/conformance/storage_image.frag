#version 450
// Writes its pixel's position to an image; pixels that discard before write nothing.
layout(set = 0, binding = 0, rgba32ui) writeonly uniform uimage2D image;
layout(location = 0) in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  if (((p.x + p.y) & 3) == 0) discard;
  imageStore(image, p, uvec4(p, floatBitsToUint(in_color.x), 7u));
  out_color = in_color;
}
