#version 450
// Loops that are unrolled, and some that look as if they were. The oracle is the same code in C++.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Out { uint results[]; };

// How many rounds they have is decided when the module is specialized.
layout(constant_id = 0) const int kRounds = 5;

uint up(uint n) {
  uint sum = n;
  for (int i = 0; i < kRounds; ++i) sum = sum * 3u + uint(i);
  return sum;
}

uint down(uint n) {  // leaves, goes on and returns at different times
  uint sum = n;
  for (int i = kRounds; i > 0; --i) {
    if ((n & 7u) == uint(i)) continue;
    sum += uint(i) * 10u;
    if ((n & 15u) == uint(i) + 8u) break;
    if (sum > 150u) return sum;
  }
  return sum + 1000u;
}

uint in_a_loop(uint n) {  // within a loop over masks
  uint sum = 0u;
  for (uint k = 0u; k < (n & 31u); ++k) {
    uint last = k;
    for (uint i = 1u; i <= uint(kRounds); i += 2u) {
      if (((k + n) & 3u) == i) break;
      last = last * 5u + i;
    }
    sum ^= last;
  }
  return sum;
}

uint bent_counter(uint n) {  // the forecast is wrong: the counter depends on the lane from some round on
  uint sum = 0u;
  for (int i = 0; i < kRounds; ++i) {
    sum = sum * 7u + uint(i) + n;
    if (i == 2) i -= int(n & 1u) - 1;
    if (i == 3 && sum > 3000000u) i = kRounds;
    if (sum > 4000000000u) break;
  }
  return sum;
}

void main() {
  uint n = gl_GlobalInvocationID.x;
  results[n * 4u] = up(n);
  results[n * 4u + 1u] = down(n);
  results[n * 4u + 2u] = in_a_loop(n);
  results[n * 4u + 3u] = bent_counter(n);
}
