#version 450
#extension GL_EXT_samplerless_texture_functions : require
// Every way to sample a 2D image with an explicit level: (u, v, level of detail, reference) for each invocation.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1) uniform sampler2DShadow shadow;
layout(set = 0, binding = 2) uniform texture2D pictures[2];
layout(set = 0, binding = 3) uniform sampler samplers[2];
layout(std430, set = 0, binding = 4) readonly buffer In { vec4 at[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Out { vec4 texels[]; };
layout(std430, set = 0, binding = 6) readonly buffer Offset { ivec2 offset; };
const int kResults = 16;
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= at.length()) return;
  vec2 uv = at[i].xy;
  float lod = at[i].z, z = at[i].w;
  vec2 dx = vec2(exp2(lod) / 16.0, 0.0), dy = vec2(0.0, exp2(lod - 1.0) / 16.0);
  const ivec2 four[4] = ivec2[4](ivec2(0, 0), ivec2(-8, 7), ivec2(3, 1), ivec2(-1, -5));
  uint o = i * kResults, which = gl_WorkGroupID.x & 1u;
  texels[o + 0] = textureLodOffset(image, uv, lod, ivec2(3, -2));
  texels[o + 1] = textureGrad(image, uv, dx, dy);
  texels[o + 2] = textureGradOffset(image, uv, dx, dy, ivec2(-8, 7));
  texels[o + 3] = textureProjLod(image, vec3(uv * 2.0, 2.0), lod);
  texels[o + 4] = textureProjLodOffset(image, vec4(uv * 4.0, 99.0, 4.0), lod, ivec2(1, 0));
  texels[o + 5] = textureGather(image, uv, 1);
  texels[o + 6] = textureGatherOffset(image, uv, offset, 2);
  texels[o + 7] = textureGatherOffsets(image, uv, four, 3);
  texels[o + 8] = vec4(textureLod(shadow, vec3(uv, z), 0.0), textureGrad(shadow, vec3(uv, z), dx, dy),
                       textureProjLod(shadow, vec4(uv * 2.0, z * 2.0, 2.0), 0.0),
                       textureLodOffset(shadow, vec3(uv, z), 0.0, ivec2(-3, 2)));
  texels[o + 9] = textureGather(shadow, uv, z);
  texels[o + 10] = textureGatherOffset(shadow, uv, z, offset);
  texels[o + 11] = vec4(textureSize(image, 1), textureQueryLevels(image), textureSize(shadow, 0).x);
  texels[o + 12] = texelFetchOffset(image, ivec2(floor(uv * 8.0)), 1, ivec2(1, -1));
  texels[o + 13] = textureLod(sampler2D(pictures[which], samplers[1u - which]), uv, lod);
  texels[o + 14] = textureLod(sampler2D(pictures[0], samplers[0]), uv, lod);
  texels[o + 15] = texelFetch(pictures[1], ivec2(floor(uv * 16.0)), 0);
}
