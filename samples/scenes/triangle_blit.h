// Scene: a triangle cut out of a picture and mapped affinely onto any other triangle; a mask leaves the rest untouched.
#pragma once

#include "scenes/affine.h"
#include "scenes/scene.h"

namespace lapilli::samples {

struct TriangleBlitOptions {
  // In the picture, whose size is 640 x 480 texels.
  Triangle source = {{{240, 50}, {98, 335}, {390, 362}}};
  // On the screen, in units of 640 x 480; SceneOptions::angle turns it about its centre.
  Triangle target = {{{589, 376}, {614, 48}, {370, 221}}};
};

std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options);

// Throws std::invalid_argument if the source triangle is degenerate.
std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options, const TriangleBlitOptions& blit);

}  // namespace lapilli::samples
