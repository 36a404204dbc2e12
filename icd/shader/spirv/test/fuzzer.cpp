// libFuzzer over the reader and the lowering: cmake --preset fuzz && cmake --build --preset fuzz &&
// build/fuzz/icd/shader/spirv_fuzzer CORPUS -max_len=65536. Its minimized corpus and what it found are in test/corpus/,
// which fuzz_test replays.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "shader/spirv/test/try_module.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<uint32_t> words(size / sizeof(uint32_t));
  if (!words.empty()) std::memcpy(words.data(), data, words.size() * sizeof(uint32_t));
  const std::string text = lapilli::try_module(words);
  if (text.empty() || lapilli::is_refusal(text)) return 0;
  std::fprintf(stderr, "no refusal: %s\n", text.c_str());
  std::abort();
}
