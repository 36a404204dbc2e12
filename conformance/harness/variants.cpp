// See variants.h.
#include "harness/variants.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace lapilli::conformance {
namespace {

using Words = std::vector<uint32_t>;

std::atomic<bool> replaced{false};

Words read_words(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  Words words(bytes.size() / sizeof(uint32_t));
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
  return words;
}

const char* folder() { return std::getenv("LAPILLI_SHADER_VARIANT"); }

const std::map<Words, Words>& modules() {
  static const std::map<Words, Words> all = [] {
    std::map<Words, Words> found;
    if (folder() == nullptr) return found;
    const std::filesystem::path variant = folder();
    for (const auto& file : std::filesystem::directory_iterator(variant))
      found[read_words(variant.parent_path() / "original" / file.path().filename())] = read_words(file.path());
    return found;
  }();
  return all;
}

}  // namespace

std::span<const uint32_t> in_variant(std::span<const uint32_t> module) {
  if (modules().empty()) return module;
  const auto found = modules().find(Words(module.begin(), module.end()));
  if (found == modules().end()) return module;
  if (found->second != found->first) replaced = true;
  return found->second;
}

bool variant_was_used() { return folder() == nullptr || replaced; }

}  // namespace lapilli::conformance
