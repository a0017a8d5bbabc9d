// The effect of a bad line on a unit's replies: some have one wrong byte, some are lost. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>

namespace ols::sim {

class PtuReplyFaults {
 public:
  explicit PtuReplyFaults(std::uint64_t seed) : random_(seed) {}

  // garble_share: share of the replies (lines) in which one byte is lost, is preceded by an extra
  // byte, or has one bit flipped. lost_every_s: interval at which one reply is lost, from `time_s`
  // on (0: never). An unchanged interval is not restarted.
  void set(double garble_share, double lost_every_s, double time_s);

  // Applies the faults and returns the bytes that arrive. A reply may be passed in any number of
  // pieces.
  std::string pass(std::string_view bytes, double time_s);

  std::uint64_t garbled() const { return garbled_; }
  std::uint64_t lost() const { return lost_; }

 private:
  void begin_reply(double time_s);
  void garble(char byte, std::string& out);
  double draw() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  std::mt19937_64 random_;
  double garble_share_ = 0.0;
  double lost_every_s_ = 0.0;
  double next_loss_s_ = 0.0;
  bool within_reply_ = false;
  bool losing_ = false;
  std::optional<int> bytes_to_error_;  // of the current reply
  std::uint64_t garbled_ = 0, lost_ = 0;
};

}  // namespace ols::sim
