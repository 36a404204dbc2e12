// The driver under test and its peer, both in this process through the stock loader.
//   LAPILLI_ICD         manifest of the driver under test (default: the build's)
//   LAPILLI_UNDER_TEST  a part of its device name (default: Lapilli), so that any driver can be tested
//   LAPILLI_PEER_ICD    manifest of the peer (default: lavapipe's; empty: none)
#pragma once

#include <memory>
#include <string>

#include "common/context.h"

namespace lapilli::conformance {

// Called by main() before the first Vulkan call: points the loader at the manifests.
void choose_drivers();

// Shared by all tests of the process; created when first asked for.
const samples::Context& subject();
// lavapipe; null in sanitizer builds and where it is not installed.
const samples::Context* peer();

// A context of its own on the driver under test, e.g. after an environment variable changed.
std::unique_ptr<samples::Context> new_subject(bool messages = false);

const std::string& subject_name();
bool subject_is_lapilli();

// The directory in the build tree where images of failures go; made when asked for.
std::string output_directory();

// Called by main() at the end, so that leaks show.
void destroy_devices();

}  // namespace lapilli::conformance
