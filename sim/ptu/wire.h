// The simulated PTU's end of its serial line: which byte is on it at which time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>
#include <string_view>

namespace ols::sim {

class PtuWire {
 public:
  struct Byte {
    char byte;
    double time_s;  // its last bit was on the line
    int baud;
  };
  struct Command {
    std::string text;  // without its delimiter; truncated if too long
    char delimiter = '\0';
  };

  explicit PtuWire(std::uint64_t noise_seed) : noise_(noise_seed) {}

  // Clears the line from this instant on.
  void clear(double time_s);
  void set_baud(int baud) { baud_ = baud; }
  // With a rate other than the unit's every byte becomes noise; 0: always right.
  void set_master_baud(int baud) { master_baud_ = baud; }

  // Bytes from the master; the first begins at `time_s`.
  void receive(std::string_view bytes, double time_s);
  const std::deque<Byte>& input() const { return input_; }
  // When the first waiting command was complete.
  std::optional<double> command_s() const;
  // Requires a waiting command.
  Command take_command();

  // Puts text on the line, in order, not before `time_s`.
  void say(const std::string& text, double time_s);
  // The bytes on the line by `time_s`, each returned once.
  std::string transmit(double time_s);
  std::optional<double> next_output_s() const;

 private:
  double byte_s() const { return baud_ > 0 ? 10.0 / baud_ : 0.0; }
  char on_the_line(char byte, int byte_baud);

  std::mt19937_64 noise_;
  int baud_ = 0, master_baud_ = 0;
  double line_free_s_ = 0.0;   // the unit's transmitter
  double input_free_s_ = 0.0;  // the master's
  std::deque<Byte> input_, output_;
};

}  // namespace ols::sim
