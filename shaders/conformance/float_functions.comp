#version 450
// The transcendental functions of GLSL.std.450 in float32.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer A { float a_values[]; };
layout(std430, set = 0, binding = 1) readonly buffer B { float b_values[]; };
layout(std430, set = 0, binding = 2) readonly buffer C { float c_values[]; };
layout(std430, set = 0, binding = 3) writeonly buffer R { float results[]; };
layout(push_constant) uniform Push { int op; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= a_values.length()) return;
  float a = a_values[i], b = b_values[i], r = 0.0;
  switch (op) {
    case 0: r = sin(a); break;
    case 1: r = cos(a); break;
    case 2: r = tan(a); break;
    case 3: r = asin(a); break;
    case 4: r = acos(a); break;
    case 5: r = atan(a); break;
    case 6: r = sinh(a); break;
    case 7: r = cosh(a); break;
    case 8: r = tanh(a); break;
    case 9: r = asinh(a); break;
    case 10: r = acosh(a); break;
    case 11: r = atanh(a); break;
    case 12: r = atan(a, b); break;
    case 13: r = pow(a, b); break;
    case 14: r = exp(a); break;
    case 15: r = log(a); break;
    case 16: r = exp2(a); break;
    case 17: r = log2(a); break;
  }
  results[i] = r;
}
