// Scene: a triangle through model, view and a 90 degree perspective, its intensity falling from one corner.
#pragma once

#include "scenes/scene.h"

namespace lapilli::samples {

std::unique_ptr<Scene> create_transform(const SceneOptions& options);

}  // namespace lapilli::samples
