// A SPIR-V module that was read and checked: what the lowering (lower.h) may rely on.
// Specification: SPIR-V, chapters "Physical Layout of a SPIR-V Module and Instruction" and "Logical Layout of a
// Module".
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace lapilli {

// A view of one instruction; operator[] gives its words, [0] is the word with opcode and length.
struct SpirvInst {
  spv::Op op;
  uint32_t count;  // words, the first included
  uint32_t word;   // where it starts in the module
  const uint32_t* words;

  uint32_t operator[](uint32_t i) const { return words[i]; }
};

constexpr uint32_t kNoBlock = 0xFFFFFFFF;
constexpr uint32_t kNoLoop = 0xFFFFFFFF;

struct SpirvBlock {
  uint32_t label = 0;           // id
  uint32_t first = 0, end = 0;  // words after OpLabel, and after the terminator
  uint32_t terminator = 0;      // word
  uint32_t merge = kNoBlock;    // indices of blocks
  uint32_t continue_target = kNoBlock;
  std::vector<uint32_t> successors;    // sorted, each once
  std::vector<uint32_t> predecessors;  // reachable ones
  uint32_t position = kNoBlock;        // in SpirvFunction::order; kNoBlock: not reachable
  uint32_t loop = kNoLoop;             // innermost loop around it; of a loop's header, that loop
};

// A merge construct that something jumps back to: positions [header, end) of the order.
struct SpirvLoop {
  uint32_t header = 0, end = 0;
  uint32_t parent = kNoLoop;
};

struct SpirvFunction {
  uint32_t id = 0;
  uint32_t word = 0;
  std::vector<uint32_t> parameters;  // ids
  std::vector<SpirvBlock> blocks;
  // Reachable blocks, structured: a block comes after all that lead to it but for loops, and loops are contiguous.
  std::vector<uint32_t> order;
  std::vector<SpirvLoop> loops;
  std::vector<std::pair<uint32_t, uint32_t>> labels;  // label id, index of block; sorted
  uint32_t return_count = 0;                          // reachable OpReturn and OpReturnValue
  std::vector<uint32_t> escaping;                     // ids used outside the innermost loop that defines them; sorted

  uint32_t block_of(uint32_t label) const;  // kNoBlock: not of this function
  bool is_header(const SpirvBlock& block) const {
    return block.loop != kNoLoop && loops[block.loop].header == block.position;
  }
};

struct SpirvEntryPoint {
  spv::ExecutionModel model;
  uint32_t function = 0;  // id
  std::string_view name;
  std::vector<uint32_t> interface;
};

class SpirvModule {
 public:
  struct Id {
    uint32_t word = 0;  // defining instruction, 0: none
    uint32_t type = 0;  // id of the result type, 0: none
  };
  struct Decoration {
    uint32_t id;
    uint32_t member;  // kWhole: of the id itself
    spv::Decoration decoration;
    uint32_t literal;  // first literal, or 0
    auto operator<=>(const Decoration&) const = default;
  };
  struct Mode {
    uint32_t function;
    spv::ExecutionMode mode;
    uint32_t word;
  };
  static constexpr uint32_t kWhole = 0xFFFFFFFF;

  SpirvInst at(uint32_t word) const {
    const uint32_t* w = words.data() + word;
    return {static_cast<spv::Op>(w[0] & 0xFFFF), w[0] >> 16, word, w};
  }
  // The instruction that defines an id; any operand of a checked module has one.
  SpirvInst definition(uint32_t id) const { return at(ids[id].word); }
  spv::Op op(uint32_t id) const { return definition(id).op; }
  std::optional<uint32_t> decoration(uint32_t id, uint32_t member, spv::Decoration decoration) const;
  bool has(uint32_t id, spv::Decoration which) const { return decoration(id, kWhole, which).has_value(); }
  bool declares(spv::Capability capability) const {
    return std::find(capabilities.begin(), capabilities.end(), capability) != capabilities.end();
  }
  const SpirvFunction* function(uint32_t id) const;
  std::string name(uint32_t id) const;  // `%12 "color"`
  // "OpFAdd %12 "sum" at word 345 (shader.frag:12): <what>"
  Error error(uint32_t word, const std::string& what) const;

  std::vector<uint32_t> words;  // in the machine's byte order
  std::vector<Id> ids;
  std::vector<Decoration> decorations;  // sorted
  std::vector<SpirvFunction> functions;
  uint32_t functions_start = 0;  // word of the first one
  std::vector<SpirvEntryPoint> entry_points;
  std::vector<Mode> modes;
  std::vector<spv::Capability> capabilities;
  std::vector<uint32_t> globals;  // words of constants, undefs and variables outside functions, in order
  std::vector<std::pair<uint32_t, uint32_t>> names;  // id, word of OpName
};

// Text of a literal string that starts at `words`.
std::string_view spirv_string(const uint32_t* words, uint32_t max_words);

// Reads the body of the function that starts at `word` (OpFunction) and moves `word` behind OpFunctionEnd.
Result<SpirvFunction> read_function(const SpirvModule& module, uint32_t& word);
// Blocks in structured order, loops, reachability; phis fit their predecessors.
// `positions`: memory for check_uses, which the functions share; empty at first.
Result<void> order_blocks(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions);
// Each use of an id is dominated by its definition, in the same function or outside of all; fills `escaping`.
Result<void> check_uses(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions);
// A type's declaration is one that is supported and well formed.
Result<void> check_type(const SpirvModule& module, const SpirvInst& inst);

}  // namespace lapilli
