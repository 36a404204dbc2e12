// For tests and the fuzzer: everything that pipeline creation does with a module, for each of its entry points.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lapilli {

// Reads and lowers the module, verifies and assembles the programs. Empty, or the text of the first error; one that is
// no refusal ("SPIR-V: …") is a bug of ours.
std::string try_module(std::span<const uint32_t> words);
bool is_refusal(const std::string& text);

}  // namespace lapilli
