// Positions and normals in world space; matrices from a uniform buffer, as applications hand them over.
#version 450
layout(set = 0, binding = 0) uniform Camera {
  mat4 projection;
  mat4 view;
  mat4 model;
  vec4 light;  // world space
  vec4 eye;    // world space
} camera;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 world_position;
layout(location = 1) out vec3 world_normal;

void main() {
  vec4 world = camera.model * vec4(position, 1.0);
  gl_Position = camera.projection * camera.view * world;
  world_position = world.xyz;
  world_normal = mat3(camera.model) * normal;
}
