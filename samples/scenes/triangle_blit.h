// Scene: a triangle cut out of a picture and mapped affinely onto any other triangle; a mask leaves the rest untouched.
#pragma once

#include "scenes/affine.h"
#include "scenes/scene.h"

namespace lapilli::samples {

struct TriangleBlitOptions {
  // In the picture, whose size is 512 x 384 texels.
  Triangle source = {{{192, 40}, {78, 268}, {312, 290}}};
  // On the screen, in units of 640 x 480; SceneOptions::angle turns it about its centre.
  Triangle target = {{{616, 372}, {612, 60}, {364, 248}}};
};

std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options);

// Throws std::invalid_argument if the source triangle is degenerate.
std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options, const TriangleBlitOptions& blit);

}  // namespace lapilli::samples
