// Reads a SPIR-V binary: header, instructions against the grammar, ids, module-level declarations, functions.
// Whatever is wrong here fails vkCreateShaderModule; what the lowering alone can judge fails the pipeline.
#include <algorithm>

#include "shader/spirv/grammar.h"
#include "shader/spirv/module.h"
#include "shader/stage.h"

namespace lapilli {
namespace {

constexpr uint32_t kHeaderWords = 5;
constexpr uint32_t kMaxWords = 1 << 24;
constexpr uint32_t kMaxBound = 1 << 22;      // SPIR-V, "Universal Limits"
constexpr size_t kMaxDecorations = 1 << 20;  // after groups are expanded
constexpr uint32_t kMaxTypeDepth = 100;
constexpr uint32_t kMaxCallDepth = 100;
constexpr uint32_t kVersion10 = 0x00010000, kVersion13 = 0x00010300;

constexpr spv::Capability kCapabilities[] = {
    spv::Capability::Matrix,
    spv::Capability::Shader,
    spv::Capability::ClipDistance,
    spv::Capability::CullDistance,
    spv::Capability::SampleRateShading,
    spv::Capability::InterpolationFunction,
    spv::Capability::ImageQuery,
    spv::Capability::ImageGatherExtended,
    spv::Capability::SampledBuffer,
    spv::Capability::ImageBuffer,
    spv::Capability::StorageImageExtendedFormats,
    spv::Capability::StorageImageReadWithoutFormat,
    spv::Capability::StorageImageWriteWithoutFormat,
    spv::Capability::StorageImageArrayDynamicIndexing,
    spv::Capability::DerivativeControl,
    spv::Capability::DrawParameters,
    spv::Capability::UniformBufferArrayDynamicIndexing,
    spv::Capability::SampledImageArrayDynamicIndexing,
    spv::Capability::StorageBufferArrayDynamicIndexing,
};

constexpr std::string_view kExtensions[] = {"SPV_KHR_storage_buffer_storage_class", "SPV_KHR_non_semantic_info",
                                            "SPV_KHR_shader_draw_parameters",       "SPV_GOOGLE_decorate_string",
                                            "SPV_GOOGLE_hlsl_functionality1",       "SPV_GOOGLE_user_type"};

// Decorations whose first literal the driver reads.
constexpr spv::Decoration kWithLiteral[] = {spv::Decoration::SpecId,        spv::Decoration::ArrayStride,
                                            spv::Decoration::MatrixStride,  spv::Decoration::BuiltIn,
                                            spv::Decoration::Location,      spv::Decoration::Component,
                                            spv::Decoration::Index,         spv::Decoration::Binding,
                                            spv::Decoration::DescriptorSet, spv::Decoration::Offset};

template <class Table, class T>
bool contains(const Table& table, const T& value) {
  return std::find(std::begin(table), std::end(table), value) != std::end(table);
}

bool is_type(spv::Op op) { return op >= spv::Op::OpTypeVoid && op <= spv::Op::OpTypeForwardPointer; }
bool is_constant(spv::Op op) { return op >= spv::Op::OpConstantTrue && op <= spv::Op::OpSpecConstantOp; }

class Parser {
 public:
  explicit Parser(SpirvModule& module) : m_(module) {}

  Result<void> run() {
    if (Result<void> r = collect_ids(); !r) return r;
    type_depth_.resize(m_.ids.size());
    for (uint32_t word = kHeaderWords; word < m_.words.size();) {
      const SpirvInst inst = m_.at(word);
      if (inst.op == spv::Op::OpFunction) {
        if (m_.functions_start == 0) m_.functions_start = word;
        Result<SpirvFunction> function = read_function(m_, word);
        if (!function) return function.error();
        m_.functions.push_back(std::move(*function));
        continue;
      }
      if (Result<void> r = declaration(inst); !r) return r;
      word += inst.count;
    }
    if (!memory_model_) return Error{VK_ERROR_UNKNOWN, "SPIR-V: the module has no OpMemoryModel"};
    std::sort(m_.decorations.begin(), m_.decorations.end());
    if (Result<void> r = expand_groups(); !r) return r;
    std::sort(m_.decorations.begin(), m_.decorations.end());
    std::vector<uint32_t> positions;
    for (SpirvFunction& function : m_.functions) {
      if (Result<void> r = order_blocks(m_, function, positions); !r) return r;
    }
    return check_entry_points_and_calls();
  }

