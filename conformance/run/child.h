// One driver drawing one scene in a process of its own: its first frame is a true first frame, its environment its own,
// and if it crashes only it is gone. The parent tells it when to draw, so that drivers can take turns.
#pragma once

#include <optional>
#include <string>

#include "run/process.h"
#include "scenes/renderer.h"

namespace lapilli::run {

struct ChildOptions {
  std::string scene;
  samples::SceneOptions scene_options;
  std::string pixels_path;  // where the child leaves colour and depth
};

// The other end, in the child: draws the first frame, then obeys "frames N" and "end" lines on stdin. Answers are lines
// of JSON.
int child_main(const ChildOptions& options);

class Child {
 public:
  // Runs `program` (this executable) with nothing but the driver of `manifest`.
  Child(const std::string& program, const std::string& manifest, const ChildOptions& options);
  ~Child();

  // {"device", "subpixel_bits", "instance_device", "pipelines", "first_frame"}, times in ms; nothing if the child ended
  // before (how: ended()).
  std::optional<nlohmann::json> first_frame();
  // Milliseconds of each of `count` further frames; empty if the child ended.
  std::vector<double> frames(int count);
  // Lets the child end and returns what it drew; nothing if it failed.
  std::optional<samples::Frame> finish();
  // "exit status 1", "signal 11" …
  const std::string& ended() const { return process_.ended(); }

 private:
  ChildOptions options_;
  Process process_;
};

}  // namespace lapilli::run
