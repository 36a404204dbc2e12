// Random programs as SPIR-V.
#include <utility>

#include "spirv/random_operations.h"
#include "spirv/random_program.h"

namespace lapilli::conformance::spirv {
namespace {

constexpr uint32_t kParameters = 2, kWords = Program::kInputs + Program::kUniforms;

// One function: its two parameters, then the inputs and uniforms as values; returns a uint.
class FunctionEmitter {
 public:
  FunctionEmitter(Module& m, const Program& program, size_t number, const Words& functions, const Words& results)
      : m_(m), function_(program.functions[number]), functions_(functions) {
    const Id uint = m.uint_type();
    ids_ = m.begin_function(uint, Words(kParameters + kWords, uint));
    const bool is_main = number + 1 == program.functions.size();
    for (size_t i = 0; i < function_.variables.size(); ++i) {
      const Type type = function_.variables[i];
      const bool result = is_main && i < results.size();
      variables_.push_back(result ? results[i] : m.local(type_id(m, type)));
      m.store(variables_.back(), !is_main && i < kParameters ? ids_[1 + i] : constant_id(m, type, 0));
    }
    array_type_ = m.type(spv::Op::OpTypeArray, {uint, m.constant_uint(Program::kArray)});
    array_ = m.local(array_type_);
    m.store(array_, m.type_with_result(spv::Op::OpConstantNull, array_type_, {}));
    if (!block(function_.body)) m.emit_void(spv::Op::OpReturnValue, {m.constant_uint(0)});
    m.end_function();
  }
  Id id() const { return ids_[0]; }

 private:
  void begin(Id label) {
    m_.label(label);
    current_ = label;
  }
  void branch(Id to) { m_.emit_void(spv::Op::OpBranch, {to}); }
  Id masked(Id value, uint32_t mask) {
    return m_.emit(spv::Op::OpBitwiseAnd, m_.uint_type(), {value, m_.constant_uint(mask)});
  }
  Id element(const Expression& index) {
    const Id at = m_.emit(spv::Op::OpUMod, m_.uint_type(), {value(index), m_.constant_uint(Program::kArray)});
    return m_.emit(spv::Op::OpAccessChain, m_.pointer_type(spv::StorageClass::Function, m_.uint_type()), {array_, at});
  }

  Id value(const Expression& e) {
    using Kind = Expression::Kind;
    const Id type = type_id(m_, e.type);
    switch (e.kind) {
      case Kind::constant:
        return constant_id(m_, e.type, e.number);
      case Kind::variable:
        return m_.load(type, variables_[e.number]);
      case Kind::input:
        return ids_[1 + kParameters + e.number];
      case Kind::uniform:
        return ids_[1 + kParameters + Program::kInputs + e.number];
      case Kind::element:
        return m_.load(type, element(*e.operands[0]));
      case Kind::phi:
        return phi(e);
      case Kind::call: {
        Words operands = {functions_[e.number]};
        for (const ExpressionPtr& operand : e.operands) operands.push_back(value(*operand));
        for (uint32_t i = 0; i < kWords; ++i) operands.push_back(ids_[1 + kParameters + i]);
        return m_.emit(spv::Op::OpFunctionCall, type, operands);
      }
      case Kind::operation:
        break;
    }
    Words operands;
    for (const ExpressionPtr& operand : e.operands) operands.push_back(value(*operand));
    return e.operation->emit(m_, operands);
  }

  Id phi(const Expression& e) {
    const Id condition = value(*e.operands[0]);
    const Id sides[] = {m_.new_id(), m_.new_id()}, merge = m_.new_id();
    m_.emit_void(spv::Op::OpSelectionMerge, {merge, 0});
    m_.emit_void(spv::Op::OpBranchConditional, {condition, sides[0], sides[1]});
    Words operands;
    for (size_t i = 0; i < 2; ++i) {
      begin(sides[i]);
      operands.push_back(value(*e.operands[1 + i]));
      operands.push_back(current_);
      branch(merge);
    }
    begin(merge);
    return m_.emit(spv::Op::OpPhi, type_id(m_, e.type), operands);
  }

  // True: the block has been left, nothing follows.
  bool block(const std::vector<Statement>& statements) {
    for (const Statement& s : statements) {
      if (statement(s)) return true;
    }
    return false;
  }

  bool statement(const Statement& s) {
    using Kind = Statement::Kind;
    switch (s.kind) {
      case Kind::assign:
        m_.store(variables_[s.variable], value(*s.value));
        return false;
      case Kind::store_element: {
        const Id to = element(*s.index);
        m_.store(to, value(*s.value));
        return false;
      }
      case Kind::choose:
        return choose(s);
      case Kind::loop:
        loop(s);
        return false;
      case Kind::branch_out:
        branch(s.out_to_header ? continue_ : break_);
        return true;
      case Kind::switch_on:
        return switch_on(s);
      case Kind::leave:
        m_.emit_void(spv::Op::OpReturnValue, {value(*s.value)});
        return true;
    }
    return false;
  }

