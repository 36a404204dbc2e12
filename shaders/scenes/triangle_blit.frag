// The cut-out: the mask is the opacity, and where it is zero nothing is touched.
#version 450
layout(set = 0, binding = 0) uniform sampler2D picture;
layout(set = 0, binding = 1) uniform sampler2D mask;
layout(location = 0) noperspective in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
  float opacity = texture(mask, uv).r;
  if (opacity == 0.0) discard;
  color = vec4(texture(picture, uv).rgb, opacity);
}
