// Vertex reuse by a hash of the index, then full batches of 64.
#include "geometry/vertex_stage.h"

#include <algorithm>

namespace lapilli {
namespace {

constexpr uint32_t kLookupSize = 8192;  // a power of two, over twice the vertices of a chunk

uint32_t hash(uint32_t index) { return (index * 2654435761u) >> 19; }
static_assert(kLookupSize == 1u << (32 - 19));

}  // namespace

bool VertexStage::begin(const DrawCall& draw, ExecutionLimits& limits) {
  draw_ = &draw;
  keys_.clear();
  if (lookup_.empty()) lookup_.assign(kLookupSize, Lookup{0, 0, 0});
  return execution_.prepare(*draw.state->programs->vertex, *draw.resources, &limits);
}

void VertexStage::begin_instance(uint32_t instance) {
  instance_ = instance;
  entries_ = 0;
  if (++stamp_ == 0) {  // after 2^32 instances the stamps start again
    std::fill(lookup_.begin(), lookup_.end(), Lookup{0, 0, 0});
    stamp_ = 1;
  }
}

uint32_t VertexStage::add(uint32_t vertex_index) {
  uint32_t at = hash(vertex_index);
  for (; lookup_[at].stamp == stamp_; at = (at + 1) % kLookupSize) {
    if (lookup_[at].index == vertex_index) return lookup_[at].slot;
  }
  const uint32_t slot = static_cast<uint32_t>(keys_.size());
  keys_.push_back({vertex_index, instance_});
  if (entries_ < kLookupSize / 2) {  // a full table only costs reuse
    lookup_[at] = {vertex_index, stamp_, slot};
    ++entries_;
  }
  return slot;
}

void VertexStage::run(const SetupState& state, BinChunk& chunk) {
  const uint32_t count = static_cast<uint32_t>(keys_.size());
  const uint32_t batches = (count + kBatchLanes - 1) / kBatchLanes;
  const size_t slots = std::max<uint32_t>(draw_->state->programs->output_slots, kSlotVaryings);
  const size_t lines_per_batch = slots * (kBatchLanes / 16);
  if (outputs_.size() < lines_per_batch) outputs_.resize(lines_per_batch);
  vertices_.clear();
  first_vertex_ = static_cast<uint32_t>(chunk.vertices.size());

  VertexBatch batch;
  batch.bindings = draw_->bindings;
  for (uint32_t b = 0; b < batches; ++b) {
    const uint32_t first = b * kBatchLanes;
    const uint32_t lanes = std::min(count - first, kBatchLanes);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const Key& key = keys_[first + std::min(lane, lanes - 1)];  // idle lanes repeat a vertex
      batch.vertex_index[lane] = key.index;
      batch.instance_index[lane] = draw_->first_instance + key.instance;
    }
    batch.outputs = outputs_[0].value;
    execution_.run_vertices(batch, lanes == kBatchLanes ? ~uint64_t{0} : (uint64_t{1} << lanes) - 1);
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      vertices_.push_back(append_vertex(state, batch.outputs + lane, chunk));
    }
  }
}

}  // namespace lapilli
