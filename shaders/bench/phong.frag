// Phong's lighting for each pixel.
#version 450
layout(set = 0, binding = 0) uniform Camera {
  mat4 projection;
  mat4 view;
  mat4 model;
  vec4 light;
  vec4 eye;
} camera;
layout(location = 0) in vec3 world_position;
layout(location = 1) in vec3 world_normal;
layout(location = 0) out vec4 color;

void main() {
  vec3 normal = normalize(world_normal);
  vec3 to_light = normalize(camera.light.xyz - world_position);
  vec3 to_eye = normalize(camera.eye.xyz - world_position);
  float diffuse = max(dot(normal, to_light), 0.0);
  float highlight = pow(max(dot(reflect(-to_light, normal), to_eye), 0.0), 32.0);
  vec3 albedo = vec3(0.62, 0.35, 0.22);
  color = vec4(albedo * (0.15 + 0.85 * diffuse) + 0.4 * highlight, 1.0);
}