 private:
  Error error(const SpirvInst& inst, const std::string& what) const { return m_.error(inst.word, what); }

  // Lengths, opcodes, operand counts and results of all instructions; then that all operands exist.
  Result<void> collect_ids() {
    const uint32_t size = static_cast<uint32_t>(m_.words.size());
    const uint32_t bound = m_.words[3];
    if (bound == 0 || bound > kMaxBound) return Error{VK_ERROR_UNKNOWN, "SPIR-V: absurd bound of ids"};
    m_.ids.resize(bound);
    for (uint32_t word = kHeaderWords; word < size;) {
      const SpirvInst inst = m_.at(word);
      const SpirvOpInfo* info = find_spirv_op(static_cast<uint32_t>(inst.op));
      if (info == nullptr) return error(inst, "there is no such instruction");
      if (inst.count == 0 || inst.count > size - word) return error(inst, "its length leaves the module");
      uint32_t result = 0, type = 0;
      const bool fits = walk_operands(info->signature, inst.words, inst.count, 1, [&](OperandKind kind, uint32_t at) {
        if (kind == OperandKind::result) result = inst[at];
        if (kind == OperandKind::type) type = inst[at];
      });
      if (!fits) return error(inst, "it has too few or too many operands");
      if (info->signature[0] == 'r' || (info->signature[0] == 't' && info->signature[1] == 'r')) {
        if (result == 0 || result >= bound) return error(inst, "its result is not below the bound");
        if (m_.ids[result].word != 0) return error(inst, "its result is already defined");
        m_.ids[result] = {word, type};
      }
      word += inst.count;
    }
    for (uint32_t word = kHeaderWords; word < size; word += m_.at(word).count) {
      if (Result<void> r = check_ids(m_.at(word)); !r) return r;
    }
    return {};
  }

  Result<void> check_ids(const SpirvInst& inst) const {
    if (inst.op == spv::Op::OpName || inst.op == spv::Op::OpMemberName) return {};  // strippers leave some behind
    uint32_t bad = 0;
    const char* what = nullptr;
    walk_operands(find_spirv_op(static_cast<uint32_t>(inst.op))->signature, inst.words, inst.count, 1,
                  [&](OperandKind kind, uint32_t at) {
                    if (kind != OperandKind::id && kind != OperandKind::type) return;
                    const uint32_t id = inst[at];
                    if (id >= m_.ids.size() || m_.ids[id].word == 0) {
                      bad = id;
                      what = " is not defined";
                    } else if (kind == OperandKind::type && !is_type(m_.op(id))) {
                      bad = id;
                      what = " is no type";
                    }
                  });
    if (what != nullptr) return error(inst, "%" + std::to_string(bad) + what);
    return {};
  }

  // One instruction outside functions.
  Result<void> declaration(const SpirvInst& inst) {
    if (is_type(inst.op)) return type(inst);
    if (is_constant(inst.op)) return global(inst);
    switch (inst.op) {
      case spv::Op::OpNop:
      case spv::Op::OpLine:
      case spv::Op::OpNoLine:
      case spv::Op::OpSource:
      case spv::Op::OpSourceContinued:
      case spv::Op::OpSourceExtension:
      case spv::Op::OpString:
      case spv::Op::OpMemberName:
      case spv::Op::OpModuleProcessed:
      case spv::Op::OpDecorationGroup:
      case spv::Op::OpDecorateId:
      case spv::Op::OpDecorateString:
      case spv::Op::OpMemberDecorateString:
        return {};
      case spv::Op::OpName:
        m_.names.emplace_back(inst[1], inst.word);
        return {};
      case spv::Op::OpCapability:
        m_.capabilities.push_back(static_cast<spv::Capability>(inst[1]));
        if (contains(kCapabilities, m_.capabilities.back())) return {};
        return error(inst, "capability " + spirv_enum_name(SpirvEnum::Capability, inst[1]) + " is not supported");
      case spv::Op::OpExtension: {
        const std::string_view name = spirv_string(inst.words + 1, inst.count - 1);
        if (contains(kExtensions, name)) return {};
        return error(inst, "extension " + std::string(name.substr(0, 100)) + " is not supported");
      }
      case spv::Op::OpExtInstImport: {
        const std::string_view name = spirv_string(inst.words + 2, inst.count - 2);
        if (name == "GLSL.std.450" || name.starts_with("NonSemantic.")) return {};
        return error(inst, "instruction set " + std::string(name.substr(0, 100)) + " is not supported");
      }
      case spv::Op::OpExtInst:
        if (non_semantic(inst)) return {};
        return error(inst, "is outside of a function");
      case spv::Op::OpMemoryModel:
        memory_model_ = true;
        if (static_cast<spv::AddressingModel>(inst[1]) != spv::AddressingModel::Logical)
          return error(inst, "only the addressing model Logical is supported");
        if (inst[2] > static_cast<uint32_t>(spv::MemoryModel::GLSL450))
          return error(inst, "only the memory model GLSL450 is supported");
        return {};
      case spv::Op::OpEntryPoint:
        return entry_point(inst);
      case spv::Op::OpExecutionMode:
      case spv::Op::OpExecutionModeId:
        m_.modes.push_back({inst[1], static_cast<spv::ExecutionMode>(inst[2]), inst.word});
        return {};
      case spv::Op::OpDecorate:
      case spv::Op::OpMemberDecorate:
        return decorate(inst);
      case spv::Op::OpGroupDecorate:
      case spv::Op::OpGroupMemberDecorate:
        groups_.push_back(inst.word);
        return {};
      case spv::Op::OpUndef:
      case spv::Op::OpVariable:
        return global(inst);
      default:
        return error(inst, "is not supported outside of a function");
    }
  }

