// Running programs: the frame of an Execution, descriptors, and the time limit.
#include "shader/program.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "shader/program_data.h"

namespace lapilli {
namespace {

constexpr std::align_val_t kAlignment{64};
constexpr Descriptor kUnwritten;

// All lanes of the quads that have one in `lanes`.
uint64_t whole_quads(uint64_t lanes) {
  const uint64_t pairs = lanes | lanes >> 1;
  return ((pairs | pairs >> 2) & 0x1111111111111111) * 15;
}

void broadcast(std::byte* reg, uint32_t bits) {
  uint32_t lanes[kBatchLanes];
  std::fill_n(lanes, kBatchLanes, bits);
  std::memcpy(reg, lanes, sizeof lanes);
}

}  // namespace

const Descriptor& descriptor_at(const Frame& frame, uint32_t resource, uint32_t index) {
  const ResourceRef& ref = frame.refs[resource];
  if (index >= ref.count || ref.set >= kMaxDescriptorSets) return kUnwritten;
  const Descriptor* const set = frame.resources->sets[ref.set];
  return set == nullptr ? kUnwritten : set[ref.first + index];
}

BufferRange buffer_at(const Frame& frame, uint32_t resource, uint32_t index) {
  const Descriptor& descriptor = descriptor_at(frame, resource, index);
  if (descriptor.data == nullptr) return {};
  const ResourceRef& ref = frame.refs[resource];
  if (ref.dynamic_offset < 0 || frame.resources->dynamic_offsets == nullptr) return {descriptor.data, descriptor.size};
  const uint64_t offset = frame.resources->dynamic_offsets[static_cast<uint32_t>(ref.dynamic_offset) + index];
  if (offset >= descriptor.room) return {};
  return {descriptor.data + offset, std::min(descriptor.size, descriptor.room - offset)};
}

bool time_is_up(Frame* frame) {
  frame->loop_budget = kLoopsPerClockRead;
  ExecutionLimits* const limits = frame->limits;
  if (limits == nullptr) return false;
  if (limits->expired.load(std::memory_order_relaxed)) return true;
  if (std::chrono::steady_clock::now() < limits->deadline) return false;
  limits->expired.store(true, std::memory_order_relaxed);
  return true;
}

// One block of memory: the frame, the registers, the mask registers, the buffers.
struct Execution::State {
  ~State() { release(); }

  void release() { ::operator delete(memory, kAlignment); }

  bool reserve(size_t bytes) {
    if (bytes <= capacity) return true;
    release();
    capacity = 0;
    program_id = 0;
    memory = static_cast<std::byte*>(::operator new(bytes, kAlignment, std::nothrow));
    if (memory == nullptr) return false;
    capacity = bytes;
    return true;
  }

  void run(uint64_t exec, uint64_t write) {
    if (write == 0) return;
    if (frame->limits != nullptr && frame->limits->expired.load(std::memory_order_relaxed)) return;
    frame->exec = exec;
    frame->write = write;
    frame->lanes = write;
    std::fill_n(frame->masks, program->source.mask_count, uint64_t{0});
    entry(program->ops.data(), frame);
  }

  std::byte* memory = nullptr;
  size_t capacity = 0;
  uint64_t program_id = 0;  // whose constants are in the registers
  const Program* program = nullptr;
  Frame* frame = nullptr;
  Run* entry = nullptr;
};

Execution::Execution() = default;
Execution::~Execution() = default;

bool Execution::prepare(const Program& program, const ResourceTable& resources, ExecutionLimits* limits) {
  if (state_ == nullptr) state_.reset(new (std::nothrow) State);
  if (state_ == nullptr) return false;
  State& state = *state_;
  const Code& code = program.source;
  const size_t registers_end = sizeof(Frame) + program.register_count * kRegisterBytes;
  const size_t masks_end = registers_end + code.mask_count * sizeof(uint64_t);
  if (!state.reserve(masks_end + code.resources.size() * sizeof(BufferRange))) return false;

  Frame* const frame = new (state.memory) Frame;
  frame->masks = new (state.memory + registers_end) uint64_t[code.mask_count];
  frame->limits = limits;
  frame->last = &program.ops.back();
  frame->resources = &resources;
  frame->refs = code.resources.data();
  frame->lists = program.lists.data();
  frame->attributes = program.attributes.data();
  frame->colors = program.colors.data();
  frame->depth = program.depth;
  frame->sampling = program.sampling;
  std::copy_n(code.workgroup_size, 3, frame->workgroup_size);
  BufferRange* const buffers = new (state.memory + masks_end) BufferRange[code.resources.size()];
  for (uint32_t i = 0; i < code.resources.size(); ++i) buffers[i] = buffer_at(*frame, i, 0);
  frame->buffers = buffers;

  state.frame = frame;
  state.program = &program;
  state.entry = &interpreter_run(program.target);
  if (state.program_id != program.id) {
    for (const Program::Constant& constant : program.constants) {
      broadcast(frame->registers() + constant.reg * kRegisterBytes, constant.bits);
    }
    state.program_id = program.id;
  }
  return true;
}

void Execution::run_vertices(const VertexBatch& batch, uint64_t lanes) {
  state_->frame->vertices = &batch;
  state_->run(lanes, lanes);
}

void Execution::run_fragments(const FragmentBatch& batch, uint64_t lanes) {
  state_->frame->fragments = &batch;
  state_->run(whole_quads(lanes), lanes);
}

void Execution::run_invocations(const ComputeBatch& batch, uint64_t lanes) {
  state_->frame->invocations = &batch;
  state_->run(lanes, lanes);
}

}  // namespace lapilli
