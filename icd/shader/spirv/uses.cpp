// Checks that definitions dominate their uses, and finds the values that loops hand out.
#include <algorithm>

#include "shader/spirv/grammar.h"
#include "shader/spirv/module.h"

namespace lapilli {
namespace {

class UseChecker {
 public:
  UseChecker(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions)
      : m_(module), f_(function), definition_(positions) {
    definition_.resize(m_.ids.size(), kNoBlock);
  }

  Result<void> run() {
    find_dominators();
    for (const uint32_t id : f_.parameters) definition_[id] = 0;
    std::vector<uint32_t> defined = f_.parameters;
    for (uint32_t position = 0; position < f_.order.size(); ++position) {
      for_each_instruction(position, [&](const SpirvInst& inst) {
        const char* signature = signature_of(inst);
        if (signature[0] != 't' || signature[1] != 'r') return;
        definition_[inst[2]] = position;
        defined.push_back(inst[2]);
      });
    }
    Result<void> result;
    for (uint32_t position = 0; position < f_.order.size(); ++position) {
      for_each_instruction(position, [&](const SpirvInst& inst) {
        if (result.ok()) result = check(inst, position);
      });
    }
    for (const uint32_t id : defined) definition_[id] = kNoBlock;
    std::sort(f_.escaping.begin(), f_.escaping.end());
    f_.escaping.erase(std::unique(f_.escaping.begin(), f_.escaping.end()), f_.escaping.end());
    return result;
  }

 private:
  static const char* signature_of(const SpirvInst& inst) {
    return find_spirv_op(static_cast<uint32_t>(inst.op))->signature;
  }

  template <class Visit>
  void for_each_instruction(uint32_t position, Visit&& visit) const {
    const SpirvBlock& block = f_.blocks[f_.order[position]];
    for (uint32_t word = block.first; word < block.end; word += m_.at(word).count) visit(m_.at(word));
  }

  // Loops are entered at their headers only, so jumps back change nothing: a block's parent in the tree is what the
  // ways to those before it have in common. `jump` leads to an ancestor further up, so that no way is long (Myers, "An
  // Applicative Random-Access Stack").
  void find_dominators() {
    const uint32_t count = static_cast<uint32_t>(f_.order.size());
    std::vector<uint32_t> parent(count), jump(count), depth(count);
    const auto meet = [&](uint32_t a, uint32_t b) {
      if (depth[a] < depth[b]) std::swap(a, b);
      while (depth[a] > depth[b]) a = depth[jump[a]] >= depth[b] ? jump[a] : parent[a];
      while (a != b) {
        const bool far = jump[a] != jump[b];
        a = far ? jump[a] : parent[a];
        b = far ? jump[b] : parent[b];
      }
      return a;
    };
    for (uint32_t position = 1; position < count; ++position) {
      uint32_t best = kNoBlock;
      for (const uint32_t from : f_.blocks[f_.order[position]].predecessors) {
        const uint32_t other = f_.blocks[from].position;
        if (other < position) best = best == kNoBlock ? other : meet(best, other);
      }
      parent[position] = best;
      depth[position] = depth[best] + 1;
      const uint32_t up = jump[best];
      jump[position] = depth[best] - depth[up] == depth[up] - depth[jump[up]] ? jump[up] : best;
    }
    // Numbers of a walk over the tree: a dominates what lies in [first_[a], last_[a]]. Children come after their
    // parents.
    std::vector<uint32_t> size(count, 1), next(count);
    for (uint32_t position = count; position-- > 1;) size[parent[position]] += size[position];
    first_.resize(count);
    last_.resize(count);
    for (uint32_t position = 0; position < count; ++position) {
      if (position != 0) {
        first_[position] = next[parent[position]];
        next[parent[position]] += size[position];
      }
      next[position] = first_[position] + 1;
      last_[position] = first_[position] + size[position] - 1;
    }
  }

  Result<void> check(const SpirvInst& inst, uint32_t position) {
    uint32_t bad = 0;
    walk_operands(signature_of(inst), inst.words, inst.count, 1, [&](OperandKind kind, uint32_t at) {
      if (kind != OperandKind::id) return;
      const uint32_t id = inst[at];
      const spv::Op op = m_.op(id);
      if (op == spv::Op::OpLabel || op == spv::Op::OpFunction) return;
      uint32_t place = position;
      if (inst.op == spv::Op::OpPhi) {  // a phi's value is read at the end of the block that it comes from
        const uint32_t parent = at % 2 == 1 && at + 1 < inst.count ? f_.block_of(inst[at + 1]) : kNoBlock;
        if (parent == kNoBlock || f_.blocks[parent].position == kNoBlock) return;
        place = f_.blocks[parent].position;
      }
      const uint32_t from = definition_[id];
      if (from == kNoBlock) {
        if (m_.ids[id].word >= m_.functions_start)
          bad = id;  // of another function, or in a block that is never reached
        return;
      }
      const bool before = from != place ? first_[place] >= first_[from] && first_[place] <= last_[from]
                                        : inst.op == spv::Op::OpPhi || m_.ids[id].word < inst.word;
      if (!before) bad = id;
      const uint32_t loop = f_.blocks[f_.order[from]].loop;
      if (loop != kNoLoop && (place < f_.loops[loop].header || place >= f_.loops[loop].end)) f_.escaping.push_back(id);
    });
    if (bad != 0) return m_.error(inst.word, "the definition of " + m_.name(bad) + " does not dominate this use");
    return {};
  }

  const SpirvModule& m_;
  SpirvFunction& f_;
  std::vector<uint32_t> first_, last_;  // by position
  std::vector<uint32_t>& definition_;   // id -> position of its block
};

}  // namespace

Result<void> check_uses(const SpirvModule& module, SpirvFunction& function, std::vector<uint32_t>& positions) {
  return UseChecker(module, function, positions).run();
}

}  // namespace lapilli
