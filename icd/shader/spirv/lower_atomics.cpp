// Lowering: barriers. Specification: SPIR-V, "Barrier Instructions".
#include "shader/batch.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {

// False: it is another instruction.
bool Lowering::lower_atomics(const SpirvInst& inst) {
  if (inst.op != spv::Op::OpControlBarrier && inst.op != spv::Op::OpMemoryBarrier) return false;
  // The lanes of one batch are at the same place anyway.
  bool waits = false;
  if (inst.op == spv::Op::OpControlBarrier) {
    const std::vector<uint32_t>* scope = constant_data(inst[1]);
    if (which_ != VK_SHADER_STAGE_COMPUTE_BIT) return fail("is for compute shaders"), true;
    if (scope == nullptr || scope->size() != 1) return fail("its scope is no constant"), true;
    const auto execution = static_cast<spv::Scope>((*scope)[0]);
    if (execution != spv::Scope::Workgroup && execution != spv::Scope::Subgroup && execution != spv::Scope::Invocation)
      return fail("its scope is more than a workgroup"), true;
    waits = execution == spv::Scope::Workgroup && code_.invocations() > kBatchLanes;
  }
  code_.emit_void(waits ? Opcode::barrier : Opcode::memory_barrier);
  return true;
}

}  // namespace lapilli::spirv
