#include "tools/logger/child_logger.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace ols {
namespace {

constexpr int kOrderlyEnd_ms = 5000;
constexpr int kCannotExecute = 127;

std::string mega(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// The name of a log goes through strftime.
std::string escaped(const std::string& folder) {
  std::string result;
  for (const char c : folder) result.append(c == '%' ? 2 : 1, c);
  return result;
}

[[noreturn]] void become(std::vector<char*> arguments, int output, pid_t parent) {
  // Whatever ends its parent must not leave a logger behind that nobody holds to a quota.
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  ::setenv("TZ", "UTC", 1);  // for the names of the files
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execvp(arguments[0], arguments.data());
  ::_exit(kCannotExecute);
}

}  // namespace

std::vector<std::string> logger_command(const LoggerConfig& config) {
  std::vector<std::string> command{
      "lcm-logger",
      "-i",  // --increment and --strftime would swallow the next word in lcm-logger 1.3.1
      "-s",
      // lcm-logger counts in 2^20 bytes.
      "--split-mb=" + mega(config.split_bytes / 1048576.0),
      "--max-unwritten-mb=" + mega(config.max_unwritten_mb),
      "--lcm-url=" + config.lcm_url,
      "--channel=" + config.channels,
  };
  if (config.invert) command.emplace_back("--invert-channels");
  command.push_back(escaped(config.folder) + "/" + config.name + "-%Y%m%dT%H%M%SZ.lcmlog");
  return command;
}

// This program has one thread: fork() is safe, and it alone can tie the child's life to ours.
ChildLogger::ChildLogger(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(arguments, ends[1], parent);
  const int error = errno;
  ::close(ends[1]);
  if (pid_ < 0) {
    ::close(ends[0]);
    throw std::system_error(error, std::generic_category(), "fork");
  }
  output_ = ends[0];
  ::fcntl(output_, F_SETFL, O_NONBLOCK);
}

ChildLogger::~ChildLogger() {
  stop();
  ::close(output_);
}

std::vector<std::string> ChildLogger::listen() {
  std::array<char, 4096> buffer;
  ssize_t n;
  while ((n = ::read(output_, buffer.data(), buffer.size())) > 0) {
    pending_.append(buffer.data(), static_cast<std::size_t>(n));
  }
  std::vector<std::string> lines;
  std::size_t end;
  while ((end = pending_.find('\n')) != std::string::npos) {
    take_line(pending_.substr(0, end), lines);
    pending_.erase(0, end + 1);
  }
  constexpr std::size_t kLongestLine = 4096;
  if (pending_.size() > kLongestLine) pending_.clear();
  return lines;
}

void ChildLogger::take_line(const std::string& line, std::vector<std::string>& lines) {
  if (line.empty() || line.starts_with("Summary:")) return;
  if (const std::size_t at = line.find("Dropped "); at != std::string::npos) {
    dropped_ += std::strtoull(line.c_str() + at + 8, nullptr, 10);
  }
  if (line.starts_with("Opening log file \"") && line.ends_with('"')) {
    const std::size_t quote = line.find('"');
    current_file_ = line.substr(quote + 1, line.size() - quote - 2);
    return;
  }
  lines.push_back(line);
}

bool ChildLogger::reap(int flags) {
  while (!reaped_) {
    const pid_t ended = ::waitpid(pid_, &status_, flags);
    if (ended == 0) return false;
    if (ended < 0 && errno == EINTR) continue;
    reaped_ = true;
  }
  return true;
}

std::optional<std::string> ChildLogger::ended() {
  if (!reap(WNOHANG)) return std::nullopt;
  if (WIFSIGNALED(status_))
    return "lcm-logger was ended by signal " + std::to_string(WTERMSIG(status_));
  const int code = WEXITSTATUS(status_);
  if (code == kCannotExecute) return "lcm-logger cannot be started: is it installed?";
  return "lcm-logger ended with status " + std::to_string(code);
}

void ChildLogger::stop() {
  if (reap(WNOHANG)) return;
  ::kill(pid_, SIGTERM);
  constexpr int kLook_ms = 20;
  for (int waited_ms = 0; waited_ms < kOrderlyEnd_ms; waited_ms += kLook_ms) {
    listen();  // it must not wait for us to read
    if (reap(WNOHANG)) return;
    ::poll(nullptr, 0, kLook_ms);
  }
  ::kill(pid_, SIGKILL);
  reap(0);
}

}  // namespace ols