  bool non_semantic(const SpirvInst& inst) const {
    const SpirvInst set = m_.definition(inst[3]);
    return set.op == spv::Op::OpExtInstImport && spirv_string(set.words + 2, set.count - 2).starts_with("NonSemantic.");
  }

  // Declarations refer to earlier ones only: so types cannot contain themselves.
  Result<void> check_backwards(const SpirvInst& inst) const {
    bool forward = false;
    walk_operands(find_spirv_op(static_cast<uint32_t>(inst.op))->signature, inst.words, inst.count, 1,
                  [&](OperandKind kind, uint32_t at) {
                    if (kind == OperandKind::id || kind == OperandKind::type)
                      forward |= m_.ids[inst[at]].word >= inst.word;
                  });
    if (forward) return error(inst, "an operand is declared further down");
    return {};
  }

  Result<void> type(const SpirvInst& inst) {
    if (inst.op == spv::Op::OpTypeForwardPointer) return error(inst, "is not supported");
    if (Result<void> r = check_backwards(inst); !r) return r;
    uint32_t depth = 0;
    for (uint32_t i = 2; i < inst.count; ++i) {
      if (inst[i] < type_depth_.size() && inst.op != spv::Op::OpTypeInt && inst.op != spv::Op::OpTypeFloat)
        depth = std::max(depth, type_depth_[inst[i]]);
    }
    if (depth >= kMaxTypeDepth) return error(inst, "is nested too deeply");
    type_depth_[inst[1]] = depth + 1;
    return check_type(m_, inst);
  }

  Result<void> global(const SpirvInst& inst) {
    if (Result<void> r = check_backwards(inst); !r) return r;
    m_.globals.push_back(inst.word);
    return {};
  }

  Result<void> entry_point(const SpirvInst& inst) {
    SpirvEntryPoint entry;
    entry.model = static_cast<spv::ExecutionModel>(inst[1]);
    entry.function = inst[2];
    entry.name = spirv_string(inst.words + 3, inst.count - 3);
    const uint32_t first = 3 + static_cast<uint32_t>(entry.name.size() / 4) + 1;
    entry.interface.assign(inst.words + first, inst.words + inst.count);
    if (m_.op(entry.function) != spv::Op::OpFunction) return error(inst, "names no function");
    for (const uint32_t id : entry.interface) {
      if (m_.op(id) != spv::Op::OpVariable) return error(inst, m_.name(id) + " is no variable");
    }
    m_.entry_points.push_back(std::move(entry));
    return {};
  }

  Result<void> decorate(const SpirvInst& inst) {
    const bool of_member = inst.op == spv::Op::OpMemberDecorate;
    const uint32_t at = of_member ? 3 : 2;
    SpirvModule::Decoration entry{inst[1], of_member ? inst[2] : SpirvModule::kWhole,
                                  static_cast<spv::Decoration>(inst[at]), inst.count > at + 1 ? inst[at + 1] : 0};
    if (contains(kWithLiteral, entry.decoration) && inst.count != at + 2)
      return error(inst, spirv_enum_name(SpirvEnum::Decoration, inst[at]) + " needs one literal");
    m_.decorations.push_back(entry);
    return {};
  }

