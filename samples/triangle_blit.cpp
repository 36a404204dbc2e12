// The sample program of the scene triangle_blit: any triangle of the picture onto any triangle of the screen.
#include "scenes/triangle_blit.h"

#include <CLI/CLI.hpp>

#include "sample_main.h"

namespace {

using lapilli::samples::Triangle;

void add_triangle_option(CLI::App& app, const std::string& name, Triangle& triangle, const std::string& help) {
  app.add_option_function<std::vector<double>>(
         name,
         [&triangle](const std::vector<double>& values) {
           for (size_t i = 0; i < 3; ++i) triangle[i] = {values[2 * i], values[2 * i + 1]};
         },
         help)
      ->type_name("X Y X Y X Y")
      ->expected(6);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lapilli::samples;
  TriangleBlitOptions blit;
  return sample_main(argc, argv,
                     {"triangle_blit", [&](const SceneOptions& options) { return create_triangle_blit(options, blit); },
                      [&](CLI::App& app) {
                        add_triangle_option(app, "--from", blit.source, "corners in the picture, 640 x 480 texels");
                        add_triangle_option(app, "--to", blit.target, "corners on the screen, in units of 640 x 480");
                      }});
}
