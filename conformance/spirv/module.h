// Writes SPIR-V modules instruction by instruction, for instructions and shapes that no compiler emits.
#pragma once

#include <spirv/unified1/GLSL.std.450.h>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <string_view>
#include <vector>

namespace lapilli::conformance::spirv {

using Id = uint32_t;
using Words = std::vector<uint32_t>;

class Module {
 public:
  Module();

  Id new_id() { return next_id_++; }

  // Types and constants: the same id for the same one.
  Id type(spv::Op op, std::initializer_list<uint32_t> operands = {});
  Id void_type() { return type(spv::Op::OpTypeVoid); }
  Id bool_type() { return type(spv::Op::OpTypeBool); }
  Id int_type() { return type(spv::Op::OpTypeInt, {32, 1}); }
  Id uint_type() { return type(spv::Op::OpTypeInt, {32, 0}); }
  Id float_type() { return type(spv::Op::OpTypeFloat, {32}); }
  Id vector_type(Id component, uint32_t count) {
    return count == 1 ? component : type(spv::Op::OpTypeVector, {component, count});
  }
  Id matrix_type(Id column, uint32_t count) { return type(spv::Op::OpTypeMatrix, {column, count}); }
  Id pointer_type(spv::StorageClass storage, Id to) {
    return type(spv::Op::OpTypePointer, {static_cast<uint32_t>(storage), to});
  }
  Id constant(Id of_type, uint32_t bits) { return type_with_result(spv::Op::OpConstant, of_type, {bits}); }
  Id constant_uint(uint32_t value) { return constant(uint_type(), value); }
  Id constant_bool(bool value) {
    return type_with_result(value ? spv::Op::OpConstantTrue : spv::Op::OpConstantFalse, bool_type(), {});
  }
  // A module-scope instruction `op type result operands`.
  Id type_with_result(spv::Op op, Id result_type, std::initializer_list<uint32_t> operands);
  Id variable(spv::StorageClass storage, Id of_type);  // module scope; part of the interface if Input or Output
  // A variable of the function that is being written.
  Id local(Id of_type);

  void capability(spv::Capability capability);
  Id glsl();  // the import of GLSL.std.450
  void decorate(std::initializer_list<uint32_t> operands) { put(annotations_, spv::Op::OpDecorate, operands); }
  void decorate_member(std::initializer_list<uint32_t> operands) {
    put(annotations_, spv::Op::OpMemberDecorate, operands);
  }

  // Body of the function that is being written.
  Id emit(spv::Op op, Id result_type, std::span<const uint32_t> operands);
  Id emit(spv::Op op, Id result_type, std::initializer_list<uint32_t> operands) {
    return emit(op, result_type, std::span(operands.begin(), operands.size()));
  }
  void emit_void(spv::Op op, std::initializer_list<uint32_t> operands = {}) { put(body_, op, operands); }
  void emit_void(spv::Op op, const Words& operands) { put(body_, op, operands); }
  Id label();  // a new block begins here
  void label(Id id) { emit_void(spv::Op::OpLabel, {id}); }
  Id composite(Id of_type, const Words& parts) { return emit(spv::Op::OpCompositeConstruct, of_type, parts); }
  Id extract(Id of_type, Id from, uint32_t index) { return emit(spv::Op::OpCompositeExtract, of_type, {from, index}); }
  Id ext(uint32_t instruction, Id result_type, const Words& operands);
  Id load(Id of_type, Id pointer) { return emit(spv::Op::OpLoad, of_type, {pointer}); }
  void store(Id pointer, Id value) { emit_void(spv::Op::OpStore, {pointer, value}); }

  // A function before main: its id, then those of the parameters. What is emitted until end_function() goes there;
  // every path has to return. main may be half written.
  Words begin_function(Id result_type, const Words& parameter_types);
  void end_function();

  // void main(): everything emitted since the last function. begin_main() opens it, finish() closes it.
  void begin_main();
  Words finish(spv::ExecutionModel model, uint32_t local_size = 64);

 private:
  void put(Words& to, spv::Op op, std::span<const uint32_t> operands);
  void put(Words& to, spv::Op op, std::initializer_list<uint32_t> operands) {
    put(to, op, std::span(operands.begin(), operands.size()));
  }

  Id next_id_ = 1;
  Id main_ = 0, glsl_ = 0;
  std::map<Words, Id> known_;
  Words saved_locals_, saved_body_;  // of main, while another function is written
  Words capabilities_, annotations_, globals_, functions_, locals_, body_, interface_;
};

}  // namespace lapilli::conformance::spirv
