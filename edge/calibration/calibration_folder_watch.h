// Notices that a new calibration was accepted while the station runs: the configured folder is then
// a link to another folder. Reads that folder in its own thread.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "conditions/alarm.h"
#include "edge/calibration/calibration_folder.h"

namespace ols::station {

class CalibrationFolderWatch {
 public:
  // `configured`: the settings as in the configuration file. The folder's content at construction
  // counts as already read.
  explicit CalibrationFolderWatch(const StationSettings& configured);

  // Call in every turn. Checks the folder once a second.
  void look(double now_s);
  // A calibration that was read completely and belongs to this station and its serial numbers; null
  // if none is waiting.
  const CalibrationFiles* waiting() const { return files_.get(); }
  void forget() { files_.reset(); }
  // Marks the calibration as unusable until another one is accepted.
  void refuse(const std::string& why);
  Alarm alarm() const;

 private:
  using Read = std::unique_ptr<CalibrationFiles>;  // the future may hold an exception instead
  void take_read();

  StationSettings configured_;
  std::string seen_;  // the folder and its time of writing
  std::string refused_;
  std::future<Read> reading_;
  Read files_;
  double looked_s_ = 0.0;
};

}  // namespace ols::station
