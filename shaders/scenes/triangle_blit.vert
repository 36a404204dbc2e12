// A corner of a rectangle of the picture and where it goes; affine, so the coordinates are linear on the screen.
#version 450
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 corner_uv;
layout(location = 0) noperspective out vec2 uv;

void main() {
  gl_Position = vec4(position, 0.0, 1.0);
  uv = corner_uv;
}
