// The whole picture, dim and grey except for the triangle that will be cut out.
#version 450
layout(set = 0, binding = 0) uniform sampler2D picture;
layout(set = 0, binding = 1) uniform sampler2D mask;
layout(location = 0) noperspective in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
  vec3 texel = texture(picture, uv).rgb;
  float grey = 0.6 * dot(texel, vec3(0.2126, 0.7152, 0.0722));
  color = vec4(mix(vec3(grey), texel, texture(mask, uv).r), 1.0);
}
