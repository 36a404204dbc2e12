// The intermediate representation: one linear list of instructions over virtual registers.
// A virtual register is one 32-bit value for each of the 64 lanes of a batch. SPIR-V is lowered to it, passes rewrite
// it, and `assemble` (program.h) turns it into the ops that the interpreter runs. The ops are listed in ops.def.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lapilli {

enum class Opcode : uint16_t {
#define OP(name, results, operands, effects, cost, equation) name,
#include "shader/ops.def"
#undef OP
  kCount
};

// Columns of ops.def as data.
enum OpEffects : uint32_t {
  kPure = 0,          // depends on its operands only; may be removed, merged, folded, moved
  kReadsMemory = 1,   // may not move across kWritesMemory; may be removed
  kWritesMemory = 2,  // buffers, images, tile, outputs: never removed
  kControl = 4,       // changes exec/write/mask registers or the order of execution
  kMasked = 8,        // writes its destination only in lanes of exec; the old value is an input
  kBatchInput = 16,   // reads what is constant in a batch (built-ins, interpolation); may be removed and merged
  kCommutes = 32,     // a and b may be swapped
  kCrossLane = 64,    // reads other lanes of the quad
};

struct OpInfo {
  const char* name;      // "fadd"
  int results;           // consecutive result registers; -1: Instruction::results says
  const char* operands;  // subset of "abc", a capital where kNoReg is allowed; "l" = operand list
  uint32_t effects;      // OpEffects
  uint32_t cost;         // in units of one plain add over 64 lanes
  const char* equation;  // "R[D] := R[A] + R[B]"
};
inline constexpr OpInfo kOps[] = {
#define OP(name, results, operands, effects, cost, equation) {#name, results, operands, effects, cost, equation},
#include "shader/ops.def"
#undef OP
};
inline const OpInfo& op_info(Opcode opcode) { return kOps[static_cast<size_t>(opcode)]; }

// What an instruction's imm and imm2 are.
enum class ImmRole : uint8_t {
  none,       // not used, 0
  number,     // see the equation
  mask,       // mask register
  forward,    // label further down
  backward,   // label further up
  array,      // index into Code::arrays
  resource,   // index into Code::resources
  attribute,  // index into Code::attributes
  color,      // index into Code::color_formats
  built_in,   // BuiltIn
  slot,       // output slot of a vertex program
  varying,    // varying component, of the fragment program
  bytes,      // offset
};
struct ImmRoles {
  ImmRole imm = ImmRole::none;
  ImmRole imm2 = ImmRole::none;
};
ImmRoles imm_roles(Opcode opcode);

// Operand list of an op on images: two descriptor indices, `required` operands, and some that may be kNoReg.
struct ImageList {
  uint32_t count = 0;  // 0: the op is none
  uint32_t required = 0;
};
ImageList image_list(Opcode opcode);

using Reg = uint32_t;
constexpr Reg kNoReg = 0xFFFFFFFF;
constexpr uint32_t kNoLabelPosition = 0xFFFFFFFF;  // in Code::labels: not placed yet

struct Instruction {
  Opcode op;
  uint8_t results = 0;  // number of consecutive registers written from dst on
  Reg dst = kNoReg;
  Reg a = kNoReg, b = kNoReg, c = kNoReg;
  uint32_t imm = 0, imm2 = 0;  // meaning per op, see ops.def; labels and mask registers are here
  uint32_t list_first = 0;     // further operands: Code::operand_list[list_first .. + list_count)
  uint16_t list_count = 0;
  uint32_t line = 0;        // source line from OpLine, 0: none
  uint32_t spirv_word = 0;  // index of the SPIR-V word that this came from, 0: fixed function
};

// Changes memory that others see.
bool writes_resource(const Instruction& instruction);

enum class RegKind : uint8_t {
  value,     // written by exactly one instruction, before all uses in linear order
  variable,  // written any number of times, by masked and plain instructions (phis, Function and Private variables)
  constant,  // holds Code::registers[r].bits in all lanes; never written
  uniform,   // the same in all lanes of a draw: written by one instruction of Code::once
};

struct RegInfo {
  RegKind kind = RegKind::value;
  uint32_t bits = 0;        // constant: the value
  uint32_t array = kNoReg;  // index into Code::arrays if it is an element of one
};

// Registers that are reached by an index at run time; they stay consecutive.
struct RegArray {
  Reg first = 0;
  uint32_t count = 0;
};

constexpr uint32_t kSharedMemory = 0xFFFFFFFF;

// A descriptor that a program uses; instructions name it by index (imm). Or, with `set` kSharedMemory, a variable in
// the workgroup's shared memory: `count` bytes from `first` on.
struct ResourceRef {
  uint32_t set = 0;
  uint32_t first = 0;           // index of array element 0 in the set's descriptors
  uint32_t count = 1;           // array size: an index outside it reads as an unwritten descriptor
  int32_t dynamic_offset = -1;  // see BindingSlot
  bool uniform = false;         // a uniform buffer: constant in a draw
};

