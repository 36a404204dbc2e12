// Ops: sampled images. The work is done by image/sampling.h; here descriptors are found.
#include <bit>
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/image.cpp"
#include <hwy/foreach_target.h>

#include "image/sampling.h"
#include "shader/interpreter/atomics-inl.h"
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

// The descriptor of the sampler; ops without one have the texture's again.
template <class Body>
const Descriptor& sampler_at(const Op* op, Frame* frame, uint32_t index) {
  return descriptor_at(*frame, Body::kSampled ? op->imm2 : op->imm, index);
}

// Calls Body::run for each set of lanes that have the same descriptors; the other lanes become 0.
template <class Body>
struct ForEachImage {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const texture = list_operand(op, frame, 0);
    const uint32_t* const sampler = list_operand(op, frame, 1);
    clear_idle_lanes(frame, op->dst, Body::kResults);
    if (texture == nullptr && sampler == nullptr) {
      Body::run(op, frame, descriptor_at(*frame, op->imm, 0), sampler_at<Body>(op, frame, 0), frame->exec);
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
                sampler_at<Body>(op, frame, samplers[first]), lanes);
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

const float* float_operand(const Op* op, Frame* frame, uint32_t i) {
  return reinterpret_cast<const float*>(list_operand(op, frame, i));
}
const int32_t* int_operand(const Op* op, Frame* frame, uint32_t i) {
  return reinterpret_cast<const int32_t*>(list_operand(op, frame, i));
}

SampleOperands sample_operands(const Op* op, Frame* frame, LodSource source, uint64_t lanes) {
  SampleOperands operands;
  operands.u = float_operand(op, frame, 2);
  operands.v = float_operand(op, frame, 3);
  operands.lod = float_operand(op, frame, 4);
  operands.lod_source = source;
  operands.lanes = lanes;
  operands.reference = float_operand(op, frame, 5);
  operands.offset_x = int_operand(op, frame, 6);
  operands.offset_y = int_operand(op, frame, 7);
  return operands;
}

template <LodSource kSource>
struct Sample {
  static constexpr bool kSampled = true;
  static constexpr uint32_t kResults = 4;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor& sampler, uint64_t lanes) {
    frame->sampling->sample_2d(texture.texture, sampler.sampler, sample_operands(op, frame, kSource, lanes),
                               Results(op, frame).rgba);
  }
};

struct Gather {
  static constexpr bool kSampled = true;
  static constexpr uint32_t kResults = 4;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor& sampler, uint64_t lanes) {
    const uint32_t* const component = list_operand(op, frame, 4);
    frame->sampling->gather_2d(texture.texture, sampler.sampler, sample_operands(op, frame, LodSource::operand, lanes),
                               component == nullptr ? 0 : component[std::countr_zero(lanes) % kLanes],
                               Results(op, frame).rgba);
  }
};

struct QueryLod {
  static constexpr bool kSampled = true;
  static constexpr uint32_t kResults = 2;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor& sampler, uint64_t lanes) {
    SampleOperands operands;
    operands.u = float_operand(op, frame, 2);
    operands.v = float_operand(op, frame, 3);
    operands.lod_source = LodSource::derivatives;
    operands.lanes = lanes;
    float* const d = reinterpret_cast<float*>(reg(frame, op->dst));
    frame->sampling->query_lod_2d(texture.texture, sampler.sampler, operands, d, d + kLanes);
  }
};

struct Fetch {
  static constexpr bool kSampled = false;
  static constexpr uint32_t kResults = 4;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    FetchOperands operands;
    operands.x = int_operand(op, frame, 2);
    operands.y = int_operand(op, frame, 3);
    operands.level = int_operand(op, frame, 4);
    operands.lanes = lanes;
    frame->sampling->fetch_2d(texture.texture, operands, Results(op, frame).rgba);
  }
};

struct Store {
  static constexpr bool kSampled = false;
  static constexpr uint32_t kResults = 0;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    FetchOperands operands;
    operands.x = int_operand(op, frame, 2);
    operands.y = int_operand(op, frame, 3);
    operands.lanes = lanes & frame->write;
    const float* const rgba[4] = {float_operand(op, frame, 4), float_operand(op, frame, 5), float_operand(op, frame, 6),
                                  float_operand(op, frame, 7)};
    frame->sampling->store_2d(texture.texture, operands, rgba);
  }
};

struct Atomic {
  static constexpr bool kSampled = false;
  static constexpr uint32_t kResults = 1;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    const TextureView* const view = texture.texture;
    FetchOperands operands;
    operands.x = int_operand(op, frame, 2);
    operands.y = int_operand(op, frame, 3);
    operands.lanes = lanes & frame->write;
    alignas(64) uint32_t offsets[kLanes], old[kLanes];
    uint64_t inside = 0;
    if (view != nullptr && view->level_count != 0 && view->format->has(kAtomic))
      inside = frame->sampling->find_texels_2d(*view, operands, offsets);
    AtomicLanes words;
    words.value = list_operand(op, frame, 4);
    words.comparator = list_operand(op, frame, 5);
    words.old = old;
    words.shared = false;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      words.word[lane] = nullptr;
      if ((inside >> lane & 1) == 0) continue;
      std::byte* const at = view->levels[0].data + offsets[lane];
      if (reinterpret_cast<uintptr_t>(at) % 4 == 0) words.word[lane] = reinterpret_cast<uint32_t*>(at);
    }
    change_lanes(static_cast<AtomicOp>(op->imm2), words);
    uint32_t* const d = reg_out(frame, op->dst);
    for (; lanes != 0; lanes &= lanes - 1) d[std::countr_zero(lanes)] = old[std::countr_zero(lanes)];
  }
};

struct Size {
  static constexpr bool kSampled = false;
  static constexpr uint32_t kResults = 3;
  static void run(const Op* op, Frame* frame, const Descriptor& texture, const Descriptor&, uint64_t lanes) {
    int32_t* const d = reinterpret_cast<int32_t*>(reg(frame, op->dst));
    int32_t* const results[] = {d, d + kLanes, d + 2 * kLanes};
    frame->sampling->size_2d(texture.texture, int_operand(op, frame, 2), lanes, results);
  }
};

using op_sample_2d = ForEachImage<Sample<LodSource::derivatives>>;
using op_sample_2d_lod = ForEachImage<Sample<LodSource::operand>>;
using op_gather_2d = ForEachImage<Gather>;
using op_query_lod_2d = ForEachImage<QueryLod>;
using op_fetch_2d = ForEachImage<Fetch>;
using op_store_2d = ForEachImage<Store>;
using op_atomic_2d = ForEachImage<Atomic>;
using op_size_2d = ForEachImage<Size>;

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(sample_2d, false),    LAPILLI_FAT(sample_2d_lod, false), LAPILLI_FAT(gather_2d, false),
    LAPILLI_FAT(query_lod_2d, false), LAPILLI_FAT(fetch_2d, false),      LAPILLI_FAT(store_2d, false),
    LAPILLI_FAT(atomic_2d, true),     LAPILLI_FAT(size_2d, false),
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
