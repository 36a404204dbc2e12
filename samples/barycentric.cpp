// The sample program of the scene barycentric.
#include "scenes/barycentric.h"

#include "sample_main.h"

int main(int argc, char** argv) {
  using namespace lapilli::samples;
  return sample_main(argc, argv, {"barycentric", create_barycentric});
}
