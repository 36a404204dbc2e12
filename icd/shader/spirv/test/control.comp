#version 450
// Divergent control flow of every kind; each invocation writes kResults words. The oracle is the same code in C++.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Out { uint results[]; };

uint early_return(uint n) {
  for (uint i = 0u; i < 20u; ++i) {
    if (i * i > n) return i;
    if ((n & 7u) == 5u) return 100u + i;
  }
  return 1000u;
}

uint nested(uint n) {
  uint sum = 0u;
  for (uint i = 0u; i < (n & 15u); ++i) {
    uint j = 0u;
    while (true) {
      if (j > i) break;
      ++j;
      if (((i + j) & 3u) == 0u) continue;
      sum += i * 10u + j;
      if (sum > 500u) return sum;
    }
    if ((i & 1u) == 1u) continue;
    sum ^= j;
  }
  return sum;
}

uint fall_through(uint n) {
  uint value = 1u;
  switch (int(n % 9u) - 2) {
    case -2: value = 20u; break;
    case 0: value += 3u;
    case 1: value += 5u;
    case 2: value *= 7u; break;
    default: value = 77u;
    case 3: value += 11u; break;
    case 5:
      for (uint i = 0u; i < 4u; ++i) {
        if (i == (n & 3u)) break;
        value += 2u;
      }
      return value;
  }
  return value + 1000u;
}

uint after_loop(uint n) {  // values that the loop made, read behind it by lanes that left at different times
  uint last = 7u, square = 0u, i = 0u;
  do {
    square = i * i;
    last = square + n;
    ++i;
  } while (last % 13u != 0u && i < 40u);
  uint inner = square * 3u;
  for (uint k = 0u; k < (n & 3u); ++k) inner += last;
  return inner * 1000u + last + i;
}

void out_parameters(uint n, out uint a, inout uint b) {
  a = n + 1u;
  if ((n & 1u) == 0u) {
    b += a;
    return;
  }
  a *= 2u;
}

uint short_circuit(uint n) {
  bool taken = n > 10u && (n & 4u) != 0u || n == 3u;
  return (taken ? 1u : 2u) + ((n > 5u) == (n < 50u) ? 10u : 20u);
}

void main() {
  uint n = gl_GlobalInvocationID.x;
  uint at = n * 7u;
  results[at] = early_return(n);
  results[at + 1u] = nested(n);
  results[at + 2u] = fall_through(n);
  results[at + 3u] = after_loop(n);
  uint a, b = 5u;
  for (uint i = 0u; i < 3u; ++i) out_parameters(n + i * b, a, b);
  results[at + 4u] = a * 65536u + b;
  results[at + 5u] = short_circuit(n);
  if (n % 3u == 1u) return;
  results[at + 6u] = n;
}
