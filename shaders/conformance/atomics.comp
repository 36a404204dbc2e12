#version 450
// Every atomic operation on a buffer, on an array of buffers and on shared memory, with all invocations on few words.
layout(local_size_x = 96) in;
struct Words { uint sum, low, high, all, any, odd, last, ticket; int least, most; uint up, loaded, guard; };
layout(std430, set = 0, binding = 0) readonly buffer In { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Out { Words words[3]; };
layout(std430, set = 0, binding = 2) buffer Old { uint tickets[]; };
shared Words local_words;

#define CHANGE(w, value)                            \
  atomicAdd(w.sum, value);                          \
  atomicMin(w.low, value);                          \
  atomicMax(w.high, value);                         \
  atomicAnd(w.all, value | 0xFF);                   \
  atomicOr(w.any, value & 0xFFFF00);                \
  atomicXor(w.odd, value);                          \
  atomicMin(w.least, int(value));                   \
  atomicMax(w.most, int(value));                    \
  atomicExchange(w.last, value);                    \
  ticket = atomicAdd(w.ticket, 1);                  \
  for (uint seen = w.up; ; ) {                      \
    uint before = atomicCompSwap(w.up, seen, seen + 3); \
    if (before == seen) break;                      \
    seen = before;                                  \
  }

void main() {
  uint n = gl_GlobalInvocationID.x, value = values[n], ticket;
  if (gl_LocalInvocationIndex == 0) {
    local_words.low = ~0u;
    local_words.all = ~0u;
    local_words.least = 0x7FFFFFFF;
    local_words.most = int(0x80000000);
  }
  barrier();
  if (n % 5 != 0) {
    CHANGE(words[0], value)
    tickets[2 * n] = ticket;
    CHANGE(local_words, value)
    tickets[2 * n + 1] = ticket;
  }
  barrier();
  if (gl_LocalInvocationIndex == 95) {
    atomicAdd(words[1].sum, local_words.sum);
    atomicMin(words[1].low, local_words.low);
    atomicMax(words[1].high, local_words.high);
    atomicAnd(words[1].all, local_words.all);
    atomicOr(words[1].any, local_words.any);
    atomicXor(words[1].odd, local_words.odd);
    atomicMin(words[1].least, local_words.least);
    atomicMax(words[1].most, local_words.most);
    atomicAdd(words[1].up, local_words.up);
    atomicAdd(words[1].ticket, local_words.ticket);
  }
}
