// Scene: a turning closed mesh, one flat colour per face, back faces dropped.
#pragma once

#include "scenes/scene.h"

namespace lapilli::samples {

std::unique_ptr<Scene> create_solid_object(const SceneOptions& options);

}  // namespace lapilli::samples
