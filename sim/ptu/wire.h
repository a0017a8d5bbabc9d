// The simulated PTU's end of the serial line: which byte is on the line at which time.
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
    double time_s;  // when its last bit was on the line
    int baud;
  };
  struct Command {
    std::string text;  // without its delimiter; truncated if too long
    char delimiter = '\0';
  };

  explicit PtuWire(std::uint64_t noise_seed) : noise_(noise_seed) {}

  // Removes all bytes from the line; it is free from this instant on.
  void clear(double time_s);
  void set_baud(int baud) { baud_ = baud; }
  // Sets the rate of the master's port. If it differs from the unit's rate, every byte becomes
  // noise. 0: always equal.
  void set_master_baud(int baud) { master_baud_ = baud; }

  // Takes bytes from the master; the transmission of the first begins at `time_s`.
  void receive(std::string_view bytes, double time_s);
  const std::deque<Byte>& input() const { return input_; }
  // When the first waiting command was complete.
  std::optional<double> command_s() const;
  // Returns the first waiting command; there must be one.
  Command take_command();

  // Sends text after all earlier texts, not before `time_s`.
  void say(const std::string& text, double time_s);
  // The bytes that have been sent completely by `time_s`. Each byte is returned once.
  std::string transmit(double time_s);
  std::optional<double> next_output_s() const;

 private:
  double byte_s() const { return baud_ > 0 ? 10.0 / baud_ : 0.0; }
  char on_the_line(char byte, int byte_baud);

  std::mt19937_64 noise_;
  int baud_ = 0, master_baud_ = 0;
  double line_free_s_ = 0.0;   // when the unit's transmitter becomes free
  double input_free_s_ = 0.0;  // when the master's transmitter becomes free
  std::deque<Byte> input_, output_;
};

}  // namespace ols::sim
