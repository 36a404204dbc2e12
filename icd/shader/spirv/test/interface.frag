#version 450
layout(location = 0) in vec4 smooth_color;
layout(location = 1) noperspective in vec2 screen;
layout(location = 2) flat in ivec2 ids;
layout(location = 3) in mat2 matrix;
layout(location = 5) in float unread;
layout(constant_id = 0) const bool kKill = false;
layout(constant_id = 1) const bool kDepth = false;
layout(location = 0) out vec4 color;
layout(location = 2) out vec2 second;
void main() {
  if (kKill && smooth_color.x < 0.5) discard;
  float zero = unread - unread;  // not 0 for infinities and NaNs, and yet nobody reads it
  color = vec4(smooth_color.xz, screen.y, float(ids.y));
  second = matrix[1] * gl_FragCoord.w;
}
