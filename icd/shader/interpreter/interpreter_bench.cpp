// Lane operations per second of the interpreter beside those of the measurement that its design started from, and what
// each op costs. One thread. Run with --benchmark_filter=chain for the former.
#include <benchmark/benchmark.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/interpreter_bench.cpp"
#include <hwy/foreach_target.h>

#include "base/lanes-inl.h"
#include "shader/fixed_function.h"
#include "shader/interpreter/fragment_fixture.h"
#include "shader/program.h"

#undef BENCH_EACH
#undef BENCH_PARAMETERS
#undef BENCH_ARGUMENTS
#if HWY_TARGET == HWY_AVX3
#define BENCH_PARAMETERS F x0, F x1, F x2, F x3
#define BENCH_ARGUMENTS x0, x1, x2, x3
#define BENCH_EACH(DO) DO(0) DO(1) DO(2) DO(3)
#elif HWY_TARGET == HWY_AVX2
#define BENCH_PARAMETERS F x0, F x1, F x2, F x3, F x4, F x5, F x6, F x7
#define BENCH_ARGUMENTS x0, x1, x2, x3, x4, x5, x6, x7
#define BENCH_EACH(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#endif
#ifdef __clang__
#define BENCH_TAIL [[clang::musttail]]
#else
#define BENCH_TAIL
#endif

