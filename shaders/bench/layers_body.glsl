// A layer of a made-up material, for shaders of any length: noise, a loop, branches, a matrix, two samples.
layout(set = 0, binding = 0) uniform Material {
  mat4 place;
  vec4 tint[8];
  int octaves;
  float roughness;
} material;
layout(set = 0, binding = 1) uniform sampler2D albedo;

layout(location = 0) in vec2 coordinate;
layout(location = 0) out vec4 result;

float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }

#define LAYER(k)                                                                                  \
  {                                                                                               \
    vec4 p = material.place * vec4(coordinate * k, color.x, 1.0);                                 \
    p.xyz /= max(abs(p.w), 1e-3);                                                                 \
    vec2 cell = floor(p.xy), f = fract(p.xy);                                                     \
    f = f * f * (3.0 - 2.0 * f);                                                                  \
    float noise = mix(mix(hash(cell), hash(cell + vec2(1.0, 0.0)), f.x),                          \
                      mix(hash(cell + vec2(0.0, 1.0)), hash(cell + vec2(1.0, 1.0)), f.x), f.y);   \
    float sum = 0.0;                                                                              \
    for (int i = 0; i < material.octaves; ++i) {                                                  \
      sum += noise / float(i + 1);                                                                \
      if (sum > k) break;                                                                         \
    }                                                                                             \
    vec3 normal = normalize(vec3(dFdx(sum), dFdy(sum), material.roughness + k));                  \
    if (normal.z > 0.25) {                                                                        \
      color += texture(albedo, p.xy + normal.xy * k).rgb * pow(normal.z, 8.0 * k);                \
    } else {                                                                                      \
      color = mix(color, material.tint[int(k * 16.0) & 7].rgb, clamp(sum, 0.0, 1.0));             \
    }                                                                                             \
    color = reflect(color, normal) * length(cross(color, normal)) + exp2(-color * k);             \
  }
