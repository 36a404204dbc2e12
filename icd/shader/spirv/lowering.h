// The state of one lowering. Its methods are spread over lower_*.cpp by subject.
// Errors stick: the first one is kept, what follows works on registers that exist, and lower_shader returns the error.
#pragma once

#include <array>
#include <bit>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shader/spirv/lower.h"
#include "shader/spirv/module.h"

namespace lapilli::spirv {

constexpr uint32_t kMaxValueComponents = 16384;     // of one value
constexpr uint32_t kMaxVariableComponents = 16384;  // of one variable in registers
constexpr uint32_t kMaxInstructions = 1 << 20;  // of a program; and registers, and SPIR-V instructions after inlining
constexpr uint32_t kMaxRegisters = 1 << 21;
constexpr size_t kMaxConstantRegisters = 1 << 15;
constexpr size_t kMaxOperandPool = 1 << 24;

enum class Kind : uint8_t {
  none,
  boolean,
  sint,
  uint,
  real,
  vector,
  matrix,
  array,
  runtime_array,
  structure,
  pointer,
  image,
  sampled_image,
  sampler
};

// A type with the specialization constants in its array lengths resolved.
struct Type {
  Kind kind = Kind::none;
  uint32_t id = 0;
  uint32_t count = 0;  // components of a vector, columns, elements, members
  uint32_t element =
      0;  // type of components, columns, elements; what a pointer points to; the image of a sampled image
  uint64_t components = 0;             // scalars; saturates
  std::vector<uint32_t> members;       // types
  std::vector<uint64_t> member_first;  // index of their first scalar
  bool is_scalar() const { return kind >= Kind::boolean && kind <= Kind::real; }
  bool is_integer() const { return kind == Kind::sint || kind == Kind::uint; }
  bool is_handle() const { return kind >= Kind::image; }
  // Structures may be empty, and arrays of them are as long as they like: whoever walks through a type stops at
  // nothing.
  bool has_value() const { return components != 0 || kind == Kind::structure || kind == Kind::array; }
};

// A variable in registers: Function, Private, Output; or the value registers of an Input. Or one in the workgroup's
// memory, one scalar behind the other.
struct Variable {
  Reg first = 0;  // in the workgroup's memory: its first byte; kNoReg: nothing uses it yet
  uint32_t count = 0;
  uint32_t array = kNoReg;  // Code::arrays, once it was indexed dynamically
  bool input = false;
};

enum class Space : uint8_t { none, registers, buffer, shared, push, handle, texel };

// What is known of a pointer while the program is made: all but `dynamic` and `descriptor`.
struct Pointer {
  Space space = Space::none;
  uint32_t type = 0;                  // of what it points to
  Variable* variable = nullptr;       // registers, shared
  const BindingSlot* slot = nullptr;  // buffer, handle
  bool in_block = false;              // buffer: arrays are no longer arrays of descriptors
  uint32_t descriptor_offset = 0;
  Reg descriptor = kNoReg;        // added to descriptor_offset
  uint32_t offset = 0;            // bytes, or components of `variable`
  Reg dynamic = kNoReg;           // added to offset
  uint32_t component_stride = 4;  // bytes between a vector's components: MatrixStride in a row-major matrix
  uint32_t matrix_stride = 0;     // of the matrices below, from the member's decorations
  bool row_major = false;
  bool uniform = false;                         // a uniform block: constant in a draw
  std::array<Reg, 2> texel = {kNoReg, kNoReg};  // texel of an image: x, y
};

struct Value {
  enum class Shape : uint8_t { none, data, pointer, handle };
  Shape shape = Shape::none;
  uint32_t type = 0;
  std::span<const Reg> regs;          // data: scalars; handle: descriptor indices of texture and sampler (kNoReg: 0)
  uint32_t texture = 0, sampler = 0;  // handle: Code::resources
  Pointer pointer;
};

// An integer op of two constants; nothing for ops that are not folded here.
std::optional<uint32_t> fold_integers(Opcode op, uint32_t a, uint32_t b);
// The op behind a comparison of integers, and whether its operands are swapped. kCount: it is none.
struct ComparedIntegers {
  Opcode op = Opcode::kCount;
  bool swapped = false;
};
ComparedIntegers compared_integers(spv::Op op);

// Known contents of variable registers: variable register, register with the same value; sorted.
using Known = std::vector<std::pair<Reg, Reg>>;

class Lowering {
 public:
  Lowering(const ShaderStage& stage, VkShaderStageFlagBits which, const ResourceLayout& layout);
  Result<LoweredShader> run();

