// Saves the seen skyline in a file, so that a station knows it again after a restart.
#pragma once

#include <optional>
#include <string>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/skyline/saved_skyline.h"

namespace ols::station {

class SkylineStore {
 public:
  // Reads `file`; if it is empty, nothing is saved.
  explicit SkylineStore(const std::string& file);

  // What was found at the start, once. nullopt if there is none, or if it is another owner's.
  std::optional<skyline::HidingSkyline> take_found(const skyline::SkylineOwner& owner);
  // Writes it every few minutes [monotonic s], without waiting for the disk.
  void keep(const skyline::SavedSkyline& saved, double now_s);
  // What is saved is no longer valid. Calls after the first one do nothing until keep().
  void drop(const skyline::SkylineOwner& owner);
  // Why the file was not used, until a skyline has been saved, or why it cannot be written; empty
  // if there is no trouble.
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
