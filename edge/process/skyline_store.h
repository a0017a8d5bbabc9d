// Saves the seen skyline (docs/glossary.md) in a file, so that the station still has it after a
// restart.
#pragma once

#include <optional>
#include <string>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/skyline/saved_skyline.h"

namespace ols::station {

class SkylineStore {
 public:
  // Reads the saved skyline from `file`. If the name is empty, nothing is saved.
  explicit SkylineStore(const std::string& file);

  // At the first call, returns the skyline that was in the file at the start. nullopt at later
  // calls, if there was none, or if its owner (station, calibration, kinematic chain) is another
  // one.
  std::optional<skyline::HidingSkyline> take_found(const skyline::SkylineOwner& owner);
  // Writes `saved` if the last writing is at least kInterval_s ago; does not wait for the disk.
  // `now_s`: CLOCK_MONOTONIC.
  void keep(const skyline::SavedSkyline& saved, double now_s);
  // Replaces the saved skyline by an empty one, because it is no longer valid. Further calls do
  // nothing until keep() has written again.
  void drop(const skyline::SkylineOwner& owner);
  // Why the file was not used (until a skyline is written), or why it cannot be written; empty if
  // all is well.
  Alarm trouble() const;

  static constexpr double kInterval_s = 300.0;

 private:
  std::string path_;
  std::optional<skyline::SavedSkyline> found_;
  Alarm refused_;
  std::optional<double> kept_s_;
  bool dropped_ = false;
  BackgroundFile file_;
};

}  // namespace ols::station
