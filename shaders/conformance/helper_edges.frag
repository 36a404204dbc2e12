#version 450
// White where a neighbour in the quad is a helper invocation.
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  float helper = gl_HelperInvocation ? 1.0 : 0.0;
  out_color = abs(dFdx(helper)) + abs(dFdy(helper)) > 0.0 ? vec4(1.0) : in_color;
}
