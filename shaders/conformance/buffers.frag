#version 450
struct Element { vec3 a; float b; mat2 c; };
layout(set = 0, binding = 0, std140) uniform Static { vec4 colors[4]; mat4 matrix; int index; } static_block;
layout(set = 0, binding = 1, std140) uniform Dynamic { vec4 color; } dynamic_block;
layout(set = 1, binding = 0, std430) readonly buffer Storage { uint count; Element elements[]; } storage;
layout(set = 1, binding = 3, std430) buffer Moving { vec4 values[]; } moving;
layout(push_constant) uniform Push { vec4 color; int element; } push;
layout(location = 0) flat in uint instance;
layout(location = 1) flat in int vertex;
layout(location = 0) out vec4 out_color;
void main() {
  vec4 from_static = static_block.matrix * static_block.colors[static_block.index];
  Element e = storage.elements[push.element];
  float extra = e.b + e.c[1][0] + float(storage.count) + float(storage.elements.length());
  out_color = from_static + dynamic_block.color * 10.0 + push.color * 100.0 + vec4(e.a, extra) + moving.values[0];
}
