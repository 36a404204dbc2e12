// See module.h. Specification: SPIR-V, "Logical Layout of a Module".
#include "spirv/module.h"

#include <string>

namespace lapilli::conformance::spirv {
namespace {

Words string_words(std::string_view text) {
  Words words(text.size() / 4 + 1);
  for (size_t i = 0; i < text.size(); ++i) words[i / 4] |= uint32_t(uint8_t(text[i])) << (i % 4 * 8);
  return words;
}

}  // namespace

Module::Module() { capability(spv::Capability::Shader); }

void Module::put(Words& to, spv::Op op, std::span<const uint32_t> operands) {
  to.push_back(uint32_t(operands.size() + 1) << 16 | uint32_t(op));
  to.insert(to.end(), operands.begin(), operands.end());
}

Id Module::type(spv::Op op, std::initializer_list<uint32_t> operands) {
  Words key = {uint32_t(op)};
  key.insert(key.end(), operands.begin(), operands.end());
  Id& id = known_[key];
  if (id != 0) return id;
  id = new_id();
  Words words = {id};
  words.insert(words.end(), operands.begin(), operands.end());
  put(globals_, op, words);
  return id;
}

Id Module::type_with_result(spv::Op op, Id result_type, std::initializer_list<uint32_t> operands) {
  Words key = {uint32_t(op), result_type};
  key.insert(key.end(), operands.begin(), operands.end());
  Id& id = known_[key];
  if (id != 0) return id;
  id = new_id();
  Words words = {result_type, id};
  words.insert(words.end(), operands.begin(), operands.end());
  put(globals_, op, words);
  return id;
}

Id Module::variable(spv::StorageClass storage, Id of_type) {
  const Id pointer = pointer_type(storage, of_type), id = new_id();
  put(globals_, spv::Op::OpVariable, {pointer, id, uint32_t(storage)});
  if (storage == spv::StorageClass::Input || storage == spv::StorageClass::Output) interface_.push_back(id);
  return id;
}

Id Module::local(Id of_type) {
  const Id pointer = pointer_type(spv::StorageClass::Function, of_type), id = new_id();
  put(locals_, spv::Op::OpVariable, {pointer, id, uint32_t(spv::StorageClass::Function)});
  return id;
}

void Module::capability(spv::Capability capability) {
  put(capabilities_, spv::Op::OpCapability, {uint32_t(capability)});
}

Id Module::glsl() {
  if (glsl_ == 0) glsl_ = new_id();
  return glsl_;
}

Id Module::emit(spv::Op op, Id result_type, std::span<const uint32_t> operands) {
  const Id id = new_id();
  Words words = {result_type, id};
  words.insert(words.end(), operands.begin(), operands.end());
  put(body_, op, words);
  return id;
}

Id Module::label() {
  const Id id = new_id();
  label(id);
  return id;
}

Id Module::ext(uint32_t instruction, Id result_type, const Words& operands) {
  Words words = {glsl(), instruction};
  words.insert(words.end(), operands.begin(), operands.end());
  return emit(spv::Op::OpExtInst, result_type, words);
}

Words Module::begin_function(Id result_type, const Words& parameter_types) {
  Words key = {uint32_t(spv::Op::OpTypeFunction), result_type};
  key.insert(key.end(), parameter_types.begin(), parameter_types.end());
  Id& type = known_[key];
  if (type == 0) {
    type = new_id();
    Words words = {type};
    words.insert(words.end(), key.begin() + 1, key.end());
    put(globals_, spv::Op::OpTypeFunction, words);
  }
  locals_.swap(saved_locals_);
  body_.swap(saved_body_);
  Words ids = {new_id()};
  put(functions_, spv::Op::OpFunction, {result_type, ids[0], 0, type});
  for (const Id parameter : parameter_types) {
    ids.push_back(new_id());
    put(functions_, spv::Op::OpFunctionParameter, {parameter, ids.back()});
  }
  put(functions_, spv::Op::OpLabel, {new_id()});
  return ids;
}

void Module::end_function() {
  functions_.insert(functions_.end(), locals_.begin(), locals_.end());
  functions_.insert(functions_.end(), body_.begin(), body_.end());
  put(functions_, spv::Op::OpFunctionEnd, {});
  locals_.swap(saved_locals_);
  body_.swap(saved_body_);
  saved_locals_.clear();
  saved_body_.clear();
}

void Module::begin_main() { main_ = new_id(); }

Words Module::finish(spv::ExecutionModel model, uint32_t local_size) {
  const Id function_type = type(spv::Op::OpTypeFunction, {void_type()}), result = void_type(), first_block = new_id();
  Words out = {spv::MagicNumber, 0x10000, 0, 0, 0};
  const auto append = [&](const Words& words) { out.insert(out.end(), words.begin(), words.end()); };
  append(capabilities_);
  if (glsl_ != 0) {
    Words import = {glsl_};
    const Words name = string_words("GLSL.std.450");
    import.insert(import.end(), name.begin(), name.end());
    put(out, spv::Op::OpExtInstImport, import);
  }
  put(out, spv::Op::OpMemoryModel, {uint32_t(spv::AddressingModel::Logical), uint32_t(spv::MemoryModel::GLSL450)});
  Words entry = {uint32_t(model), main_};
  const Words name = string_words("main");
  entry.insert(entry.end(), name.begin(), name.end());
  entry.insert(entry.end(), interface_.begin(), interface_.end());
  put(out, spv::Op::OpEntryPoint, entry);
  if (model == spv::ExecutionModel::GLCompute)
    put(out, spv::Op::OpExecutionMode, {main_, uint32_t(spv::ExecutionMode::LocalSize), local_size, 1, 1});
  if (model == spv::ExecutionModel::Fragment)
    put(out, spv::Op::OpExecutionMode, {main_, uint32_t(spv::ExecutionMode::OriginUpperLeft)});
  append(annotations_);
  append(globals_);
  append(functions_);
  put(out, spv::Op::OpFunction, {result, main_, 0, function_type});
  put(out, spv::Op::OpLabel, {first_block});
  append(locals_);
  append(body_);
  put(out, spv::Op::OpReturn, {});
  put(out, spv::Op::OpFunctionEnd, {});
  out[3] = next_id_;
  return out;
}

}  // namespace lapilli::conformance::spirv
