// Finds the messages that a link has lost, by the gaps in each sender's sequence numbers. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ols::bridge {

class SequenceWatch {
 public:
  // `stream`: a station and a kind of message.
  void hear(const std::string& stream, std::int64_t boot_id, std::int64_t sequence, double now_s);

  // Number of missing messages of all streams. A message that arrives late is subtracted again.
  std::uint64_t missing() const { return missing_; }
  // Number of messages that arrived twice, or so late that they cannot be distinguished from
  // repeated ones.
  std::uint64_t repeated() const { return repeated_; }
  // The stream that had the last gap, if that was within the last kAlarm_s; otherwise empty.
  std::string alarm(double now_s) const;
  static constexpr double kAlarm_s = 10.0;

 private:
  struct Mark {
    std::int64_t boot_id = 0;
    std::int64_t newest = 0;
    std::uint64_t heard = 0;  // bit n: sequence newest - n was received
    double heard_s = 0.0;
  };
  void advance(const std::string& stream, Mark& mark, std::int64_t sequence, double now_s);
  void forget_silent(double now_s);

  std::map<std::string, Mark> marks_;
  std::uint64_t missing_ = 0, repeated_ = 0;
  std::string last_;
  double gap_s_ = -1e9, swept_s_ = -1e9;
};

}  // namespace ols::bridge
