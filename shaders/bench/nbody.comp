// Gravity of all bodies on each, read straight from the buffer; about 20 flops a pair.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
  float step;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer Bodies { vec4 bodies[]; };  // position and mass
layout(std430, set = 0, binding = 1) writeonly buffer Result { vec4 result[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  vec3 place = bodies[i].xyz;
  vec3 acceleration = vec3(0.0);
  for (uint j = 0; j < push.count; ++j) {
    vec4 other = bodies[j];
    vec3 away = other.xyz - place;
    float squared = dot(away, away) + 0.01;
    float inverse = inversesqrt(squared);
    acceleration += away * (other.w * inverse * inverse * inverse);
  }
  result[i] = vec4(place + push.step * acceleration, length(acceleration));
}
