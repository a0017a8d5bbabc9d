// INDI's own telescope simulator behind indiserver.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/process/command_output.h"
#include "tests/unit/temporary_folder.h"

namespace ols::indi {

inline constexpr const char* kTelescope = "Telescope Simulator";

// indiserver with a simulator; both end with it.
class Server {
 public:
  explicit Server(int port, std::string driver = "indi_simulator_telescope")
      : port_(port), driver_(std::move(driver)) {
    ::setenv("HOME", (folder_.path()).c_str(), 1);  // its settings
    start();
  }
  ~Server() { end(); }
  void end() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  void start() {
    const std::string port = std::to_string(port_), pipe = folder_ / "pipe";
    const char* arguments[] = {"indiserver",    "-p",   port.c_str(), "-u", pipe.c_str(),
                               driver_.c_str(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (::posix_spawnp(&process_, arguments[0], &files, nullptr,
                       const_cast<char* const*>(arguments), environ) != 0)
      throw std::runtime_error("no indiserver: Debian's package indi-bin");
    posix_spawn_file_actions_destroy(&files);
  }

 private:
  int port_;
  std::string driver_;
  TemporaryFolder folder_;
  pid_t process_ = 0;
};

// Whether the drivers have told their devices.
inline bool has_devices(int port) {
  const auto text = command_output({"indi_getprop", "-p", std::to_string(port), "-t", "1"}, 10.0);
  return text && !text->empty();
}

}  // namespace ols::indi
