// A process of its own for one driver: its environment, its crashes and its memory are its own. Parent and child talk
// in lines, commands down and JSON up.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lapilli::run {

struct Launch {
  std::string program;
  std::vector<std::string> arguments;
  std::string manifest;                                          // the only driver that the loader is given
  std::vector<std::pair<std::string, std::string>> environment;  // set beside it
  int cpus = 0;                                                  // the process may use the first so many; 0: all
};

class Process {
 public:
  // Throws std::runtime_error where there are no more pipes or processes.
  explicit Process(const Launch& launch);
  ~Process() { wait_for_end(); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool tell(const std::string& line);
  // The next line that is a JSON object; nothing if the process has ended (how: ended()).
  std::optional<nlohmann::json> answer();
  // Closes the pipes, which ends the child.
  void wait_for_end();
  // "exit status 1", "signal 11" …
  const std::string& ended() const { return ended_; }

 private:
  int process_ = -1;
  std::FILE* to_child_ = nullptr;
  std::FILE* from_child_ = nullptr;
  std::string ended_;
};

}  // namespace lapilli::run
