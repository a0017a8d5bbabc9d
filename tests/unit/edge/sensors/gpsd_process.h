// Runs a real gpsd for a test, on a port of the loopback. It reads one device at a fixed speed.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace ols::sensors {

class GpsdProcess {
 public:
  static constexpr const char* kProgram = "/usr/sbin/gpsd";
  static bool is_installed() { return ::access(kProgram, X_OK) == 0; }

  static std::string free_port() {
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    const bool bound = ::bind(fd, generic, size) == 0 && ::getsockname(fd, generic, &size) == 0;
    ::close(fd);
    if (!bound) throw std::system_error(errno, std::generic_category(), "no free port");
    return std::to_string(ntohs(address.sin_port));
  }

  // If `device` is empty, gpsd has no receiver, only a control socket through which a receiver
  // could be added.
  GpsdProcess(const std::string& device, const std::string& port) {
    const std::string control = "/tmp/ols_gpsd_" + port + ".socket";
    const char* option = device.empty() ? "-F" : "-b";
    const char* last = device.empty() ? control.c_str() : device.c_str();
    control_ = device.empty() ? control : "";
    pid_ = ::fork();
    if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid_ > 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    // gpsd leaves shared memory behind; a failure of this call does no harm.
    ::unshare(CLONE_NEWIPC);
    ::execl(kProgram, kProgram, "-N", "-n", "-s", "38400", "-f", "8N1", "-S", port.c_str(), option,
            last, nullptr);
    ::_exit(127);
  }
  ~GpsdProcess() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    if (!control_.empty()) ::unlink(control_.c_str());
  }
  GpsdProcess(const GpsdProcess&) = delete;
  GpsdProcess& operator=(const GpsdProcess&) = delete;

 private:
  std::string control_;
  pid_t pid_ = -1;
};

}  // namespace ols::sensors
