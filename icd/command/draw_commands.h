// Draws and dispatches. Specification: chapters "Drawing Commands", "Dispatching Commands".
#pragma once

#include "command/command.h"
#include "object/buffer.h"

namespace lapilli::cmd {

struct Draw : CommandOf<CommandKind::kDraw> {
  VkDrawIndirectCommand draw = {};
};
struct DrawIndexed : CommandOf<CommandKind::kDrawIndexed> {
  VkDrawIndexedIndirectCommand draw = {};
};
// `count` structures in a buffer, `stride` bytes apart.
struct DrawIndirect : CommandOf<CommandKind::kDrawIndirect> {
  Buffer* buffer = nullptr;
  uint64_t offset = 0;
  uint32_t count = 0;
  uint32_t stride = 0;
  bool indexed = false;
};

struct Dispatch : CommandOf<CommandKind::kDispatch> {
  uint32_t groups[3] = {};
};
struct DispatchIndirect : CommandOf<CommandKind::kDispatchIndirect> {
  Buffer* buffer = nullptr;
  uint64_t offset = 0;
};

}  // namespace lapilli::cmd
