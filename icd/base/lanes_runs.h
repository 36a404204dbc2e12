// For tests: the primitives of lanes-inl.h over arrays of 32-bit patterns, for each SIMD target.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simd_dispatch.h"

namespace lapilli {

// Counts are multiples of 16. Conditions give 0 or 0xFFFFFFFF.
using UnaryBits = void(const std::uint32_t* x, std::uint32_t* result, std::size_t count);
using BinaryBits = void(const std::uint32_t* x, const std::uint32_t* y, std::uint32_t* result, std::size_t count);

// Name, and the expression on x (and y) as U.
#define LAPILLI_UNARY_BITS(X)                                     \
  X(to_int, to_int(as_f(x)))                                      \
  X(to_uint, to_uint(as_f(x)))                                    \
  X(int_to_float, to_float(as_i(x)))                              \
  X(uint_to_float, to_float(x))                                   \
  X(int_through_double, truncate_in_range(to_double(as_i(x))))    \
  X(uint_through_double, truncate_to_uint_in_range(to_double(x))) \
  X(to_half, to_half(as_f(x)))                                    \
  X(from_half, from_half(x))                                      \
  X(bit_count, bit_count(x))                                      \
  X(bit_reverse, bit_reverse(x))                                  \
  X(find_lsb, find_lsb(x))                                        \
  X(find_msb_unsigned, find_msb(x))                               \
  X(find_msb_signed, find_msb(as_i(x)))                           \
  X(absolute_int, abs(as_i(x)))                                   \
  X(canonical, canonical(as_f(x)))                                \
  X(negate_float, negate(as_f(x)))                                \
  X(swap_columns, swap_columns(x))                                \
  X(swap_rows, swap_rows(x))                                      \
  X(is_nan, mask_to_u(is_nan(as_f(x))))                           \
  X(is_inf, mask_to_u(is_inf(as_f(x))))                           \
  X(is_finite, mask_to_u(is_finite(as_f(x))))

#define LAPILLI_BINARY_BITS(X)                                             \
  X(multiply, x* y)                                                        \
  X(mul_high_unsigned, mul_high(x, y))                                     \
  X(mul_high_signed, mul_high(as_i(x), as_i(y)))                           \
  X(divide_unsigned, divide(x, y))                                         \
  X(remainder_unsigned, remainder(x, y))                                   \
  X(divide_signed, divide(as_i(x), as_i(y)))                               \
  X(remainder_signed, remainder(as_i(x), as_i(y)))                         \
  X(modulo_signed, modulo(as_i(x), as_i(y)))                               \
  X(shift_left, shift_left(x, y))                                          \
  X(shift_right_logical, shift_right(x, y))                                \
  X(shift_right_arithmetic, shift_right(as_i(x), y))                       \
  X(add_carry, add_carry(x, y))                                            \
  X(sub_borrow, sub_borrow(x, y))                                          \
  X(min_unsigned, min(x, y))                                               \
  X(max_unsigned, max(x, y))                                               \
  X(min_signed, min(as_i(x), as_i(y)))                                     \
  X(max_signed, max(as_i(x), as_i(y)))                                     \
  X(less_unsigned, mask_to_u(lt(x, y)))                                    \
  X(less_signed, mask_to_u(lt(as_i(x), as_i(y))))                          \
  X(less_equal_unsigned, mask_to_u(le(x, y)))                              \
  X(less_equal_signed, mask_to_u(le(as_i(x), as_i(y))))                    \
  X(equal_bits, mask_to_u(eq(x, y)))                                       \
  X(equal, mask_to_u(eq(as_f(x), as_f(y))))                                \
  X(not_equal, mask_to_u(ne(as_f(x), as_f(y))))                            \
  X(less, mask_to_u(lt(as_f(x), as_f(y))))                                 \
  X(less_equal, mask_to_u(le(as_f(x), as_f(y))))                           \
  X(greater, mask_to_u(gt(as_f(x), as_f(y))))                              \
  X(greater_equal, mask_to_u(ge(as_f(x), as_f(y))))                        \
  X(ordered_not_equal, mask_to_u(ordered_ne(as_f(x), as_f(y))))            \
  X(unordered_equal, mask_to_u(unordered_eq(as_f(x), as_f(y))))            \
  X(unordered_less, mask_to_u(unordered_lt(as_f(x), as_f(y))))             \
  X(unordered_less_equal, mask_to_u(unordered_le(as_f(x), as_f(y))))       \
  X(unordered_greater, mask_to_u(unordered_gt(as_f(x), as_f(y))))          \
  X(unordered_greater_equal, mask_to_u(unordered_ge(as_f(x), as_f(y))))    \
  X(add_float, as_f(x) + as_f(y))                                          \
  X(divide_float, as_f(x) / as_f(y))                                       \
  X(product_in_double, to_float(to_double(as_f(x)) * to_double(as_f(y))))  \
  X(less_in_double, mask_to_u(lt(to_double(as_f(x)), to_double(as_f(y))))) \
  X(min_in_double, to_float(min(to_double(as_f(x)), to_double(as_f(y)))))  \
  X(select_float, select(lt(x, y), as_f(x), as_f(y)))                      \
  X(select_bits, select(lt(x, y), x, y))

struct LaneRuns {
#define LAPILLI_MEMBER(name, expression) UnaryBits* name;
  LAPILLI_UNARY_BITS(LAPILLI_MEMBER)
#undef LAPILLI_MEMBER
#define LAPILLI_MEMBER(name, expression) BinaryBits* name;
  LAPILLI_BINARY_BITS(LAPILLI_MEMBER)
#undef LAPILLI_MEMBER
  void (*extract_unsigned)(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width, std::uint32_t* result);
  void (*extract_signed)(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width, std::uint32_t* result);
  // Inserts the 16 words x into ~x.
  void (*insert)(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width, std::uint32_t* result);
  // Through mask_of and bits_of, vector by vector.
  std::uint64_t (*mask_round_trip)(std::uint64_t word);
  // 64 lanes.
  void (*gather)(const void* base, const std::uint32_t* offsets, std::uint64_t mask, std::uint32_t* result);
};

const LaneRuns& lane_runs(SimdTarget target);

}  // namespace lapilli