 private:
  // --- lower.cpp: values, errors, dispatch ---
  void fail(const std::string& what);  // at the current instruction
  bool failed() const { return error_.has_value(); }
  bool within_limits();
  std::span<Reg> allocate(size_t count);
  void bind(uint32_t id, std::span<const Reg> regs);
  void bind(uint32_t id, Value value);
  const Value* find_value(uint32_t id) const;
  // Scalars of a value or constant. The second fails unless there are `count`, and returns that many in any case.
  std::span<const Reg> data(uint32_t id);
  std::span<const Reg> data(uint32_t id, uint64_t count);
  Reg scalar(uint32_t id) { return data(id, 1)[0]; }
  const Pointer* pointer(uint32_t id);
  std::optional<uint32_t> constant_bits(Reg reg) const;
  // Folds logic with constants, so that branches over specialization constants are decided here.
  Reg emit(Opcode op, Reg a = kNoReg, Reg b = kNoReg, Reg c = kNoReg);
  Reg constant(uint32_t bits);
  Reg constant_f(float value) { return constant(std::bit_cast<uint32_t>(value)); }
  void lower_instruction(const SpirvInst& inst);
  void lower_body_instruction(const SpirvInst& inst);
  void lower_composite(const SpirvInst& inst);

  // --- lower_types.cpp ---
  const Type& type(uint32_t id);
  Type resolve(uint32_t id);
  const Type& type_of(uint32_t id) { return type(m_.ids[id].type); }
  spv::Dim dimension(const Type& image) const;  // of an image or a sampled image
  // The scalars' type and their number; kind none if it is no scalar or vector.
  Kind scalar_kind(const Type& type);
  // Type of the element `index` of a composite and the index of its first scalar; fails if there is none.
  struct Element {
    uint32_t type = 0;
    uint64_t first = 0;
  };
  Element element(uint32_t composite, uint32_t index);
  void collect_scalar_kinds(uint32_t type, std::vector<Kind>& kinds);

  // --- lower_constants.cpp ---
  void evaluate_constants();
  void evaluate_constant(const SpirvInst& inst);
  std::vector<uint32_t> evaluate_spec_op(const SpirvInst& inst);
  const std::vector<uint32_t>* constant_data(uint32_t id) const;  // null: no constant
  uint32_t specialized(uint32_t id, uint32_t bits) const;

