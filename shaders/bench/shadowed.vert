// The scene as the eye sees it, with its place in the shadow map.
#version 450
layout(set = 0, binding = 0) uniform Scene {
  mat4 view_projection;
  mat4 light_projection;
  vec4 light;
} scene;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 in_light;
layout(location = 1) out vec3 world_normal;

void main() {
  gl_Position = scene.view_projection * vec4(position, 1.0);
  in_light = scene.light_projection * vec4(position, 1.0);
  world_normal = normal;
}
