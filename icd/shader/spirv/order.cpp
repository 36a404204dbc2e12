// Brings a function's blocks into structured order and checks that masks can run them: only loops jump backwards, and
// a loop is entered at its header.
#include <algorithm>

#include "shader/spirv/module.h"

namespace lapilli {
namespace {

constexpr uint32_t kMaxLoopDepth = 200;
constexpr size_t kMaxPhiParents = 8192;
constexpr size_t kMaxBlocks = 1 << 15;

class Orderer {
 public:
  Orderer(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions)
      : m_(module), f_(function), reachable_(function.blocks.size()), positions_(positions) {}

  Result<void> run() {
    if (f_.blocks.size() > kMaxBlocks) return m_.error(f_.word, "has too many blocks");
    mark_reachable();
    const std::vector<uint32_t> all = structured_order();
    std::vector<uint32_t> place(f_.blocks.size());  // reachable blocks before it, for unreachable ones too
    for (const uint32_t block : all) {
      place[block] = static_cast<uint32_t>(f_.order.size());
      if (!reachable_[block]) continue;
      f_.blocks[block].position = place[block];
      f_.order.push_back(block);
    }
    for (const uint32_t index : f_.order) {
      for (const uint32_t target : f_.blocks[index].successors) f_.blocks[target].predecessors.push_back(index);
    }
    if (Result<void> r = find_loops(place); !r) return r;
    for (const uint32_t index : f_.order) {
      const SpirvBlock& block = f_.blocks[index];
      for (const uint32_t target : block.successors) {
        if (Result<void> r = check_edge(block, f_.blocks[target]); !r) return r;
      }
      const spv::Op end = m_.at(block.terminator).op;
      if (end == spv::Op::OpReturn || end == spv::Op::OpReturnValue) ++f_.return_count;
    }
    for (const uint32_t index : f_.order) {
      if (Result<void> r = check_phis(f_.blocks[index]); !r) return r;
    }
    return check_uses(m_, f_, positions_);
  }

 private:
  void mark_reachable() {
    std::vector<uint32_t> stack{0};
    reachable_[0] = true;
    while (!stack.empty()) {
      const SpirvBlock& block = f_.blocks[stack.back()];
      stack.pop_back();
      for (const uint32_t target : block.successors) {
        if (!reachable_[target]) stack.push_back(target);
        reachable_[target] = true;
      }
    }
  }

  // Reverse post-order of a walk that takes the merge block first and the continue target second: whatever they lead to
  // then comes after the construct.
  std::vector<uint32_t> structured_order() const {
    struct Visit {
      uint32_t block;
      uint32_t next;
    };
    std::vector<uint32_t> order;
    std::vector<bool> visited(f_.blocks.size());
    std::vector<Visit> stack{{0, 0}};
    visited[0] = true;
    while (!stack.empty()) {
      Visit& top = stack.back();
      const SpirvBlock& block = f_.blocks[top.block];
      const uint32_t count = static_cast<uint32_t>(block.successors.size());
      if (top.next == count + 2) {
        order.push_back(top.block);
        stack.pop_back();
        continue;
      }
      const uint32_t n = top.next++;
      const uint32_t target = n == 0 ? block.merge : n == 1 ? block.continue_target : block.successors[count + 1 - n];
      if (target == kNoBlock || visited[target]) continue;
      visited[target] = true;
      stack.push_back({target, 0});
    }
    std::reverse(order.begin(), order.end());
    return order;
  }

  Result<void> find_loops(const std::vector<uint32_t>& place) {
    uint32_t current = kNoLoop, depth = 0;
    for (uint32_t position = 0; position < f_.order.size(); ++position) {
      SpirvBlock& block = f_.blocks[f_.order[position]];
      while (current != kNoLoop && f_.loops[current].end == position) {
        current = f_.loops[current].parent;
        --depth;
      }
      bool jumped_back_to = false;
      for (const uint32_t from : block.predecessors) jumped_back_to |= f_.blocks[from].position >= position;
      if (block.continue_target != kNoBlock && jumped_back_to) {
        const uint32_t end = place[block.merge];
        const uint32_t outer_end = current == kNoLoop ? static_cast<uint32_t>(f_.order.size()) : f_.loops[current].end;
        if (end <= position || end > outer_end)
          return m_.error(block.terminator, "the loop it starts is not structured");
        if (++depth > kMaxLoopDepth) return m_.error(block.terminator, "loops are nested too deeply");
        f_.loops.push_back({position, end, current});
        current = static_cast<uint32_t>(f_.loops.size() - 1);
      }
      block.loop = current;
    }
    return {};
  }

  Result<void> check_edge(const SpirvBlock& from, const SpirvBlock& to) const {
    const bool header = f_.is_header(to);
    if (to.position <= from.position) {
      if (header && from.position < f_.loops[to.loop].end) return {};
      return m_.error(from.terminator, "jumps back, but not to the header of a loop around it");
    }
    for (uint32_t loop = header ? f_.loops[to.loop].parent : to.loop; loop != kNoLoop; loop = f_.loops[loop].parent) {
      if (from.position < f_.loops[loop].header) return m_.error(from.terminator, "jumps into a loop");
    }
    return {};
  }

  // Each phi names each block that leads here once.
  Result<void> check_phis(const SpirvBlock& block) const {
    std::vector<uint32_t> expected = block.predecessors, given;
    std::sort(expected.begin(), expected.end());
    for (uint32_t word = block.first; word < block.end; word += m_.at(word).count) {
      const SpirvInst inst = m_.at(word);
      if (inst.op == spv::Op::OpLine || inst.op == spv::Op::OpNoLine) continue;
      if (inst.op != spv::Op::OpPhi) break;
      if (expected.size() > kMaxPhiParents) return m_.error(word, "has too many parents");
      given.clear();
      for (uint32_t i = 4; i < inst.count; i += 2) {
        const uint32_t parent = f_.block_of(inst[i]);
        if (parent != kNoBlock && reachable_[parent]) given.push_back(parent);
      }
      std::sort(given.begin(), given.end());
      if (given != expected || given.empty()) return m_.error(word, "does not name the blocks that lead here");
    }
    return {};
  }

  const SpirvModule& m_;
  SpirvFunction& f_;
  std::vector<bool> reachable_;
  std::vector<uint32_t>& positions_;
};

}  // namespace

Result<void> order_blocks(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions) {
  return Orderer(module, function, positions).run();
}

}  // namespace lapilli
