#version 450
// Distances to five planes that clip and three that cull, some written by an index that is known only at run time.
layout(push_constant) uniform Push {
  vec4 planes[8];
  int first;
} push;

layout(location = 0) in vec4 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 color_out;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[5];
  float gl_CullDistance[3];
};

void main() {
  gl_Position = position;
  color_out = color;
  gl_ClipDistance[4] = dot(push.planes[4], position);
  for (int i = 0; i < 4; ++i) {
    const int plane = (i + push.first) & 3;
    gl_ClipDistance[plane] = dot(push.planes[plane], position);
  }
  const vec3 cull = vec3(dot(push.planes[5], position), dot(push.planes[6], position), dot(push.planes[7], position));
  gl_CullDistance = float[3](cull.x, cull.y, cull.z);
}
