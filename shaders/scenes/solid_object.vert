// Lights a face once, at its provoking vertex: diffuse and highlight from a distant light and a distant eye.
#version 450
layout(set = 0, binding = 0) uniform Object {
  mat4 model_view_projection;
  vec4 light;     // unit vectors in object space
  vec4 half_way;  // between light and eye
} object;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 0) flat out vec3 face_color;

void main() {
  gl_Position = object.model_view_projection * vec4(position, 1.0);
  float diffuse = max(dot(normal, object.light.xyz), 0.0);
  float highlight = pow(max(dot(normal, object.half_way.xyz), 0.0), 32.0);
  face_color = albedo * (0.18 + 0.82 * diffuse) + vec3(0.35 * highlight);
}
