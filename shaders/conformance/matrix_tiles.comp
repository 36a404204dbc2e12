#version 450
// The product of two square matrices, tile by tile; the tiles are as large as the workgroup.
layout(local_size_x = 16, local_size_y = 16) in;
layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(push_constant) uniform Push { uint size; } push;
layout(std430, set = 0, binding = 0) readonly buffer A { float a[]; };
layout(std430, set = 0, binding = 1) readonly buffer B { float b[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Out { float product[]; };
shared float rows[gl_WorkGroupSize.y][gl_WorkGroupSize.x];
shared float columns[gl_WorkGroupSize.y][gl_WorkGroupSize.x];

void main() {
  uvec2 local = gl_LocalInvocationID.xy, at = gl_GlobalInvocationID.xy;
  float sum = 0.0;
  for (uint tile = 0; tile < push.size; tile += gl_WorkGroupSize.x) {
    rows[local.y][local.x] = a[at.y * push.size + tile + local.x];
    columns[local.y][local.x] = b[(tile + local.y) * push.size + at.x];
    barrier();
    for (uint k = 0; k < gl_WorkGroupSize.x; ++k) sum += rows[local.y][k] * columns[k][local.x];
    barrier();
  }
  product[at.y * push.size + at.x] = sum;
}
