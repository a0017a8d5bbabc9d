#include "bridge/sequence_watch.h"

namespace ols::bridge {
namespace {

constexpr std::uint64_t kWindow = 64;
constexpr std::uint64_t kAll = ~std::uint64_t{0};  // nothing is missed before the first
// If there are more, what has been silent for a minute is forgotten.
constexpr std::size_t kMost = 40'000;
constexpr double kSilent_s = 60.0, kSweep_s = 1.0;
constexpr std::uint64_t kLongestGap = 100'000;  // beyond it is no gap, but nonsense

// Unsigned: a sender's sequences may be anything.
std::uint64_t distance(std::int64_t from, std::int64_t to) {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

}  // namespace

void SequenceWatch::hear(const std::string& stream, std::int64_t boot_id, std::int64_t sequence,
                         double now_s) {
  if (marks_.size() >= kMost && now_s - swept_s_ >= kSweep_s) forget_silent(now_s);
  Mark& mark = marks_[stream];
  mark.heard_s = now_s;
  // A station that restarts begins a new sequence.
  if (mark.heard == 0 || mark.boot_id != boot_id) {
    mark = {boot_id, sequence, kAll, now_s};
    return;
  }
  if (sequence > mark.newest) {
    advance(stream, mark, sequence, now_s);
    return;
  }
  const std::uint64_t behind = distance(sequence, mark.newest);
  const std::uint64_t bit = behind < kWindow ? std::uint64_t{1} << behind : 0;
  if (bit == 0 || (mark.heard & bit) != 0) {
    ++repeated_;
    return;
  }
  mark.heard |= bit;
  if (missing_ > 0) --missing_;
}

void SequenceWatch::forget_silent(double now_s) {
  swept_s_ = now_s;
  std::erase_if(marks_,
                [now_s](const auto& one) { return now_s - one.second.heard_s >= kSilent_s; });
}

void SequenceWatch::advance(const std::string& stream, Mark& mark, std::int64_t sequence,
                            double now_s) {
  const std::uint64_t step = distance(mark.newest, sequence);
  if (step > kLongestGap) {
    mark = {mark.boot_id, sequence, kAll, now_s};
    return;
  }
  mark.heard = (step < kWindow ? mark.heard << step : 0) | 1;
  mark.newest = sequence;
  if (step == 1) return;
  missing_ += step - 1;
  last_ = stream;
  gap_s_ = now_s;
}

std::string SequenceWatch::alarm(double now_s) const {
  return now_s - gap_s_ <= kAlarm_s ? last_ : "";
}

}  // namespace ols::bridge
