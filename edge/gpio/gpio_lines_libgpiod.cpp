// libgpiod 1.6. For 2.x rewrite this file: gpiod_line_settings, gpiod_chip_request_lines,
// gpiod_line_request_read_edge_events.
#include <fcntl.h>
#include <gpiod.h>

#include <array>
#include <cerrno>
#include <map>
#include <system_error>

#include "base/process/clocks.h"
#include "edge/gpio/gpio_lines.h"

namespace ols::gpio {
namespace {

constexpr const char* kConsumer = "ols-station";

class ChipLines : public GpioLines {
 public:
  ChipLines(const std::string& chip, const LineUse& use)
      : name_(chip), chip_(gpiod_chip_open(chip.c_str())) {
    if (!chip_) fail("cannot be opened");
    for (const int line : use.outputs) request_output(line);
    for (const LineInput& input : use.inputs) request_input(input);
  }

  std::vector<int> fds() const override {
    std::vector<int> fds;
    for (const Input& input : inputs_) fds.push_back(input.fd);
    return fds;
  }

  std::vector<LineLevel> receive() override {
    std::vector<LineLevel> levels = std::move(fresh_);
    fresh_.clear();
    for (const Input& input : inputs_) receive(input, levels);
    return levels;
  }

  void refresh() override {
    for (const Input& input : inputs_) {
      const int value = gpiod_line_get_value(input.line);
      if (value < 0) fail("cannot be read");
      // Edges from before this reading must not be reported after it.
      receive(input, fresh_);
      fresh_.push_back({input.number, value != 0, clock_monotonic_s()});
    }
  }

  void write(int line, bool high) override {
    if (gpiod_line_set_value(outputs_.at(line), high ? 1 : 0) != 0) fail("cannot be written");
  }

 private:
  struct CloseChip {
    void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }  // releases its lines too
  };

  struct Input {
    int number = 0;
    gpiod_line* line = nullptr;
    int fd = -1;
  };

  void receive(const Input& input, std::vector<LineLevel>& levels) const {
    std::array<gpiod_line_event, 16> events;
    while (true) {
      const int n = gpiod_line_event_read_fd_multiple(input.fd, events.data(), events.size());
      if (n < 0 && errno == EAGAIN) return;
      if (n <= 0) fail("has vanished");
      for (int i = 0; i < n; ++i) {
        levels.push_back(level_of(input.number, events[static_cast<std::size_t>(i)]));
      }
    }
  }

  // The kernel stamps edges by CLOCK_MONOTONIC since 5.7.
  static LineLevel level_of(int line, const gpiod_line_event& event) {
    return {line, event.event_type == GPIOD_LINE_EVENT_RISING_EDGE,
            static_cast<double>(event.ts.tv_sec) + 1e-9 * static_cast<double>(event.ts.tv_nsec)};
  }

  gpiod_line* line(int offset) {
    gpiod_line* found = gpiod_chip_get_line(chip_.get(), static_cast<unsigned>(offset));
    if (found == nullptr) fail("has no line " + std::to_string(offset));
    return found;
  }

  void request_output(int offset) {
    gpiod_line* output = line(offset);
    if (gpiod_line_request_output(output, kConsumer, 0) != 0) {
      fail("line " + std::to_string(offset) + " cannot be used as an output");
    }
    outputs_[offset] = output;
  }

  void request_input(const LineInput& wanted) {
    gpiod_line* input = line(wanted.line);
    const int bias = wanted.bias == LineBias::kPullUp ? GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP
                                                      : GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    if (gpiod_line_request_both_edges_events_flags(input, kConsumer, bias) != 0) {
      fail("line " + std::to_string(wanted.line) + " cannot be watched");
    }
    const int fd = gpiod_line_event_get_fd(input);
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    inputs_.push_back({wanted.line, input, fd});
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::system_error(errno, std::generic_category(), name_ + ": " + what);
  }

  std::string name_;
  std::unique_ptr<gpiod_chip, CloseChip> chip_;
  std::vector<Input> inputs_;
  std::map<int, gpiod_line*> outputs_;
  std::vector<LineLevel> fresh_;
};

}  // namespace

std::unique_ptr<GpioLines> open_chip_lines(const std::string& chip, const LineUse& use) {
  return std::make_unique<ChipLines>(chip, use);
}

}  // namespace ols::gpio
