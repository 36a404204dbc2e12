// Tests of single ops: buffers, push constants, arrays. Each component that is out of range reads 0 and writes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "shader/interpreter/test_frame.h"
#include "shader/program.h"

namespace lapilli {
namespace {

using Lanes = std::array<uint32_t, kBatchLanes>;
constexpr uint64_t kSome = 0x8000F00FC3A50F31;
constexpr uint32_t kWords = 100;
constexpr uint32_t kOld = 0xDEADBEEF;

// Three descriptors: kWords words, half of them, never written; the resource is an array of two, or of all.
struct MemoryTest {
  TestFrame frame;
  std::array<uint32_t, kWords> words;
  std::array<Descriptor, 3> descriptors;
  ResourceTable table;
  ResourceRef ref;
  BufferRange first;
  uint32_t dynamic_offsets[3] = {16, 0, 0};
  std::byte push_constants[kMaxPushConstantBytes];

  explicit MemoryTest(SimdTarget target) : frame(target) {
    for (uint32_t i = 0; i < kWords; ++i) words[i] = 1000 + i;
    std::byte* const data = reinterpret_cast<std::byte*>(words.data());
    descriptors[0] = {data, sizeof words, sizeof words, nullptr, nullptr};
    descriptors[1] = {data, sizeof words / 2, sizeof words, nullptr, nullptr};
    table.sets[1] = descriptors.data();
    for (uint32_t i = 0; i < kMaxPushConstantBytes; ++i) push_constants[i] = static_cast<std::byte>(i);
    table.push_constants = push_constants;
    table.push_constant_bytes = kMaxPushConstantBytes;
    ref.set = 1;
    ref.count = 3;
    bind();
  }
  void bind() {
    frame.frame().resources = &table;
    frame.frame().refs = &ref;
    first = buffer_at(frame.frame(), 0, 0);
    frame.frame().buffers = &first;
  }
  // What the equations say.
  uint32_t expected(uint32_t element, uint64_t at) const {
    const uint64_t size = element < ref.count && element < 3 ? descriptors[element].size : 0;
    return at + 4 <= size && at % 4 == 0 ? words[at / 4] : 0;
  }
};

Lanes same(uint32_t value) {
  Lanes lanes;
  lanes.fill(value);
  return lanes;
}

// Addresses by pattern: the same, consecutive, strided, scattered, and out of range in all ways.
std::vector<Lanes> address_patterns() {
  std::mt19937 random(5);
  std::vector<Lanes> patterns = {same(0),          same(8),          same(kWords * 4 - 4),
                                 same(kWords * 4), same(0xFFFFFFFC), same(0x80000000)};
  Lanes lanes;
  for (uint32_t step : {4u, 8u, 16u, 0xFFFFFFFCu}) {
    for (uint32_t start : {0u, 4u, 120u, 160u, 0xFFFFFFF0u}) {
      for (uint32_t i = 0; i < kBatchLanes; ++i) lanes[i] = start + i * step;
      patterns.push_back(lanes);
    }
  }
  for (uint32_t& lane : lanes) lane = static_cast<uint32_t>(random() % 120) * 4;
  patterns.push_back(lanes);
  for (uint32_t& lane : lanes) lane = static_cast<uint32_t>(random()) & ~3u;
  patterns.push_back(lanes);
  return patterns;
}

uint32_t changed(AtomicOp op, uint32_t old, uint32_t value, uint32_t comparator) {
  const int32_t a = static_cast<int32_t>(old), b = static_cast<int32_t>(value);
  switch (op) {
    case AtomicOp::load:
      return old;
    case AtomicOp::exchange:
      return value;
    case AtomicOp::compare_exchange:
      return old == comparator ? value : old;
    case AtomicOp::add:
      return old + value;
    case AtomicOp::smin:
      return static_cast<uint32_t>(std::min(a, b));
    case AtomicOp::smax:
      return static_cast<uint32_t>(std::max(a, b));
    case AtomicOp::umin:
      return std::min(old, value);
    case AtomicOp::umax:
      return std::max(old, value);
    case AtomicOp::bit_and:
      return old & value;
    case AtomicOp::bit_or:
      return old | value;
    default:
      return old ^ value;
  }
}

// One lane after the other, on buffers and on shared memory; lanes that may not write get 0.
TEST(Op, atomic) {
  const uint64_t write = 0xFFFFFFFF00000FFF;
  std::mt19937 random(8);
  Lanes values, comparators, index;
  for (uint32_t i = 0; i < kBatchLanes; ++i) {
    values[i] = i % 3 == 0 ? static_cast<uint32_t>(random()) : 1000 + i;
    comparators[i] = 1000 + i / 2;
    index[i] = i % 5 == 4 ? 0xFFFFFFFFu : i % 5;
  }
  for (SimdTarget target : supported_simd_targets()) {
    for (uint32_t kind = 0; kind < 11 * 3; ++kind) {
      const AtomicOp op = static_cast<AtomicOp>(kind / 3);
      const bool indexed = kind % 3 == 1, shared = kind % 3 == 2;
      std::vector<Lanes> patterns = address_patterns();
      patterns.push_back(same(2));  // not aligned: as if outside
      for (const Lanes& addresses : patterns) {
        MemoryTest test(target);
        if (shared) {
          test.frame.frame().shared = reinterpret_cast<std::byte*>(test.words.data()) - 16;
          test.ref = {kSharedMemory, 16, sizeof test.words};
          test.bind();
        }
        test.frame.frame().exec = kSome;
        test.frame.frame().write = write;
        test.frame.write(0, addresses);
        test.frame.write(1, index);
        test.frame.write(2, values);
        test.frame.write(3, comparators);
        const uint16_t list[] = {0, static_cast<uint16_t>(indexed ? 1 : kNoOperand), 2, 3};
        test.frame.frame().lists = list;
        std::array<uint32_t, kWords> expected = test.words;
        Lanes old;
        for (uint32_t i = 0; i < kBatchLanes; ++i) {
          const uint32_t element = indexed ? index[i] : 0;
          const uint64_t size = shared ? sizeof test.words : element < 3 ? test.descriptors[element].size : 0;
          old[i] = 0;
          if ((kSome & write & uint64_t{1} << i) == 0 || addresses[i] + uint64_t{4} > size || addresses[i] % 4 != 0)
            continue;
          uint32_t& word = expected[addresses[i] / 4];
          old[i] = word;
          word = changed(op, word, values[i], comparators[i]);
        }
        test.frame.write(4, same(kOld));
        test.frame.add(Opcode::atomic, kStore, Op{nullptr, 4, 0, 0, 0, 0, static_cast<uint32_t>(op)});
        test.frame.run();
        Lanes got;
        test.frame.read(4, got);
        EXPECT_EQ(got, old) << kind << ' ' << addresses[0] << ' ' << addresses[1];
        EXPECT_EQ(test.words, expected) << kind << ' ' << addresses[0] << ' ' << addresses[1];
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

// The passes keep accesses on their sides of it; the op itself touches nothing.
TEST(Op, memory_barrier) {
  for (SimdTarget target : supported_simd_targets()) {
    TestFrame frame(target);
    frame.write(0, same(7));
    frame.add(Opcode::memory_barrier, kStore, Op{});
    frame.add(Opcode::mov, kStore, 1, 0);
    frame.run();
    Lanes got;
    frame.read(1, got);
    EXPECT_EQ(got, same(7));
  }
}

TEST(Op, load_buffer) {
  for (SimdTarget target : supported_simd_targets()) {
    for (const Lanes& addresses : address_patterns()) {
      for (uint64_t exec : {~uint64_t{0}, kSome}) {
        for (uint16_t form = 0; form < 8; ++form) {
          const bool indexed = form % 2 != 0;
          const uint16_t count = static_cast<uint16_t>(1 + form / 2);
          MemoryTest test(target);
          test.frame.frame().exec = exec;
          test.frame.write(0, addresses);
          Lanes index;
          for (uint32_t i = 0; i < kBatchLanes; ++i) index[i] = i % 5 == 4 ? 0xFFFFFFFFu : i % 5;
          test.frame.write(1, index);
          for (uint32_t k = 4; k < 8; ++k) test.frame.write(k, same(kOld));
          const uint16_t b = indexed ? 1 : kNoOperand;
          test.frame.add(Opcode::load_buffer, kStore, Op{nullptr, 4, 0, b, count, 0, 8});
          test.frame.run();
          for (uint32_t k = 0; k < count; ++k) {
            Lanes got;
            test.frame.read(4 + k, got);
            for (uint32_t i = 0; i < kBatchLanes; ++i) {
              if ((exec >> i & 1) == 0) continue;
              EXPECT_EQ(got[i], test.expected(indexed ? index[i] : 0, uint64_t{addresses[i]} + 8 + 4 * k))
                  << addresses[i];
            }
          }
        }
      }
    }
  }
}

TEST(Op, store_buffer) {
  for (SimdTarget target : supported_simd_targets()) {
    for (const Lanes& addresses : address_patterns()) {
      for (uint64_t exec : {~uint64_t{0}, kSome, uint64_t{0}}) {
        for (bool indexed : {false, true}) {
          const uint64_t write = exec == kSome ? 0xFFFFFFFF00000FFF : ~uint64_t{0};
          MemoryTest test(target);
          test.frame.frame().exec = exec;
          test.frame.frame().write = write;
          Lanes values, index;
          for (uint32_t i = 0; i < kBatchLanes; ++i) values[i] = 5000 + i;
          for (uint32_t i = 0; i < kBatchLanes; ++i) index[i] = i % 4;
          test.frame.write(0, addresses);
          test.frame.write(1, values);
          test.frame.write(2, index);
          std::array<uint32_t, kWords> expected = test.words;
          // Groups of lanes with the same descriptor in the order of their first lanes, within them by lane.
          for (uint32_t element = 0; element < 4; ++element) {
            for (uint32_t i = 0; i < kBatchLanes; ++i) {
              if ((exec & write) >> i == 0 || ((exec & write) >> i & 1) == 0) continue;
              if (indexed ? index[i] != element : element != 0) continue;
              const uint64_t at = uint64_t{addresses[i]} + 4;
              if (element < 3 && at + 4 <= test.descriptors[element].size) expected[at / 4] = values[i];
            }
          }
          const bool order_matters = indexed && (addresses[0] == addresses[1] || addresses[0] > addresses[1]);
          test.frame.add(Opcode::store_buffer, kStore,
                         Op{nullptr, 0, 0, 1, static_cast<uint16_t>(indexed ? 2 : kNoOperand), 0, 4});
          test.frame.run();
          if (!order_matters) {
            EXPECT_EQ(test.words, expected) << addresses[0] << ' ' << addresses[1] << ' ' << exec << ' ' << indexed;
          }
        }
      }
    }
  }
}

TEST(Op, load_uniform) {
  for (SimdTarget target : supported_simd_targets()) {
    MemoryTest test(target);
    test.frame.add(Opcode::load_uniform, kStore, Op{nullptr, 4, 0, 0, 4, 0, kWords * 4 - 8});
    test.frame.run();
    for (uint32_t k = 0; k < 4; ++k) {
      Lanes got;
      test.frame.read(4 + k, got);
      EXPECT_EQ(got, same(k < 2 ? 1000 + kWords - 2 + k : 0));
    }
  }
}

TEST(Op, buffer_size) {
  for (SimdTarget target : supported_simd_targets()) {
    MemoryTest test(target);
    Lanes index;
    for (uint32_t i = 0; i < kBatchLanes; ++i) index[i] = i;
    test.frame.write(0, index);
    test.frame.add(Opcode::buffer_size, kStore, Op{nullptr, 1, 0, 0, 0, 0, 0});
    test.frame.add(Opcode::buffer_size, kStore, Op{nullptr, 2, 0, kNoOperand, 0, 0, 0});
    test.frame.run();
    Lanes got;
    test.frame.read(1, got);
    EXPECT_EQ(got[0], kWords * 4);
    EXPECT_EQ(got[1], kWords * 2);
    EXPECT_EQ(got[2], 0u);
    EXPECT_EQ(got[63], 0u);
    test.frame.read(2, got);
    EXPECT_EQ(got, same(kWords * 4));
  }
}

TEST(Op, load_push) {
  for (SimdTarget target : supported_simd_targets()) {
    MemoryTest test(target);
    test.frame.add(Opcode::load_push, kStore, Op{nullptr, 4, 0, 0, 2, 0, 252});
    test.frame.run();
    Lanes got;
    test.frame.read(4, got);
    EXPECT_EQ(got, same(0xFFFEFDFC));
    test.frame.read(5, got);
    EXPECT_EQ(got, same(0));
  }
}

TEST(Op, load_push_indexed) {
  for (SimdTarget target : supported_simd_targets()) {
    MemoryTest test(target);
    Lanes addresses;
    for (uint32_t i = 0; i < kBatchLanes; ++i) addresses[i] = i == 63 ? 0xFFFFFFF0u : 4 * i;
    test.frame.write(0, addresses);
    test.frame.add(Opcode::load_push_indexed, kStore, Op{nullptr, 4, 0, 0, 1, 0, 8});
    test.frame.run();
    Lanes got;
    test.frame.read(4, got);
    EXPECT_EQ(got[0], 0x0B0A0908u);
    EXPECT_EQ(got[61], 0xFFFEFDFCu);
    EXPECT_EQ(got[62], 0u);
    EXPECT_EQ(got[63], 0u);
  }
}

TEST(Op, load_array) {
  for (SimdTarget target : supported_simd_targets()) {
    TestFrame test(target);
    Lanes index;
    for (uint32_t i = 0; i < kBatchLanes; ++i) index[i] = i == 5 ? 0x80000001u : i == 6 ? 0xFFFFFFFFu : i % 4;
    test.write(0, index);
    for (uint32_t k = 0; k < 4; ++k) {
      Lanes element;
      for (uint32_t i = 0; i < kBatchLanes; ++i) element[i] = 100 * k + i;
      test.write(4 + k, element);
    }
    test.add(Opcode::load_array, kStore, Op{nullptr, 1, 0, 4, 0, 3, 0});
    test.run();
    Lanes got;
    test.read(1, got);
    for (uint32_t i = 0; i < kBatchLanes; ++i) EXPECT_EQ(got[i], index[i] < 3 ? 100 * index[i] + i : 0);
  }
}

TEST(Op, store_array) {
  for (SimdTarget target : supported_simd_targets()) {
    TestFrame test(target);
    test.frame().exec = kSome;
    Lanes index, values;
    for (uint32_t i = 0; i < kBatchLanes; ++i) index[i] = i == 5 ? 0xFFFFFFFFu : i % 4;
    for (uint32_t i = 0; i < kBatchLanes; ++i) values[i] = i;
    test.write(0, index);
    test.write(1, values);
    for (uint32_t k = 0; k < 4; ++k) test.write(4 + k, same(kOld));
    test.add(Opcode::store_array, kStore, Op{nullptr, 0, 0, 1, 4, 3, 0});
    test.run();
    for (uint32_t k = 0; k < 4; ++k) {
      Lanes got;
      test.read(4 + k, got);
      for (uint32_t i = 0; i < kBatchLanes; ++i) {
        const bool written = (kSome >> i & 1) != 0 && index[i] == k && k < 3;
        EXPECT_EQ(got[i], written ? i : kOld);
      }
    }
  }
}

TEST(Descriptors, DynamicOffsetsStayInTheBuffer) {
  MemoryTest test(SimdTarget::kBaseline);
  test.ref.dynamic_offset = 0;
  test.ref.count = 1;
  test.table.dynamic_offsets = test.dynamic_offsets;
  test.descriptors[0].size = 40;
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 0).size, 40u);
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 0).data, test.descriptors[0].data + 16);
  test.dynamic_offsets[0] = kWords * 4 - 8;
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 0).size, 8u);
  test.dynamic_offsets[0] = kWords * 4 + 4;
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 0).size, 0u);
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 1).size, 0u);
  test.ref.set = 2;
  EXPECT_EQ(buffer_at(test.frame.frame(), 0, 0).data, nullptr);
}

}  // namespace
}  // namespace lapilli
