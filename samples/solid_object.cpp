// The sample program of the scene solid_object.
#include "scenes/solid_object.h"

#include "sample_main.h"

int main(int argc, char** argv) {
  using namespace lapilli::samples;
  return sample_main(argc, argv, {"solid_object", create_solid_object});
}
