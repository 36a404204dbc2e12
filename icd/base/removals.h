// What a draw can be spared, by name: LAPILLI_KEEP=hidden,uniforms has the work done all the same, and the ledger says
// how much it would have been. The image is the same either way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lapilli {

enum class Removal : uint8_t {
  hidden,     // shading of pixels that a later opaque draw covers, or that fail the early depth test
  blocks,     // depth tests of 8x8 blocks that lie behind (or before) everything there
  triangles,  // triangles without a pixel: culled, outside, between pixel centres
  vertices,   // runs of the vertex program for a vertex that several triangles share
  varyings,   // vertex outputs that the fragment program does not read: neither computed nor interpolated
  uniforms,   // ops whose result is the same in a whole draw: run once per draw
  outputs,    // ops whose result only a masked or missing attachment would take
  kCount
};
constexpr size_t kRemovalCount = static_cast<size_t>(Removal::kCount);

struct RemovalInfo {
  const char* name;  // as in LAPILLI_KEEP
  const char* unit;  // what the ledger counts
};
const RemovalInfo& removal_info(Removal removal);

// Whether LAPILLI_KEEP names it, so that the work has to be done. "all" names all.
bool keeps(Removal removal);
// From LAPILLI_KEEP, read when an instance is created; an unknown name is a warning.
void set_kept_removals_from_environment();
void set_kept_removals(uint32_t bits);  // for tests: bit i is Removal i
uint32_t kept_removals();

// One draw's account. Workers add to it with add_to_ledger.
struct DrawLedger {
  struct Line {
    uint64_t count = 0;     // in RemovalInfo::unit
    uint64_t lane_ops = 0;  // what that would have cost: lanes x cost (ops.def)
  };
  Line lines[kRemovalCount];
  uint64_t vertices = 0, fragments = 0;  // lanes that the programs ran, helpers among them
  uint64_t lane_ops_run = 0;             // by the same measure
};
// From any thread. A null ledger is none.
void add_to_ledger(DrawLedger* ledger, Removal removal, uint64_t count, uint64_t lane_ops);
// Lanes that ran a program, and what they cost.
void add_vertices_to_ledger(DrawLedger* ledger, uint64_t lanes, uint64_t lane_ops);
void add_fragments_to_ledger(DrawLedger* ledger, uint64_t lanes, uint64_t lane_ops);

}  // namespace lapilli
