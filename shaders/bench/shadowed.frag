// Nine lookups in the shadow map, compared in the shader.
#version 450
layout(set = 0, binding = 0) uniform Scene {
  mat4 view_projection;
  mat4 light_projection;
  vec4 light;
} scene;
layout(set = 0, binding = 1) uniform sampler2D shadow_map;
layout(location = 0) in vec4 in_light;
layout(location = 1) in vec3 world_normal;
layout(location = 0) out vec4 color;

void main() {
  vec3 place = in_light.xyz / in_light.w;
  vec2 uv = place.xy * 0.5 + 0.5;
  vec2 texel = 1.0 / vec2(textureSize(shadow_map, 0));
  float lit = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      float nearest = textureLod(shadow_map, uv + vec2(x, y) * texel, 0.0).r;
      lit += place.z - 0.002 > nearest ? 0.0 : 1.0 / 9.0;
    }
  }
  float diffuse = max(dot(normalize(world_normal), scene.light.xyz), 0.0);
  color = vec4(vec3(0.75, 0.7, 0.62) * (0.2 + 0.8 * diffuse * lit), 1.0);
}
