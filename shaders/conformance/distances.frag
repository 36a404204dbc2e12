#version 450
// The distances as the fragment shader sees them.
layout(push_constant) uniform Push {
  vec4 planes[8];
  int first;
} push;

layout(location = 0) in vec4 color;
layout(location = 0) out vec4 result;

in float gl_ClipDistance[5];
in float gl_CullDistance[3];

void main() {
  result = vec4(gl_ClipDistance[push.first], gl_CullDistance[push.first % 3], gl_ClipDistance[0], gl_CullDistance[2]);
}
