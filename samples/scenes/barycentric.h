// Scene: one triangle with red, green and blue corners, and a second behind it that is drawn after it.
#pragma once

#include "scenes/scene.h"

namespace lapilli::samples {

std::unique_ptr<Scene> create_barycentric(const SceneOptions& options);

}  // namespace lapilli::samples
