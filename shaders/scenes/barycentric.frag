// The interpolated corner colours are the barycentric coordinates made visible.
#version 450
layout(location = 0) in vec3 corner_color;
layout(location = 0) out vec4 color;

void main() { color = vec4(corner_color, 1.0); }
