#version 450
// Vectors, matrices and composites: every case writes 16 floats.
layout(local_size_x = 16) in;
struct Inner { vec2 a; float b[3]; };
struct Outer { Inner list[2]; mat3 m; int n; };
layout(std430, set = 0, binding = 0) readonly buffer In { float x[16]; } inputs;
layout(std430, set = 0, binding = 1) writeonly buffer Out { float r[][16]; } outputs;
layout(push_constant) uniform Push { int count; };
float result[16];
void put(int at, float v) { result[at] = v; }
void put(int at, vec2 v) { result[at] = v.x; result[at + 1] = v.y; }
void put(int at, vec3 v) { put(at, v.xy); result[at + 2] = v.z; }
void put(int at, vec4 v) { put(at, v.xyz); result[at + 3] = v.w; }
void put(int at, mat2 m) { put(at, m[0]); put(at + 2, m[1]); }
void put(int at, mat3 m) { put(at, m[0]); put(at + 3, m[1]); put(at + 6, m[2]); }
void put(int at, mat4 m) { for (int i = 0; i < 4; ++i) put(at + 4 * i, m[i]); }
void swap(inout float a, inout float b) { float t = a; a = b; b = t; }
void fill(out vec3 v, in float from) { v = vec3(from, from + 1.0, from + 2.0); from = 99.0; }
Outer make(float s) {
  Outer o;
  for (int i = 0; i < 2; ++i) {
    o.list[i].a = vec2(s, float(i));
    for (int k = 0; k < 3; ++k) o.list[i].b[k] = s * float(i + 1) + float(k);
  }
  o.m = mat3(s);
  o.n = int(s * 4.0);
  return o;
}
void main() {
  int which = int(gl_GlobalInvocationID.x);
  if (which >= count) return;
  float x[16];
  for (int i = 0; i < 16; ++i) { x[i] = inputs.x[i]; result[i] = 0.0; }
  vec4 a = vec4(x[0], x[1], x[2], x[3]), b = vec4(x[4], x[5], x[6], x[7]);
  mat4 m = mat4(a, b, vec4(x[8], x[9], x[10], x[11]), vec4(x[12], x[13], x[14], x[15]));
  mat3 m3 = mat3(m);
  mat2 m2 = mat2(m);
  switch (which) {
    case 0: put(0, a + b); put(4, a - b); put(8, a * b); put(12, a * 2.5); break;
    case 1: put(0, dot(a, b)); put(1, length(a)); put(2, distance(a, b)); put(3, normalize(a)); put(7, cross(a.xyz, b.xyz)); put(10, -a); break;
    case 2: put(0, m * a); put(4, a * m); put(8, m3 * a.xyz); put(11, b.xyz * m3); put(14, m2 * a.xy); break;
    case 3: put(0, m * transpose(m)); break;
    case 4: put(0, inverse(m)); break;
    case 5: put(0, determinant(m)); put(1, determinant(m3)); put(2, determinant(m2)); put(3, inverse(m3)); put(12, inverse(m2)); break;
    case 6: put(0, outerProduct(a, b)); break;
    case 7: put(0, matrixCompMult(m, m + m)); break;
    case 8: { mat2x3 p = mat2x3(a.xyz, b.xyz); mat3x2 q = transpose(p); put(0, p * q); put(9, q * p); put(13, p * a.xy); break; }
    case 9: put(0, a.wzyx); put(4, a.xxzz); put(8, vec4(b.yx, a.wz)); { vec4 c = a; c.zx = b.xy; c.w += 3.0; put(12, c); } break;
    case 10: for (int i = 0; i < 4; ++i) { put(i, a[(i * 3 + int(x[15])) & 3]); vec4 c = b; c[i] = 7.0; put(4 + i, dot(c, vec4(1.0, 10.0, 100.0, 1000.0))); put(8 + i, m[i][3 - i]); mat4 d = m; d[3 - i] = a; put(12 + i, d[3][i] + d[0][1]); } break;
    case 11: { float p = x[0], q = x[1]; swap(p, q); put(0, p); put(1, q); swap(x[2], x[3]); put(2, x[2]); put(3, x[3]); vec3 v; float from = 5.0; fill(v, from); put(4, v); put(7, from); vec4 c = a; swap(c.x, c.w); put(8, c); break; }
    case 12: { Outer o = make(x[0]); Outer copy = o; copy.list[1].b[2] = -1.0; copy.m[1] = vec3(x[1]); put(0, o.list[1].b[2]); put(1, copy.list[1].b[2]); put(2, o.m[1]); put(5, copy.m[1]); put(8, float(o == copy)); put(9, float(o == make(x[0]))); put(10, o.list[0].a); put(12, float(o.n)); Inner n = copy.list[int(x[15]) & 1]; put(13, n.b[1]); put(14, n.a); break; }
    case 13: put(0, reflect(a.xyz, normalize(b.xyz))); put(3, refract(normalize(a.xyz), normalize(b.xyz), 0.7)); put(6, faceforward(a.xyz, b.xyz, vec3(0.3, -2.0, 1.0))); put(9, mix(a, b, 0.25)); put(13, length(a.xy)); put(14, length(-3.5)); put(15, distance(1.0, -2.0)); break;
    case 14: put(0, vec4(lessThan(a, b))); put(4, vec4(greaterThanEqual(a, b))); put(8, vec4(equal(ivec4(a), ivec4(a + 0.25)))); put(12, float(any(lessThan(a, b)))); put(13, float(all(lessThan(a, b)))); put(14, vec2(not(bvec2(a.x < b.x, true)))); break;
    case 15: put(0, mix(a, b, lessThan(a, b))); put(4, min(a, b)); put(8, clamp(a, 0.5, 2.0)); put(12, mod(a, 1.5)); break;
  }
  for (int i = 0; i < 16; ++i) outputs.r[which][i] = result[i];
}
