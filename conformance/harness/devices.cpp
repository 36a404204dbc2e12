// Driver selection: see devices.h.
#include "harness/devices.h"

#include <cstdlib>
#include <filesystem>

namespace lapilli::conformance {
namespace {

constexpr const char* kPeerName = "llvmpipe";

std::string environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

std::string peer_manifest() {
#ifdef LAPILLI_SANITIZED
  const char* otherwise = "";
#else
  const char* otherwise = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json";
#endif
  const std::string path = environment("LAPILLI_PEER_ICD", otherwise);
  return !path.empty() && std::filesystem::exists(path) ? path : std::string();
}

std::unique_ptr<samples::Context> shared_subject;
std::unique_ptr<samples::Context> shared_peer;

}  // namespace

const std::string& subject_name() {
  static const std::string name = environment("LAPILLI_UNDER_TEST", "Lapilli");
  return name;
}

bool subject_is_lapilli() { return subject_name() == "Lapilli"; }

void choose_drivers() {
  const std::string subject_manifest = environment("LAPILLI_ICD", LAPILLI_ICD_MANIFEST);
  const std::string peer_path = peer_manifest();
  const bool add_peer = !peer_path.empty() && peer_path != subject_manifest;
  const std::string manifests = add_peer ? subject_manifest + ":" + peer_path : subject_manifest;
  setenv("VK_DRIVER_FILES", manifests.c_str(), 1);
  setenv("VK_ICD_FILENAMES", manifests.c_str(), 1);  // the name of older loaders
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  // lavapipe's float texture filter instead of the one with 8-bit weights.
  setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 0);
  setenv("NODEVICE_SELECT", "1", 1);  // Mesa's implicit device-select layer
  setenv("XDG_RUNTIME_DIR", "/tmp", 0);
}

std::unique_ptr<samples::Context> new_subject(bool messages) {
  samples::ContextOptions options;
  options.device_name = subject_name();
  options.messages = messages;
  return std::make_unique<samples::Context>(options);
}

const samples::Context& subject() {
  if (!shared_subject) shared_subject = new_subject();
  return *shared_subject;
}

const samples::Context* peer() {
  if (peer_manifest().empty()) return nullptr;
  if (!shared_peer) {
    samples::ContextOptions options;
    options.device_name = kPeerName;
    shared_peer = std::make_unique<samples::Context>(options);
  }
  return shared_peer.get();
}

std::string output_directory() {
  const std::filesystem::path path = environment("LAPILLI_CONFORMANCE_OUT", LAPILLI_CONFORMANCE_OUT);
  std::filesystem::create_directories(path);
  return path.string();
}

void destroy_devices() {
  shared_subject.reset();
  shared_peer.reset();
}

}  // namespace lapilli::conformance
