// Vertex reuse by a direct-mapped table of the vertex index, then full batches of 64.
#include "geometry/vertex_stage.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace lapilli {
namespace {

constexpr uint32_t kTableSize = VertexStage::kMostVertices;

}  // namespace

bool VertexStage::begin(const DrawCall& draw, ExecutionLimits& limits) {
  draw_ = &draw;
  vertex_.clear();
  instance_.clear();
  instance_first_ = 0;
  if (last_slot_.empty()) last_slot_.assign(kTableSize, 0);
  return execution_.prepare(*draw.state->programs->vertex, *draw.resources, &limits);
}

uint32_t VertexStage::add(uint32_t instance, std::span<uint32_t> vertices) {
  const uint32_t before = static_cast<uint32_t>(vertex_.size());
  if (before == 0 || instance_[before - 1] != instance) instance_first_ = before;
  vertex_.resize(before + vertices.size());
  uint32_t count = before;
  for (uint32_t& each : vertices) {
    const uint32_t vertex = each;
    uint16_t& last = last_slot_[vertex % kTableSize];
    if (last - instance_first_ >= count - instance_first_ || vertex_[last] != vertex) {
      last = static_cast<uint16_t>(count);
      vertex_[count++] = vertex;
    }
    each = last;
  }
  vertex_.resize(count);
  instance_.resize(count);
  std::fill_n(instance_.data() + before, count - before, instance);
  return count - before;
}

void VertexStage::add_distinct(uint32_t instance, std::span<uint32_t> vertices) {
  const size_t before = vertex_.size();
  vertex_.resize(before + vertices.size());
  instance_.resize(before + vertices.size());
  std::copy(vertices.begin(), vertices.end(), vertex_.data() + before);
  std::fill_n(instance_.data() + before, vertices.size(), instance);
  std::iota(vertices.begin(), vertices.end(), static_cast<uint32_t>(before));
}

void VertexStage::run(const SetupState& state, BinChunk& chunk) {
  const uint32_t count = static_cast<uint32_t>(vertex_.size());
  const uint32_t batches = (count + kBatchLanes - 1) / kBatchLanes;
  const size_t slots = std::max<uint32_t>(draw_->state->programs->output_slots, kSlotVaryings);
  const size_t lines_per_batch = slots * (kBatchLanes / 16);
  if (outputs_.size() < lines_per_batch) outputs_.resize(lines_per_batch);
  positions_.resize(batches * ClipPositions::kBatchFloats);
  // Idle lanes repeat a vertex.
  for (BinArray<uint32_t>* each : {&vertex_, &instance_}) {
    each->resize(batches * kBatchLanes);
    if (count > 0) std::fill(each->data() + count, each->data() + each->size(), (*each)[count - 1]);
  }

  VertexBatch batch;
  batch.bindings = draw_->bindings;
  batch.outputs = outputs_.empty() ? nullptr : outputs_[0].value;
  for (uint32_t b = 0; b < batches; ++b) {
    const uint32_t first = b * kBatchLanes;
    const uint32_t lanes = std::min(count - first, kBatchLanes);
    std::memcpy(batch.vertex_index, vertex_.data() + first, sizeof batch.vertex_index);
    std::memcpy(batch.instance_index, instance_.data() + first, sizeof batch.instance_index);
    execution_.run_vertices(batch, lanes == kBatchLanes ? ~uint64_t{0} : (uint64_t{1} << lanes) - 1);
    static_assert(kSlotPosition == 0);
    std::memcpy(positions_.data() + b * ClipPositions::kBatchFloats, batch.outputs,
                ClipPositions::kBatchFloats * sizeof(float));
    append_vertices(state, batch.outputs, lanes, chunk);
  }
}

}  // namespace lapilli
