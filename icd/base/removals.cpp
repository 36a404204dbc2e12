// Names of the removals, and which of them LAPILLI_KEEP switches off.
#include "base/removals.h"

#include <atomic>
#include <cstdlib>

#include "base/log.h"

namespace lapilli {
namespace {

constexpr RemovalInfo kRemovals[kRemovalCount] = {
    {"hidden", "pixels"},   {"blocks", "blocks"}, {"triangles", "triangles"}, {"vertices", "vertices"},
    {"varyings", "values"}, {"uniforms", "ops"},  {"outputs", "ops"},
};
constexpr uint32_t kAll = (1u << kRemovalCount) - 1;

std::atomic<uint32_t> kept{0};

uint32_t bits_of_name(std::string_view name) {
  if (name == "all") return kAll;
  for (size_t i = 0; i < kRemovalCount; ++i) {
    if (name == kRemovals[i].name) return 1u << i;
  }
  return 0;
}

void add(uint64_t& sum, uint64_t value) { std::atomic_ref(sum).fetch_add(value, std::memory_order_relaxed); }

}  // namespace

const RemovalInfo& removal_info(Removal removal) { return kRemovals[static_cast<size_t>(removal)]; }

bool keeps(Removal removal) {
  return (kept.load(std::memory_order_relaxed) >> static_cast<uint32_t>(removal) & 1) != 0;
}

void set_kept_removals(uint32_t bits) { kept.store(bits & kAll, std::memory_order_relaxed); }
uint32_t kept_removals() { return kept.load(std::memory_order_relaxed); }

void set_kept_removals_from_environment() {
  const char* const text = std::getenv("LAPILLI_KEEP");
  uint32_t bits = 0;
  for (std::string_view rest = text != nullptr ? text : ""; !rest.empty();) {
    const size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    const uint32_t found = bits_of_name(name);
    if (found == 0) log_warning("LAPILLI_KEEP: unknown \"%.*s\"", static_cast<int>(name.size()), name.data());
    bits |= found;
  }
  set_kept_removals(bits);
}

void add_to_ledger(DrawLedger* ledger, Removal removal, uint64_t count, uint64_t lane_ops) {
  if (ledger == nullptr) return;
  add(ledger->lines[static_cast<size_t>(removal)].count, count);
  add(ledger->lines[static_cast<size_t>(removal)].lane_ops, lane_ops);
}

void add_vertices_to_ledger(DrawLedger* ledger, uint64_t lanes, uint64_t lane_ops) {
  if (ledger == nullptr) return;
  add(ledger->vertices, lanes);
  add(ledger->lane_ops_run, lane_ops);
}

void add_fragments_to_ledger(DrawLedger* ledger, uint64_t lanes, uint64_t lane_ops) {
  if (ledger == nullptr) return;
  add(ledger->fragments, lanes);
  add(ledger->lane_ops_run, lane_ops);
}

}  // namespace lapilli
