#version 450
#extension GL_EXT_shader_image_load_formatted : require
// Reads each texel of one image and writes it to another, and asks for sizes; texels outside of both too.
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kKind = 0;
layout(set = 0, binding = 0) uniform image2D from;
layout(set = 0, binding = 1) writeonly uniform image2D to;
layout(set = 0, binding = 2) uniform uimage2D from_unsigned;
layout(set = 0, binding = 3) writeonly uniform uimage2D to_unsigned;
layout(std430, set = 0, binding = 4) buffer Out { ivec4 sizes; uvec4 texels[]; };
void main() {
  ivec2 p = ivec2(gl_GlobalInvocationID.xy) - 4;
  uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 8u + gl_GlobalInvocationID.x;
  if (i == 0) sizes = ivec4(imageSize(from), imageSize(to));
  if (kKind == 0) {
    vec4 texel = imageLoad(from, p);
    texels[i] = floatBitsToUint(texel);
    imageStore(to, p, texel.wzyx);
  } else {
    uvec4 texel = imageLoad(from_unsigned, p);
    texels[i] = texel;
    imageStore(to_unsigned, p, texel.wzyx);
  }
}
