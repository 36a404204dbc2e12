// Vertex reuse by a direct-mapped table of the vertex index, then full batches of 64.
#include "geometry/vertex_stage.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace lapilli {
namespace {

constexpr uint32_t kTableSize = VertexStage::kMostVertices;

}  // namespace

void VertexStage::begin_list() {
  inputs_.positions.clear();
  inputs_.distances.clear();
}

bool VertexStage::begin(const DrawCall& draw, ExecutionLimits& limits) {
  draw_ = &draw;
  limits_ = &limits;
  first_ = static_cast<uint32_t>(inputs_.positions.size());
  vertex_.clear();
  instance_.clear();
  instance_first_ = 0;
  parts_.clear();
  parts_.push_back({draw.resources, 0});
  batch_.draw_parameters[0] = draw.indices.data != nullptr ? static_cast<uint32_t>(draw.vertex_offset) : draw.first;
  batch_.draw_parameters[1] = draw.first_instance;
  batch_.draw_parameters[2] = draw.draw_index;
  return execution_.prepare(*draw.state->programs->vertex, *draw.resources, &limits);
}

void VertexStage::change_resources(const DrawCall& draw) {
  instance_first_ = static_cast<uint32_t>(vertex_.size());
  parts_.push_back({draw.resources, instance_first_});
}

void VertexStage::make_table() {
  last_slot_.assign(kTableSize, 0);
  const size_t count = vertex_.size();
  vertex_.resize(kMostVertices);
  std::fill_n(vertex_.data() + count, kMostVertices - count, 0u);
  vertex_.resize(count);
}

// Without branches on whether a vertex is new, which nobody could predict.
uint32_t VertexStage::add(uint32_t instance, std::span<uint32_t> vertices) {
  if (last_slot_.empty()) make_table();
  const uint32_t before = static_cast<uint32_t>(vertex_.size());
  if (before == 0 || instance_[before - 1] != instance) instance_first_ = before;
  const uint32_t first = instance_first_;
  vertex_.resize(before + vertices.size());
  uint32_t* const known = vertex_.data();
  uint16_t* const table = last_slot_.data();
  uint32_t count = before;
  for (uint32_t& each : vertices) {
    const uint32_t vertex = each;
    const uint32_t last = table[vertex % kTableSize];
    const bool found = (last - first < count - first) & (known[last] == vertex);
    const uint32_t slot = found ? last : count;
    table[vertex % kTableSize] = static_cast<uint16_t>(slot);
    known[slot] = vertex;
    count += found ? 0 : 1;
    each = first_ + slot;
  }
  vertex_.resize(count);
  instance_.resize(count);
  std::fill_n(instance_.data() + before, count - before, instance);
  return count - before;
}

void VertexStage::add_distinct(uint32_t instance, std::span<uint32_t> vertices) {
  const size_t before = vertex_.size();
  if (before == 0 || instance_[before - 1] != instance) instance_first_ = static_cast<uint32_t>(before);
  vertex_.resize(before + vertices.size());
  instance_.resize(before + vertices.size());
  std::copy(vertices.begin(), vertices.end(), vertex_.data() + before);
  std::fill_n(instance_.data() + before, vertices.size(), instance);
  std::iota(vertices.begin(), vertices.end(), first_ + static_cast<uint32_t>(before));
}

// For the slots of a batch; `part` is that of the first one, and then that of the last.
void VertexStage::prepare_lanes(uint32_t first, uint32_t lanes, size_t& part) {
  const uint32_t end = first + lanes;
  for (uint32_t slot = first; slot < end;) {
    while (part + 1 < parts_.size() && parts_[part + 1].first <= slot) ++part;
    const uint32_t part_end = part + 1 < parts_.size() ? std::min(parts_[part + 1].first, end) : end;
    // The program is bound already: this cannot fail.
    (void)execution_.prepare(*draw_->state->programs->vertex, *parts_[part].resources, limits_);
    execution_.prepare_lanes(slot - first, part_end - first);
    slot = part_end;
  }
}

void VertexStage::run(const SetupState& state, BinChunk& chunk) {
  const uint32_t count = static_cast<uint32_t>(vertex_.size());
  const size_t slots = std::max<uint32_t>(draw_->state->programs->output_slots, kSlotVaryings);
  const size_t lines_per_batch = slots * (kBatchLanes / 16);
  if (outputs_.size() < lines_per_batch) outputs_.resize(lines_per_batch);
  batch_.bindings = draw_->bindings;
  batch_.outputs = outputs_[0].value;
  chunk.vertices.reserve(chunk.vertices.size() + count + kBatchLanes);
  chunk.varyings.reserve(chunk.varyings.size() + (count + kBatchLanes) * state.varyings.size());
  inputs_.positions.reserve(inputs_.positions.size() + count + kBatchLanes);
  size_t part = 0;
  for (uint32_t first = 0; first < count; first += kBatchLanes) {
    const uint32_t lanes = std::min(count - first, kBatchLanes);
    // Idle lanes keep what they had.
    std::memcpy(batch_.vertex_index, vertex_.data() + first, lanes * sizeof(uint32_t));
    std::memcpy(batch_.instance_index, instance_.data() + first, lanes * sizeof(uint32_t));
    if (parts_.size() > 1) prepare_lanes(first, lanes, part);
    execution_.run_vertices(batch_, lanes == kBatchLanes ? ~uint64_t{0} : (uint64_t{1} << lanes) - 1);
    append_vertices(state, batch_.outputs, lanes, chunk, inputs_);
  }
}

}  // namespace lapilli
