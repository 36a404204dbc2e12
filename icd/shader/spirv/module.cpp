// Look-ups in a checked module, and the text of errors.
#include "shader/spirv/module.h"

#include <algorithm>

#include "shader/spirv/grammar.h"

namespace lapilli {

std::optional<uint32_t> SpirvModule::decoration(uint32_t id, uint32_t member, spv::Decoration which) const {
  const Decoration key{id, member, which, 0};
  const auto at = std::lower_bound(decorations.begin(), decorations.end(), key);
  if (at == decorations.end() || at->id != id || at->member != member || at->decoration != which) return std::nullopt;
  return at->literal;
}

const SpirvFunction* SpirvModule::function(uint32_t id) const {
  const auto at = std::ranges::lower_bound(functions, ids[id].word, {}, &SpirvFunction::word);
  return at != functions.end() && at->id == id ? &*at : nullptr;
}

std::string_view spirv_string(const uint32_t* words, uint32_t max_words) {
  const char* text = reinterpret_cast<const char*>(words);
  const size_t size = size_t{max_words} * 4;
  return {text, static_cast<size_t>(std::find(text, text + size, '\0') - text)};
}

std::string SpirvModule::name(uint32_t id) const {
  std::string text = "%" + std::to_string(id);
  const auto at = std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == id; });
  if (at == names.end()) return text;
  const SpirvInst inst = this->at(at->second);
  constexpr size_t kLongestName = 80;
  std::string given(spirv_string(inst.words + 2, inst.count - 2).substr(0, kLongestName));
  for (char& c : given) {
    if (c < ' ' || c > '~') c = '?';
  }
  return given.empty() ? text : text + " \"" + given + '"';
}

Error SpirvModule::error(uint32_t word, const std::string& what) const {
  constexpr uint32_t kFirstInstruction = 5;
  std::string text;
  if (word < kFirstInstruction || word >= words.size()) return {VK_ERROR_UNKNOWN, "SPIR-V: " + what};
  const SpirvInst inst = at(word);
  const SpirvOpInfo* info = find_spirv_op(static_cast<uint32_t>(inst.op));
  text += info != nullptr ? info->name : "opcode " + std::to_string(static_cast<uint32_t>(inst.op));
  const bool whole = info != nullptr && inst.count <= words.size() - word;
  if (whole && info->signature[0] == 't' && info->signature[1] == 'r' && inst.count > 2) text += " " + name(inst[2]);
  if (whole && info->signature[0] == 'r' && inst.count > 1) text += " " + name(inst[1]);
  text += " at word " + std::to_string(word);
  // The last OpLine before it that holds here.
  uint32_t line = 0;
  for (uint32_t w = kFirstInstruction; w < word;) {
    const SpirvInst step = at(w);
    if (step.count == 0 || step.count > words.size() - w) break;
    if (step.op == spv::Op::OpLine && step.count == 4) line = w;
    if (step.op == spv::Op::OpNoLine || step.op == spv::Op::OpFunctionEnd) line = 0;
    w += step.count;
  }
  if (line != 0) {
    const SpirvInst inst_line = at(line);
    const uint32_t file = inst_line[1];
    std::string place = "line " + std::to_string(inst_line[2]);
    if (file < ids.size() && ids[file].word != 0 && op(file) == spv::Op::OpString) {
      const SpirvInst string = definition(file);
      const std::string_view path = spirv_string(string.words + 2, string.count - 2);
      constexpr size_t kLongestPath = 200;
      if (!path.empty() && path.size() <= kLongestPath) place = std::string(path) + ":" + std::to_string(inst_line[2]);
    }
    text += " (" + place + ")";
  }
  return {VK_ERROR_UNKNOWN, "SPIR-V: " + text + ": " + what};
}

}  // namespace lapilli
