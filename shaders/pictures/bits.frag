// Integers only, so every driver has to give the same bits: division, remainders, shifts, bit fields, carries, and arrays with computed
// indices.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

const int kPrimes[8] = int[](2, 3, 5, 7, 11, 13, 17, 19);

int collatz(int n) {
  int steps = 0;
  while (n != 1 && steps < 127) {
    n = (n & 1) == 0 ? n >> 1 : 3 * n + 1;
    ++steps;
  }
  return steps;
}

uint greatest_common_divisor(uint a, uint b) {
  while (b != 0u) {
    uint rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 p = uvec2(pixel);
  ivec2 from_center = pixel - 100;
  int divisor = kPrimes[(pixel.x ^ pixel.y) & 7];

  int quotient = from_center.x * from_center.y / divisor;
  int rest = from_center.x - (from_center.x / divisor) * divisor;
  uint carry, borrow, high, low;
  uint sum = uaddCarry(p.x * 0x01234567u, p.y * 0x89ABCDEFu, carry);
  uint difference = usubBorrow(p.x, p.y, borrow);
  umulExtended(sum, difference | 1u, high, low);
  int high_signed, low_signed;
  imulExtended(quotient, int(sum), high_signed, low_signed);

  uint red = uint(collatz(pixel.x * 7 + pixel.y + 1)) * 2u;
  uint green = (p.x ^ p.y) + carry * 16u + borrow * 32u + (high ^ uint(high_signed)) % 32u;
  uint blue = greatest_common_divisor(p.x + 1u, p.y + 1u) * 24u + uint(abs(rest)) +
              uint(bitfieldExtract(from_center.x, 1, 5) & 15) + bitfieldInsert(low, p.y, 3, 9) / 0x10000000u +
              uint((low_signed >> 29) + 4) + (sum << (p.x & 3u)) / 0x20000000u;
  uint nibbles[4] = uint[](1u, 2u, 4u, 8u);
  nibbles[pixel.y & 3] += p.x & 7u;
  blue += nibbles[pixel.x & 3];
  color = vec4(uvec4(red & 255u, green & 255u, blue & 255u, 255u)) / 255.0;
}
