#version 450
// Writes a buffer, whatever becomes of the colour.
layout(set = 1, binding = 4) buffer Counts { uint counts[]; };
layout(location = 0) out vec4 color;
void main() {
  counts[int(gl_FragCoord.x)] = 1;
  color = vec4(1);
}