  // --- lower_control.cpp ---
  struct BlockState {
    uint32_t mask = kNoReg;
    bool reached = false;                                         // something branches to it
    bool pending = false;                                         // branched to and not yet entered
    uint32_t edges = 0;                                           // made so far
    std::vector<std::pair<uint32_t, std::span<const Reg>>> phis;  // id, value on the first edge
    Known known;
  };
  struct LoopState {
    uint32_t label = 0;
    Reg first_register = 0;  // registers from here on were made inside
    bool open = false;       // a loop over masks, not (or no longer) unrolled
    std::vector<std::pair<uint32_t, Value>> exports;
    bool forecast = false;  // the rest says something
    uint32_t rounds = 0, rounds_left = 0;
    size_t first_instruction = 0;
  };
  struct Frame {
    const SpirvFunction* function;
    std::vector<BlockState> blocks;
    std::vector<LoopState> loops;
    BlockState exit;
    std::span<const Reg> returned;  // variables, or the value itself
    uint32_t fallthrough = kNoBlock;
    uint32_t block = 0;
    bool direct_exit = false;  // the only return is at the very end
    bool returned_directly = false;
  };
  void lower_call(const SpirvInst& inst);
  std::span<const Reg> lower_function(const SpirvFunction& function);
  bool begin_block(uint32_t index);
  void close_loop(uint32_t loop);
  void lower_terminator(const SpirvInst& inst);
  void lower_switch(const SpirvInst& inst);
  void lower_return(const SpirvInst& inst);
  void go_to(uint32_t target);  // unconditional
  uint32_t destination(uint32_t target) const;
  spv::Op first_op(const SpirvBlock& block) const;
  void make_edge(uint32_t target, Reg condition, bool negate, bool last);
  void copy_to_phis(uint32_t target, Reg condition, bool negate);
  uint32_t mark_pending(BlockState& state);  // its mask
  void enter(BlockState& state);
  void place_skip_label();
  bool escapes(uint32_t id) const;  // from the loop that makes it
  void export_from_loop(uint32_t id);
  void join_known(BlockState& state, Reg first_inner, bool last);
  Reg first_inner_register(uint32_t target_position) const;
  void forget_stored_in_loop(uint32_t loop);
  uint32_t root_of_pointer(uint32_t id) const;  // 0: too many access chains lead to it

  // --- unroll.cpp ---
  bool may_unroll(uint32_t loop) const;
  uint32_t count_rounds(uint32_t loop, const Known& known);
  bool unrolls(uint32_t loop, const Known& known);

  // --- lower_memory.cpp ---
  Variable* new_variable(uint64_t components);
  void lower_variable(const SpirvInst& inst);
  void lower_access_chain(const SpirvInst& inst);
  void index_pointer(Pointer& to, uint32_t index_id);
  void advance(Pointer& to, Reg index, uint64_t stride);
  std::vector<Reg> load(const Pointer& from);
  void store(const Pointer& to, std::span<const Reg> values);
  void assign(Reg variable, Reg value);  // under exec
  void set_known(Reg variable, Reg value);
  Reg get_known(Reg variable) const;  // kNoReg: not known
  void forget(Reg first, uint32_t count);
  uint32_t array_of(Variable& variable);
  void collect_offsets(const Pointer& from, std::vector<uint64_t>& offsets, std::vector<Kind>& kinds);
  std::vector<Reg> load_memory(const Pointer& from);
  void store_memory(const Pointer& to, std::span<const Reg> values);
  std::pair<uint32_t, Reg> resolve_descriptor(const BindingSlot* slot, uint32_t offset, Reg dynamic,
                                              bool uniform = false);
  void lower_load(const SpirvInst& inst);
  void lower_array_length(const SpirvInst& inst);
  std::pair<uint32_t, Reg> resource_of(const Pointer& pointer);
  uint32_t add_resource(const ResourceRef& ref);
  uint32_t descriptors_in(uint32_t type);
  Reg canonical(Reg reg);  // before it is stored or seen as an integer: the same NaN on all machines

  // --- lower_atomics.cpp ---
  bool lower_atomics(const SpirvInst& inst);  // and barriers
  void lower_barrier(const SpirvInst& inst);

