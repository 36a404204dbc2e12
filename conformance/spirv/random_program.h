// Random programs with structured control flow: what they compute here, and the same as SPIR-V. All arithmetic is exact
// (floats are whole numbers below 2^24), so that every driver must give the same bits.
#pragma once

#include <array>
#include <memory>
#include <random>
#include <string>

#include "spirv/snippet.h"

namespace lapilli::conformance::spirv {

enum class Type : uint8_t { boolean, uint, integer, real, real3, uint2 };
constexpr uint32_t kTypes = 6;
using Value = std::array<uint32_t, 3>;

struct Operation;  // one of a table: types, meaning, SPIR-V
struct Expression;
using ExpressionPtr = std::shared_ptr<const Expression>;

struct Expression {
  enum class Kind : uint8_t { constant, variable, input, uniform, element, operation, call, phi };
  Kind kind = Kind::constant;
  Type type = Type::uint;
  uint32_t number = 0;  // bits of a constant; variable, input, element's array, function
  const Operation* operation = nullptr;
  std::vector<ExpressionPtr> operands;  // of an element: the index; of a phi: condition and the two values
};

struct Statement {
  enum class Kind : uint8_t { assign, store_element, choose, loop, branch_out, switch_on, leave };
  Kind kind = Kind::assign;
  uint32_t variable = 0;                       // assign, loop (its counter), store_element
  bool out_to_header = false;                  // branch_out: continue instead of break
  ExpressionPtr value;                         // assigned; condition; rounds of a loop; selector; returned
  ExpressionPtr index;                         // store_element
  std::vector<std::vector<Statement>> blocks;  // body; then and else; cases, the last being the default
  std::vector<bool> falls_through;             // of a case into the next
};

// A function of two uints and a pointer to a uint of the caller. main has no parameters and returns through `results`.
struct Function {
  std::vector<Type> variables;  // in a function, the first two are its parameters
  std::vector<Statement> body;
};

struct Program {
  static constexpr uint32_t kInputs = 4;    // words that differ between invocations
  static constexpr uint32_t kUniforms = 4;  // words that do not
  static constexpr uint32_t kResults = 6;
  static constexpr uint32_t kArray = 5;  // elements of each function's array
  std::vector<Function> functions;       // the last is main; each calls earlier ones only
};

Program random_program(uint32_t seed);

// What an invocation stores: the variables of main, one word each.
std::array<uint32_t, Program::kResults> evaluate(const Program& program, const uint32_t* inputs,
                                                 const uint32_t* uniforms);

// As a snippet of kInputs inputs; the uniforms are push constants.
Snippet snippet_of(const Program& program, const Words& uniforms, uint32_t results = Program::kResults);

// Source-like text, for messages.
std::string text_of(const Program& program);

// The program with parts taken out for as long as `fails` stays true.
Program shrink(Program program, const std::function<bool(const Program&)>& fails);

}  // namespace lapilli::conformance::spirv
