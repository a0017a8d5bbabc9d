#include "tests/unit/edge/gpio/fake_gpiod.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace ols::fake {

Chip& chip() {
  static Chip only;
  return only;
}

void Chip::change(int offset, int value, double time_s) {
  Line& line = requested.at(offset);
  line.value = value;
  gpiod_line_event event{};
  event.ts.tv_sec = static_cast<time_t>(time_s);
  event.ts.tv_nsec = static_cast<long>((time_s - static_cast<double>(event.ts.tv_sec)) * 1e9);
  event.event_type = value != 0 ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
  [[maybe_unused]] const ssize_t n = ::write(line.write_end, &event, sizeof event);
}

}  // namespace ols::fake

using ols::fake::chip;
using ols::fake::Line;

struct gpiod_chip {};
struct gpiod_line {
  int offset;
};

namespace {

gpiod_chip the_chip;
std::array<gpiod_line, 64> the_lines;

int failure(int error) {
  errno = error;
  return -1;
}

int request(gpiod_line* line, Line as) {
  if (chip().refuses || chip().requested.contains(line->offset)) return failure(EBUSY);
  as.offset = line->offset;
  chip().requested[line->offset] = as;
  return 0;
}

}  // namespace

extern "C" {

gpiod_chip* gpiod_chip_open(const char* path) {
  if (path != chip().path || chip().gone) {
    errno = ENOENT;
    return nullptr;
  }
  ++chip().open;
  return &the_chip;
}

void gpiod_chip_close(gpiod_chip*) {
  --chip().open;
  for (const auto& [offset, line] : chip().requested) {
    if (line.read_end < 0) continue;
    ::close(line.read_end);
    ::close(line.write_end);
  }
  chip().requested.clear();
}

gpiod_line* gpiod_chip_get_line(gpiod_chip*, unsigned int offset) {
  if (static_cast<int>(offset) >= chip().lines) {
    errno = EINVAL;
    return nullptr;
  }
  the_lines[offset].offset = static_cast<int>(offset);
  return &the_lines[offset];
}

int gpiod_line_request_output(gpiod_line* line, const char*, int value) {
  Line as;
  as.output = true;
  as.value = value;
  return request(line, as);
}

int gpiod_line_request_both_edges_events_flags(gpiod_line* line, const char*, int flags) {
  Line as;
  as.flags = flags;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return -1;
  as.read_end = ends[0];
  as.write_end = ends[1];
  return request(line, as);
}

int gpiod_line_event_get_fd(gpiod_line* line) { return chip().requested.at(line->offset).read_end; }

int gpiod_line_event_read_fd_multiple(int fd, gpiod_line_event* events, unsigned int count) {
  if (chip().gone) return failure(ENODEV);
  const ssize_t n = ::read(fd, events, count * sizeof(gpiod_line_event));
  return n < 0 ? -1 : static_cast<int>(n / static_cast<ssize_t>(sizeof(gpiod_line_event)));
}

int gpiod_line_get_value(gpiod_line* line) {
  return chip().gone ? failure(ENODEV) : chip().requested.at(line->offset).value;
}

int gpiod_line_set_value(gpiod_line* line, int value) {
  if (chip().gone) return failure(ENODEV);
  chip().requested.at(line->offset).value = value;
  return 0;
}

}  // extern "C"
