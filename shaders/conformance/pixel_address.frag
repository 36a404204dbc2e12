#version 450
// The pixel's column and row as red and green bytes.
layout(location = 0) out vec4 out_color;
void main() { out_color = vec4(floor(gl_FragCoord.xy) / 255.0, 0.0, 1.0); }
