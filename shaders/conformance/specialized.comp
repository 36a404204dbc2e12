#version 450
// Specialization constants: scalars, a derived one, an array size, and the workgroup size.
layout(local_size_x_id = 10, local_size_y_id = 11) in;
layout(constant_id = 0) const int kInt = 3;
layout(constant_id = 1) const float kFloat = 0.5;
layout(constant_id = 2) const bool kBool = false;
layout(constant_id = 3) const uint kSize = 2u;
const int kDerived = kInt * 10 + 1;
layout(std430, set = 0, binding = 0) writeonly buffer Out { float r[]; };
void main() {
  float list[kSize];
  for (uint i = 0u; i < kSize; ++i) list[i] = float(i) + kFloat;
  float sum = 0.0;
  for (uint i = 0u; i < kSize; ++i) sum += list[i];
  uint at = gl_LocalInvocationIndex + gl_WorkGroupID.x * gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  r[at] = float(kDerived) * 1000.0 + sum + (kBool ? 0.25 : 0.0) + float(gl_WorkGroupSize.x * 100u + gl_WorkGroupSize.y) * 100000.0;
}
