// The command line that all sample programs share.
#pragma once

#include <functional>
#include <memory>

#include "scenes/scene.h"

namespace CLI {
class App;
}

namespace lapilli::samples {

struct SampleProgram {
  const char* name;
  std::function<std::unique_ptr<Scene>(const SceneOptions&)> create;
  std::function<void(CLI::App&)> add_options = [](CLI::App&) {};  // the scene's own
};

// Renders one image, writes it as PNG and prints the times. Returns the exit status.
int sample_main(int argc, char** argv, const SampleProgram& program);

}  // namespace lapilli::samples
