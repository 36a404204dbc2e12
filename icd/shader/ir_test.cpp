// Tests of building, printing and checking a Code.
#include "shader/ir.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace lapilli {
namespace {

// A loop that runs until no lane has a counter below 10; `counter` is what the program is about.
struct Counting {
  Code code;
  uint32_t header_mask = code.new_mask();
  uint32_t exit_mask = code.new_mask();
  uint32_t header = code.new_label();
  uint32_t back = code.new_label();
  uint32_t exit = code.new_label();
  Reg counter = code.new_variable();
  Reg next = kNoReg;
};

Counting counting_loop() {
  Counting c;
  Code& code = c.code;
  code.output_slots = 8;
  code.emit_to(Opcode::mov, c.counter, code.constant(0));
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, c.header_mask);
  code.place_label(c.header);
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, c.header_mask, c.back);
  c.next = code.emit(Opcode::iadd, c.counter, code.constant(1));
  code.emit_set(c.counter, c.next);
  const Reg more = code.emit(Opcode::ult, c.next, code.constant(10));
  code.emit_void(Opcode::branch_if, more, kNoReg, kNoReg, c.header_mask, c.exit_mask);
  code.place_label(c.back);
  code.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, c.header_mask, c.header);
  code.place_label(c.exit);
  const uint32_t done = code.new_label();
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, c.exit_mask, done);
  code.emit_void(Opcode::store_output, c.counter, kNoReg, kNoReg, 5);
  code.place_label(done);
  code.emit_void(Opcode::end);
  return c;
}

TEST(OpTable, IsConsistent) {
  std::set<std::string> names;
  for (uint32_t i = 0; i < static_cast<uint32_t>(Opcode::kCount); ++i) {
    const OpInfo& info = op_info(static_cast<Opcode>(i));
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_EQ(std::strspn(info.operands, "aAbBcCl"), std::strlen(info.operands)) << info.name;
    EXPECT_STRNE(info.equation, "") << info.name;
    const bool has_effect = (info.effects & (kWritesMemory | kControl)) != 0;
    const bool exchanges = (info.effects & kReadsMemory) != 0;  // an atomic op does both
    EXPECT_EQ(info.results == 0, has_effect && !exchanges) << info.name << ": an op gives a result or does something";
    if ((info.effects & kCommutes) != 0) {
      EXPECT_EQ(std::strncmp(info.operands, "ab", 2), 0) << info.name;
    }
  }
  EXPECT_STREQ(op_info(Opcode::fadd).name, "fadd");
  EXPECT_STREQ(op_info(Opcode::end).name, "end");
}

TEST(Code, ConstantsAreShared) {
  Code code;
  const Reg one = code.constant_f(1.0f);
  const Reg zero = code.constant(0);
  const Reg minus_zero = code.constant_f(-0.0f);
  EXPECT_EQ(code.constant(0x3F800000), one);
  EXPECT_EQ(code.constant_f(0.0f), zero);
  EXPECT_NE(minus_zero, zero);
  EXPECT_EQ(code.registers[minus_zero].bits, 0x80000000u);
  EXPECT_EQ(code.registers.size(), 3u);
}

TEST(Code, ResourcesAreShared) {
  Code code;
  const uint32_t a = code.add_resource({0, 2, 1, -1});
  const uint32_t b = code.add_resource({0, 2, 1, 0});
  EXPECT_NE(a, b);
  EXPECT_EQ(code.add_resource({0, 2, 1, -1}), a);
}

TEST(Code, MultiResultsAreConsecutive) {
  Code code;
  const Reg first = code.emit_n(Opcode::load_push, 3, kNoReg, kNoReg, kNoReg, 0, 16);
  EXPECT_EQ(code.registers.size(), first + 3u);
  EXPECT_EQ(code.instructions[0].results, 3);
}

