// Ops: sampled images. The work is done by image/sampling.h; here descriptors are found.
#include <bit>
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/image.cpp"
#include <hwy/foreach_target.h>

#include "image/sampling.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// Operand i of the op's list, or null.
const uint32_t* list_operand(const Op* op, Frame* frame, uint32_t i) {
  const uint16_t number = frame->lists[op->a + i];
  return number == kNoOperand ? nullptr : reg_u(frame, number);
}

// Calls Body::run for each set of lanes that have the same descriptors; the other lanes become 0.
template <class Body>
struct ForEachImage {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const texture = list_operand(op, frame, 0);
    const uint32_t* const sampler = list_operand(op, frame, 1);
    clear_idle_lanes(frame, op->dst, Body::kResults);
    if (texture == nullptr && sampler == nullptr) {
      Body::run(op, frame, descriptor_at(*frame, op->imm, 0), descriptor_at(*frame, op->imm2, 0), frame->exec);
      return op + 1;
    }
    uint32_t textures[kLanes] = {};
    uint32_t samplers[kLanes] = {};
    if (texture != nullptr) std::memcpy(textures, texture, sizeof textures);
    if (sampler != nullptr) std::memcpy(samplers, sampler, sizeof samplers);
    uint64_t rest = frame->exec;
    while (rest != 0) {
      const int first = std::countr_zero(rest);
      uint64_t lanes = 0;
      for (uint64_t scan = rest; scan != 0; scan &= scan - 1) {
        const int lane = std::countr_zero(scan);
        const bool same = textures[lane] == textures[first] && samplers[lane] == samplers[first];
        if (same) lanes |= uint64_t{1} << lane;
      }
      Body::run(op, frame, descriptor_at(*frame, op->imm, textures[first]),
                descriptor_at(*frame, op->imm2, samplers[first]), lanes);
      rest &= ~lanes;
    }
    return op + 1;
  }
};

struct Results {
  float* rgba[4];
  Results(const Op* op, Frame* frame) {
    for (uint32_t i = 0; i < 4; ++i) rgba[i] = reinterpret_cast<float*>(reg(frame, op->dst + i));
  }
};

template <bool kDerivatives>
struct Sample {
  static constexpr uint32_t kResults = 4;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor& sampler, uint64_t lanes) {
    SampleOperands operands;
    operands.u = reinterpret_cast<const float*>(list_operand(op, frame, 2));
    operands.v = reinterpret_cast<const float*>(list_operand(op, frame, 3));
    operands.lod = reinterpret_cast<const float*>(list_operand(op, frame, 4));
    operands.lod_source = kDerivatives ? LodSource::derivatives : LodSource::operand;
    operands.lanes = lanes;
    frame->sampling->sample_2d(texture.texture, sampler.sampler, operands, Results(op, frame).rgba);
  }
};

struct Fetch {
  static constexpr uint32_t kResults = 4;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    FetchOperands operands;
    operands.x = reinterpret_cast<const int32_t*>(list_operand(op, frame, 2));
    operands.y = reinterpret_cast<const int32_t*>(list_operand(op, frame, 3));
    operands.level = reinterpret_cast<const int32_t*>(list_operand(op, frame, 4));
    operands.lanes = lanes;
    frame->sampling->fetch_2d(texture.texture, operands, Results(op, frame).rgba);
  }
};

struct Size {
  static constexpr uint32_t kResults = 2;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    const int32_t* const level = reinterpret_cast<const int32_t*>(list_operand(op, frame, 2));
    int32_t* const d = reinterpret_cast<int32_t*>(reg(frame, op->dst));
    frame->sampling->size_2d(texture.texture, level, lanes, d, d + kLanes);
  }
};

using op_sample_2d = ForEachImage<Sample<true>>;
using op_sample_2d_lod = ForEachImage<Sample<false>>;
using op_fetch_2d = ForEachImage<Fetch>;
using op_size_2d = ForEachImage<Size>;

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(sample_2d, false),
    LAPILLI_FAT(sample_2d_lod, false),
    LAPILLI_FAT(fetch_2d, false),
    LAPILLI_FAT(size_2d, false),
};

}  // namespace

HandlerList image_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kImageHandlers = LAPILLI_PER_TARGET(image_handlers);
}  // namespace lapilli
#endif
