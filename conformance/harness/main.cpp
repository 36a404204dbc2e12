// main() of the tests that talk to drivers: chooses the manifests before the loader reads its environment.
#include <gtest/gtest.h>

#include "harness/devices.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  lapilli::conformance::choose_drivers();
  const int result = RUN_ALL_TESTS();
  lapilli::conformance::destroy_devices();
  return result;
}
