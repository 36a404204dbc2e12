// What an op is to the interpreter: a handler and its operands; and the frame that a program runs in.
//
// A handler is compiled once for each SIMD target and each form. The form says where an operand comes from and whether
// the result goes to a register; the result of an op with one result is always left in the accumulator too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/simd_dispatch.h"
#include "shader/batch.h"
#include "shader/ir.h"
#include "shader/resources.h"

namespace lapilli {

struct BlendEquation;
struct ExecutionLimits;
struct TexelFunctions;
struct SamplingFunctions;

// The true type depends on the target (machine-inl.h).
using Handler = void (*)();

// Register numbers count 256 bytes from Frame::registers on. `c` is the number of results where the instruction says
// it; `a` is the place in Frame::lists where there is an operand list. Labels are distances from this op, in ops.
struct Op {
  Handler handler;
  uint16_t dst, a, b, c;
  uint32_t imm, imm2;
};
static_assert(sizeof(Op) == 24);

constexpr uint16_t kNoOperand = 0xFFFF;
constexpr uint32_t kMaxRegisters = 0xFFFF;
constexpr size_t kRegisterBytes = 4 * kBatchLanes;

// Forms: where the first (second, third) operand comes from, and whether the result is stored.
enum Form : uint8_t {
  kKeep = 0,   // result in the accumulator only
  kStore = 1,  // and in register dst
  kFromRegisters = 0,
  kAccumulatorIsA = 2,
  kAccumulatorIsB = 4,
  kAccumulatorIsC = 6,
};
// On scalars, in the section that runs once per draw: operands and results are places in Frame::scalars.
constexpr uint32_t kOnce = 8;
constexpr uint32_t kFormCount = 9;

struct HandlerEntry {
  Opcode op;
  uint8_t form;
  Handler handler;
};

// A buffer descriptor with its dynamic offset applied.
struct BufferRange {
  std::byte* data = nullptr;
  uint64_t size = 0;  // bytes
};

struct Attribute {
  uint32_t binding = 0;
  uint32_t offset = 0;      // bytes
  uint32_t texel_size = 0;  // bytes
  const TexelFunctions* texels = nullptr;
};

// A register all lanes of which hold a scalar.
struct Spread {
  uint16_t reg;
  uint16_t scalar;
};

// The state of one running program. The registers follow it in memory, the mask registers follow them.
struct alignas(64) Frame {
  uint64_t exec = 0;   // lanes that run, helper lanes included
  uint64_t write = 0;  // lanes that may have side effects
  uint64_t lanes = 0;  // `write` at the start: all others are helper lanes
  uint64_t* masks = nullptr;
  const Op* last = nullptr;    // the op `end`
  uint32_t loop_budget = 0;    // iterations until the clock is read
  const Op* resume = nullptr;  // where a batch that stopped at a barrier goes on
  ExecutionLimits* limits = nullptr;

  const ResourceTable* resources = nullptr;
  const ResourceRef* refs = nullptr;
  const BufferRange* buffers = nullptr;  // array element 0 of each resource
  std::byte* shared = nullptr;           // the workgroup's memory
  uint32_t* scalars = nullptr;           // constants, and what is the same in all lanes of a draw
  const uint16_t* lists = nullptr;       // registers of operand lists
  const Attribute* attributes = nullptr;
  const TexelFunctions* const* colors = nullptr;  // one for each colour attachment
  const BlendEquation* blends = nullptr;          // imm2 of blend_color
  const TexelFunctions* depth = nullptr;
  const SamplingFunctions* sampling = nullptr;
  uint32_t workgroup_size[3] = {1, 1, 1};

  // The batch; those of other stages are null.
  const VertexBatch* vertices = nullptr;
  const FragmentBatch* fragments = nullptr;
  const ComputeBatch* invocations = nullptr;

  // The accumulator of the plain loop.
  alignas(64) uint32_t accumulator[kBatchLanes];

  std::byte* registers() { return reinterpret_cast<std::byte*>(this) + sizeof(Frame); }
};

constexpr uint32_t kLoopsPerClockRead = 1024;
// Called by `loop` when its budget is used up: refills it, and says whether the program has to end.
bool time_is_up(Frame* frame);
// Descriptor `index` of a resource; one outside the array is an unwritten descriptor.
const Descriptor& descriptor_at(const Frame& frame, uint32_t resource, uint32_t index);
BufferRange buffer_at(const Frame& frame, uint32_t resource, uint32_t index);

// What one target's code offers.
using Run = void(const Op* first, Frame* frame);
Run& interpreter_run(SimdTarget target);
// Fills registers with scalars.
using SpreadScalars = void(std::span<const Spread> list, Frame* frame);
SpreadScalars& interpreter_spread(SimdTarget target);
// Null where the op has no such form.
Handler find_handler(SimdTarget target, Opcode op, uint32_t form);

// The entries of one file of handlers.
using HandlerList = std::span<const HandlerEntry>;

}  // namespace lapilli
