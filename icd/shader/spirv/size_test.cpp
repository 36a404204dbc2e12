// Large modules, of shapes in which each part has to do with many others: they become programs, or are refused, in a
// time that grows with their length. (Where it grew with the square, each of these took a minute or an hour.)
#include "shader/program.h"
#include "shader/spirv/test/assembler.h"

namespace lapilli {
namespace {

using spv::Op;

// Storage classes.
constexpr uint32_t kShared = 4, kFunction = 7, kPushConstant = 9;

struct LargeModule : Assembler {
  uint32_t next = kFree;
  uint32_t truth, lie, push, shared_word, function_word, word, condition;

  LargeModule() {
    bound = 1 << 22;
    const uint32_t block = id(), block_pointer = id(), push_word = id(), boolean = id(), push_block = id();
    add(annotations, Op::OpDecorate, {block, static_cast<uint32_t>(spv::Decoration::Block)});
    add(annotations, Op::OpMemberDecorate, {block, 0, static_cast<uint32_t>(spv::Decoration::Offset), 0});
    add(globals, Op::OpTypeStruct, {block, kUint});
    add(globals, Op::OpTypePointer, {block_pointer, kPushConstant, block});
    add(globals, Op::OpTypePointer, {push_word, kPushConstant, kUint});
    add(globals, Op::OpTypePointer, {shared_word = id(), kShared, kUint});
    add(globals, Op::OpTypePointer, {function_word = id(), kFunction, kUint});
    add(globals, Op::OpTypeBool, {boolean});
    add(globals, Op::OpConstantTrue, {boolean, truth = id()});
    add(globals, Op::OpConstantFalse, {boolean, lie = id()});
    add(globals, Op::OpConstantNull, {kUint, push = id()});
    add(globals, Op::OpVariable, {block_pointer, push_block, kPushConstant});
    push_block_ = push_block;
    push_word_ = push_word;
    boolean_ = boolean;
  }

  uint32_t id() { return next++; }
  uint32_t shared(uint32_t type) {
    const uint32_t variable = id();
    add(globals, Op::OpVariable, {type, variable, kShared});
    return variable;
  }
  // A number and a condition that the driver cannot know.
  void load_unknown(std::vector<uint32_t>& code) {
    const uint32_t pointer = id();
    word = id();
    condition = id();
    add(code, Op::OpAccessChain, {push_word_, pointer, push_block_, push});
    add(code, Op::OpLoad, {kUint, word, pointer});
    add(code, Op::OpIEqual, {boolean_, condition, word, kOne});
  }
  // main calls a function `times` times, whose code goes to `functions`, up to its OpReturn.
  void begin_function(uint32_t times) {
    const uint32_t function = id();
    for (uint32_t i = 0; i < times; ++i) add(body, Op::OpFunctionCall, {kVoid, id(), function});
    add(functions, Op::OpFunction, {kVoid, function, 0, kFunctionType});
    label(functions);
  }
  void end_function() {
    add(functions, Op::OpReturn, {});
    add(functions, Op::OpFunctionEnd, {});
  }
  uint32_t label(std::vector<uint32_t>& code) {
    add(code, Op::OpLabel, {next});
    return next++;
  }
  // A switch over the unknown word, and the block behind it; each case does what `fill` appends, the first one is the
  // default. Labels of the cases.
  std::vector<uint32_t> make_switch(std::vector<uint32_t>& code, uint32_t cases, const std::function<void()>& fill) {
    const uint32_t merge = id(), first = next;
    next += cases;
    std::vector<uint32_t> labels, operands{word, first};
    for (uint32_t i = 0; i < cases; ++i) {
      labels.push_back(first + i);
      operands.insert(operands.end(), {i, first + i});
    }
    add(code, Op::OpSelectionMerge, {merge, 0});
    add(code, Op::OpSwitch, operands);
    for (const uint32_t each : labels) {
      add(code, Op::OpLabel, {each});
      fill();
      add(code, Op::OpBranch, {merge});
    }
    add(code, Op::OpLabel, {merge});
    return labels;
  }

