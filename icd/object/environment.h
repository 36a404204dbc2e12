// The driver's environment variables: LAPILLI_LOG, LAPILLI_THREADS, LAPILLI_SIMD, LAPILLI_TIMEOUT_MS,
// LAPILLI_KEEP, LAPILLI_STATS, LAPILLI_DUMP.
#pragma once

#include <chrono>

namespace lapilli {

struct Environment {
  unsigned threads = 1;                      // worker threads of a device
  std::chrono::milliseconds timeout{10000};  // of one command on the queue, then the device is lost
  bool stats = false;                        // print the ledger of every submission that draws
  // How long a thread of the driver waits awake for more to do; 0 where it would keep the only core from the others.
  std::chrono::microseconds spin{0};
};

// Reads them anew: sets the log level and the SIMD target of the process. A value without meaning is a warning.
Environment read_environment();

}  // namespace lapilli
