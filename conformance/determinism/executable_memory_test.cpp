// No executable memory: once the device exists, a seccomp filter refuses PROT_EXEC to the whole process; pipelines are
// created and everything renders as before. Both peers fail this (LAPILLI_UNDER_TEST=llvmpipe or SwiftShader with their
// manifests in LAPILLI_ICD): their JIT needs such memory.
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <fstream>

#include "determinism/workload.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

#if defined(__x86_64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#else
constexpr uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#endif

// mmap, mprotect and pkey_mprotect with PROT_EXEC fail with EACCES, in all threads of the process.
bool refuse_executable_memory() {
  constexpr uint32_t kProtection = offsetof(seccomp_data, args) + 2 * sizeof(uint64_t);  // its low half
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_mmap, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_mprotect, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_pkey_mprotect, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kProtection),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EACCES),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program = {sizeof(filter) / sizeof(filter[0]), filter};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  return syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
}

// Executable mappings that no file stands behind.
std::string anonymous_executable_mappings() {
  std::string found;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const size_t space = line.find(' ');
    const bool executable = line[space + 3] == 'x', writable = line[space + 2] == 'w';
    const bool backed = line.find('/') != std::string::npos && line.find("memfd") == std::string::npos;
    const bool kernel = line.find("[vdso]") != std::string::npos || line.find("[vsyscall]") != std::string::npos;
    if (executable && (writable || (!backed && !kernel))) found += line + "\n";
  }
  return found;
}

// The child's report: a word for the outcome, then the text of the first failure.
enum class Outcome : uint8_t { kSame, kDifferent, kNoFilter, kFilterLeaks, kExecutableMapping, kException };

Outcome run_under_filter(const Workload& workload, int results_pipe) {
  const auto context = new_subject();
  if (!refuse_executable_memory()) return Outcome::kNoFilter;
  if (mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED) {
    return Outcome::kFilterLeaks;
  }
  const std::vector<Result> results = workload.run(*context);
  if (!anonymous_executable_mappings().empty()) return Outcome::kExecutableMapping;
  for (const Result& r : results) {
    for (size_t done = 0; done < r.bytes.size();) {
      const ssize_t n = write(results_pipe, r.bytes.data() + done, r.bytes.size() - done);
      if (n <= 0) return Outcome::kException;
      done += size_t(n);
    }
  }
  return Outcome::kSame;
}

// This test has a program of its own: the child is forked before any driver is loaded.
TEST(ExecutableMemory, RendersWhereNoneCanBeMade) {
  Workload workload;
  int fds[2];
  ASSERT_EQ(pipe(fds), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    close(fds[0]);
    Outcome outcome = Outcome::kException;
    try {
      outcome = run_under_filter(workload, fds[1]);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "under the filter: %s\n", e.what());
    }
    close(fds[1]);
    _exit(int(outcome));
  }
  close(fds[1]);
  Bytes from_child;
  std::byte chunk[65536];
  for (ssize_t n; (n = read(fds[0], chunk, sizeof(chunk))) > 0;) from_child.insert(from_child.end(), chunk, chunk + n);
  close(fds[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "the child died of signal " << WTERMSIG(status);
  if (WEXITSTATUS(status) == int(Outcome::kNoFilter)) GTEST_SKIP() << "this kernel refuses the filter";
  ASSERT_EQ(WEXITSTATUS(status), int(Outcome::kSame))
      << "2: no filter, 3: the filter leaks, 4: an executable mapping that is no file, 5: a call failed";

  Bytes here;
  for (const Result& r : workload.run(subject())) here.insert(here.end(), r.bytes.begin(), r.bytes.end());
  EXPECT_TRUE(here == from_child) << "other bits under the filter";
}

}  // namespace
}  // namespace lapilli::conformance
