// The operations that random programs are made of.
#pragma once

#include <span>

#include "spirv/random_program.h"

namespace lapilli::conformance::spirv {

struct Operation {
  const char* name;
  Type result;
  std::vector<Type> operands;
  Value (*evaluate)(const Value* operands);
  Id (*emit)(Module& module, const Words& operands);
};

std::span<const Operation> operations();

Id type_id(Module& module, Type type);
// One word of any value, to look at it: floats and vectors mixed into one.
uint32_t word_of(Type type, const Value& value);
Id word_id(Module& module, Type type, Id value);
// Constants: the number that `bits` makes of each type.
Value constant_value(Type type, uint32_t bits);
Id constant_id(Module& module, Type type, uint32_t bits);

}  // namespace lapilli::conformance::spirv
