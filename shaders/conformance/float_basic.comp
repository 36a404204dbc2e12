#version 450
// One float32 operation for every invocation; which one is a push constant.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer A { float a_values[]; };
layout(std430, set = 0, binding = 1) readonly buffer B { float b_values[]; };
layout(std430, set = 0, binding = 2) readonly buffer C { float c_values[]; };
layout(std430, set = 0, binding = 3) writeonly buffer R { float results[]; };
layout(push_constant) uniform Push { int op; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= a_values.length()) return;
  float a = a_values[i], b = b_values[i], c = c_values[i], r = 0.0;
  precise float p;
  switch (op) {
    case 0: p = a + b; r = p; break;
    case 1: p = a - b; r = p; break;
    case 2: p = a * b; r = p; break;
    case 3: p = a / b; r = p; break;
    case 4: r = fma(a, b, c); break;
    case 5: r = -a; break;
    case 6: r = abs(a); break;
    case 7: r = sign(a); break;
    case 8: r = min(a, b); break;
    case 9: r = max(a, b); break;
    case 10: r = clamp(a, min(b, c), max(b, c)); break;
    case 11: r = floor(a); break;
    case 12: r = ceil(a); break;
    case 13: r = trunc(a); break;
    case 14: r = roundEven(a); break;
    case 15: r = round(a); break;
    case 16: r = fract(a); break;
    case 17: r = mod(a, b); break;
    case 18: r = step(a, b); break;
    case 19: r = mix(a, b, c); break;
    case 20: r = smoothstep(a, b, c); break;
    case 21: r = sqrt(a); break;
    case 22: r = inversesqrt(a); break;
    case 23: { float whole; r = modf(a, whole); break; }
    case 24: { float whole; r = modf(a, whole); r = whole; break; }
    case 25: { int e; r = frexp(a, e); break; }
    case 26: { int e; r = frexp(a, e); r = float(e); break; }
    case 27: r = ldexp(a, int(b)); break;
    case 28: r = float(a == b); break;
    case 29: r = float(a != b); break;
    case 30: r = float(a < b); break;
    case 31: r = float(a <= b); break;
    case 32: r = float(a > b); break;
    case 33: r = float(a >= b); break;
    case 34: r = float(isnan(a)); break;
    case 35: r = float(isinf(a)); break;
    case 36: r = float(!(a < b)); break;
    case 37: r = radians(a); break;
    case 38: r = degrees(a); break;
    case 39: r = float(a < b && b < c || a > c); break;
    case 40: r = a < b ? c : a; break;
  }
  results[i] = r;
}
