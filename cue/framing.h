// Splits a stream of bytes, in any pieces, into messages. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ols::cues {

enum class Framing {
  kWhole,  // a message comes as a whole: a datagram or a file
  kLines,
  kCot,      // XML events in sequence, or messages of the TAK protocol with their length
  kSapient,  // messages, each with its length in four bytes before it
};

class Framer {
 public:
  explicit Framer(Framing framing) : framing_(framing) {}

  // Takes bytes, and returns the messages that they complete.
  std::vector<std::string> take(std::string_view bytes);
  // Call when the stream starts again.
  void clear() { drop_rest(); }
  // How often the stream was dropped because a message had no end within the size limit.
  int overlong() const { return overlong_; }

  static constexpr std::size_t kLongest_bytes = 65'536;

 private:
  // Takes the next message; false: it is not yet complete.
  bool next(std::string& message);
  bool next_line(std::string& message);
  bool next_event(std::string& message);
  bool next_tak_message(std::string& message);
  bool next_sapient_message(std::string& message);
  // Drops the stream because a message's length is impossible: where the next one begins is
  // unknown.
  bool refuse_overlong();

  void drop_rest();
  std::string_view rest() const { return std::string_view(bytes_).substr(taken_); }

  Framing framing_;
  std::string bytes_;
  std::size_t taken_ = 0;  // bytes of complete messages; they are erased once, at the end of take()
  int overlong_ = 0;
};

}  // namespace ols::cues