struct VertexAttribute {
  uint32_t location = 0;
  uint32_t binding = 0;
  uint32_t offset = 0;  // bytes
  VkFormat format = VK_FORMAT_UNDEFINED;
};

// How the components of a varying slot are interpolated.
enum class Interpolation : uint8_t { perspective, linear, flat };

// Output slots of a vertex program: a slot is one 32-bit component.
constexpr uint32_t kSlotPosition = 0;  // x y z w
constexpr uint32_t kSlotPointSize = 4;
constexpr uint32_t kSlotVaryings = 5;  // first varying component, assigned densely when the stages are linked
constexpr uint32_t kMaxVaryingComponents = 64;
constexpr uint32_t kMaxDistances = 8;  // to clip planes and cull planes together

enum class BuiltIn : uint32_t {
  vertex_index,
  instance_index,
  frag_coord_x,
  frag_coord_y,  // pixel centres, framebuffer space
  front_facing,  // 0 or ~0
  local_invocation_x,
  local_invocation_y,
  local_invocation_z,
  local_invocation_index,
  workgroup_x,
  workgroup_y,
  workgroup_z,
  num_workgroups_x,
  num_workgroups_y,
  num_workgroups_z,
  global_invocation_x,
  global_invocation_y,
  global_invocation_z,
  blend_constant_r,
  blend_constant_g,
  blend_constant_b,
  blend_constant_a,
  helper_invocation,  // 0 or ~0
  base_vertex,
  base_instance,
  draw_index,
  lane_index,  // 0..63, for tests
  kCount
};

// What the op `atomic` makes of a word and its value. A store is an exchange whose result nobody reads.
enum class AtomicOp : uint32_t {
  load,
  exchange,
  compare_exchange,  // the value, if the word equals the comparator
  add,
  smin,
  smax,
  umin,
  umax,
  bit_and,
  bit_or,
  bit_xor,
  kCount
};

// A program under construction.
struct Code {
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_VERTEX_BIT;
  std::vector<Instruction> once;  // before all others, once per draw, on scalars
  std::vector<Instruction> instructions;
  std::vector<RegInfo> registers;
  std::vector<Reg> operand_list;
  std::vector<RegArray> arrays;
  std::vector<uint32_t> labels;  // label -> index into instructions (targets of jumps); kept right by every pass
  uint32_t mask_count = 0;       // mask registers
  std::vector<ResourceRef> resources;
  std::vector<VertexAttribute> attributes;
  std::vector<VkFormat> color_formats;  // of the attachments named by load_color and store_color
  uint32_t workgroup_size[3] = {1, 1, 1};
  uint32_t shared_bytes = 0;  // of a workgroup's memory, 0 at its start
  uint32_t output_slots = 0;  // vertex: slots written
  std::vector<Reg> kept;      // computed although nothing reads them: LAPILLI_KEEP

  uint32_t invocations() const { return workgroup_size[0] * workgroup_size[1] * workgroup_size[2]; }  // of a workgroup

  Reg new_value(uint32_t count = 1);  // `count` consecutive registers of kind value
  Reg new_variable(uint32_t count = 1);
  Reg constant(uint32_t bits);  // the same register for the same bits
  Reg constant_f(float value);
  uint32_t new_array(uint32_t count);  // index into arrays
  uint32_t new_mask();
  uint32_t new_label();                           // not yet placed
  void place_label(uint32_t label);               // before the next instruction that is appended
  uint32_t add_resource(const ResourceRef& ref);  // deduplicated

  Instruction& append(Opcode op, uint32_t results = 0);  // results > 0: new value registers
  Reg emit(Opcode op, Reg a = kNoReg, Reg b = kNoReg, Reg c = kNoReg, uint32_t imm = 0,
           uint32_t imm2 = 0);  // one result
  Reg emit_n(Opcode op, uint32_t results, Reg a = kNoReg, Reg b = kNoReg, Reg c = kNoReg, uint32_t imm = 0,
             uint32_t imm2 = 0);  // `results` consecutive registers, the first is returned
  void emit_void(Opcode op, Reg a = kNoReg, Reg b = kNoReg, Reg c = kNoReg, uint32_t imm = 0, uint32_t imm2 = 0);
  void emit_set(Reg variable, Reg value);  // set: under exec
  void emit_to(Opcode op, Reg dst, Reg a = kNoReg, Reg b = kNoReg,
               Reg c = kNoReg);  // one result, into a variable, in all lanes
  void set_list(Instruction& instruction, std::span<const Reg> operands);

 private:
  std::vector<std::pair<uint32_t, Reg>> constants_;
};

// Text of a program, one instruction a line: for dumps, tests and the debug log.
std::string disassemble(const Code& code);
// Checks what every pass relies on (operands defined before use, results, labels, mask registers, lists). Empty: fine.
std::string verify(const Code& code);

}  // namespace lapilli
