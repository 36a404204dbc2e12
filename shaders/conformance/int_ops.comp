#version 450
// One 32-bit integer operation, conversion or packing for every invocation.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer A { uint a_values[]; };
layout(std430, set = 0, binding = 1) readonly buffer B { uint b_values[]; };
layout(std430, set = 0, binding = 2) readonly buffer C { uint c_values[]; };
layout(std430, set = 0, binding = 3) writeonly buffer R { uint results[]; };
layout(push_constant) uniform Push { int op; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= a_values.length()) return;
  uint a = a_values[i], b = b_values[i], c = c_values[i], r = 0u;
  int sa = int(a), sb = int(b), sc = int(c);
  switch (op) {
    case 0: r = a + b; break;
    case 1: r = a - b; break;
    case 2: r = a * b; break;
    case 3: r = a / b; break;
    case 4: r = a % b; break;
    case 5: r = uint(sa / sb); break;
    case 6: r = uint(sa % sb); break;
    case 7: r = uint(-sa); break;
    case 8: r = uint(abs(sa)); break;
    case 9: r = uint(sign(sa)); break;
    case 10: r = uint(min(sa, sb)); break;
    case 11: r = uint(max(sa, sb)); break;
    case 12: r = min(a, b); break;
    case 13: r = max(a, b); break;
    case 14: r = uint(clamp(sa, min(sb, sc), max(sb, sc))); break;
    case 15: r = clamp(a, min(b, c), max(b, c)); break;
    case 16: r = a & b; break;
    case 17: r = a | b; break;
    case 18: r = a ^ b; break;
    case 19: r = ~a; break;
    case 20: r = a << (b & 31u); break;
    case 21: r = a >> (b & 31u); break;
    case 22: r = uint(sa >> int(b & 31u)); break;
    case 23: r = uint(bitCount(a)); break;
    case 24: r = bitfieldReverse(a); break;
    case 25: r = uint(findLSB(a)); break;
    case 26: r = uint(findMSB(a)); break;
    case 27: r = uint(findMSB(sa)); break;
    case 28: r = bitfieldExtract(a, int(b & 31u), int(c % (33u - (b & 31u)))); break;
    case 29: r = uint(bitfieldExtract(sa, int(b & 31u), int(c % (33u - (b & 31u))))); break;
    case 30: r = bitfieldInsert(a, ~a, int(b & 31u), int(c % (33u - (b & 31u)))); break;
    case 31: { uint carry; r = uaddCarry(a, b, carry); r = carry; break; }
    case 32: { uint carry; r = uaddCarry(a, b, carry); break; }
    case 33: { uint borrow; r = usubBorrow(a, b, borrow); r = borrow; break; }
    case 34: { uint high, low; umulExtended(a, b, high, low); r = high; break; }
    case 35: { int high, low; imulExtended(sa, sb, high, low); r = uint(high); break; }
    case 36: { int high, low; imulExtended(sa, sb, high, low); r = uint(low); break; }
    case 37: r = uint(a < b) | uint(a <= b) << 1 | uint(a > b) << 2 | uint(a >= b) << 3 | uint(a == b) << 4 | uint(a != b) << 5; break;
    case 38: r = uint(sa < sb) | uint(sa <= sb) << 1 | uint(sa > sb) << 2 | uint(sa >= sb) << 3; break;
    case 39: r = floatBitsToUint(float(sa)); break;
    case 40: r = floatBitsToUint(float(a)); break;
    case 41: r = uint(int(uintBitsToFloat(a))); break;
    case 42: r = uint(uintBitsToFloat(a)); break;
    case 43: r = uint(bool(a)) + uint(!bool(b)); break;
    case 44: r = packHalf2x16(vec2(uintBitsToFloat(a), uintBitsToFloat(b))); break;
    case 45: r = floatBitsToUint(unpackHalf2x16(a).x); break;
    case 46: r = floatBitsToUint(unpackHalf2x16(a).y); break;
    case 47: r = packUnorm4x8(vec4(uintBitsToFloat(a), uintBitsToFloat(b), uintBitsToFloat(c), 0.5)); break;
    case 48: r = packSnorm4x8(vec4(uintBitsToFloat(a), uintBitsToFloat(b), uintBitsToFloat(c), -1.0)); break;
    case 49: r = packUnorm2x16(vec2(uintBitsToFloat(a), uintBitsToFloat(b))); break;
    case 50: r = packSnorm2x16(vec2(uintBitsToFloat(a), uintBitsToFloat(b))); break;
    case 51: r = floatBitsToUint(unpackUnorm4x8(a)[b & 3u]); break;
    case 52: r = floatBitsToUint(unpackSnorm4x8(a)[b & 3u]); break;
    case 53: r = floatBitsToUint(unpackUnorm2x16(a)[b & 1u]); break;
    case 54: r = floatBitsToUint(unpackSnorm2x16(a)[b & 1u]); break;
    case 55: r = uint(any(lessThan(uvec3(a, b, c), uvec3(b, c, a)))) | uint(all(notEqual(ivec2(sa, sb), ivec2(sb, sc)))) << 1; break;
  }
  results[i] = r;
}
