// One matrix, projection * view * model, by push constant.
#version 450
layout(push_constant) uniform Push {
  mat4 model_view_projection;
} push;
layout(location = 0) in vec3 position;
layout(location = 1) in float vertex_intensity;
layout(location = 0) out float intensity;

void main() {
  gl_Position = push.model_view_projection * vec4(position, 1.0);
  intensity = vertex_intensity;
}
