// Notices when a new calibration is accepted while the station runs: the configured path then links
// to another folder, or the folder's setup.toml was written again. Reads that folder in its own
// thread.
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
  // `configured`: the settings of the configuration file. The folder's present content counts as
  // already read.
  explicit CalibrationFolderWatch(const StationSettings& configured);

  // Checks the folder once a second. Call it in every cycle of the control loop.
  void look(double now_s);
  // A new calibration that was read completely and belongs to this station and its serial numbers;
  // null if there is none.
  const CalibrationFiles* waiting() const { return files_.get(); }
  void forget() { files_.reset(); }
  // Rejects the new calibration; alarm() gives the reason until another one is accepted.
  void refuse(const std::string& why);
  Alarm alarm() const;

 private:
  using Read = std::unique_ptr<CalibrationFiles>;  // the future may hold an exception instead
  void take_read();

  StationSettings configured_;
  std::string seen_;  // path of the folder, and the time at which its setup.toml was written
  std::string refused_;
  std::future<Read> reading_;
  Read files_;
  double looked_s_ = 0.0;
};

}  // namespace ols::station
