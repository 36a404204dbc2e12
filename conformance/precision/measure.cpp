// See measure.h.
#include "precision/measure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <thread>

#include "harness/compute.h"
#include "shaders/precision.comp.h"

namespace lapilli::precision {
namespace {

constexpr size_t kCallsAtOnce = size_t{1} << 21;
// Errors below one ULP are within every bound; of those only some are compared with it, since formulas take long.
constexpr uint64_t kBoundEvery = 61;

struct Push {
  uint32_t count, first, stride;
};

std::vector<float> run(const samples::Context& context, int number, uint32_t operands, uint32_t results,
                       std::vector<float> input, const Push& push) {
  const std::array<uint32_t, 3> constants = {uint32_t(number), operands, results};
  const VkSpecializationMapEntry entries[] = {{0, 0, 4}, {1, 4, 4}, {2, 8, 4}};
  const VkSpecializationInfo specialization = {3, entries, sizeof(constants), constants.data()};
  if (input.empty()) input.push_back(0);
  conformance::ComputeRun job;
  job.shader = shaders::kPrecisionComp;
  job.buffers = {conformance::to_bytes(input), conformance::Bytes(size_t{push.count} * results * sizeof(float))};
  job.groups[0] = (push.count + 63) / 64;
  job.push_constants = conformance::to_bytes(std::vector<Push>{push});
  job.specialization = &specialization;
  return conformance::from_bytes<float>(conformance::run_compute(context, job)[1]);
}

void keep_worst(Worst& worst, double value, std::span<const float> operands) {
  if (!(value > worst.value)) return;
  worst.value = value;
  worst.operands.assign(operands.begin(), operands.end());
}

void merge(Measured& all, const Measured& part) {
  all.calls += part.calls;
  all.judged += part.judged;
  all.specials += part.specials;
  keep_worst(all.ulp, part.ulp.value, part.ulp.operands);
  keep_worst(all.share, part.share.value, part.share.operands);
  keep_worst(all.special, part.special.value, part.special.operands);
}

// Calls work(begin, end, part) for the two halves of a range on two threads.
template <typename Work>
void in_halves(size_t count, Measured& all, const Work& work) {
  Measured parts[2];
  std::thread other([&] { work(size_t{0}, count / 2, parts[0]); });
  work(count / 2, count, parts[1]);
  other.join();
  for (const Measured& part : parts) merge(all, part);
}

// `want` is NaN or rounds to infinity; then the largest number is as right (the rounding mode is open).
bool special_differs(float got, double want) {
  if (std::isnan(want)) return !std::isnan(got);
  return !(std::abs(got) >= std::numeric_limits<float>::max() && std::signbit(got) == std::signbit(want));
}

bool denormal(double x) { return x != 0 && std::abs(x) < 0x1p-126; }

bool counts(Judge judge, std::span<const float> operands, double want, const Inexact& allowed) {
  if (judge == Judge::everything) return true;
  return std::isfinite(allowed.error) && !denormal(want) &&
         std::none_of(operands.begin(), operands.end(), [](float x) { return denormal(double(x)); });
}

void compare_with_bound(float got, double want, const Inexact& allowed, std::span<const float> operands,
                        Measured& out) {
  if (!std::isfinite(allowed.error)) return;
  ++out.judged;
  const double error = std::abs(double(got) - allowed.value);
  const double share = std::isnan(got) ? INFINITY : error == 0 || got == float(want) ? 0 : error / allowed.error;
  keep_worst(out.share, share, operands);
}

}  // namespace

Measured measure(const samples::Context& context, Judge judge, const OneOperand& function, uint32_t stride) {
  Measured all = {.name = function.name, .bound = function.bound, .promised = function.promised};
  const uint64_t calls = ((uint64_t{1} << 32) - 1) / stride + 1;
  for (uint64_t first = 0; first < calls; first += kCallsAtOnce) {
    const auto count = uint32_t(std::min<uint64_t>(kCallsAtOnce, calls - first));
    const auto bits = uint32_t(first * stride);
    const std::vector<float> got = run(context, function.number, 1, 1, {}, {count, bits, stride});
    in_halves(count, all, [&](size_t begin, size_t end, Measured& part) {
      for (size_t i = begin; i < end; ++i) {
        const uint32_t operand = bits + uint32_t(i) * stride;
        const auto x = std::bit_cast<float>(operand);
        const double value = function.bits ? double(operand) : double(x);
        const double want = function.exact(value);
        ++part.calls;
        if (!(std::abs(want) < 0x1p128)) {
          ++part.specials;
          if (special_differs(got[i], want)) keep_worst(part.special, 1, {&x, 1});
          continue;
        }
        const double error = oracle::ulp_error(got[i], want);
        const bool near = error < 1 && part.calls % kBoundEvery != 0;
        const Inexact allowed =
            near && judge == Judge::everything ? Inexact(want, INFINITY, 0) : function.allowed(value, want);
        if (!counts(judge, {&x, 1}, want, allowed)) continue;
        keep_worst(part.ulp, error, {&x, 1});
        compare_with_bound(got[i], want, allowed, {&x, 1}, part);
      }
    });
  }
  return all;
}

Measured measure(const samples::Context& context, Judge judge, const SeveralOperands& function, size_t calls,
                 uint32_t seed) {
  Measured all = {.name = function.name, .bound = function.bound, .promised = function.promised};
  for (size_t first = 0; first < calls; first += kCallsAtOnce) {
    const size_t count = std::min(kCallsAtOnce, calls - first);
    const std::vector<float> operands = operands_for(function, count, seed++);
    const std::vector<float> got =
        run(context, function.number, function.operands, function.results, operands, {uint32_t(count), 0, 0});
    in_halves(count, all, [&](size_t begin, size_t end, Measured& part) {
      for (size_t call = begin; call < end; ++call) {
        const std::span<const float> x(&operands[call * function.operands], function.operands);
        double exact_operands[kMaxOperands] = {}, want[kMaxResults];
        std::copy(x.begin(), x.end(), exact_operands);
        Inexact allowed[kMaxResults];
        function.exact(exact_operands, want);
        function.allowed(exact_operands, allowed);
        ++part.calls;
        for (uint32_t i = 0; i < function.results; ++i) {
          const float result = got[call * function.results + i];
          const bool promised = std::isfinite(function.promised);
          if (!(std::abs(want[i]) < 0x1p128)) {
            ++part.specials;
            if (promised && special_differs(result, want[i])) keep_worst(part.special, 1, x);
            continue;
          }
          if (!counts(judge, x, want[i], allowed[i])) continue;
          if (promised || std::isfinite(allowed[i].error)) keep_worst(part.ulp, oracle::ulp_error(result, want[i]), x);
          compare_with_bound(result, want[i], allowed[i], x, part);
        }
      }
    });
  }
  return all;
}

std::vector<float> run_edge(const samples::Context& context, const Edge& edge) {
  const auto results = uint32_t(edge.result.size()), operands = uint32_t(edge.operands.size());
  return run(context, edge.number, operands, results, edge.operands, {1, std::bit_cast<uint32_t>(edge.operands[0]), 0});
}

bool same(std::span<const float> got, std::span<const float> want) {
  return std::equal(got.begin(), got.end(), want.begin(), want.end(), [](float a, float b) {
    return std::isnan(b) ? std::isnan(a) : std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
  });
}

}  // namespace lapilli::precision
