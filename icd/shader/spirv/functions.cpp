// Reads a function: parameters, blocks, merge instructions, branch targets.
// Specification: SPIR-V, "Structured Control Flow".
#include <algorithm>

#include "shader/spirv/module.h"

namespace lapilli {
namespace {

bool is_terminator(spv::Op op) { return op >= spv::Op::OpBranch && op <= spv::Op::OpUnreachable; }

bool is_declaration(spv::Op op) {
  const uint32_t code = static_cast<uint32_t>(op);
  return (code >= static_cast<uint32_t>(spv::Op::OpSourceContinued) &&
          code <= static_cast<uint32_t>(spv::Op::OpString)) ||
         (code >= static_cast<uint32_t>(spv::Op::OpExtension) &&
          code <= static_cast<uint32_t>(spv::Op::OpExtInstImport)) ||
         (code >= static_cast<uint32_t>(spv::Op::OpMemoryModel) &&
          code <= static_cast<uint32_t>(spv::Op::OpCapability)) ||
         (code >= static_cast<uint32_t>(spv::Op::OpTypeVoid) &&
          code <= static_cast<uint32_t>(spv::Op::OpSpecConstantOp)) ||
         (code >= static_cast<uint32_t>(spv::Op::OpDecorate) &&
          code <= static_cast<uint32_t>(spv::Op::OpGroupMemberDecorate)) ||
         op == spv::Op::OpFunction || op == spv::Op::OpFunctionParameter;
}

class FunctionReader {
 public:
  FunctionReader(const SpirvModule& module, uint32_t word) : m_(module), word_(word) {}

  Result<SpirvFunction> run() {
    if (Result<void> r = head(); !r) return r.error();
    while (true) {
      if (word_ >= m_.words.size()) return m_.error(function_.word, "has no end");
      const SpirvInst inst = m_.at(word_);
      if (inst.op == spv::Op::OpFunctionEnd) break;
      if (inst.op == spv::Op::OpLine || inst.op == spv::Op::OpNoLine) {
        word_ += inst.count;
        continue;
      }
      if (inst.op != spv::Op::OpLabel) return m_.error(word_, "is outside of a block");
      word_ += inst.count;
      if (Result<void> r = block(inst[1]); !r) return r.error();
    }
    word_ += m_.at(word_).count;
    if (function_.blocks.empty()) return m_.error(function_.word, "has no body");
    for (uint32_t i = 0; i < function_.blocks.size(); ++i) function_.labels.emplace_back(function_.blocks[i].label, i);
    std::sort(function_.labels.begin(), function_.labels.end());
    for (SpirvBlock& each : function_.blocks) {
      if (Result<void> r = link(each); !r) return r.error();
    }
    return std::move(function_);
  }

  uint32_t word() const { return word_; }

 private:
  Result<void> head() {
    const SpirvInst inst = m_.at(word_);
    function_.id = inst[2];
    function_.word = word_;
    const SpirvInst type = m_.definition(inst[4]);
    if (type.op != spv::Op::OpTypeFunction) return m_.error(word_, "its type is no function type");
    if (type[2] != inst[1]) return m_.error(word_, "its result is not that of its type");
    word_ += inst.count;
    for (uint32_t i = 3; i < type.count;) {
      if (word_ >= m_.words.size()) return m_.error(function_.word, "has too few parameters");
      const SpirvInst parameter = m_.at(word_);
      if (parameter.op == spv::Op::OpFunctionParameter) {
        if (parameter[1] != type[i]) return m_.error(word_, "its type is not that of the function's type");
        function_.parameters.push_back(parameter[2]);
        ++i;
      } else if (parameter.op != spv::Op::OpLine && parameter.op != spv::Op::OpNoLine) {
        return m_.error(function_.word, "has too few parameters");
      }
      word_ += parameter.count;
    }
    return {};
  }

  Result<void> block(uint32_t label) {
    SpirvBlock block;
    block.label = label;
    block.first = word_;
    bool phis_allowed = true;
    while (true) {
      if (word_ >= m_.words.size()) return m_.error(function_.word, "ends within a block");
      const SpirvInst inst = m_.at(word_);
      if (is_declaration(inst.op)) return m_.error(word_, "may not be in a block");
      if (inst.op == spv::Op::OpLabel || inst.op == spv::Op::OpFunctionEnd)
        return m_.error(word_, "the block before it has no end");
      if (inst.op == spv::Op::OpPhi && !phis_allowed) return m_.error(word_, "is not at the start of its block");
      if (inst.op == spv::Op::OpVariable && !function_.blocks.empty())
        return m_.error(word_, "is not in the function's first block");
      if (inst.op != spv::Op::OpPhi && inst.op != spv::Op::OpLine && inst.op != spv::Op::OpNoLine) phis_allowed = false;
      word_ += inst.count;
      if (is_terminator(inst.op)) {
        block.terminator = inst.word;
        block.end = word_;
        function_.blocks.push_back(std::move(block));
        return {};
      }
      const bool merges = inst.op == spv::Op::OpLoopMerge || inst.op == spv::Op::OpSelectionMerge;
      if (merges && (word_ >= m_.words.size() || !is_terminator(m_.at(word_).op)))
        return m_.error(inst.word, "is not right before the end of its block");
    }
  }

  // Labels of the merge instruction and the terminator become indices.
  Result<void> link(SpirvBlock& block) const {
    const SpirvInst end = m_.at(block.terminator);
    uint32_t first = 0, step = 1, last = end.count;
    switch (end.op) {
      case spv::Op::OpBranch:
        first = 1;
        break;
      case spv::Op::OpBranchConditional:
        first = 2;
        last = 4;
        break;
      case spv::Op::OpSwitch:
        first = 2;
        step = 2;
        break;
      default:
        first = last;
    }
    for (uint32_t i = first; i < last; i += step) {
      const uint32_t target = function_.block_of(end[i]);
      if (target == kNoBlock) return m_.error(end.word, m_.name(end[i]) + " is no block of this function");
      if (target == 0) return m_.error(end.word, "branches to the function's first block");
      block.successors.push_back(target);
    }
    std::sort(block.successors.begin(), block.successors.end());
    block.successors.erase(std::unique(block.successors.begin(), block.successors.end()), block.successors.end());
    for (uint32_t word = block.first; word < block.terminator; word += m_.at(word).count) {
      const SpirvInst inst = m_.at(word);
      if (inst.op != spv::Op::OpLoopMerge && inst.op != spv::Op::OpSelectionMerge) continue;
      block.merge = function_.block_of(inst[1]);
      const bool loop = inst.op == spv::Op::OpLoopMerge;
      if (loop) block.continue_target = function_.block_of(inst[2]);
      if (block.merge == kNoBlock || (loop && block.continue_target == kNoBlock))
        return m_.error(word, "names no block of this function");
    }
    return {};
  }

  const SpirvModule& m_;
  uint32_t word_;
  SpirvFunction function_;
};

}  // namespace

uint32_t SpirvFunction::block_of(uint32_t label) const {
  const auto at = std::lower_bound(labels.begin(), labels.end(), std::pair<uint32_t, uint32_t>{label, 0});
  return at != labels.end() && at->first == label ? at->second : kNoBlock;
}

Result<SpirvFunction> read_function(const SpirvModule& module, uint32_t& word) {
  FunctionReader reader(module, word);
  Result<SpirvFunction> function = reader.run();
  word = reader.word();
  return function;
}

}  // namespace lapilli
