// Making random programs, running them here, and taking parts out of them.
#include "spirv/random_program.h"

#include <algorithm>
#include <sstream>

#include "spirv/random_operations.h"

namespace lapilli::conformance::spirv {
namespace {

class Generator {
 public:
  explicit Generator(uint32_t seed) : random_(seed) {}

  Program run() {
    const uint32_t helpers = pick(3);
    for (uint32_t i = 0; i <= helpers; ++i) {
      Function function;
      function_ = &function;
      main_ = i == helpers;
      // The results of main, or two parameters; then variables of all types.
      for (uint32_t k = 0; k < (main_ ? Program::kResults : 2); ++k)
        function.variables.push_back(main_ ? Type(pick(kTypes)) : Type::uint);
      for (uint32_t k = 0; k < kTypes; ++k) function.variables.push_back(Type(k));
      function.body = block(3, 3 + pick(6));
      program_.functions.push_back(std::move(function));
    }
    return std::move(program_);
  }

 private:
  uint32_t pick(size_t count) { return uint32_t(random_() % count); }

  ExpressionPtr expression(Type type, uint32_t depth) {
    auto out = std::make_shared<Expression>();
    out->type = type;
    const uint32_t dice = depth == 0 ? pick(4) : pick(16);
    if (dice == 0) {
      out->number = pick(3) == 0 ? uint32_t(random_()) : pick(300);
      return out;
    }
    if (dice == 1 && type == Type::uint) {
      out->kind = pick(3) == 0 ? Expression::Kind::uniform : Expression::Kind::input;
      out->number = pick(out->kind == Expression::Kind::uniform ? Program::kUniforms : Program::kInputs);
      return out;
    }
    if (dice == 4 && type == Type::uint) {
      out->kind = Expression::Kind::element;
      out->operands = {expression(Type::uint, depth - 1)};
      return out;
    }
    if (dice == 5 && type == Type::uint && !program_.functions.empty() && calls_ < kMaxCalls) {
      ++calls_;
      out->kind = Expression::Kind::call;
      out->number = pick(program_.functions.size());
      out->operands = {expression(Type::uint, depth - 1), expression(Type::uint, depth - 1)};
      return out;
    }
    if (dice == 6) {
      out->kind = Expression::Kind::phi;
      out->operands = {expression(Type::boolean, depth - 1), expression(type, depth - 1), expression(type, depth - 1)};
      return out;
    }
    if (dice <= 3 || depth == 0) {
      out->kind = Expression::Kind::variable;
      do {
        out->number = pick(function_->variables.size());
      } while (function_->variables[out->number] != type);
      return out;
    }
    out->kind = Expression::Kind::operation;
    do {
      out->operation = &operations()[pick(operations().size())];
    } while (out->operation->result != type);
    for (const Type operand : out->operation->operands) out->operands.push_back(expression(operand, depth - 1));
    return out;
  }

  // A condition: uniform, constant for many invocations, or divergent.
  ExpressionPtr condition() { return expression(Type::boolean, 3); }

  std::vector<Statement> block(uint32_t depth, uint32_t count) {
    std::vector<Statement> out;
    for (uint32_t i = 0; i < count; ++i) out.push_back(statement(depth));
    return out;
  }

  Statement statement(uint32_t depth) {
    using Kind = Statement::Kind;
    Statement out;
    const uint32_t dice = pick(depth == 0 ? 8 : 14);
    if (dice < 5) {
      out.variable = pick(function_->variables.size());
      out.value = expression(function_->variables[out.variable], 3);
    } else if (dice < 6) {
      out.kind = Kind::store_element;
      out.index = expression(Type::uint, 2);
      out.value = expression(Type::uint, 2);
    } else if (dice < 8) {
      // A way out, behind a condition; without anything to leave, an assignment.
      const bool leave = pick(4) == 0;
      if (!leave && loops_ == 0) return statement(0);
      Statement way_out;
      way_out.kind = leave ? Kind::leave : Kind::branch_out;
      way_out.out_to_header = pick(2) == 0;
      if (leave) way_out.value = expression(Type::uint, 2);
      out.kind = Kind::choose;
      out.value = condition();
      out.blocks.resize(2);
      out.blocks[0].push_back(std::move(way_out));
    } else if (dice < 11) {
      out.kind = Kind::choose;
      out.value = condition();
      out.blocks.push_back(block(depth - 1, 1 + pick(3)));
      out.blocks.push_back(block(depth - 1, pick(3)));
    } else if (dice < 13) {
      out.kind = Kind::loop;
      function_->variables.push_back(Type::uint);  // a counter that nothing else writes
      out.variable = uint32_t(function_->variables.size() - 1);
      counters_.push_back(out.variable);
      out.value = expression(Type::uint, 2);
      ++loops_;
      out.blocks.push_back(block(depth - 1, 1 + pick(4)));
      --loops_;
    } else {
      out.kind = Kind::switch_on;
      out.value = expression(Type::uint, 2);
      const uint32_t cases = 1 + pick(4);
      for (uint32_t i = 0; i < cases; ++i) {
        out.blocks.push_back(block(depth - 1, pick(3)));
        out.falls_through.push_back(i + 1 < cases && pick(3) == 0);
      }
    }
    // Counters are not assigned to, or a loop might not end.
    if (out.kind == Kind::assign && std::find(counters_.begin(), counters_.end(), out.variable) != counters_.end())
      out.variable = main_ ? 0 : 1, out.value = expression(function_->variables[out.variable], 2);
    return out;
  }

