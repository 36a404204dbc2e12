// What all files of entry points use. Each entry point casts the handles and calls one function.
#pragma once

#include <span>

#include "command/record.h"
#include "queue/device.h"

namespace lapilli {

// The application's array and its count.
template <class T>
std::span<const T> list(const T* data, uint32_t count) {
  return {data, count};
}

}  // namespace lapilli
