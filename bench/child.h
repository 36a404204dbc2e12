// The process that loads one driver and draws one scene when it is told to.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace lapilli::bench {

struct ChildOptions {
  std::string scene;  // empty: instance and device only
  SceneOptions scene_options;
};

// Command line that makes this program such a process.
std::vector<std::string> arguments_of(const ChildOptions& options);

// Says {"device", "instance_device" [ms], "resident_kb", "anonymous_kb", "peak_kb"} and, with a scene, either
// {"missing"} or {"pipelines", "first_record", "first_frame"} [ms] beside it. Then obeys:
//   turn MS FRAMES  draws for MS milliseconds, at most FRAMES frames: {"frames": [ms…], "records": [ms…], "cpu" [ms a
//                   frame], "others" [share of all CPUs that others used], "waited" [share of the time that threads of
//                   this process were ready and got none]}
//   memory          {"resident_kb", "anonymous_kb", "peak_kb"}
//   picture FILE    writes the last frame as a PNG: {"colors": how many different ones, up to 1,000}
int child_main(const ChildOptions& options);

}  // namespace lapilli::bench
