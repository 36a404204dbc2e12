// Running programs: the frame of an Execution, descriptors, and the time limit.
#include "shader/program.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "shader/program_data.h"

namespace lapilli {
namespace {

constexpr std::align_val_t kAlignment{64};
constexpr Descriptor kUnwritten;

constexpr size_t aligned(size_t bytes) { return (bytes + 63) / 64 * 64; }

}  // namespace

const Descriptor& descriptor_at(const Frame& frame, uint32_t resource, uint32_t index) {
  const ResourceRef& ref = frame.refs[resource];
  if (index >= ref.count || ref.set >= kMaxDescriptorSets) return kUnwritten;
  const Descriptor* const set = frame.resources->sets[ref.set];
  return set == nullptr ? kUnwritten : set[ref.first + index];
}

BufferRange buffer_at(const Frame& frame, uint32_t resource, uint32_t index) {
  if (frame.refs[resource].set == kSharedMemory)
    return {frame.shared + frame.refs[resource].first, frame.refs[resource].count};
  const Descriptor& descriptor = descriptor_at(frame, resource, index);
  if (descriptor.data == nullptr) return {};
  const ResourceRef& ref = frame.refs[resource];
  if (ref.dynamic_offset < 0 || frame.resources->dynamic_offsets == nullptr) return {descriptor.data, descriptor.size};
  const uint64_t offset = frame.resources->dynamic_offsets[static_cast<uint32_t>(ref.dynamic_offset) + index];
  if (offset >= descriptor.room) return {};
  return {descriptor.data + offset, std::min(descriptor.size, descriptor.room - offset)};
}

bool time_is_up(Frame* frame) {
  frame->loop_budget = frame->last->imm;
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

// One block of memory: frames, each with its registers and mask registers behind it; and what they share: buffers,
// scalars, the workgroup's memory. There is one frame, or one for each batch of a workgroup with barriers.
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
    frame_bytes = aligned(masks + code.mask_count * sizeof(uint64_t));
    const size_t ranges = next.frames * frame_bytes;
    const size_t scalars = aligned(ranges + code.resources.size() * sizeof(BufferRange));
    const size_t shared = aligned(scalars + next.scalar_count * sizeof(uint32_t));
    if (!reserve(shared + code.shared_bytes)) return false;
    entry = &interpreter_run(next.target);
    spread = &interpreter_spread(next.target);
    program = &next;
    buffers = new (memory + ranges) BufferRange[code.resources.size()];
    uint32_t* const constants = new (memory + scalars) uint32_t[next.scalar_count];
    std::copy(next.constants.begin(), next.constants.end(), constants);
    for (uint32_t i = 0; i < next.frames; ++i) {
      Frame* const each = new (memory + i * frame_bytes) Frame;
      each->masks = new (memory + i * frame_bytes + masks) uint64_t[code.mask_count];
      each->buffers = buffers;
      each->scalars = constants;
      each->shared = memory + shared;
      each->last = &next.ops.back();
      each->refs = code.resources.data();
      each->lists = next.lists.data();
      each->attributes = next.attributes.data();
      each->colors = next.colors.data();
      each->blends = next.blends.data();
      each->depth = next.depth;
      each->sampling = next.sampling;
      std::copy_n(code.workgroup_size, 3, each->workgroup_size);
      spread(next.constant_lanes, each);
    }
    frame = frame_at(0);
    batches_until_look = 0;
    program_id = next.id;
    limits_serial = 0;
    return true;
  }

  Frame* frame_at(uint32_t i) const { return std::launder(reinterpret_cast<Frame*>(memory + i * frame_bytes)); }

  void run_once() {
    once_is_due = false;
    entry(program->once.data(), frame);
    for (uint32_t i = 0; i < program->frames; ++i) spread(program->uniform_lanes, frame_at(i));
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

  // Before each batch: a program without loops may be long, and a draw or dispatch have 2^48 batches.
  bool expired() {
    if (frame->limits == nullptr) return false;
    if (batches_until_look-- != 0) return frame->limits->expired.load(std::memory_order_relaxed);
    batches_until_look = frame->last->imm - 1;
    return frame->limits->read_clock();
  }

  void run(uint64_t exec, uint64_t write) {
    if (write == 0 || expired()) return;
    if (once_is_due) run_once();
    start(frame, exec, write);
  }

  // A batch from the program's start.
  void start(Frame* batch, uint64_t exec, uint64_t write) {
    batch->exec = exec;
    batch->write = write;
    batch->lanes = write;
    batch->resume = nullptr;
    std::fill_n(batch->masks, program->source.mask_count, uint64_t{0});
    entry(program->ops.data(), batch);
  }

  // Takes every batch that waits at a barrier to its next one, or its end. False: none of them waits any more.
  bool pass_barrier() {
    bool waiting = false;
    for (uint32_t i = 0; i < program->frames && !expired(); ++i) {
      Frame* const batch = frame_at(i);
      if (batch->resume == nullptr) continue;
      entry(std::exchange(batch->resume, nullptr), batch);
      waiting |= batch->resume != nullptr;
    }
    return waiting;
  }

  std::byte* memory = nullptr;
  size_t capacity = 0;
  uint64_t program_id = 0;  // that the memory is laid out for; 0: none
  const Program* program = nullptr;
  size_t frame_bytes = 0;
  ComputeBatch batches[kMaxWorkgroupBatches];  // of the frames
  Frame* frame = nullptr;                      // the first one
  BufferRange* buffers = nullptr;
  Run* entry = nullptr;
  SpreadScalars* spread = nullptr;
  uint64_t limits_serial = 0;  // of the pass or dispatch that the resources were bound in; 0: not known
  bool once_is_due = false;
  uint32_t batches_until_look = 0;
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
  for (uint32_t i = 0; i < program.frames; ++i) {
    state.frame_at(i)->limits = limits;
    state.frame_at(i)->resources = &resources;
  }
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

void Execution::run_workgroup(const uint32_t workgroup[3], const uint32_t num_workgroups[3]) {
  State& state = *state_;
  if (state.once_is_due) state.run_once();
  const Code& code = state.program->source;
  std::memset(state.frame->shared, 0, code.shared_bytes);
  const uint32_t invocations = code.invocations();
  for (uint32_t i = 0; i * kBatchLanes < invocations && !state.expired(); ++i) {
    const uint32_t place = state.program->frames == 1 ? 0 : i;
    ComputeBatch& batch = state.batches[place];
    std::copy_n(workgroup, 3, batch.workgroup);
    std::copy_n(num_workgroups, 3, batch.num_workgroups);
    batch.first_invocation = i * kBatchLanes;
    const uint32_t left = invocations - batch.first_invocation;
    const uint64_t lanes = left >= kBatchLanes ? ~uint64_t{0} : (uint64_t{1} << left) - 1;
    Frame* const frame = state.frame_at(place);
    frame->invocations = &batch;
    state.start(frame, lanes, lanes);
  }
  while (state.pass_barrier()) {
  }
}

}  // namespace lapilli
