#version 450
// What needs the derivatives of a fragment's quad; one of them in each pipeline.
layout(constant_id = 0) const int kWhich = 0;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) uniform sampler2DShadow shadow;
layout(location = 0) in vec2 in_uv;
layout(location = 0) out vec4 out_color;
void main() {
  if (kWhich == 0) out_color = texture(image, in_uv, 1.0);
  if (kWhich == 1) out_color = textureOffset(image, in_uv, ivec2(2, -3));
  if (kWhich == 2) out_color = textureProj(image, vec3(in_uv * 2.0, 2.0), -1.0);
  if (kWhich == 3) out_color = vec4(textureQueryLod(image, in_uv), 0.0, 1.0);
  if (kWhich == 4) out_color = vec4(texture(shadow, vec3(in_uv, 0.5)), textureProj(shadow, vec4(in_uv * 2.0, 1.0, 2.0)),
                                    textureOffset(shadow, vec3(in_uv, 0.5), ivec2(-8, 7)), 1.0);
}
