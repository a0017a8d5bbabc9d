// Messages out of a stream of bytes in any pieces. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ols::cues {

enum class Framing {
  kWhole,  // a datagram, a file
  kLines,
  kCot,  // events as XML, one behind the other, or messages of the TAK protocol with their length
  kSapient,  // messages with their length, four bytes before them
};

class Framer {
 public:
  explicit Framer(Framing framing) : framing_(framing) {}

  // The messages that the bytes complete.
  std::vector<std::string> take(std::string_view bytes);
  // The stream begins anew.
  void clear() { drop_rest(); }
  // Streams without an end of a message in sight: they were dropped.
  int overlong() const { return overlong_; }

  static constexpr std::size_t kLongest_bytes = 65'536;

 private:
  // Takes the first message that is not taken yet; false: it is not complete.
  bool next(std::string& message);
  bool next_line(std::string& message);
  bool next_event(std::string& message);
  bool next_tak_message(std::string& message);
  bool next_sapient_message(std::string& message);
  // A message of such a length is none: where the next one begins is unknown.
  bool refuse_overlong();

  void drop_rest();
  std::string_view rest() const { return std::string_view(bytes_).substr(taken_); }

  Framing framing_;
  std::string bytes_;
  std::size_t taken_ = 0;  // of them, during take(): erased once at its end
  int overlong_ = 0;
};

}  // namespace ols::cues