  static constexpr uint32_t kMaxCalls = 6;  // calls are inlined
  std::mt19937 random_;
  Program program_;
  Function* function_ = nullptr;
  std::vector<uint32_t> counters_;
  bool main_ = false;
  uint32_t loops_ = 0, calls_ = 0;
};

enum class Flow : uint8_t { on, broke, continued, left };

class Evaluator {
 public:
  Evaluator(const Program& program, const uint32_t* inputs, const uint32_t* uniforms)
      : program_(program), inputs_(inputs), uniforms_(uniforms) {}

  struct Frame {
    std::vector<Value> variables;
    std::array<uint32_t, Program::kArray> array = {};
    uint32_t result = 0;
  };

  Frame call(size_t number, std::array<uint32_t, 2> parameters) {
    const Function& function = program_.functions[number];
    Frame frame;
    frame.variables.resize(function.variables.size());
    if (number + 1 != program_.functions.size()) {
      frame.variables[0] = {parameters[0]};
      frame.variables[1] = {parameters[1]};
    }
    run(function, function.body, frame);
    return frame;
  }

 private:
  Value value(const Expression& e, Frame& frame) {
    using Kind = Expression::Kind;
    switch (e.kind) {
      case Kind::constant:
        return constant_value(e.type, e.number);
      case Kind::variable:
        return frame.variables[e.number];
      case Kind::input:
        return {inputs_[e.number]};
      case Kind::uniform:
        return {uniforms_[e.number]};
      case Kind::element:
        return {frame.array[value(*e.operands[0], frame)[0] % Program::kArray]};
      case Kind::call: {
        const uint32_t first = value(*e.operands[0], frame)[0];
        const uint32_t second = value(*e.operands[1], frame)[0];
        return {call(e.number, {first, second}).result};
      }
      case Kind::phi:
        return value(*e.operands[value(*e.operands[0], frame)[0] != 0 ? 1 : 2], frame);
      case Kind::operation:
        break;
    }
    Value operands[3];
    for (size_t i = 0; i < e.operands.size(); ++i) operands[i] = value(*e.operands[i], frame);
    return e.operation->evaluate(operands);
  }

  Flow run(const Function& function, const std::vector<Statement>& block, Frame& frame) {
    for (const Statement& statement : block) {
      if (const Flow flow = run(function, statement, frame); flow != Flow::on) return flow;
    }
    return Flow::on;
  }

  Flow run(const Function& function, const Statement& s, Frame& frame) {
    using Kind = Statement::Kind;
    switch (s.kind) {
      case Kind::assign:
        frame.variables[s.variable] = value(*s.value, frame);
        return Flow::on;
      case Kind::store_element: {
        const uint32_t index = value(*s.index, frame)[0] % Program::kArray;
        frame.array[index] = value(*s.value, frame)[0];
        return Flow::on;
      }
      case Kind::choose:
        return run(function, s.blocks[value(*s.value, frame)[0] != 0 ? 0 : 1], frame);
      case Kind::loop: {
        const uint32_t rounds = value(*s.value, frame)[0] & 7;
        uint32_t& counter = frame.variables[s.variable][0];
        for (counter = 0; counter < rounds; ++counter) {
          const Flow flow = run(function, s.blocks[0], frame);
          if (flow == Flow::broke) break;
          if (flow == Flow::left) return flow;
        }
        return Flow::on;
      }
      case Kind::branch_out:
        return s.out_to_header ? Flow::continued : Flow::broke;
      case Kind::switch_on: {
        const size_t last = s.blocks.size() - 1;
        for (size_t i = std::min<size_t>(value(*s.value, frame)[0] & 7, last);; ++i) {
          if (const Flow flow = run(function, s.blocks[i], frame); flow != Flow::on) return flow;
          if (i == last || !s.falls_through[i]) return Flow::on;
        }
      }
      case Kind::leave:
        frame.result = value(*s.value, frame)[0];
        return Flow::left;
    }
    return Flow::on;
  }