#ifndef LAPILLI_BENCH_CHAIN
#define LAPILLI_BENCH_CHAIN
namespace lapilli {
// Of a chain of arithmetic ops: which op, where its first operand comes from, whether it stores.
struct ChainOp {
  uint32_t op;  // add, mul, sub, fma, min
  bool load, store;
  uint16_t d, a, b, c;
};
constexpr uint32_t kChainRegisters = 24;
constexpr uint32_t kChainLength = 200;
// Runs the chain `batches` times, starting from the same registers. False: there is no such code for this target.
using BaselineRun = bool(const std::vector<ChainOp>& chain, float* registers, uint64_t batches);
}  // namespace lapilli
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// The measurement's interpreter: nothing but what the chain needs.
#if (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2) && defined(__OPTIMIZE__) && !defined(LAPILLI_SANITIZED)
namespace {

struct BareOp;
using BareHandler = void (*)(const BareOp*, float*, BENCH_PARAMETERS);
struct BareOp {
  BareHandler handler;
  uint16_t d, a, b, c;
};

template <int kOp>
HWY_INLINE F apply(F x, const float* b, const float* c) {
  if constexpr (kOp == 0) return x + load<F>(b);
  if constexpr (kOp == 1) return x * load<F>(b);
  if constexpr (kOp == 2) return x - load<F>(b);
  if constexpr (kOp == 3) return fma(x, load<F>(b), load<F>(c));
  if constexpr (kOp == 4) return min(x, load<F>(b));
}
template <int kOp, bool kLoad, bool kStoreIt>
void bare(const BareOp* op, float* r, BENCH_PARAMETERS) {
  const float* a = r + op->a * size_t{64};
  const float* b = r + op->b * size_t{64};
  const float* c = r + op->c * size_t{64};
  float* d = r + op->d * size_t{64};
#define BENCH_DO(i)                                                    \
  if (kLoad) x##i = load<F>(a + i * kVectorLanes);                     \
  x##i = apply<kOp>(x##i, b + i * kVectorLanes, c + i * kVectorLanes); \
  if (kStoreIt) store(x##i, d + i * kVectorLanes);
  BENCH_EACH(BENCH_DO)
#undef BENCH_DO
  BENCH_TAIL return op[1].handler(op + 1, r, BENCH_ARGUMENTS);
}
void bare_stop(const BareOp*, float*, BENCH_PARAMETERS) {
#define BENCH_DO(i) (void)x##i;
  BENCH_EACH(BENCH_DO)
#undef BENCH_DO
}
template <int kOp>
BareHandler pick(bool load_it, bool store_it) {
  if (load_it) return store_it ? bare<kOp, true, true> : bare<kOp, true, false>;
  return store_it ? bare<kOp, false, true> : bare<kOp, false, false>;
}

}  // namespace

bool run_baseline(const std::vector<ChainOp>& chain, float* registers, uint64_t batches) {
  std::vector<BareOp> ops;
  for (const ChainOp& op : chain) {
    const BareHandler handlers[] = {pick<0>(op.load, op.store), pick<1>(op.load, op.store), pick<2>(op.load, op.store),
                                    pick<3>(op.load, op.store), pick<4>(op.load, op.store)};
    ops.push_back({handlers[op.op], op.d, op.a, op.b, op.c});
  }
  ops.push_back({bare_stop, 0, 0, 0, 0});
  const std::vector<float> start(registers, registers + 8 * 64);
  const F zero = zero_f();
#define BENCH_DO(i) , zero
  for (; batches > 0; --batches) {
    std::memcpy(registers, start.data(), start.size() * sizeof(float));
    ops[0].handler(ops.data(), registers BENCH_EACH(BENCH_DO));
  }
#undef BENCH_DO
  return true;
}
#else
bool run_baseline(const std::vector<ChainOp>&, float*, uint64_t) { return false; }
#endif

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<BaselineRun> kBaselines = LAPILLI_PER_TARGET(run_baseline);
constexpr uint64_t kBatchesPerIteration = 64;

std::vector<ChainOp> make_chain(uint32_t percent_accumulator, uint32_t percent_stored) {
  std::mt19937 random(1);
  std::vector<ChainOp> chain;
  const auto reg = [&] { return static_cast<uint16_t>(random() % kChainRegisters); };
  for (uint32_t i = 0; i < kChainLength; ++i) {
    const bool load = random() % 100 >= percent_accumulator;
    const bool store = random() % 100 < percent_stored;
    chain.push_back({static_cast<uint32_t>(random() % 5), load, store, reg(), reg(), reg(), reg()});
  }
  return chain;
}

void fill_registers(float* registers) {
  std::mt19937 random(2);
  for (uint32_t i = 0; i < kChainRegisters * 64; ++i) registers[i] = 1 + static_cast<float>(random() % 1000) * 1e-4f;
}

void report(benchmark::State& state, uint64_t ops) {
  state.counters["lane_ops"] =
      benchmark::Counter(static_cast<double>(ops) * 64, benchmark::Counter::kIsIterationInvariantRate);
}

void chain_baseline(benchmark::State& state, SimdTarget target, uint32_t accumulator, uint32_t stored) {
  alignas(64) float registers[kChainRegisters * 64];
  fill_registers(registers);
  const std::vector<ChainOp> chain = make_chain(accumulator, stored);
  for (auto _ : state) {
    if (!for_target(kBaselines, target)(chain, registers, kBatchesPerIteration))
      state.SkipWithError("not on this target");
  }
  report(state, kBatchesPerIteration * kChainLength);
}

void chain_interpreter(benchmark::State& state, SimdTarget target, uint32_t accumulator, uint32_t stored) {
  struct alignas(64) Memory {
    std::byte bytes[sizeof(Frame) + kChainRegisters * kRegisterBytes];
  };
  const auto memory = std::make_unique<Memory>();
  Frame* const frame = new (memory->bytes) Frame;
  float* const registers = reinterpret_cast<float*>(frame->registers());
  fill_registers(registers);
  constexpr Opcode kOps[] = {Opcode::fadd, Opcode::fmul, Opcode::fsub, Opcode::fma, Opcode::fmin};
  std::vector<Op> ops;
  for (const ChainOp& op : make_chain(accumulator, stored)) {
    const uint32_t form = (op.load ? kFromRegisters : kAccumulatorIsA) | (op.store ? kStore : kKeep);
    ops.push_back({find_handler(target, kOps[op.op], form), op.d, op.a, op.b, op.c, 0, 0});
  }
  ops.push_back({find_handler(target, Opcode::end, kStore), 0, 0, 0, 0, 0, 0});
  const std::vector<float> start(registers, registers + 8 * 64);
  Run& run = interpreter_run(target);
  for (auto _ : state) {
    for (uint64_t i = 0; i < kBatchesPerIteration; ++i) {
      std::memcpy(registers, start.data(), start.size() * sizeof(float));
      run(ops.data(), frame);
    }
  }
  report(state, kBatchesPerIteration * kChainLength);
}

// One op, 100 times in a row.
void one_op(benchmark::State& state, SimdTarget target, Opcode op, Op operands, Quads quads) {
  FragmentTest fixture(target, quads);
  VertexBatch vertices = {};
  alignas(64) static float outputs[64 * 64];
  alignas(64) static float data[64 * 16];
  VertexBinding binding = {reinterpret_cast<const std::byte*>(data), sizeof data, 16, false};
  vertices.bindings = &binding;
  vertices.outputs = outputs;
  std::array<uint32_t, kBatchLanes> lanes;
  for (uint32_t i = 0; i < kBatchLanes; ++i) vertices.vertex_index[i] = i;
  const Attribute attribute = {0, 0, 16, &texel_functions(*find_format(VK_FORMAT_R32G32B32A32_SFLOAT), target)};
  static std::vector<uint32_t> texels(256 * 256, 0x80402010);
  TextureView view;
  view.format = find_format(VK_FORMAT_R8G8B8A8_UNORM);
  view.level_count = view.layer_count = 1;
  view.levels[0] = {reinterpret_cast<std::byte*>(texels.data()), 256, 256, 1024};
  SamplerState sampler;
  sampler.mag_filter = sampler.min_filter = VK_FILTER_LINEAR;
  Descriptor descriptor = {reinterpret_cast<std::byte*>(data), sizeof data, sizeof data, &view, &sampler};
  ResourceTable table;
  table.sets[0] = &descriptor;
  const ResourceRef ref;
  const BufferRange range = {descriptor.data, descriptor.size};
  uint16_t list[] = {kNoOperand, kNoOperand, 0, 1, kNoOperand, kNoOperand, kNoOperand, kNoOperand, 0, 1, 0, 1};
  uint64_t masks[2] = {};
  Frame& frame = fixture.test.frame();
  frame.vertices = &vertices;
  frame.attributes = &attribute;
  frame.resources = &table;
  frame.refs = &ref;
  frame.buffers = &range;
  frame.lists = list;
  const BlendEquation source_alpha_over = blend_equation(15 | 0xDE0);
  frame.blends = &source_alpha_over;
  frame.masks = masks;
  // Registers 0 to 2: u and v as of a picture drawn somewhat enlarged; 3: addresses.
  const auto write = [&](uint32_t reg, auto value) {
    for (uint32_t i = 0; i < kBatchLanes; ++i) lanes[i] = value(i);
    fixture.test.write(reg, lanes);
  };
  write(0, [](uint32_t i) { return u(0.1f + static_cast<float>(i / 8 * 2 + (i & 1)) * 0.003f); });
  write(1, [](uint32_t i) { return u(0.2f + static_cast<float>(i / 4 % 2 * 2 + (i >> 1 & 1)) * 0.003f); });
  write(2, [](uint32_t i) { return u(0.3f + static_cast<float>(i) * 0.01f); });
  write(3, [](uint32_t i) { return i * 16; });
  Run& run = interpreter_run(target);
  operands.handler = find_handler(target, op, kStore);
  std::vector<Op> ops(100, operands);
  ops.push_back({find_handler(target, Opcode::end, kStore), 0, 0, 0, 0, 0, 0});
  for (auto _ : state) {
    run(ops.data(), &frame);
    frame.exec = frame.write = ~uint64_t{0};
  }
  state.counters["time_per_op"] =
      benchmark::Counter(100, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Passes, registers and handlers of a program of arithmetic with some inputs and outputs.
void assemble_program(benchmark::State& state) {
  std::mt19937 random(3);
  Code code;
  code.output_slots = 8;
  std::vector<Reg> values;
  for (uint32_t i = 0; i < 16; i += 4) {
    const Reg first = code.emit_n(Opcode::load_push, 4, kNoReg, kNoReg, kNoReg, 0, 4 * i);
    for (uint32_t k = 0; k < 4; ++k) values.push_back(first + k);
  }
  constexpr Opcode kOps[] = {Opcode::fadd, Opcode::fmul, Opcode::fsub, Opcode::fma, Opcode::fmin, Opcode::fsin};
  const auto any = [&] { return values[values.size() - 1 - random() % 16]; };
  while (code.instructions.size() < static_cast<size_t>(state.range(0))) {
    const Opcode op = kOps[random() % std::size(kOps)];
    values.push_back(code.emit(op, any(), op == Opcode::fsin ? kNoReg : any(), op == Opcode::fma ? any() : kNoReg));
  }
  for (uint32_t slot = 0; slot < 8; ++slot) code.emit_void(Opcode::store_output, any(), kNoReg, kNoReg, slot);
  code.emit_void(Opcode::end);
  for (auto _ : state) {
    Result<ProgramPtr> program = assemble(code);
    benchmark::DoNotOptimize(program);
  }
}
BENCHMARK(assemble_program)->Arg(200)->Arg(2000);

void add_op(SimdTarget target, const std::string& name, Opcode op, Op operands, Quads quads = Quads::one_triangle) {
  const std::string full = std::string("op/") + simd_target_name(target) + '/' + name;
  benchmark::RegisterBenchmark(full.c_str(),
                               [=](benchmark::State& state) { one_op(state, target, op, operands, quads); });
}

void add_all() {
  for (SimdTarget target : supported_simd_targets()) {
    const std::string name = simd_target_name(target);
    for (const auto& [accumulator, stored] : {std::pair{0u, 100u}, {50u, 60u}, {70u, 40u}, {90u, 20u}}) {
      const std::string mix = std::to_string(accumulator) + '/' + std::to_string(stored);
      const uint32_t a = accumulator, s = stored;
      benchmark::RegisterBenchmark(("chain/" + name + '/' + mix + "/measurement").c_str(),
                                   [=](benchmark::State& state) { chain_baseline(state, target, a, s); });
      benchmark::RegisterBenchmark(("chain/" + name + '/' + mix + "/interpreter").c_str(),
                                   [=](benchmark::State& state) { chain_interpreter(state, target, a, s); });
    }
    for (uint32_t i = 0; i < static_cast<uint32_t>(Opcode::kCount); ++i) {
      const Opcode op = static_cast<Opcode>(i);
      const OpInfo& info = op_info(op);
      if ((info.effects & ~static_cast<uint32_t>(kCommutes | kCrossLane)) == kPure)
        add_op(target, info.name, op, {nullptr, 4, 0, 1, 2, 0, 0});
    }
    add_op(target, "set", Opcode::set, {nullptr, 4, 0, 0, 0, 0, 0});
    add_op(target, "load_array", Opcode::load_array, {nullptr, 8, 4, 4, 0, 3, 0});
    add_op(target, "store_array", Opcode::store_array, {nullptr, 0, 4, 0, 5, 3, 0});
    add_op(target, "load_buffer x4 (stride 16)", Opcode::load_buffer, {nullptr, 4, 3, kNoOperand, 4, 0, 0});
    add_op(target, "load_buffer x4 (same)", Opcode::load_buffer, {nullptr, 5, 4, kNoOperand, 4, 0, 0});
    add_op(target, "store_buffer (stride 16)", Opcode::store_buffer, {nullptr, 0, 3, 0, kNoOperand, 0, 0});
    add_op(target, "load_uniform x4", Opcode::load_uniform, {nullptr, 4, 0, 0, 4, 0, 0});
    add_op(target, "load_push x4", Opcode::load_push, {nullptr, 4, 0, 0, 4, 0, 0});
    add_op(target, "fetch x4", Opcode::fetch, {nullptr, 4, 0, 0, 4, 0, 0});
    add_op(target, "store_output", Opcode::store_output, {nullptr, 0, 0, 0, 0, 5, 0});
    add_op(target, "sample_2d bilinear", Opcode::sample_2d, {nullptr, 4, 0, 0, 0, 0, 0});
    add_op(target, "sample_2d_lod bilinear", Opcode::sample_2d_lod, {nullptr, 4, 0, 0, 0, 0, 0});
    add_op(target, "fetch_2d", Opcode::fetch_2d, {nullptr, 4, 0, 0, 0, 0, 0});
    constexpr std::pair<Quads, const char*> kQuads[] = {{Quads::one_triangle, " (one triangle)"},
                                                        {Quads::many_triangles, " (many triangles)"},
                                                        {Quads::block, " (block)"}};
    for (const auto& [one, suffix_text] : kQuads) {
      const std::string suffix = suffix_text;
      add_op(target, "frag_linear" + suffix, Opcode::frag_linear, {nullptr, 4, 0, 0, 0, 0, 0}, one);
      add_op(target, "frag_depth" + suffix, Opcode::frag_depth, {nullptr, 4, 0, 0, 0, 0, 0}, one);
      add_op(target, "frag_perspective" + suffix, Opcode::frag_perspective, {nullptr, 4, 0, 1, 0, 0, 0}, one);
      add_op(target, "interpolate x3" + suffix, Opcode::interpolate, {nullptr, 4, 0, 1, 3, 0, 0}, one);
      add_op(target, "interpolate_perspective x3" + suffix, Opcode::interpolate_perspective,
             {nullptr, 4, 0, 0, 3, 0, 0}, one);
      add_op(target, "interpolate_flat x3" + suffix, Opcode::interpolate_flat, {nullptr, 4, 0, 1, 3, 0, 0}, one);
    }
    add_op(target, "builtin frag_coord_x", Opcode::builtin,
           {nullptr, 4, 0, 0, 0, static_cast<uint32_t>(BuiltIn::frag_coord_x), 0});
    for (const auto& [quads, suffix] : {std::pair{Quads::one_triangle, ""}, {Quads::block, " (block)"}}) {
      const std::string end = suffix;
      add_op(target, "depth_test always" + end, Opcode::depth_test, {nullptr, 0, 0, 0, 0, VK_COMPARE_OP_ALWAYS, 1},
             quads);
      add_op(target, "depth_test and write" + end, Opcode::depth_test,
             {nullptr, 0, 0, 0, 0, VK_COMPARE_OP_ALWAYS | 8, 1}, quads);
      add_op(target, "load_color" + end, Opcode::load_color, {nullptr, 4, 0, 0, 0, 0, 0}, quads);
      add_op(target, "store_color" + end, Opcode::store_color, {nullptr, 0, 8, 0, 0, 0, 15}, quads);
      add_op(target, "blend_color" + end, Opcode::blend_color, {nullptr, 0, 8, 0, 0, 0, 0}, quads);
    }
  }
}

}  // namespace
}  // namespace lapilli

int main(int argc, char** argv) {
  lapilli::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
#endif
