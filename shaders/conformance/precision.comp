// The functions of docs/precision.md, one for each value of kFunction (conformance/precision/functions.cpp has them under
// the same numbers). Functions below 50 have one operand: the float or integer whose bits are first + stride * invocation.
#version 450
layout(local_size_x = 64) in;
layout(constant_id = 0) const int kFunction = 0;
layout(constant_id = 1) const uint kOperands = 1;
layout(constant_id = 2) const uint kResults = 1;
layout(std430, binding = 0) readonly buffer In { float operands[]; };
layout(std430, binding = 1) writeonly buffer Out { float results[]; };
layout(push_constant) uniform Push {
  uint count;
  uint first;
  uint stride;
} push;

uint invocation;

float a(uint i) { return operands[kOperands * invocation + i]; }
vec2 a2(uint i) { return vec2(a(i), a(i + 1)); }
vec3 a3(uint i) { return vec3(a(i), a(i + 1), a(i + 2)); }
vec4 a4(uint i) { return vec4(a(i), a(i + 1), a(i + 2), a(i + 3)); }
mat2 m2() { return mat2(a2(0), a2(2)); }
mat3 m3() { return mat3(a3(0), a3(3), a3(6)); }
mat4 m4() { return mat4(a4(0), a4(4), a4(8), a4(12)); }

void put(uint i, float value) { results[kResults * invocation + i] = value; }
void put3(vec3 v) { put(0, v.x); put(1, v.y); put(2, v.z); }

float of_one(uint bits) {
  float x = uintBitsToFloat(bits);
  int exponent;
  float whole;
  switch (kFunction) {
    case 0: return sin(x);
    case 1: return cos(x);
    case 2: return tan(x);
    case 3: return asin(x);
    case 4: return acos(x);
    case 5: return atan(x);
    case 6: return sinh(x);
    case 7: return cosh(x);
    case 8: return tanh(x);
    case 9: return asinh(x);
    case 10: return acosh(x);
    case 11: return atanh(x);
    case 12: return exp(x);
    case 13: return exp2(x);
    case 14: return log(x);
    case 15: return log2(x);
    case 16: return sqrt(x);
    case 17: return inversesqrt(x);
    case 18: return floor(x);
    case 19: return ceil(x);
    case 20: return trunc(x);
    case 21: return roundEven(x);
    case 22: return fract(x);
    case 23: return radians(x);
    case 24: return degrees(x);
    case 25: return modf(x, whole);
    case 26: return frexp(x, exponent);
    case 27: return 1.0 / x;
    case 28: return float(int(x));
    case 29: return float(int(bits));
    case 30: return float(bits);
    case 31: return unpackHalf2x16(bits).x;
    case 32: return unpackHalf2x16(packHalf2x16(vec2(0.0, x))).y;
    case 33: return unpackSnorm4x8(bits).w;
    case 34: return unpackUnorm2x16(bits).x;
  }
  return 0.0;
}

void of_several() {
  switch (kFunction) {
    case 50: put(0, a(0) + a(1)); break;
    case 51: put(0, a(0) - a(1)); break;
    case 52: put(0, a(0) * a(1)); break;
    case 53: put(0, a(0) / a(1)); break;
    case 54: put(0, fma(a(0), a(1), a(2))); break;
    case 55: put(0, pow(a(0), a(1))); break;
    case 56: put(0, atan(a(0), a(1))); break;
    case 57: put(0, mod(a(0), a(1))); break;
    case 58: put(0, ldexp(a(0), a(1) > -400.0 ? int(min(a(1), 400.0)) : -400)); break;
    case 59: put(0, mix(a(0), a(1), a(2))); break;
    case 60: put(0, smoothstep(a(0), a(1), a(2))); break;
    case 61: put(0, length(a2(0))); break;
    case 62: put(0, length(a3(0))); break;
    case 63: put(0, length(a4(0))); break;
    case 64: put(0, distance(a3(0), a3(3))); break;
    case 65: put(0, dot(a3(0), a3(3))); break;
    case 66: put3(cross(a3(0), a3(3))); break;
    case 67: put3(normalize(a3(0))); break;
    case 68: put3(reflect(a3(0), a3(3))); break;
    case 69: put3(refract(a3(0), a3(3), a(6))); break;
    case 70: put3(faceforward(a3(0), a3(3), a3(6))); break;
    case 71: put(0, determinant(m2())); break;
    case 72: put(0, determinant(m3())); break;
    case 73: put(0, determinant(m4())); break;
    case 74: { mat2 m = inverse(m2()); for (uint i = 0; i < 4; ++i) put(i, m[i / 2][i % 2]); break; }
    case 75: { mat3 m = inverse(m3()); for (uint i = 0; i < 9; ++i) put(i, m[i / 3][i % 3]); break; }
    case 76: { mat4 m = inverse(m4()); for (uint i = 0; i < 16; ++i) put(i, m[i / 4][i % 4]); break; }
  }
}

void main() {
  invocation = gl_GlobalInvocationID.x;
  if (invocation >= push.count) return;
  if (kFunction < 50) {
    put(0, of_one(push.first + push.stride * invocation));
  } else {
    of_several();
  }
}
