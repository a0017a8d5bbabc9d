// Decides which owner's commands a station obeys: those with the greatest epoch. Pure.
//
// Epochs are revisions of one store, so they grow over all targets and owners. Of two commands, the
// one with the greater epoch therefore comes from the later owner. So the commands of an owner that
// was replaced are ignored, even while that owner does not know it yet. Epochs are not signed.
// Impossible ones are therefore refused, and those of a sender that is silent for a minute are
// forgotten.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ols::bridge {

// What a command states about its sender. Epoch 0: the sender works without ownership.
struct Claim {
  std::string target;  // the region-wide id
  std::string owner{};
  std::uint64_t epoch = 0;
};

class EpochFence {
 public:
  // If the owner that leads a station has sent it no command for this long, it no longer leads the
  // station, and an owner with a lower epoch may lead it.
  static constexpr double kSilence_s = 2.0;
  static constexpr double kForgotten_s = 60.0;
  // The store counts the renewals of all targets. Its next revision may exceed the greatest one so
  // far by at most kMostJump, plus kMost_Hz for each second since then.
  static constexpr std::uint64_t kMostEver = 1'000'000'000'000'000, kMostJump = 1'000'000;
  static constexpr double kMost_Hz = 10'000.0;

  // A command without ownership passes while no owner leads the station. `now_s`: monotonic.
  bool passes(const std::string& station, const Claim& claim, double now_s);
  // The greatest epoch among commands that have passed; 0: no command had an owner.
  std::uint64_t greatest() const { return greatest_; }

 private:
  static constexpr double kSweep_s = 1.0;  // shortest time between two searches for silent
                                           // stations, even if new names arrive faster

  struct Led {
    std::uint64_t epoch = 0;
    std::string owner;
    double heard_s = -1e9;
  };
  struct Heard {
    std::uint64_t epoch = 0;
    double heard_s = 0.0;
  };
  struct Station {
    Led by;                                // the owner that leads it now
    std::map<std::string, Heard> targets;  // the greatest epoch for each
  };
  bool is_possible(std::uint64_t epoch, double now_s) const;
  Station* station_of(const std::string& station, double now_s);
  static bool is_greatest_of_its_target(Station& station, const Claim& claim, double now_s);

  std::map<std::string, Station> stations_;
  std::uint64_t greatest_ = 0;
  double greatest_s_ = 0.0, swept_s_ = -1e9;
};

}  // namespace ols::bridge
