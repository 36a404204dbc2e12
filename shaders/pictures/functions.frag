// A chart of the extended instruction set: each cell of an 8 x 8 grid plots one function of GLSL.std.450 as brightness.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

vec3 evaluate(int cell, vec2 p) {
  float x = p.x * 3.0;  // [-3, 3]
  float y = p.y * 3.0;
  float unit = p.x;  // [-1, 1]
  vec3 v = vec3(x, y, 1.0);
  switch (cell) {
    case 0: return vec3(sin(x), cos(y), sin(x * y));
    case 1: return vec3(clamp(tan(unit), -2.0, 2.0), clamp(tan(y), -2.0, 2.0), 0.0);
    case 2: return vec3(asin(unit), acos(p.y), 0.0);
    case 3: return vec3(atan(x), atan(y, x) * 0.3, atan(y * 9.0));
    case 4: return vec3(sinh(unit), cosh(p.y), tanh(x));
    case 5: return vec3(asinh(x), acosh(1.0 + abs(y)), atanh(unit * 0.99));
    case 6: return vec3(exp(x) * 0.05, exp2(y) * 0.12, exp(-x * x));
    case 7: return vec3(log(abs(x) + 0.01), log2(abs(y) + 0.01), 0.0) * 0.3;
    case 8: return vec3(pow(abs(x), 1.7), pow(abs(y), -0.4), pow(2.0, unit)) * 0.4;
    case 9: return vec3(sqrt(abs(x)), inversesqrt(abs(y) + 0.1), 0.0) * 0.5;
    case 10: return vec3(abs(x), sign(y), sign(x * y)) * 0.4;
    case 11: return vec3(floor(x), ceil(y), trunc(x + y)) * 0.2;
    case 12: return vec3(fract(x), fract(y), fract(x + y));
    case 13: return vec3(round(x), roundEven(y), floor(x + 0.5)) * 0.2;
    case 14: return vec3(mod(x, 0.7), mod(y, -0.9), mod(x, 1.3 + p.y));
    case 15: return vec3(min(x, y), max(x, y), clamp(x, -1.0, y * 0.1 + 1.0)) * 0.4;
    case 16: return vec3(mix(x, y, 0.3), mix(unit, -unit, p.y), mix(1.0, 0.0, x > y)) * 0.5;
    case 17: return vec3(step(x, 0.3), step(-1.0, y), smoothstep(-2.0, 2.0, x));
    case 18: return normalize(v);
    case 19: return vec3(length(v), distance(v, vec3(1.0, -1.0, 0.0)), dot(v, v)) * 0.2;
    case 20: return cross(v, vec3(0.3, -0.5, 0.7)) * 0.3;
    case 21: return reflect(v, normalize(vec3(0.2, 0.9, -0.4))) * 0.3;
    case 22: return refract(normalize(v), normalize(vec3(0.1, 0.2, -1.0)), 0.8);
    case 23: return faceforward(v, vec3(0.0, 0.0, 1.0), vec3(x, y, 0.5)) * 0.3;
    case 24: {
      float whole;
      float part = modf(x * 2.0, whole);
      return vec3(part, whole * 0.2, modf(y, whole));
    }
    case 25: {
      int exponent;
      float mantissa = frexp(x * 5.0, exponent);
      return vec3(mantissa, float(exponent) * 0.2, ldexp(y, exponent - 4));
    }
    case 26: return vec3(fma(x, y, 0.25), fma(x, x, y), fma(-x, y, x)) * 0.2;
    case 27: return vec3(radians(x * 60.0), degrees(y) * 0.01, 0.0) * 0.4;
    case 28: return unpackUnorm4x8(packUnorm4x8(vec4(x, y, unit, 1.0))).xyz;
    case 29: return unpackSnorm4x8(packSnorm4x8(vec4(x, y, unit, p.y))).xyz;
    case 30: return vec3(unpackUnorm2x16(packUnorm2x16(p)), unpackSnorm2x16(packSnorm2x16(p)).x);
    case 31: return vec3(unpackHalf2x16(packHalf2x16(v.xy * 0.3)), 0.0);
    case 32: return vec3(determinant(mat2(x, 1.0, y, 0.5)), determinant(mat3(v, v.zxy, vec3(1.0, 0.0, 0.4))), 0.0) * 0.3;
    case 33: return inverse(mat3(2.0, 0.3, unit, 0.1, 3.0, 0.2, p.y, 0.4, 2.5)) * vec3(1.0, 2.0, -1.0);
    case 34: return (inverse(mat4(2.0, 0.1, 0.2, unit, 0.3, 2.2, 0.1, 0.2, 0.5, 0.6, 1.9, 0.1, p.y, 0.0, 0.0, 1.0)) * vec4(v, 1.0)).xyz * 0.4;
    case 35: return transpose(mat3(v, v.yzx, v.zxy)) * vec3(0.2, -0.1, 0.3);
    case 36: return outerProduct(v, vec3(0.3, 0.2, -0.1)) * vec3(1.0, 0.5, 2.0) * 0.3;
    case 37: return vec3(float(findLSB(int(x * 40.0))), float(findMSB(int(y * 40.0))), float(findMSB(uint(abs(x) * 40.0)))) * 0.1;
    case 38: return vec3(float(min(int(x), int(y))), float(max(int(x), int(y))), float(clamp(int(x * 3.0), -2, 5))) * 0.3;
    case 39: return vec3(float(abs(int(x * 3.0))), float(sign(int(y))), float(min(uint(abs(x)), uint(abs(y))))) * 0.2;
    case 40: return uintBitsToFloat(floatBitsToUint(v) & 0xFFF00000u) * 0.3;
    case 41: return vec3(isnan(sqrt(x)) ? 0.2 : 0.8, isinf(1.0 / floor(y)) ? 1.0 : 0.1, 0.5);
    case 42: return vec3(lessThan(v, vec3(0.5, -0.5, 2.0)));
    case 43: return vec3(any(greaterThan(v, vec3(2.0))), all(lessThan(v, vec3(1.5))), not(bvec2(x > 0.0, y > 0.0)).x);
    case 44: return matrixCompMult(mat3(v, v, v), mat3(0.1, 0.2, 0.3, 0.3, 0.2, 0.1, 0.5, 0.5, 0.5))[1];
    case 45: return vec3(dFdx(x * x), dFdy(y * y), fwidth(x * y)) * 10.0;
    case 46: return vec3(float(bitCount(int(x * 99.0))), float(bitfieldReverse(uint(abs(y) * 9.0)) >> 28), float(bitfieldExtract(int(x * 99.0), 2, 4))) * 0.06;
    default: return vec3(0.12);
  }
}

void main() {
  vec2 grid = vec2(place.x / 1.3333334, place.y) * 0.5 + 0.5;  // [0, 1] on a 4:3 screen
  vec2 scaled = grid * 7.0;
  ivec2 at = clamp(ivec2(scaled), ivec2(0), ivec2(6));
  vec2 inside = (scaled - vec2(at)) * 2.0 - 1.0;
  vec3 value = evaluate(at.y * 7 + at.x, inside);
  float frame = step(max(abs(inside.x), abs(inside.y)), 0.94);
  color = vec4(frame * (value * 0.5 + 0.5), 1.0);
}
