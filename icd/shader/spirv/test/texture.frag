#version 450
layout(set = 1, binding = 0) uniform sampler2D both[2];
layout(set = 1, binding = 2) uniform texture2D pictures[4];
layout(set = 1, binding = 3) uniform sampler samplers[2];
layout(location = 0) in vec2 at;
layout(location = 1) flat in int which;
layout(location = 0) out vec4 color;
vec4 through(texture2D picture, vec2 where) { return texture(sampler2D(picture, samplers[1]), where, 0.5); }
void main() {
  color = texture(both[1], at) + textureLod(both[which], at, 2.0);
  color += through(pictures[which], at) + textureGrad(both[0], at, dFdx(at), dFdy(at));
  color += texelFetch(both[0], ivec2(at), 1) + vec4(textureSize(both[0], 0), fwidth(at));
}
