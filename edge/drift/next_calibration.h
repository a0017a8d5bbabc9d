// A calibration that was accepted while the station runs: noticed by the configured folder, which
// is a link to another one then, and read in a thread of its own.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "edge/calibration_folder.h"

namespace ols::station {

class NextCalibration {
 public:
  // `configured`: as the configuration file has it. What the folder is at this moment counts as
  // read.
  explicit NextCalibration(const StationSettings& configured);

  // In every turn: looks at the folder once a second.
  void look(double now_s);
  // Read, whole, of this station and of its serial numbers; null: none waits.
  const CalibrationFiles* waiting() const { return files_.get(); }
  void forget() { files_.reset(); }
  // Marks it as unusable until another one is accepted.
  void refuse(const std::string& why);
  std::string alarm() const;

 private:
  using Read = std::unique_ptr<CalibrationFiles>;  // or an exception
  void take_read();

  StationSettings configured_;
  std::string seen_;  // which folder, and when it was written
  std::string refused_;
  std::future<Read> reading_;
  Read files_;
  double looked_s_ = 0.0;
};

}  // namespace ols::station