TEST(Disassemble, NamesEverything) {
  const Counting c = counting_loop();
  const std::string text = disassemble(c.code);
  EXPECT_NE(text.find("$0 = mov 0x00000000\n"), std::string::npos) << text;
  EXPECT_NE(text.find("L0:\n    2  enter m0 L1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("%" + std::to_string(c.next) + " = iadd $0 0x00000001\n"), std::string::npos) << text;
  EXPECT_NE(text.find(" m0 m1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("loop m0 L0\n"), std::string::npos) << text;
}

TEST(Verify, AcceptsALoop) { EXPECT_EQ(verify(counting_loop().code), ""); }

// Each changes one thing of a correct program.
struct Defect {
  const char* name;
  void (*damage)(Counting& c);
  const char* message;
};

const Defect kDefects[] = {
    {"no end", [](Counting& c) { c.code.instructions.pop_back(); }, "not end"},
    {"end in the middle",
     [](Counting& c) {
       c.code.instructions[0] = {};
       c.code.instructions[0].op = Opcode::end;
     },
     "not the last"},
    {"empty", [](Counting& c) { c.code.instructions.clear(); }, "not end"},
    {"no opcode", [](Counting& c) { c.code.instructions[0].op = Opcode::kCount; }, "no opcode"},
    {"register out of range", [](Counting& c) { c.code.instructions[3].a = 1000; }, "no register"},
    {"missing operand", [](Counting& c) { c.code.instructions[3].b = kNoReg; }, "operand b is missing"},
    {"surplus operand", [](Counting& c) { c.code.instructions[3].c = c.counter; }, "operand c is not used"},
    {"use before definition", [](Counting& c) { c.code.instructions[3].b = c.next; }, "before its definition"},
    {"never defined", [](Counting& c) { c.code.instructions[3].a = c.code.new_value(); }, "before its definition"},
    {"no masked copy", [](Counting& c) { c.code.instructions[9].a = c.next; }, "masked copy"},
    {"two definitions", [](Counting& c) { c.code.instructions[5].dst = c.next; }, "second time"},
    {"constant written", [](Counting& c) { c.code.instructions[0].dst = c.code.constant(0); }, "writes a constant"},
    {"several results in variables",
     [](Counting& c) {
       Instruction& i = c.code.instructions[3];
       i = {};
       i.op = Opcode::load_push;
       i.results = 2;
       i.dst = c.code.new_variable(2);
     },
     "several variables"},
    {"set of a value", [](Counting& c) { c.code.instructions[4].dst = c.code.new_value(); }, "no variable"},
    {"too many results", [](Counting& c) { c.code.instructions[3].results = 2; }, "number of results"},
    {"no results", [](Counting& c) { c.code.instructions[3].results = 0; }, "number of results"},
    {"destination without result", [](Counting& c) { c.code.instructions[1].dst = c.counter; }, "no result"},
    {"no such mask", [](Counting& c) { c.code.instructions[1].imm = 9; }, "no such mask"},
    {"unused immediate", [](Counting& c) { c.code.instructions[3].imm = 1; }, "immediate"},
    {"label not placed", [](Counting& c) { c.code.labels[c.back] = kNoLabelPosition; }, "no such label"},
    {"label behind the end", [](Counting& c) { c.code.labels[c.back] = 99; }, "outside the program"},
    {"backward label is forward", [](Counting& c) { c.code.instructions[7].imm2 = c.exit; }, "further up"},
    {"forward label is backward", [](Counting& c) { c.code.instructions[8].imm2 = c.header; }, "further down"},
    {"header of another mask", [](Counting& c) { c.code.instructions[7].imm = c.exit_mask; }, "header"},
    {"slot out of range", [](Counting& c) { c.code.output_slots = 5; }, "output slot"},
    {"jump into a loop",
     [](Counting& c) {
       c.code.instructions[1] = {};
       c.code.instructions[1].op = Opcode::jump_if_none;
       c.code.instructions[1].imm = c.back;
     },
     "into a loop"},
    {"jump out of a loop",
     [](Counting& c) {
       c.code.instructions[6] = {};
       c.code.instructions[6].op = Opcode::jump_if_none;
       c.code.instructions[6].imm = c.exit;
     },
     "out of a loop"},
    {"list where none belongs",
     [](Counting& c) {
       const Reg r[] = {c.counter};
       c.code.set_list(c.code.instructions[3], r);
     },
     "no operand list"},
    {"array with a foreign register",
     [](Counting& c) {
       const uint32_t array = c.code.new_array(2);
       c.code.arrays[array].first = 0;
     },
     "not its own"},
};

TEST(Verify, FindsEachDefect) {
  for (const Defect& defect : kDefects) {
    Counting c = counting_loop();
    defect.damage(c);
    const std::string message = verify(c.code);
    EXPECT_NE(message.find(defect.message), std::string::npos) << defect.name << ": \"" << message << '"';
  }
}

TEST(Verify, ChecksWhatOpsName) {
  struct Bad {
    Opcode op;
    uint32_t results, imm, imm2;
  };
  for (const Bad& bad :
       {Bad{Opcode::load_uniform, 4, 1, 0}, Bad{Opcode::load_push, 1, 0, 256}, Bad{Opcode::fetch, 1, 0, 0},
        Bad{Opcode::interpolate_flat, 2, 63, 0}, Bad{Opcode::load_color, 4, 0, 0}, Bad{Opcode::builtin, 1, 999, 0},
        Bad{Opcode::load_uniform, 17, 0, 0}}) {
    Code code;
    code.add_resource({});
    code.emit_n(bad.op, bad.results, kNoReg, kNoReg, kNoReg, bad.imm, bad.imm2);
    code.emit_void(Opcode::end);
    EXPECT_NE(verify(code), "") << op_info(bad.op).name;
  }
}

TEST(Verify, ChecksOperandLists) {
  Code code;
  code.color_formats = {VK_FORMAT_R8G8B8A8_UNORM};
  const Reg one = code.constant_f(1);
  const Reg list[] = {one, kNoReg, one, one};
  code.emit_void(Opcode::store_color, kNoReg, kNoReg, kNoReg, 0, 13);  // no green
  code.set_list(code.instructions.back(), list);
  code.emit_void(Opcode::end);
  EXPECT_EQ(verify(code), "");
  code.instructions[0].imm2 = 15;
  EXPECT_NE(verify(code).find("list operand 1 is missing"), std::string::npos);
  code.instructions[0].list_count = 3;
  EXPECT_NE(verify(code).find("wrong length"), std::string::npos);
  code.instructions[0].list_count = 4;
  code.instructions[0].list_first = 1;
  EXPECT_NE(verify(code).find("outside"), std::string::npos);
}

}  // namespace
}  // namespace lapilli
