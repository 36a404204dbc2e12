// One flat colour for each face.
#version 450
layout(location = 0) flat in vec3 face_color;
layout(location = 0) out vec4 color;

void main() { color = vec4(face_color, 1.0); }
