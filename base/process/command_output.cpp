#include "base/process/command_output.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>

#include "base/process/clocks.h"

namespace ols {
namespace {

// Nothing if the program cannot be started.
std::optional<pid_t> start(const std::vector<std::string>& command, int output) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, 3);
  pid_t child = -1;
  const int error =
      ::posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return std::nullopt;
  return child;
}

// Reads until the program closes its output; false on timeout or too much output.
bool read_all(int fd, double end_s, std::size_t most_bytes, std::string& text) {
  std::array<char, 4096> buffer;
  while (text.size() <= most_bytes) {
    pollfd entry{fd, POLLIN, 0};
    const double left_s = end_s - clock_monotonic_s();
    if (left_s <= 0.0) return false;
    if (::poll(&entry, 1, static_cast<int>(std::ceil(left_s * 1e3))) <= 0) continue;
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n == 0) return true;
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return false;
}

}  // namespace

std::optional<std::string> command_output(const std::vector<std::string>& command,
                                          double deadline_s, std::size_t most_bytes) {
  if (command.empty()) return std::nullopt;
  const double end_s = clock_monotonic_s() + deadline_s;
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const std::optional<pid_t> child = start(command, ends[1]);
  ::close(ends[1]);
  std::string text;
  const bool complete = child && read_all(ends[0], end_s, most_bytes, text);
  ::close(ends[0]);
  if (!child) return std::nullopt;
  // A program that has closed its output may still run, so the timeout applies here, too.
  int status = 0;
  pid_t ended = 0;
  while (complete && (ended = ::waitpid(*child, &status, WNOHANG)) == 0 &&
         clock_monotonic_s() < end_s) {
    ::poll(nullptr, 0, 2);
  }
  if (ended == 0) {
    ::kill(*child, SIGKILL);
    while (::waitpid(*child, &status, 0) < 0 && errno == EINTR) {
    }
    return std::nullopt;
  }
  if (!complete || ended != *child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return std::nullopt;
  }
  return text;
}

}  // namespace ols
