// The makers of the scenes; scenes.cpp lists them. Each expects a count where its entry has one.
#pragma once

#include "scenes/scene.h"

namespace lapilli::bench {

// full_screen.cpp
std::unique_ptr<Scene> clear_scene(const SceneOptions& options);
std::unique_ptr<Scene> back_to_front_scene(const SceneOptions& options);
std::unique_ptr<Scene> front_to_back_scene(const SceneOptions& options);
std::unique_ptr<Scene> blended_scene(const SceneOptions& options);
std::unique_ptr<Scene> bilinear_scene(const SceneOptions& options);
std::unique_ptr<Scene> trilinear_scene(const SceneOptions& options);
std::unique_ptr<Scene> noise_scene(const SceneOptions& options);
std::unique_ptr<Scene> mandelbrot_scene(const SceneOptions& options);
std::unique_ptr<Scene> ray_march_scene(const SceneOptions& options);
// meshes.cpp
std::unique_ptr<Scene> triangle_scene(const SceneOptions& options);
std::unique_ptr<Scene> grid_scene(const SceneOptions& options);
std::unique_ptr<Scene> tiny_scene(const SceneOptions& options);
std::unique_ptr<Scene> phong_scene(const SceneOptions& options);
std::unique_ptr<Scene> phong_msaa_scene(const SceneOptions& options);
// draws.cpp
std::unique_ptr<Scene> draws_scene(const SceneOptions& options);
std::unique_ptr<Scene> descriptors_scene(const SceneOptions& options);
std::unique_ptr<Scene> pipelines_scene(const SceneOptions& options);
// shadow_map.cpp
std::unique_ptr<Scene> shadow_map_scene(const SceneOptions& options);
// compute.cpp
std::unique_ptr<Scene> saxpy_scene(const SceneOptions& options);
std::unique_ptr<Scene> nbody_scene(const SceneOptions& options);
std::unique_ptr<Scene> nbody_shared_scene(const SceneOptions& options);
std::unique_ptr<Scene> matmul_scene(const SceneOptions& options);
std::unique_ptr<Scene> fft_scene(const SceneOptions& options);
std::unique_ptr<Scene> sort_scene(const SceneOptions& options);
std::unique_ptr<Scene> histogram_scene(const SceneOptions& options);

}  // namespace lapilli::bench
