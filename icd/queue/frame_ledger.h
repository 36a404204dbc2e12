// The ledger of LAPILLI_STATS=1: what the draws of a submission were spared, and what that would have cost.
#pragma once

#include <deque>
#include <string>

#include "base/removals.h"
#include "geometry/draw_call.h"

namespace lapilli {

class FrameLedger {
 public:
  // The account of the next draw; it stays where it is until clear(). Throws std::bad_alloc.
  DrawLedger* add_draw(const GraphicsPrograms& programs);
  bool empty() const { return draws_.empty(); }
  // The table. The first few draws are listed one by one. A line of a removal says how much there was of it, and the
  // lane-ops (lanes x cost, ops.def) that it saved.
  std::string text(uint64_t submission) const;
  void clear() { draws_.clear(); }

 private:
  // What is known of a program beforehand and counts for every lane that runs it.
  struct ProgramSavings {
    uint64_t once_ops = 0, once_cost = 0;
  };
  struct Draw {
    ProgramSavings vertex, fragment;
    RemovedWork removed;
    DrawLedger ledger;

    DrawLedger total() const;
  };
  static ProgramSavings savings_of(const ProgramPtr& program);

  std::deque<Draw> draws_;
};

}  // namespace lapilli
