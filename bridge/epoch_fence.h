// Decides which owner's commands may reach a station: those with the greatest epoch. Pure.
//
// An epoch is a revision number of the store of owners. Revisions grow with every change of any
// record. Of two commands, the one with the greater epoch therefore comes from the later owner. The
// commands of an owner that was replaced are refused, even before that owner learns of its
// replacement. Because epochs are not signed, impossible epochs are refused, and a target's epoch
// is forgotten if no command about the target passes for a minute.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ols::bridge {

// What the headers of a command state about its target and its sender. Epoch 0: the sender does not
// use ownership.
struct Claim {
  std::string target;  // the target's id, the same for all fusions
  std::string owner{};
  std::uint64_t epoch = 0;
};

class EpochFence {
 public:
  // An owner leads a station as long as it sends the station commands. If no command has passed for
  // this long, nobody leads the station, and an owner with a lower epoch may take over.
  static constexpr double kSilence_s = 2.0;
  static constexpr double kForgotten_s = 60.0;
  // Which epochs are possible. Revisions count the renewals of all targets. An epoch therefore
  // exceeds the greatest one received so far by at most kMostJump, plus kMost_Hz for each second
  // since that one was received.
  static constexpr std::uint64_t kMostEver = 1'000'000'000'000'000, kMostJump = 1'000'000;
  static constexpr double kMost_Hz = 10'000.0;

  // Whether the command may reach the station. A command without ownership passes while no owner
  // leads the station. `now_s`: monotonic.
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
    std::map<std::string, Heard> targets;  // the greatest epoch for each target
  };
  bool is_possible(std::uint64_t epoch, double now_s) const;
  Station* station_of(const std::string& station, double now_s);
  static bool is_greatest_of_its_target(Station& station, const Claim& claim, double now_s);

  std::map<std::string, Station> stations_;
  std::uint64_t greatest_ = 0;
  double greatest_s_ = 0.0, swept_s_ = -1e9;
};

}  // namespace ols::bridge