  // What is wrong with the module; nothing if it becomes a program.
  std::string outcome() const {
    const Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words());
    if (!module) return module.error().message;
    Result<Code> code = make_compute_code({*module, "main", {}}, {});
    if (!code) return code.error().message;
    const Result<ProgramPtr> program = assemble(std::move(*code));
    return program.ok() ? "" : program.error().message;
  }

 private:
  uint32_t push_block_, push_word_, boolean_;
};

void expect_too_large(const LargeModule& module) {
  const std::string text = module.outcome();
  EXPECT_NE(text.find("the program is too large"), std::string::npos) << text;
}

TEST(SpirvSize, ManyLoops) {
  LargeModule m;
  m.begin_function(20);
  m.load_unknown(m.functions);
  for (uint32_t i = 0; i < 3000; ++i) {
    const uint32_t header = m.id(), merge = m.id(), next = m.id();
    m.add(m.functions, Op::OpBranch, {header});
    m.add(m.functions, Op::OpLabel, {header});
    m.add(m.functions, Op::OpLoopMerge, {merge, next, 0});
    m.add(m.functions, Op::OpBranchConditional, {m.condition, next, merge});
    m.add(m.functions, Op::OpLabel, {next});
    m.add(m.functions, Op::OpBranch, {header});
    m.add(m.functions, Op::OpLabel, {merge});
  }
  m.end_function();
  EXPECT_EQ(m.outcome(), "");
}

TEST(SpirvSize, ManyShortIfs) {
  LargeModule m;
  const uint32_t variable = m.id(), shared = m.shared(m.shared_word);
  m.begin_function(8);
  m.add(m.functions, Op::OpVariable, {m.function_word, variable, kFunction});
  m.load_unknown(m.functions);
  for (uint32_t i = 0; i < 8000; ++i) {
    const uint32_t yes = m.id(), merge = m.id(), old = m.id(), sum = m.id();
    m.add(m.functions, Op::OpSelectionMerge, {merge, 0});
    m.add(m.functions, Op::OpBranchConditional, {m.condition, yes, merge});
    m.add(m.functions, Op::OpLabel, {yes});
    m.add(m.functions, Op::OpLoad, {kUint, old, variable});
    m.add(m.functions, Op::OpIAdd, {kUint, sum, old, m.word});
    m.add(m.functions, Op::OpStore, {variable, sum});
    m.add(m.functions, Op::OpBranch, {merge});
    m.add(m.functions, Op::OpLabel, {merge});
  }
  const uint32_t last = m.id();
  m.add(m.functions, Op::OpLoad, {kUint, last, variable});
  m.add(m.functions, Op::OpStore, {shared, last});
  m.end_function();
  EXPECT_EQ(m.outcome(), "");
}

TEST(SpirvSize, ManyFunctionsAndCalls) {
  constexpr uint32_t kFunctions = 100000, kCalls = 200000;
  LargeModule m;
  for (uint32_t i = 0; i + 1 < kFunctions; ++i) {
    m.begin_function(0);
    m.end_function();
  }
  m.begin_function(kCalls);
  m.end_function();
  EXPECT_EQ(m.outcome(), "");
}

// All of a long row of blocks lead to the same few ones.
TEST(SpirvSize, ManyWaysToABlock) {
  constexpr uint32_t kBlocks = 16000, kTargets = 8;
  LargeModule m;
  m.load_unknown(m.body);
  const uint32_t first_target = m.next;
  m.next += kTargets;
  for (uint32_t i = 0; i < kBlocks; ++i) {
    std::vector<uint32_t> operands{m.word, i + 1 < kBlocks ? m.next : first_target};
    for (uint32_t t = 0; t < kTargets; ++t) operands.insert(operands.end(), {t, first_target + t});
    m.add(m.body, Op::OpSwitch, operands);
    if (i + 1 < kBlocks) m.label(m.body);
  }
  for (uint32_t t = 0; t < kTargets; ++t) {
    m.add(m.body, Op::OpLabel, {first_target + t});
    if (t + 1 < kTargets) m.add(m.body, Op::OpReturn, {});
  }
  EXPECT_EQ(m.outcome(), "");
}

// What is known of thousands of variables goes to thousands of blocks: 1 GB of it, were all of it kept.
TEST(SpirvSize, ManyVariablesAndCases) {
  LargeModule m;
  const uint32_t shared = m.shared(m.shared_word);
  for (uint32_t i = 0; i < 4096; ++i) m.add(m.body, Op::OpVariable, {m.function_word, m.id(), kFunction});
  m.load_unknown(m.body);
  m.make_switch(m.body, 30000, [&] { m.add(m.body, Op::OpStore, {shared, m.word}); });
  EXPECT_EQ(m.outcome(), "");
}

TEST(SpirvSize, ManySharedVariables) {
  constexpr uint32_t kVariables = 8000, kStores = 300000;
  LargeModule m;
  const uint32_t first = m.next;
  for (uint32_t i = 0; i < kVariables; ++i) m.shared(m.shared_word);
  for (uint32_t i = 0; i < kStores; ++i) m.add(m.body, Op::OpStore, {first + std::min(i, kVariables - 1), kOne});
  EXPECT_EQ(m.outcome(), "");
}

// Every other register is free while vectors look for four in a row.
TEST(SpirvSize, ManyVectorsAmongScalars) {
  constexpr uint32_t kScalars = 20000, kVectors = 40000;
  LargeModule m;
  const uint32_t vector = m.id(), vector_pointer = m.id(), array = m.id(), array_pointer = m.id(), count = m.id();
  m.add(m.globals, Op::OpTypeVector, {vector, kUint, 4});
  m.add(m.globals, Op::OpConstant, {kUint, count, 100});
  m.add(m.globals, Op::OpTypeArray, {array, vector, count});
  m.add(m.globals, Op::OpTypePointer, {vector_pointer, kShared, vector});
  m.add(m.globals, Op::OpTypePointer, {array_pointer, kShared, array});
  const uint32_t vectors = m.shared(array_pointer), shared = m.shared(m.shared_word);
  m.load_unknown(m.body);
  std::vector<uint32_t> scalars{m.word};
  for (uint32_t i = 0; i < kScalars; ++i) {
    m.add(m.body, Op::OpIMul, {kUint, m.next, m.word, scalars.back()});
    scalars.push_back(m.id());
  }
  const auto in_a_block = [&](const std::function<void()>& fill) {
    const uint32_t yes = m.id(), merge = m.id();
    m.add(m.body, Op::OpSelectionMerge, {merge, 0});
    m.add(m.body, Op::OpBranchConditional, {m.condition, yes, merge});
    m.add(m.body, Op::OpLabel, {yes});
    fill();
    m.add(m.body, Op::OpBranch, {merge});
    m.add(m.body, Op::OpLabel, {merge});
  };
  const auto store_half = [&](uint32_t first) {
    in_a_block([&] {
      for (uint32_t i = first; i <= kScalars; i += 2) m.add(m.body, Op::OpStore, {shared, scalars[i]});
    });
  };
  store_half(1);
  in_a_block([&] {
    for (uint32_t i = 0; i < kVectors; ++i) {
      const uint32_t pointer = m.id(), loaded = m.id(), first = m.id(), last = m.id(), sum = m.id();
      m.add(m.body, Op::OpAccessChain, {vector_pointer, pointer, vectors, m.word});
      m.add(m.body, Op::OpLoad, {vector, loaded, pointer});
      m.add(m.body, Op::OpCompositeExtract, {kUint, first, loaded, 0});
      m.add(m.body, Op::OpCompositeExtract, {kUint, last, loaded, 3});
      m.add(m.body, Op::OpIAdd, {kUint, sum, first, last});
      m.add(m.body, Op::OpStore, {shared, sum});
    }
  });
  store_half(0);
  EXPECT_EQ(m.outcome(), "");
}

// Phis of 8,000 parents, of a structure without members, so that no instruction comes of them.
TEST(SpirvSize, PhisWithManyParents) {
  for (const bool same_order : {true, false}) {
    LargeModule m;
    const uint32_t nothing = m.id(), null = m.id();
    m.add(m.globals, Op::OpTypeStruct, {nothing});
    m.add(m.globals, Op::OpConstantNull, {nothing, null});
    m.begin_function(4);
    m.load_unknown(m.functions);
    std::vector<uint32_t> labels = m.make_switch(m.functions, 8000, [] {});
    for (uint32_t i = 0; i < 30; ++i) {
      std::vector<uint32_t> operands{nothing, m.id()};
      for (const uint32_t label : labels) operands.insert(operands.end(), {null, label});
      m.add(m.functions, Op::OpPhi, operands);
      if (!same_order) std::ranges::reverse(labels);
    }
    m.end_function();
    if (same_order) {
      EXPECT_EQ(m.outcome(), "");
    } else {
      expect_too_large(m);
    }
  }
}

// Structures with a member and 60,000 that are nothing, thousands of them in an array.
TEST(SpirvSize, MembersThatAreNothing) {
  LargeModule m;
  const uint32_t nothing = m.id(), type = m.id(), count = m.id(), array = m.id(), pointer = m.id();
  std::vector<uint32_t> members(60000, nothing);
  members[0] = type;
  members[1] = kUint;
  m.add(m.globals, Op::OpTypeStruct, {nothing});
  m.add(m.globals, Op::OpTypeStruct, members);
  m.add(m.globals, Op::OpConstant, {kUint, count, 4000});
  m.add(m.globals, Op::OpTypeArray, {array, type, count});
  m.add(m.globals, Op::OpTypePointer, {pointer, kShared, array});
  const uint32_t variable = m.shared(pointer);
  for (uint32_t i = 0; i < 1000; ++i) m.add(m.body, Op::OpLoad, {array, m.id(), variable});
  expect_too_large(m);
}

// The loop's body is looked at for stores in each of 100,000 calls, though none of it is ever lowered.
TEST(SpirvSize, LoopsWithCodeThatIsNotReached) {
  LargeModule m;
  const uint32_t variable = m.id();
  m.begin_function(100000);
  m.add(m.functions, Op::OpVariable, {m.function_word, variable, kFunction});
  m.load_unknown(m.functions);
  const uint32_t header = m.id(), body = m.id(), dead = m.id(), merge = m.id(), next = m.id(), after = m.id();
  m.add(m.functions, Op::OpBranch, {header});
  m.add(m.functions, Op::OpLabel, {header});
  m.add(m.functions, Op::OpLoopMerge, {after, next, 2});
  m.add(m.functions, Op::OpBranch, {body});
  m.add(m.functions, Op::OpLabel, {body});
  m.add(m.functions, Op::OpSelectionMerge, {merge, 0});
  m.add(m.functions, Op::OpBranchConditional, {m.lie, dead, merge});
  m.add(m.functions, Op::OpLabel, {dead});
  for (uint32_t i = 0; i < 100000; ++i) m.add(m.functions, Op::OpIAdd, {kUint, m.id(), kOne, kOne});
  m.add(m.functions, Op::OpBranch, {merge});
  m.add(m.functions, Op::OpLabel, {merge});
  m.add(m.functions, Op::OpBranchConditional, {m.condition, next, after});
  m.add(m.functions, Op::OpLabel, {next});
  m.add(m.functions, Op::OpBranch, {header});
  m.add(m.functions, Op::OpLabel, {after});
  m.end_function();
  expect_too_large(m);
}

}  // namespace
}  // namespace lapilli
