#version 450
#extension GL_ARB_shader_draw_parameters : require
layout(location = 0) in vec4 in_position;
layout(location = 1) in vec4 in_color;
layout(location = 0) flat out vec4 out_color;
void main() {
  gl_Position = in_position;
  out_color = vec4(gl_BaseVertexARB, gl_BaseInstanceARB, gl_DrawIDARB, gl_VertexIndex);
}
