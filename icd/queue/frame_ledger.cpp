// Sums of the draws' accounts, as text.
#include "queue/frame_ledger.h"

#include <cinttypes>

#include "base/text.h"

namespace lapilli {
namespace {

constexpr size_t kDrawsListed = 8;

void add(DrawLedger& sum, const DrawLedger& draw) {
  for (size_t i = 0; i < kRemovalCount; ++i) {
    sum.lines[i].count += draw.lines[i].count;
    sum.lines[i].lane_ops += draw.lines[i].lane_ops;
  }
  sum.vertices += draw.vertices;
  sum.fragments += draw.fragments;
  sum.lane_ops_run += draw.lane_ops_run;
}

void append(std::string& text, const std::string& name, const DrawLedger& ledger) {
  append_format(text, "  %s: %" PRIu64 " vertices, %" PRIu64 " fragments, %" PRIu64 " lane-ops run\n", name.c_str(),
                ledger.vertices, ledger.fragments, ledger.lane_ops_run);
  for (size_t i = 0; i < kRemovalCount; ++i) {
    const DrawLedger::Line& left_out = ledger.lines[i];
    if (left_out.count == 0 && left_out.lane_ops == 0) continue;
    const RemovalInfo& info = removal_info(static_cast<Removal>(i));
    append_format(text, "    %-10s %14" PRIu64 " %-10s %18" PRIu64 " lane-ops\n", info.name, left_out.count, info.unit,
                  left_out.lane_ops);
  }
}

}  // namespace

FrameLedger::ProgramSavings FrameLedger::savings_of(const ProgramPtr& program) {
  if (program == nullptr) return {};
  return {source(*program).once.size(), once_cost(*program)};
}

DrawLedger FrameLedger::Draw::total() const {
  DrawLedger sum = ledger;
  DrawLedger::Line& uniforms = sum.lines[static_cast<size_t>(Removal::uniforms)];
  uniforms.count += vertex.once_ops + fragment.once_ops;
  uniforms.lane_ops += vertex.once_cost * sum.vertices + fragment.once_cost * sum.fragments;
  DrawLedger::Line& varyings = sum.lines[static_cast<size_t>(Removal::varyings)];
  varyings.count += removed.vertex_values * sum.vertices + removed.input_values * sum.fragments;
  varyings.lane_ops += removed.vertex_cost * sum.vertices + removed.input_cost * sum.fragments;
  DrawLedger::Line& outputs = sum.lines[static_cast<size_t>(Removal::outputs)];
  outputs.count += removed.output_ops * sum.fragments;
  outputs.lane_ops += removed.output_cost * sum.fragments;
  return sum;
}

DrawLedger* FrameLedger::add_draw(const GraphicsPrograms& programs) {
  return &draws_.emplace_back(Draw{savings_of(programs.vertex), savings_of(programs.fragment), programs.removed, {}})
              .ledger;
}

std::string FrameLedger::text(uint64_t submission) const {
  std::string text;
  append_format(text, "lapilli: ledger of submission %" PRIu64 "\n", submission);
  DrawLedger all, rest;
  for (size_t i = 0; i < draws_.size(); ++i) {
    const DrawLedger ledger = draws_[i].total();
    add(all, ledger);
    if (i < kDrawsListed) {
      append(text, "draw " + std::to_string(i), ledger);
    } else {
      add(rest, ledger);
    }
  }
  if (draws_.size() > kDrawsListed) {
    append(text, "draws " + std::to_string(kDrawsListed) + " to " + std::to_string(draws_.size() - 1), rest);
  }
  append(text, "all " + std::to_string(draws_.size()) + " draws", all);
  return text;
}

}  // namespace lapilli
