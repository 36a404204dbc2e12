// See start.h.
#include "start.h"

#include "child.h"
#include "run/process.h"

namespace lapilli::bench {

std::vector<Start> measure_starts(const std::vector<run::Driver>& drivers, const Plan& plan, int rounds) {
  std::vector<run::Driver> all = drivers;
  all.push_back({LAPILLI_NULL_DRIVER, "nothing"});
  struct Taken {
    std::vector<double> times, resident, anonymous;
  };
  std::vector<Start> starts(all.size());
  std::vector<Taken> taken(all.size());
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < all.size(); ++i) {
      run::Process process({plan.program, arguments_of({}), all[i].manifest, {}});
      const auto hello = process.answer();
      if (!hello || !hello->contains("instance_device")) {
        process.wait_for_end();
        starts[i].absent = hello ? hello->dump() : process.ended();
        continue;
      }
      taken[i].times.push_back(hello->at("instance_device"));
      taken[i].resident.push_back(hello->at("resident_kb"));
      taken[i].anonymous.push_back(hello->at("anonymous_kb"));
    }
  }
  for (size_t i = 0; i < all.size(); ++i) {
    starts[i].driver = all[i].label;
    starts[i].instance_device = run::median(taken[i].times);
    starts[i].resident_kb = run::median(taken[i].resident);
    starts[i].anonymous_kb = run::median(taken[i].anonymous);
  }
  return starts;
}

}  // namespace lapilli::bench
