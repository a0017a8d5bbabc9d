// Splits a stream of bytes into messages. The bytes arrive in pieces of any size. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ols::cues {

enum class Framing {
  kWhole,  // each piece is a whole message: a datagram or a file
  kLines,
  kCot,      // XML events one after the other, or messages of the TAK protocol with their length
  kSapient,  // messages, each after four bytes with its length
};

class Framer {
 public:
  explicit Framer(Framing framing) : framing_(framing) {}

  // Takes the next bytes of the stream, and returns the messages that they complete.
  std::vector<std::string> take(std::string_view bytes);
  // Call when the stream starts again.
  void clear() { drop_rest(); }
  // How often received bytes were dropped because a message did not end within kLongest_bytes.
  int overlong() const { return overlong_; }

  static constexpr std::size_t kLongest_bytes = 65'536;

 private:
  // Each takes the next message; false: this message is not complete yet.
  bool next(std::string& message);
  bool next_line(std::string& message);
  bool next_event(std::string& message);
  bool next_tak_message(std::string& message);
  bool next_sapient_message(std::string& message);
  // Drops all bytes received, because a message states an impossible length, and nobody knows where
  // the next message begins.
  bool refuse_overlong();

  void drop_rest();
  std::string_view rest() const { return std::string_view(bytes_).substr(taken_); }

  Framing framing_;
  std::string bytes_;
  std::size_t taken_ = 0;  // size of the messages already returned at the beginning of bytes_;
                           // take() erases them at its end
  int overlong_ = 0;
};

}  // namespace ols::cues
