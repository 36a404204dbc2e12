// What this process and the whole machine have used so far.
#pragma once

namespace lapilli::bench {

struct Usage {
  double process_ms = 0;  // user and system time of all threads of this process
  double machine_ms = 0;  // the same of all processes, and what the hypervisor took, over all CPUs; in steps of 10 ms
  double waited_ms = 0;   // that its threads, those that still run, were ready and got no CPU
};
Usage usage_now();

struct Memory {
  double resident_kb = 0;   // VmRSS
  double anonymous_kb = 0;  // RssAnon: what is this process's own
  double peak_kb = 0;       // VmHWM
};
Memory memory_now();

}  // namespace lapilli::bench
