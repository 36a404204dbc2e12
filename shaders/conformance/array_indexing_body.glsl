// What an invocation reads of the descriptors that its index names, and what it changes there. The set's arrays may be
// longer than these.
const uint kResults = 8u;
layout(set = 0, binding = 0) uniform usampler2D combined[3];
layout(set = 0, binding = 1) uniform utexture2D pictures[3];
layout(set = 0, binding = 2) uniform sampler samplers[3];
layout(set = 0, binding = 3, r32ui) uniform uimage2D images[3];
layout(std140, set = 0, binding = 4) uniform Uniform { uvec4 value; } uniforms[3];
layout(std430, set = 0, binding = 5) buffer Storage { uint count, value, words[]; } storage[3];
layout(std430, set = 0, binding = 6) readonly buffer In { uint indices[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Out { uint results[]; };

uint texel_of(utexture2D of, sampler with) { return textureLod(usampler2D(of, with), vec2(1.5), 0.0).x; }

void use_arrays(uint n) {
  uint i = indices[n], o = n * kResults;
  results[o + 0] = textureLod(combined[i], vec2(0.5), 0.0).x;
  results[o + 1] = texel_of(pictures[i], samplers[i]);
  results[o + 2] = imageLoad(images[i], ivec2(0)).x;
  results[o + 3] = uniforms[i].value.y;
  results[o + 4] = storage[i].value;
  results[o + 5] = uint(storage[i].words.length());
  results[o + 6] = uint(textureSize(combined[i], 0).y * 100 + imageSize(images[i]).x);
  results[o + 7] = texelFetch(combined[2 - i], ivec2(0), 0).x;
  atomicAdd(storage[i].count, 1u);
  imageAtomicAdd(images[i], ivec2(1, 0), 1u);
  imageStore(images[i], ivec2(2, 0), uvec4(i + 1u));
  storage[i].words[1] = i + 1u;
}
