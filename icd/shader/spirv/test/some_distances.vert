#version 450
// Distances that are declared, and those that are written.
layout(location = 0) in vec4 position;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[3];
  float gl_CullDistance[2];
};

void main() {
  gl_Position = position;
  gl_ClipDistance[2] = position.x;
  gl_CullDistance[0] = position.y;
}
