// The tables of handlers that the files of this folder make, one list for each target.
#pragma once

#include "shader/interpreter/op.h"

namespace lapilli {

using ListHandlers = HandlerList();

extern const PerTarget<ListHandlers> kArithmeticHandlers;
extern const PerTarget<ListHandlers> kMathHandlers;
extern const PerTarget<ListHandlers> kIntegerHandlers;
extern const PerTarget<ListHandlers> kCompareHandlers;
extern const PerTarget<ListHandlers> kConvertHandlers;
extern const PerTarget<ListHandlers> kMemoryHandlers;
extern const PerTarget<ListHandlers> kImageHandlers;
extern const PerTarget<ListHandlers> kInputHandlers;
extern const PerTarget<ListHandlers> kFragmentHandlers;
extern const PerTarget<ListHandlers> kControlHandlers;
extern const PerTarget<ListHandlers> kOnceHandlers;
// In control.cpp.
extern const PerTarget<Run> kRun;
// In once.cpp.
extern const PerTarget<SpreadScalars> kSpread;

}  // namespace lapilli
