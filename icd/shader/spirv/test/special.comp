#version 450
// Specialization constants, in sizes too.
layout(local_size_x_id = 0, local_size_y = 2) in;
layout(constant_id = 1) const int kCount = 3;
layout(constant_id = 2) const float kScale = 1.5;
layout(constant_id = 3) const bool kFlag = false;
const int kMore = kCount * 2 + 1;
layout(set = 0, binding = 0) buffer Out { float results[]; };
void main() {
  float local[kMore];
  for (int i = 0; i < kMore; ++i) local[i] = float(i) * kScale;
  float sum = kFlag ? 1000.0 : 0.0;
  for (int i = 0; i < kMore; ++i) sum += local[i];
  if (gl_LocalInvocationIndex == 0u) {
    results[0] = sum;
    results[1] = float(kMore);
    results[2] = float(gl_WorkGroupSize.x);
    results[3] = float(gl_WorkGroupSize.y);
  }
}
