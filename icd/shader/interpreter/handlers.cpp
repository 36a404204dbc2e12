// All handlers of all targets in one table, made when it is first used.
#include "shader/interpreter/handlers.h"

#include <array>
#include <memory>

namespace lapilli {
namespace {

constexpr size_t kOpcodes = static_cast<size_t>(Opcode::kCount);
using TargetTable = std::array<std::array<Handler, kFormCount>, kOpcodes>;
using Table = std::array<TargetTable, kSimdTargetCount>;

Table make_table() {
  const PerTarget<ListHandlers>* const files[] = {
      &kArithmeticHandlers, &kMathHandlers,  &kIntegerHandlers,  &kCompareHandlers, &kConvertHandlers, &kMemoryHandlers,
      &kImageHandlers,      &kInputHandlers, &kFragmentHandlers, &kControlHandlers, &kOnceHandlers};
  Table table = {};
  for (size_t target = 0; target < kSimdTargetCount; ++target) {
    for (const PerTarget<ListHandlers>* file : files) {
      ListHandlers* const list = (*file)[target];
      if (list == nullptr) continue;
      for (const HandlerEntry& entry : list()) table[target][static_cast<size_t>(entry.op)][entry.form] = entry.handler;
    }
  }
  return table;
}

}  // namespace

Handler find_handler(SimdTarget target, Opcode op, uint32_t form) {
  static const Table table = make_table();
  return table[static_cast<size_t>(target)][static_cast<size_t>(op)][form];
}

Run& interpreter_run(SimdTarget target) { return for_target(kRun, target); }
SpreadScalars& interpreter_spread(SimdTarget target) { return for_target(kSpread, target); }

}  // namespace lapilli
