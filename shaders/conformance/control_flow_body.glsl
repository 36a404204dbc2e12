// Functions that are valid GLSL and valid C++: the test includes this file too and runs them as its oracle.
// Every invocation has another x, so lanes of a batch take different ways.

uint flow_if_else(uint x) {
  uint r = 1u;
  if ((x & 1u) != 0u) {
    r += 10u;
    if ((x & 2u) != 0u) {
      r *= 3u;
    } else if ((x & 4u) != 0u) {
      r *= 5u;
    }
  } else {
    r += 20u;
    if ((x & 8u) != 0u) r ^= x;
  }
  return r;
}

uint flow_for_break_continue(uint x) {
  uint sum = 0u;
  for (uint i = 0u; i < (x & 63u); ++i) {
    if ((i & 3u) == (x & 3u)) continue;
    if (sum > 500u) break;
    sum += i * i + (x >> 4);
  }
  return sum;
}

uint flow_nested_loops(uint x) {
  uint r = x;
  for (uint i = 0u; i < (x % 7u); ++i) {
    for (uint j = i; j < (x % 11u); ++j) {
      if (((i ^ j) & 1u) != 0u) continue;
      r = r * 31u + j;
      if ((r & 15u) == 7u) break;
    }
    if ((r & 31u) == 3u) break;
    r ^= i << 3;
  }
  return r;
}

uint flow_do_while(uint x) {
  uint n = 0u;
  uint v = (x & 255u) + 1u;
  do {
    v = (v & 1u) != 0u ? 3u * v + 1u : v >> 1;
    ++n;
  } while (v != 1u && n < 200u);
  return n;
}

uint flow_early_return(uint x) {
  if (x % 5u == 0u) return 7u;
  for (uint i = 0u; i < 20u; ++i) {
    if (i * i > (x & 255u)) return i;
    for (uint j = 0u; j < 4u; ++j) {
      if (i + j == (x & 15u)) return 100u + i * 10u + j;
    }
  }
  return 9999u;
}

uint flow_switch(uint x) {
  uint r = 0u;
  switch (x % 9u) {
    case 0u: r = 1u; break;
    case 1u: r = 2u;
    case 2u: r += 10u;
    case 3u: r += 100u; break;
    case 5u: if ((x & 64u) != 0u) break; r = 50u;
    default: r += 1000u; break;
    case 7u: r = 7u; break;
  }
  return r;
}

uint flow_switch_in_loop(uint x) {
  uint r = 0u;
  for (uint i = 0u; i < 16u; ++i) {
    switch ((x >> i) & 3u) {
      case 0u: continue;
      case 1u: r += i; break;
      case 2u: r = r * 2u + 1u;
      default: r ^= 5u;
    }
    if (r > 3000u) break;
    r += 1u;
  }
  return r;
}

uint flow_calls_inner(uint a, uint b) {
  if (a > b) return a - b;
  uint r = 0u;
  while (a < b) {
    a += 3u;
    if ((a & 7u) == 5u) return r + 1000u;
    ++r;
  }
  return r;
}

uint flow_calls(uint x) {
  uint r = 0u;
  for (uint i = 0u; i < 5u; ++i) r = r * 7u + flow_calls_inner((x + i) & 31u, (x >> 5) & 63u);
  if ((x & 16u) != 0u) r += flow_early_return(x >> 1);
  return r;
}

// A value made inside a loop that lanes leave in different rounds is used after it.
uint flow_value_after_loop(uint x) {
  uint last = 0u;
  uint i = 0u;
  uint mixed = 0u;
  while (true) {
    mixed = i * 13u + (x & 7u);
    if (i >= (x & 31u)) break;
    last = mixed + i;
    ++i;
  }
  return mixed * 1000u + last;
}

uint flow_short_circuit(uint x) {
  uint r = 0u;
  if ((x & 1u) != 0u && (x & 2u) != 0u || (x & 4u) != 0u) r |= 1u;
  if (!((x & 8u) != 0u || (x & 16u) != 0u) && x > 100u) r |= 2u;
  bool both = ((x & 32u) != 0u) != ((x & 64u) != 0u);
  if (both) r |= 4u;
  return r;
}

uint flow_local_array(uint x) {
  uint list[8];
  for (uint i = 0u; i < 8u; ++i) list[i] = i * x;
  for (uint i = 0u; i < (x & 15u); ++i) list[(x + i * 5u) & 7u] += list[(i + 3u) & 7u] ^ i;
  uint r = 0u;
  for (uint i = 0u; i < 8u; ++i) r = r * 33u + list[i];
  return r;
}

uint flow_float(uint x) {
  float v = float(x & 1023u);
  int rounds = 0;
  while (v > 1.5f && rounds < 40) {
    if (v > 100.0f) v = v - 50.0f;
    else if (v > 10.0f) v = v * 0.75f;
    else v = v - 1.0f;
    ++rounds;
  }
  return uint(rounds) * 65536u + uint(v * 1024.0f);
}

uint flow_deep(uint x) {
  uint r = 0u;
  for (uint a = 0u; a < 3u; ++a) {
    if ((x & (1u << a)) == 0u) continue;
    for (uint b = 0u; b < 3u; ++b) {
      if ((x & (8u << b)) == 0u) {
        for (uint c = 0u; c < 3u; ++c) {
          if ((x & (64u << c)) != 0u) {
            switch ((a + b + c) % 3u) {
              case 0u: r += 1u; break;
              case 1u: r += 16u; if ((x & 512u) != 0u) return r;
              case 2u: r += 256u;
            }
          } else {
            do { r ^= 3u; } while ((r & 1u) != 0u);
          }
        }
      } else if ((x & 1024u) != 0u) {
        break;
      }
    }
  }
  return r;
}

uint flow_dispatch(uint which, uint x) {
  switch (which) {
    case 0u: return flow_if_else(x);
    case 1u: return flow_for_break_continue(x);
    case 2u: return flow_nested_loops(x);
    case 3u: return flow_do_while(x);
    case 4u: return flow_early_return(x);
    case 5u: return flow_switch(x);
    case 6u: return flow_switch_in_loop(x);
    case 7u: return flow_calls(x);
    case 8u: return flow_value_after_loop(x);
    case 9u: return flow_short_circuit(x);
    case 10u: return flow_local_array(x);
    case 11u: return flow_float(x);
    default: return flow_deep(x);
  }
}