  // --- lower_arithmetic.cpp, lower_vector.cpp, lower_ext.cpp, lower_image.cpp ---
  bool lower_by_table(const SpirvInst& inst);
  bool lower_arithmetic(const SpirvInst& inst);
  bool lower_vector(const SpirvInst& inst);
  void lower_matrix_product(const SpirvInst& inst);
  Reg dot(std::span<const Reg> a, std::span<const Reg> b);
  Reg select_dynamic(std::span<const Reg> values, Reg index);
  void lower_ext_inst(const SpirvInst& inst);
  bool lower_ext_by_table(const SpirvInst& inst);
  bool lower_ext_geometric(const SpirvInst& inst);
  bool lower_ext_packing(const SpirvInst& inst);
  void lower_matrix_function(const SpirvInst& inst);
  void lower_interpolation(const SpirvInst& inst);
  void lower_parts(const SpirvInst& inst);  // Modf, Frexp and their Struct forms
  bool lower_image(const SpirvInst& inst);
  // Ids, 0: not given; offsets are 2 or 8 registers.
  struct ImageOperands {
    uint32_t lod = 0, dx = 0, dy = 0;  // lod: or the bias
    std::span<const Reg> offsets;
  };
  ImageOperands read_image_operands(const SpirvInst& inst, uint32_t at, uint32_t allowed);
  const Value* image_value(uint32_t id);  // fails if it is no image
  void lower_sample(const SpirvInst& inst);
  void lower_fetch(const SpirvInst& inst);
  void lower_image_write(const SpirvInst& inst);
  void lower_texel_pointer(const SpirvInst& inst);
  std::array<Reg, 2> texel_coordinate(const Type& image, uint32_t id);
  void lower_image_query(const SpirvInst& inst);
  Reg gradient_lod(const Value& image, std::span<const Reg> dx, std::span<const Reg> dy);
  std::span<const Reg> emit_image(Opcode op, const Value& image, std::span<const Reg> operands);

  // --- lower_interface.cpp ---
  void declare_globals(const SpirvEntryPoint& entry);
  void declare_interface(const SpirvInst& inst, bool output);
  void declare_built_in(const SpirvInst& inst, uint32_t built_in, uint32_t type, Reg first, bool output);
  bool declare_sample_input(spv::BuiltIn which, Reg first, uint64_t count);  // lower_interpolation.cpp
  void declare_distances(bool cull, uint32_t type, Reg first, bool output);
  struct Place {
    uint32_t location = 0, component = 0;
    Interpolation interpolation = Interpolation::perspective;
    bool output = false;
  };
  void declare_located(uint32_t type, Place& place, Reg& next);
  Place place_of(uint32_t id, uint32_t member, Place place) const;
  void declare_resource(const SpirvInst& inst, bool handle);
  void declare_shared(const SpirvInst& inst);
  void read_modes(const SpirvEntryPoint& entry);

  const SpirvModule& m_;
  const ShaderStage& stage_;
  const VkShaderStageFlagBits which_;
  const ResourceLayout& layout_;
  LoweredShader out_;
  Code& code_ = out_.code;
  std::optional<Error> error_;

  std::deque<Type> types_;
  std::vector<const Type*> types_of_;  // id -> type, null: not resolved yet
  std::deque<std::vector<uint32_t>> constants_;
  std::vector<const std::vector<uint32_t>*> constants_of_;  // id -> bits, null: no constant
  size_t constant_words_ = 0, constant_registers_ = 0;
  std::vector<uint32_t> value_of_;  // id -> index into values_, 0: none
  std::vector<Value> values_;
  std::deque<Variable> variables_;
  std::vector<std::unique_ptr<Reg[]>> chunks_;
  Reg* chunk_next_ = nullptr;
  size_t chunk_left_ = 0, pool_size_ = 0;
  Known known_;
  size_t known_waiting_ = 0;                               // entries of BlockState::known
  std::map<std::array<uint32_t, 5>, uint32_t> resources_;  // what they are, index in Code::resources
  Frame* frame_ = nullptr;
  uint32_t skip_label_ = kNoReg;
  uint32_t pending_ = 0, open_loops_ = 0;
  bool uniform_ = true;  // all lanes that live execute
  uint32_t word_ = 0, line_ = 0, steps_ = 0;
  std::vector<Opcode> producers_;  // by register, of the first `scanned_` instructions
  size_t scanned_ = 0;
};

}  // namespace lapilli::spirv
