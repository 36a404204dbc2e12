// The generated tables and their look-up.
#include "shader/spirv/grammar.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace lapilli {
namespace {

constexpr SpirvOpInfo kInstructions[] = {
#define SPIRV_INST(opcode, name, signature) {opcode, name, signature},
#define SPIRV_NAME(kind, value, name)
#include "shader/spirv/grammar.inc"
#undef SPIRV_INST
#undef SPIRV_NAME
};

struct EnumName {
  SpirvEnum kind;
  uint32_t value;
  const char* name;
};
constexpr EnumName kNames[] = {
#define SPIRV_INST(opcode, name, signature)
#define SPIRV_NAME(kind, value, name) {SpirvEnum::kind, value, name},
#include "shader/spirv/grammar.inc"
#undef SPIRV_INST
#undef SPIRV_NAME
};

constexpr const char* kEnumNames[] = {"BuiltIn",        "Capability", "Decoration",    "Dim",         "ExecutionMode",
                                      "ExecutionModel", "ExtInst",    "ImageOperands", "StorageClass"};

// Most opcodes are small: their places in the list, one behind; 0 is none.
constexpr uint32_t kSmallOpcodes = 512;
constexpr auto kPlaces = [] {
  std::array<uint16_t, kSmallOpcodes> places = {};
  uint16_t place = 0;
  for (const SpirvOpInfo& info : kInstructions) {
    ++place;
    if (info.opcode < kSmallOpcodes) places[info.opcode] = place;
  }
  return places;
}();

}  // namespace

const SpirvOpInfo* find_spirv_op(uint32_t opcode) {
  if (opcode < kSmallOpcodes) return kPlaces[opcode] == 0 ? nullptr : &kInstructions[kPlaces[opcode] - 1];
  const auto at = std::lower_bound(std::begin(kInstructions), std::end(kInstructions), opcode,
                                   [](const SpirvOpInfo& info, uint32_t key) { return info.opcode < key; });
  return at != std::end(kInstructions) && at->opcode == opcode ? &*at : nullptr;
}

std::string spirv_enum_name(SpirvEnum kind, uint32_t value) {
  for (const EnumName& entry : kNames) {
    if (entry.kind == kind && entry.value == value) return entry.name;
  }
  return std::string(kEnumNames[static_cast<size_t>(kind)]) + " " + std::to_string(value);
}

}  // namespace lapilli
