// The sample program of the scene transform.
#include "scenes/transform.h"

#include "sample_main.h"

int main(int argc, char** argv) {
  using namespace lapilli::samples;
  return sample_main(argc, argv, {"transform", create_transform});
}
