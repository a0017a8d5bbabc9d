// Measures the tracker's processing time by stage. The tracker itself reads no clock; a caller may
// provide one.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>

namespace ols::tracker {

enum class Stage {
  kReduction,    // reduced frame and its pyramid
  kEgoMotion,    // KLT and RANSAC
  kRecognition,  // learnt appearance
  kPrediction,   // eq. (2)-(4)
  kProposals,    // frame difference, movers
  kMasks,        // foreground masks and views
  kWeighting,    // eq. (5) of all particles, maximum a posteriori
  kPosition,     // sub-pixel refinement
  kLearning,     // belief, appearance, references, resampling
};
inline constexpr std::array<const char*, 9> kStageNames{"reduction",  "ego_motion", "recognition",
                                                        "prediction", "proposals",  "masks",
                                                        "weighting",  "position",   "learning"};

struct StageTimes {
  std::array<double, kStageNames.size()> seconds{};  // indexed by Stage
  double of(Stage stage) const { return seconds[static_cast<std::size_t>(stage)]; }
};

// A monotonic clock, in seconds.
using StageClock = std::function<double()>;

// Adds the time since the last lap to a stage; does nothing without a clock.
class StageTimer {
 public:
  void set_clock(StageClock clock) { clock_ = std::move(clock); }
  void start() {
    times_ = {};
    if (clock_) lap_s_ = clock_();
  }
  void lap(Stage stage) {
    if (!clock_) return;
    const double now_s = clock_();
    times_.seconds[static_cast<std::size_t>(stage)] += now_s - lap_s_;
    lap_s_ = now_s;
  }
  const StageTimes& times() const { return times_; }

 private:
  StageClock clock_;
  StageTimes times_;
  double lap_s_ = 0.0;
};

}  // namespace ols::tracker
