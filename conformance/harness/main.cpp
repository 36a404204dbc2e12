// main() of the tests that talk to drivers: chooses the manifests before the loader reads its environment.
#include <gtest/gtest.h>

#include <cstdio>

#include "harness/devices.h"
#include "harness/variants.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  lapilli::conformance::choose_drivers();
  const int result = RUN_ALL_TESTS();
  lapilli::conformance::destroy_devices();
  if (lapilli::conformance::variant_was_used()) return result;
  std::fprintf(stderr, "LAPILLI_SHADER_VARIANT replaced no shader\n");
  return 1;
}
