// Counts numbers of [-1, 1] in 256 bins: each workgroup those of 4,096 in shared memory, then in the buffer.
#version 450
layout(local_size_x = 256) in;
layout(push_constant) uniform Push {
  float scale;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer In { float values[]; };
layout(std430, set = 0, binding = 1) buffer Out { uint bins[]; };
shared uint own[256];

void main() {
  uint i = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * 4096;
  own[i] = 0;
  barrier();
  for (uint k = i; k < 4096; k += 256)
    if (first + k < push.count) atomicAdd(own[uint(clamp(values[first + k] * 128.0 + 128.0, 0.0, 255.0))], 1u);
  barrier();
  atomicAdd(bins[i], own[i]);
}
