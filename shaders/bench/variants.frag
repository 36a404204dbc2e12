// A material whose terms are chosen by specialization constants, as engines make hundreds of.
#version 450
layout(constant_id = 0) const int kVariant = 0;
layout(constant_id = 1) const float kRoughness = 0.5;
layout(push_constant) uniform Push {
  vec4 tint;
  vec2 center;
  vec2 size;
} push;
layout(location = 0) in vec3 base;
layout(location = 0) out vec4 color;

vec3 fresnel(float cosine, vec3 f0) {
  float m = 1.0 - cosine;
  float m2 = m * m;
  return f0 + (1.0 - f0) * m2 * m2 * m;
}

void main() {
  vec3 normal = normalize(vec3(base.xy - 0.5, 1.0));
  vec3 light = normalize(vec3(0.3, -0.5, 0.9));
  vec3 eye = vec3(0.0, 0.0, 1.0);
  vec3 half_way = normalize(light + eye);
  float n_l = max(dot(normal, light), 0.0);
  float n_h = max(dot(normal, half_way), 0.0);
  vec3 albedo = base;
  if ((kVariant & 1) != 0) albedo = pow(albedo, vec3(1.0 + kRoughness));
  if ((kVariant & 2) != 0) albedo *= 0.75 + 0.25 * sin(30.0 * base.x + float(kVariant));
  float alpha = kRoughness * kRoughness;
  float d = n_h * n_h * (alpha * alpha - 1.0) + 1.0;
  vec3 specular = vec3(alpha * alpha / (3.14159265 * d * d));
  if ((kVariant & 4) != 0) specular *= fresnel(max(dot(half_way, eye), 0.0), vec3(0.04));
  if ((kVariant & 8) != 0) specular = mix(specular, vec3(0.5), exp2(-4.0 * n_h));
  vec3 lit = albedo * (0.2 + 0.8 * n_l) + 0.1 * specular;
  for (int i = 0; i < (kVariant >> 4); ++i) lit += 0.01 * fract(lit * 1.7 + float(i));
  color = vec4(lit, 1.0);
}
