#version 450
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;
void main() {
  first = in_color;
  second = in_color.bgra * 0.5;
  third = vec4(gl_FragCoord.xy, in_color.xy);
}
