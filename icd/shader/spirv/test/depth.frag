#version 450
// Reads its depth.
layout(location = 0) out vec4 color;
void main() { color = vec4(gl_FragCoord.z); }