  const Program& program_;
  const uint32_t* inputs_;
  const uint32_t* uniforms_;
};

void print(std::ostream& out, const Expression& e) {
  using Kind = Expression::Kind;
  static const char* const kNames[] = {"", "v", "input", "uniform", "array", "", "f", "phi"};
  out << (e.kind == Kind::operation ? e.operation->name : kNames[size_t(e.kind)]);
  if (e.kind == Kind::constant || e.kind == Kind::variable || e.kind == Kind::input || e.kind == Kind::uniform ||
      e.kind == Kind::call)
    out << e.number;
  if (e.operands.empty()) return;
  out << '(';
  for (size_t i = 0; i < e.operands.size(); ++i) {
    if (i != 0) out << ", ";
    print(out, *e.operands[i]);
  }
  out << ')';
}

void print(std::ostream& out, const std::vector<Statement>& block, const std::string& indent) {
  using Kind = Statement::Kind;
  static const char* const kNames[] = {"v", "array", "if ", "for v", "", "switch ", "return "};
  for (const Statement& s : block) {
    out << indent << kNames[size_t(s.kind)];
    if (s.kind == Kind::branch_out) out << (s.out_to_header ? "continue" : "break");
    if (s.kind == Kind::assign || s.kind == Kind::loop)
      out << s.variable << (s.kind == Kind::assign ? " = " : " below 7 & ");
    if (s.kind == Kind::store_element) {
      out << '[';
      print(out, *s.index);
      out << "] = ";
    }
    if (s.value) print(out, *s.value);
    out << '\n';
    for (size_t i = 0; i < s.blocks.size(); ++i) {
      if (i != 0)
        out << indent << (s.kind == Kind::choose ? "else\n" : s.falls_through[i - 1] ? "next\n" : "break, next\n");
      print(out, s.blocks[i], indent + "  ");
    }
  }
}

// Calls visit on every block of statements, outer ones first, until it returns true.
bool any_block(std::vector<Statement>& block, const std::function<bool(std::vector<Statement>&)>& visit) {
  if (visit(block)) return true;
  for (Statement& s : block) {
    for (std::vector<Statement>& inner : s.blocks) {
      if (any_block(inner, visit)) return true;
    }
  }
  return false;
}

}  // namespace

Program random_program(uint32_t seed) { return Generator(seed).run(); }

std::array<uint32_t, Program::kResults> evaluate(const Program& program, const uint32_t* inputs,
                                                 const uint32_t* uniforms) {
  const Evaluator::Frame frame = Evaluator(program, inputs, uniforms).call(program.functions.size() - 1, {});
  std::array<uint32_t, Program::kResults> out = {};
  for (uint32_t i = 0; i < out.size(); ++i) out[i] = word_of(program.functions.back().variables[i], frame.variables[i]);
  return out;
}

std::string text_of(const Program& program) {
  std::ostringstream out;
  for (size_t i = 0; i < program.functions.size(); ++i) {
    out << "f" << i << ":\n";
    print(out, program.functions[i].body, "  ");
  }
  return out.str();
}

Program shrink(Program program, const std::function<bool(const Program&)>& fails) {
  bool smaller = true;
  while (smaller) {
    smaller = false;
    for (Function& function : program.functions) {
      smaller |= any_block(function.body, [&](std::vector<Statement>& block) {
        for (size_t i = 0; i < block.size(); ++i) {
          // Without the statement, or with what is in it instead.
          const std::vector<Statement> before = block;
          block.erase(block.begin() + std::ptrdiff_t(i));
          if (fails(program)) return true;
          block = before;
        }
        return false;
      });
    }
  }
  return program;
}

}  // namespace lapilli::conformance::spirv
