// Gravity of all bodies on each, in pieces that a workgroup reads together; about 20 flops a pair.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
  float step;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer Bodies { vec4 bodies[]; };  // position and mass
layout(std430, set = 0, binding = 1) writeonly buffer Result { vec4 result[]; };
shared vec4 piece[64];

void main() {
  uint i = gl_GlobalInvocationID.x;
  vec3 place = bodies[i].xyz;
  vec3 acceleration = vec3(0.0);
  for (uint start = 0; start < push.count; start += 64) {
    piece[gl_LocalInvocationID.x] = bodies[start + gl_LocalInvocationID.x];
    barrier();
    for (uint j = 0; j < 64; ++j) {
      vec3 away = piece[j].xyz - place;
      float squared = dot(away, away) + 0.01;
      float inverse = inversesqrt(squared);
      acceleration += away * (piece[j].w * inverse * inverse * inverse);
    }
    barrier();
  }
  result[i] = vec4(place + push.step * acceleration, length(acceleration));
}
