// Starts, asks and ends a process that loads a driver.
#include "run/process.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace lapilli::run {
namespace {

using nlohmann::json;

// Narrows the process to the first `count` of the CPUs that it may use.
void use_cpus(int count) {
  cpu_set_t allowed, wanted;
  CPU_ZERO(&allowed);
  CPU_ZERO(&wanted);
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return;
  for (size_t cpu = 0; cpu < CPU_SETSIZE && count > 0; ++cpu) {
    if (!CPU_ISSET(cpu, &allowed)) continue;
    CPU_SET(cpu, &wanted);
    --count;
  }
  sched_setaffinity(0, sizeof(wanted), &wanted);
}

}  // namespace

Process::Process(const Launch& launch) {
  std::array<int, 2> down = {};
  std::array<int, 2> up = {};
  // Closed on exec, or the next child would hold this one's pipe open.
  if (pipe2(down.data(), O_CLOEXEC) != 0 || pipe2(up.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipes");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ == 0) {
    dup2(down[0], STDIN_FILENO);
    dup2(up[1], STDOUT_FILENO);
    setenv("VK_DRIVER_FILES", launch.manifest.c_str(), 1);
    setenv("VK_ICD_FILENAMES", launch.manifest.c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // a first frame compiles
    for (const auto& [name, value] : launch.environment) setenv(name.c_str(), value.c_str(), 1);
    if (launch.cpus > 0) use_cpus(launch.cpus);
    std::vector<char*> arguments = {const_cast<char*>(launch.program.c_str())};
    for (const std::string& argument : launch.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execv(launch.program.c_str(), arguments.data());
    _exit(127);
  }
  close(down[0]);
  close(up[1]);
  to_child_ = fdopen(down[1], "w");
  from_child_ = fdopen(up[0], "r");
}

std::optional<json> Process::answer() {
  if (from_child_ == nullptr) return std::nullopt;
  std::string line;
  for (int c = std::fgetc(from_child_); c != EOF; c = std::fgetc(from_child_)) {
    if (c != '\n') {
      line.push_back(static_cast<char>(c));
      continue;
    }
    // Whatever else a driver prints is not for us.
    const json reply = json::parse(line, nullptr, false);
    if (reply.is_object()) return reply;
    line.clear();
  }
  wait_for_end();
  return std::nullopt;
}

bool Process::tell(const std::string& line) {
  if (to_child_ == nullptr) return false;
  return std::fputs((line + "\n").c_str(), to_child_) >= 0 && std::fflush(to_child_) == 0;
}

void Process::wait_for_end() {
  if (process_ < 0) return;
  std::fclose(to_child_);
  std::fclose(from_child_);
  to_child_ = nullptr;
  from_child_ = nullptr;
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  ended_ = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                               : "exit status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace lapilli::run
