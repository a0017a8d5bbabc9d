#include "sim/ptu/wire.h"

#include <algorithm>

namespace ols::sim {

namespace {

constexpr std::size_t kInputBuffer_bytes = 512;
constexpr std::size_t kLongestCommand_bytes = 80;

bool is_delimiter(char byte) { return byte == ' ' || byte == '\r' || byte == '\n'; }

}  // namespace

void PtuWire::clear(double time_s) {
  input_.clear();
  output_.clear();
  line_free_s_ = input_free_s_ = time_s;
}

char PtuWire::on_the_line(char byte, int byte_baud) {
  const bool right = master_baud_ == 0 || byte_baud == 0 || master_baud_ == byte_baud;
  return right ? byte : static_cast<char>(noise_());
}

void PtuWire::receive(std::string_view bytes, double time_s) {
  for (const char byte : bytes) {
    input_free_s_ = std::max(input_free_s_, time_s) + byte_s();
    // A full buffer loses its last byte, so that a delimiter always fits.
    if (input_.size() == kInputBuffer_bytes) input_.pop_back();
    input_.push_back({on_the_line(byte, baud_), input_free_s_, baud_});
  }
}

std::optional<double> PtuWire::command_s() const {
  const auto delimiter = std::ranges::find_if(input_, is_delimiter, &Byte::byte);
  if (delimiter == input_.end()) return std::nullopt;
  return delimiter->time_s;
}

PtuWire::Command PtuWire::take_command() {
  Command command;
  while (command.delimiter == '\0') {
    const char byte = input_.front().byte;
    input_.pop_front();
    if (is_delimiter(byte)) {
      command.delimiter = byte;
    } else if (command.text.size() < kLongestCommand_bytes) {
      command.text.push_back(byte);
    }
  }
  return command;
}

void PtuWire::say(const std::string& text, double time_s) {
  for (const char byte : text) {
    line_free_s_ = std::max(line_free_s_, time_s) + byte_s();
    output_.push_back({byte, line_free_s_, baud_});
  }
}

std::string PtuWire::transmit(double time_s) {
  std::string bytes;
  while (!output_.empty() && output_.front().time_s <= time_s) {
    bytes.push_back(on_the_line(output_.front().byte, output_.front().baud));
    output_.pop_front();
  }
  return bytes;
}

std::optional<double> PtuWire::next_output_s() const {
  if (output_.empty()) return std::nullopt;
  return output_.front().time_s;
}

}  // namespace ols::sim
