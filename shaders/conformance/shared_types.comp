#version 450
// Shared memory of all types: what one invocation writes, another reads, with indices of all kinds.
layout(local_size_x = 10, local_size_y = 13) in;
struct Part {
  mat3x2 m;
  float list[5];
  bool odd;
  uvec3 words;
};
shared uint zeros[7];
shared Part parts[7];
shared vec4 vectors[130];
shared bool flags[130];
layout(std430, set = 0, binding = 0) writeonly buffer Out { float results[]; };

void fill(uint at, inout Part part) {
  for (uint c = 0; c < 3; ++c) part.m[c] = vec2(at + 2 * c, at + 2 * c + 1);
  part.m[at % 3][at & 1] = -1.0;
  part.words = uvec3(at, at + 1, at + 2);
}

void main() {
  uint n = gl_LocalInvocationIndex;
  uint to = (gl_WorkGroupID.x * 130 + n) * 13;
  results[to] = float(zeros[n % 7] + uint(flags[n])) + vectors[n].y + parts[n % 7].list[n % 5];
  barrier();
  vectors[n] = vec4(n, 2 * n, gl_WorkGroupID.x, n ^ 5);
  vectors[n][n & 3] = 100.0;
  flags[n] = n % 3 == 0;
  zeros[n % 7] = 1;
  if (n < 7) {
    fill(n, parts[n]);
    for (uint k = 0; k < 5; ++k) parts[n].list[k] = float(10 * n + k);
    parts[n].odd = (n & 1) == 1;
  }
  barrier();
  vec4 v = vectors[129 - n];
  results[to + 1] = v.x;
  results[to + 2] = v.y;
  results[to + 3] = v.z;
  results[to + 4] = v.w;
  results[to + 5] = flags[129 - n] ? 1.0 : 0.0;
  results[to + 6] = parts[n % 7].m[n % 3][n & 1];
  results[to + 7] = parts[n % 7].list[n % 5];
  results[to + 8] = float(parts[(n + 3) % 7].words[n % 3]);
  results[to + 9] = parts[n % 7].odd ? 1.0 : 0.0;
  Part whole = parts[n % 7];
  results[to + 10] = whole.list[4] + whole.m[2][1];
  barrier();
  if (n == 64) parts[2] = parts[5];
  barrier();
  results[to + 11] = parts[2].list[n % 5] + parts[n % 7].list[4];
  results[to + 12] = vectors[(n * 7) % 130][n & 3];
}
