// A library to preload into one process: its wall clock is offset by the current content of a file,
// so that it can be stepped while it runs. Nothing else changes: neither CLOCK_MONOTONIC nor any
// sleep. (libfaketime 0.9.10 also intercepts clock_nanosleep, and then refuses absolute monotonic
// times.)
//
// OLS_CLOCK_OFFSET_FILE names a file of eight bytes: int64, nanoseconds, native byte order.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Written by another process: always loaded as a whole.
const std::atomic<std::int64_t>* offset_ns = nullptr;

__attribute__((constructor)) void open_offset() {
  const char* path = std::getenv("OLS_CLOCK_OFFSET_FILE");
  const int fd = path != nullptr ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (fd < 0) return;
  void* mapped = mmap(nullptr, sizeof *offset_ns, PROT_READ, MAP_SHARED, fd, 0);
  close(fd);
  if (mapped != MAP_FAILED) offset_ns = static_cast<const std::atomic<std::int64_t>*>(mapped);
}

std::int64_t utc_ns() {
  timespec now{};
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec + (offset_ns != nullptr ? offset_ns->load() : 0);
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE) {
    return static_cast<int>(syscall(SYS_clock_gettime, clock, now));
  }
  const std::int64_t utc = utc_ns();
  *now = {utc / kSecond_ns, utc % kSecond_ns};
  return 0;
}

int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  const std::int64_t utc = utc_ns();
  *now = {utc / kSecond_ns, utc % kSecond_ns / 1000};
  return 0;
}

time_t time(time_t* now) noexcept {
  const time_t utc = utc_ns() / kSecond_ns;
  if (now != nullptr) *now = utc;
  return utc;
}
}
