#version 450
// Every atomic operation on texels of two images and a texel buffer, with all invocations on few texels; those of every
// fifth invocation lie outside.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, r32ui) uniform uimage2D unsigned_image;  // 6 x 2: one texel for each operation
layout(set = 0, binding = 1, r32i) uniform iimage2D signed_image;
layout(set = 0, binding = 2, r32ui) uniform uimageBuffer unsigned_buffer;
layout(std430, set = 0, binding = 3) readonly buffer In { uint values[]; };
layout(std430, set = 0, binding = 4) buffer Out { uint old[]; };
void main() {
  uint n = gl_GlobalInvocationID.x, value = values[n];
  int far = n % 5u == 0u ? (n % 2u == 0u ? 100000 : -9) : 0;
  imageAtomicAdd(unsigned_image, ivec2(0 + far, 0), value);
  imageAtomicMin(unsigned_image, ivec2(1 + far, 0), value);
  imageAtomicMax(unsigned_image, ivec2(2, 0 + far), value);
  imageAtomicAnd(unsigned_image, ivec2(3 + far, 0), value | 0xFFu);
  imageAtomicOr(unsigned_image, ivec2(4, 0 + far), value & 0xFFFF00u);
  imageAtomicXor(unsigned_image, ivec2(5 + 7 * far, 1), value);
  imageAtomicMin(signed_image, ivec2(0 + far, 1), int(value));
  imageAtomicMax(signed_image, ivec2(1 + 2 * far, 1), int(value));
  old[2 * n] = imageAtomicAdd(unsigned_image, ivec2(4 + 7 * far, 1), 1u);
  old[2 * n + 1] = imageAtomicAdd(unsigned_buffer, 7 + 13 * far, 1u);
  imageAtomicExchange(unsigned_buffer, int(n % 7u), n);
  for (uint seen = 0u;;) {
    uint before = imageAtomicCompSwap(unsigned_buffer, 8, seen, seen + 3u);
    if (before == seen) break;
    seen = before;
  }
}
