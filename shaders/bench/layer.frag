// What an opaque surface without textures costs: a lit, rippled plate, about 60 flops.
#version 450
layout(push_constant) uniform Push {
  vec4 tint;
  float depth;
} push;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

void main() {
  vec2 wave = fract(place * 4.0 + push.depth) * 2.0 - 1.0;
  vec2 slope = wave * (1.0 - dot(wave, wave) * 0.5);
  vec3 normal = normalize(vec3(slope, 1.0));
  vec3 to_light = normalize(vec3(0.4, -0.6, 0.8) - vec3(0.3 * place, 0.0));
  float diffuse = max(dot(normal, to_light), 0.0);
  float shine = max(dot(normal, normalize(to_light + vec3(0.0, 0.0, 1.0))), 0.0);
  shine *= shine;
  shine *= shine;
  shine *= shine;
  color = vec4(push.tint.rgb * (0.2 + 0.8 * diffuse) + 0.3 * shine, 1.0);
}