  Result<void> expand_groups() {
    const auto own = static_cast<std::ptrdiff_t>(m_.decorations.size());
    for (const uint32_t word : groups_) {
      const SpirvInst inst = m_.at(word);
      const bool of_members = inst.op == spv::Op::OpGroupMemberDecorate;
      std::vector<SpirvModule::Decoration> group;
      const auto end = m_.decorations.begin() + own;
      for (auto at = std::lower_bound(m_.decorations.begin(), end, SpirvModule::Decoration{inst[1], 0, {}, 0});
           at != end && at->id == inst[1]; ++at)
        group.push_back(*at);
      for (uint32_t i = 2; i < inst.count; i += of_members ? 2 : 1) {
        if (m_.decorations.size() + group.size() > kMaxDecorations) return error(inst, "makes too many decorations");
        for (SpirvModule::Decoration entry : group) {
          entry.id = inst[i];
          if (of_members) entry.member = inst[i + 1];
          m_.decorations.push_back(entry);
        }
      }
    }
    return {};
  }

  // Functions exist, and the call graph has no circle and is not too deep.
  Result<void> check_entry_points_and_calls() const {
    std::vector<uint32_t> index(m_.ids.size(), kNoBlock);
    for (uint32_t i = 0; i < m_.functions.size(); ++i) index[m_.functions[i].id] = i;
    std::vector<std::vector<uint32_t>> calls(m_.functions.size());
    std::vector<uint32_t> callers(m_.functions.size());
    for (uint32_t i = 0; i < m_.functions.size(); ++i) {
      for (const SpirvBlock& block : m_.functions[i].blocks) {
        for (uint32_t word = block.first; word < block.end; word += m_.at(word).count) {
          const SpirvInst inst = m_.at(word);
          if (inst.op != spv::Op::OpFunctionCall) continue;
          if (index[inst[3]] == kNoBlock) return error(inst, "calls what is no function");
          calls[i].push_back(index[inst[3]]);
          ++callers[index[inst[3]]];
        }
      }
    }
    std::vector<uint32_t> ready, depth(m_.functions.size(), 1);
    for (uint32_t i = 0; i < m_.functions.size(); ++i) {
      if (callers[i] == 0) ready.push_back(i);
    }
    for (size_t next = 0; next < ready.size(); ++next) {
      const uint32_t function = ready[next];
      if (depth[function] > kMaxCallDepth) return m_.error(m_.functions[function].word, "calls are nested too deeply");
      for (const uint32_t callee : calls[function]) {
        depth[callee] = std::max(depth[callee], depth[function] + 1);
        if (--callers[callee] == 0) ready.push_back(callee);
      }
    }
    for (uint32_t i = 0; i < m_.functions.size(); ++i) {
      if (callers[i] != 0) return m_.error(m_.functions[i].word, "is part of a recursion");
    }
    return {};
  }

  SpirvModule& m_;
  std::vector<uint32_t> type_depth_;
  std::vector<uint32_t> groups_;
  bool memory_model_ = false;
};

}  // namespace

Result<std::shared_ptr<const SpirvModule>> parse_spirv(std::span<const uint32_t> words) {
  const auto refuse = [](const char* why) { return Error{VK_ERROR_UNKNOWN, std::string("SPIR-V: ") + why}; };
  if (words.size() < kHeaderWords) return refuse("shorter than its header");
  if (words.size() > kMaxWords) return refuse("absurdly long");
  const bool swapped = words[0] == __builtin_bswap32(spv::MagicNumber);
  if (words[0] != spv::MagicNumber && !swapped) return refuse("wrong magic number");
  auto module = std::make_shared<SpirvModule>();
  module->words.assign(words.begin(), words.end());
  if (swapped) {
    for (uint32_t& word : module->words) word = __builtin_bswap32(word);
  }
  const uint32_t version = module->words[1];
  if (version < kVersion10 || version > kVersion13 || (version & 0xFF0000FF) != 0)
    return Error{VK_ERROR_UNKNOWN, "SPIR-V: version " + std::to_string(version >> 16) + "." +
                                       std::to_string(version >> 8 & 0xFF) + " is not supported (1.0 to 1.3 are)"};
  if (Result<void> r = Parser(*module).run(); !r) return r.error();
  return std::shared_ptr<const SpirvModule>(std::move(module));
}

}  // namespace lapilli
