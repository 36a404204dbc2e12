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
  return frame->limits != nullptr && frame->limits->read_clock();
}

bool ExecutionLimits::read_clock() {
  if (!expired.load(std::memory_order_relaxed)) {
    if (std::chrono::steady_clock::now() < deadline) return false;
    expired.store(true, std::memory_order_relaxed);
  }
  return true;
}

uint64_t ExecutionLimits::next_serial() {
  static std::atomic<uint64_t> next{1};
  return next.fetch_add(1, std::memory_order_relaxed);
}

// One block of memory: the frame, the registers, the mask registers, the buffers, the scalars.
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

  // All that depends on the program alone.
  bool bind(const Program& next) {
    const Code& code = next.source;
    const size_t masks = sizeof(Frame) + next.register_count * kRegisterBytes;
    const size_t ranges = masks + code.mask_count * sizeof(uint64_t);
    const size_t scalars = ranges + code.resources.size() * sizeof(BufferRange);
    if (!reserve(scalars + next.scalar_count * sizeof(uint32_t))) return false;
    frame = new (memory) Frame;
    frame->masks = new (memory + masks) uint64_t[code.mask_count];
    buffers = new (memory + ranges) BufferRange[code.resources.size()];
    frame->buffers = buffers;
    frame->scalars = new (memory + scalars) uint32_t[next.scalar_count];
    frame->last = &next.ops.back();
    frame->refs = code.resources.data();
    frame->lists = next.lists.data();
    frame->attributes = next.attributes.data();
    frame->colors = next.colors.data();
    frame->blends = next.blends.data();
    frame->depth = next.depth;
    frame->sampling = next.sampling;
    std::copy_n(code.workgroup_size, 3, frame->workgroup_size);
    std::copy(next.constants.begin(), next.constants.end(), frame->scalars);
    entry = &interpreter_run(next.target);
    spread = &interpreter_spread(next.target);
    spread(next.constant_lanes, frame);
    program = &next;
    program_id = next.id;
    limits_serial = 0;
    return true;
  }

  void run_once() {
    once_is_due = false;
    entry(program->once.data(), frame);
    spread(program->uniform_lanes, frame);
  }

  void run_once_for(uint32_t first, uint32_t end) {
    if (once_is_due) entry(program->once.data(), frame);
    once_is_due = false;
    limits_serial = 0;  // the other lanes are those of other draws
    for (const Spread& each : program->uniform_lanes) {
      uint32_t lanes[kBatchLanes];
      std::byte* const reg = frame->registers() + each.reg * kRegisterBytes + first * sizeof(uint32_t);
      std::fill_n(lanes, end - first, frame->scalars[each.scalar]);
      std::memcpy(reg, lanes, (end - first) * sizeof(uint32_t));
    }
  }

  void run(uint64_t exec, uint64_t write) {
    if (write == 0) return;
    if (frame->limits != nullptr && frame->limits->expired.load(std::memory_order_relaxed)) return;
    if (once_is_due) run_once();
    frame->exec = exec;
    frame->write = write;
    frame->lanes = write;
    std::fill_n(frame->masks, program->source.mask_count, uint64_t{0});
    entry(program->ops.data(), frame);
  }

  std::byte* memory = nullptr;
  size_t capacity = 0;
  uint64_t program_id = 0;  // that the memory is laid out for; 0: none
  const Program* program = nullptr;
  Frame* frame = nullptr;
  BufferRange* buffers = nullptr;
  Run* entry = nullptr;
  SpreadScalars* spread = nullptr;
  uint64_t limits_serial = 0;  // of the pass or dispatch that the resources were bound in; 0: not known
  bool once_is_due = false;
  float blend_constants[4] = {};  // that the once section has seen
};

Execution::Execution() = default;
Execution::~Execution() = default;

bool Execution::prepare(const Program& program, const ResourceTable& resources, ExecutionLimits* limits) {
  if (state_ == nullptr) state_.reset(new (std::nothrow) State);
  if (state_ == nullptr) return false;
  State& state = *state_;
  if (state.program_id != program.id && !state.bind(program)) return false;
  Frame* const frame = state.frame;
  const uint64_t serial = limits != nullptr ? limits->serial : 0;
  if (serial != 0 && serial == state.limits_serial && frame->resources == &resources) return true;
  state.limits_serial = serial;
  frame->limits = limits;
  frame->resources = &resources;
  const size_t count = program.source.resources.size();
  for (uint32_t i = 0; i < count; ++i) state.buffers[i] = buffer_at(*frame, i, 0);
  state.once_is_due = !program.once.empty();
  return true;
}

void Execution::prepare_lanes(uint32_t first, uint32_t end) { state_->run_once_for(first, end); }

void Execution::run_vertices(const VertexBatch& batch, uint64_t lanes) {
  state_->frame->vertices = &batch;
  state_->run(lanes, lanes);
}

void Execution::run_fragments(const FragmentBatch& batch, uint64_t lanes) {
  State& state = *state_;
  state.frame->fragments = &batch;
  if (state.program->once_reads_batch &&
      !std::equal(batch.blend_constants, batch.blend_constants + 4, state.blend_constants)) {
    std::copy_n(batch.blend_constants, 4, state.blend_constants);
    state.once_is_due = true;
  }
  state_->run(batch.lane_triangles != nullptr ? lanes : whole_quads(lanes), lanes);
}

void Execution::run_invocations(const ComputeBatch& batch, uint64_t lanes) {
  state_->frame->invocations = &batch;
  state_->run(lanes, lanes);
}

}  // namespace lapilli
