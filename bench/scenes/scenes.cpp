// The list of scenes.
#include "scenes/scene.h"

#include <array>

#include "scenes/kinds.h"

namespace lapilli::bench {

std::span<const SceneEntry> scenes() {
  static constexpr std::array<SceneEntry, 25> kScenes = {{
      {"clear", "clears the colour attachment", "", 0, 0, clear_scene},
      {"triangle", "one triangle over half the screen, three colours interpolated", "", 0, 0, triangle_scene},
      {"layers_btf", "opaque full-screen layers with a depth test, back to front", "layers", 64, 8,
       back_to_front_scene},
      {"layers_ftb", "the same layers, front to back", "layers", 64, 8, front_to_back_scene},
      {"blend", "translucent full-screen layers over each other", "layers", 32, 8, blended_scene},
      {"bilinear", "a texture over the screen, bilinear", "", 0, 0, bilinear_scene},
      {"trilinear", "a textured floor to the horizon, trilinear", "", 0, 0, trilinear_scene},
      {"noise", "three octaves of gradient noise for each pixel, about 200 flops", "", 0, 0, noise_scene},
      {"mandelbrot", "a loop of up to 96 steps for each pixel", "", 0, 0, mandelbrot_scene},
      {"ray_march", "spheres found by marching along rays, with soft shadows", "", 0, 0, ray_march_scene},
      {"grid", "a height field of indexed triangles that share vertices", "triangles", 1000000, 20000, grid_scene},
      {"tiny", "triangles of about a pixel that share nothing", "triangles", 600000, 20000, tiny_scene},
      {"phong", "a torus knot, Phong's lighting for each pixel", "triangles", 50000, 5000, phong_scene},
      {"phong_msaa", "the same with four samples", "triangles", 50000, 5000, phong_msaa_scene},
      {"draws", "draws of one small triangle, push constants changing", "draws", 10000, 1000, draws_scene},
      {"descriptors", "draws with a dynamic uniform buffer and a texture of their own", "draws", 1000, 200,
       descriptors_scene},
      {"pipelines", "draws with a pipeline of their own each", "pipelines", 200, 40, pipelines_scene},
      {"shadow_map", "columns on a floor: a depth pass from the light, then lit with nine lookups a pixel", "triangles",
       50000, 5000, shadow_map_scene},
      {"saxpy", "compute: y = a x + y", "elements", 4000000, 64000, saxpy_scene},
      {"nbody", "compute: gravity between all pairs, read from a buffer", "bodies", 4096, 512, nbody_scene},
      {"nbody_shared", "compute: the same in pieces through shared memory", "bodies", 4096, 512, nbody_shared_scene},
      {"matmul", "compute: product of two matrices, by tiles in shared memory", "elements", 65536, 4096, matmul_scene},
      {"fft", "compute: Fourier transforms of 1,024 numbers each", "numbers", 262144, 8192, fft_scene},
      {"sort", "compute: pieces of 1,024 numbers sorted by a bitonic network", "numbers", 131072, 8192, sort_scene},
      {"histogram", "compute: counts in 256 bins, atomics on shared memory", "numbers", 1048576, 65536,
       histogram_scene},
  }};
  return kScenes;
}

const SceneEntry* find_scene(std::string_view name) {
  for (const SceneEntry& entry : scenes()) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

std::unique_ptr<Scene> create_scene(const SceneEntry& entry, SceneOptions options) {
  if (options.count == 0) options.count = entry.count;
  return entry.create(options);
}

}  // namespace lapilli::bench
