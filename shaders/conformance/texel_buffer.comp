#version 450
#extension GL_EXT_shader_image_load_formatted : require
// Reads each texel of a texel buffer and writes it to another, and asks for sizes; indices outside of both too.
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kKind = 0;  // 0: floats, 1: integers; + 2: the source is a storage texel buffer
layout(set = 0, binding = 0) uniform samplerBuffer from;
layout(set = 0, binding = 1) uniform usamplerBuffer from_unsigned;
layout(set = 0, binding = 2) uniform imageBuffer from_storage;
layout(set = 0, binding = 3) uniform uimageBuffer from_storage_unsigned;
layout(set = 0, binding = 4) writeonly uniform imageBuffer to;
layout(set = 0, binding = 5) writeonly uniform uimageBuffer to_unsigned;
layout(std430, set = 0, binding = 6) buffer Out { ivec4 sizes; uvec4 texels[]; };
void main() {
  int p = int(gl_GlobalInvocationID.x) - 5;
  if (p == -5) sizes = ivec4(textureSize(from), imageSize(from_storage), imageSize(to), 0);
  if ((kKind & 1) == 0) {
    vec4 texel = kKind == 0 ? texelFetch(from, p) : imageLoad(from_storage, p);
    texels[gl_GlobalInvocationID.x] = floatBitsToUint(texel);
    imageStore(to, p, texel.wzyx);
  } else {
    uvec4 texel = kKind == 1 ? texelFetch(from_unsigned, p) : imageLoad(from_storage_unsigned, p);
    texels[gl_GlobalInvocationID.x] = texel;
    imageStore(to_unsigned, p, texel.wzyx);
  }
}
