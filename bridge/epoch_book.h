// Which owner's commands a station obeys: those of the greatest epoch. Pure.
//
// Epochs are revisions of one store, so they grow over all targets and owners: of two commands the
// one with the greater epoch comes from who became an owner later. An owner that does not know yet
// that it has been replaced is thereby ignored.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ols::bridge {

class EpochBook {
 public:
  // Another target's command of a lower epoch passes when nothing of the greatest has come for this
  // long: then its owner leads this station no more.
  static constexpr double kSilence_s = 2.0;

  // `epoch` 0: of a sender without ownership; passes while no owner leads the station.
  // `target`: the region-wide id. `now_s`: monotonic.
  bool passes(const std::string& station, const std::string& target, std::uint64_t epoch,
              double now_s);
  // Of all that have passed; 0: none with an owner.
  std::uint64_t greatest() const { return greatest_; }

 private:
  struct Led {
    std::uint64_t epoch = 0;
    double heard_s = 0.0;
  };
  struct Station {
    Led by;                                        // who leads it now
    std::map<std::string, std::uint64_t> targets;  // the greatest of each, which never goes back
  };
  static void forget_some(Station& station);

  std::map<std::string, Station> stations_;
  std::uint64_t greatest_ = 0;
};

}  // namespace ols::bridge
