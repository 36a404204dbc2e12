#version 450
layout(local_size_x = 3, local_size_y = 2, local_size_z = 2) in;
layout(std430, set = 0, binding = 0) writeonly buffer Out { uvec4 r[]; };
void main() {
  uvec3 total = gl_NumWorkGroups * gl_WorkGroupSize;
  uint at = (gl_GlobalInvocationID.z * total.y + gl_GlobalInvocationID.y) * total.x + gl_GlobalInvocationID.x;
  r[at] = uvec4(gl_WorkGroupID.x | gl_WorkGroupID.y << 8 | gl_WorkGroupID.z << 16,
                gl_LocalInvocationID.x | gl_LocalInvocationID.y << 8 | gl_LocalInvocationID.z << 16,
                gl_LocalInvocationIndex, gl_NumWorkGroups.x | gl_NumWorkGroups.y << 8 | gl_NumWorkGroups.z << 16);
}