  // Ends a construct all of whose paths went elsewhere.
  bool merge_at(Id merge, bool reached) {
    begin(merge);
    if (!reached) m_.emit_void(spv::Op::OpUnreachable);
    return !reached;
  }

  bool choose(const Statement& s) {
    const Id condition = value(*s.value), merge = m_.new_id(), yes = m_.new_id();
    const Id no = s.blocks[1].empty() ? merge : m_.new_id();
    m_.emit_void(spv::Op::OpSelectionMerge, {merge, 0});
    m_.emit_void(spv::Op::OpBranchConditional, {condition, yes, no});
    bool reached = no == merge;
    for (size_t i = 0; i < 2; ++i) {
      if (i == 1 && no == merge) break;
      begin(i == 0 ? yes : no);
      if (block(s.blocks[i])) continue;
      branch(merge);
      reached = true;
    }
    return merge_at(merge, reached);
  }

  void loop(const Statement& s) {
    const Id rounds = masked(value(*s.value), 7), counter = variables_[s.variable], uint = m_.uint_type();
    m_.store(counter, m_.constant_uint(0));
    const Id header = m_.new_id(), test = m_.new_id(), body = m_.new_id(), next = m_.new_id(), merge = m_.new_id();
    branch(header);
    begin(header);
    m_.emit_void(spv::Op::OpLoopMerge, {merge, next, 0});
    branch(test);
    begin(test);
    const Id more = m_.emit(spv::Op::OpULessThan, m_.bool_type(), {m_.load(uint, counter), rounds});
    m_.emit_void(spv::Op::OpBranchConditional, {more, body, merge});
    begin(body);
    const Id outer_break = std::exchange(break_, merge), outer_continue = std::exchange(continue_, next);
    if (!block(s.blocks[0])) branch(next);
    break_ = outer_break;
    continue_ = outer_continue;
    begin(next);
    m_.store(counter, m_.emit(spv::Op::OpIAdd, uint, {m_.load(uint, counter), m_.constant_uint(1)}));
    branch(header);
    begin(merge);
  }

  bool switch_on(const Statement& s) {
    const Id selector = masked(value(*s.value), 7), merge = m_.new_id();
    Words labels;
    for (size_t i = 0; i < s.blocks.size(); ++i) labels.push_back(m_.new_id());
    m_.emit_void(spv::Op::OpSelectionMerge, {merge, 0});
    Words operands = {selector, labels.back()};
    for (uint32_t i = 0; i + 1 < labels.size(); ++i) {
      operands.push_back(i);
      operands.push_back(labels[i]);
    }
    m_.emit_void(spv::Op::OpSwitch, operands);
    bool reached = false;
    for (size_t i = 0; i < labels.size(); ++i) {
      begin(labels[i]);
      if (block(s.blocks[i])) continue;
      const bool falls = i + 1 < labels.size() && s.falls_through[i];
      branch(falls ? labels[i + 1] : merge);
      reached = reached || !falls;
    }
    return merge_at(merge, reached);
  }

  Module& m_;
  const Function& function_;
  const Words& functions_;
  Words ids_, variables_;
  Id array_type_ = 0, array_ = 0, current_ = 0, break_ = 0, continue_ = 0;
};

}  // namespace

Snippet snippet_of(const Program& program, const Words& uniforms, uint32_t results) {
  return {Program::kInputs, results,
          [&program, results](Module& m, const Words& inputs) {
            const std::vector<Type>& types = program.functions.back().variables;
            Words functions, outputs, words;
            for (uint32_t i = 0; i < Program::kResults; ++i)
              outputs.push_back(m.variable(spv::StorageClass::Private, type_id(m, types[i])));
            for (size_t i = 0; i < program.functions.size(); ++i)
              functions.push_back(FunctionEmitter(m, program, i, functions, outputs).id());
            Words operands = {functions.back(), m.constant_uint(0), m.constant_uint(0)};
            operands.insert(operands.end(), inputs.begin(), inputs.end());
            m.emit(spv::Op::OpFunctionCall, m.uint_type(), operands);
            for (uint32_t i = 0; i < results; ++i)
              words.push_back(word_id(m, types[i], m.load(type_id(m, types[i]), outputs[i])));
            return words;
          },
          uniforms};
}

}  // namespace lapilli::conformance::spirv
