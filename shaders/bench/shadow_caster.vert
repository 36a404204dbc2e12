// The scene as the light sees it: depth alone.
#version 450
layout(set = 0, binding = 0) uniform Scene {
  mat4 view_projection;
  mat4 light_projection;
  vec4 light;
} scene;
layout(location = 0) in vec3 position;

void main() { gl_Position = scene.light_projection * vec4(position, 1.0); }
