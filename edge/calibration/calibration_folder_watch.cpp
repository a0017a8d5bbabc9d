#include "edge/calibration/calibration_folder_watch.h"

#include <exception>
#include <filesystem>

#include "base/process/time_source.h"
#include "conditions/alarms.h"

namespace ols::station {
namespace {

namespace fs = std::filesystem;

constexpr double kInterval_s = 1.0;

// Which folder a path stands for; empty: none.
fs::path folder_of(const std::string& path) {
  std::error_code failed;
  const fs::path folder = fs::canonical(path, failed);
  return failed ? fs::path() : folder;
}

// Changes with the folder and with its setup.
std::string mark_of(const std::string& path) {
  if (path.empty()) return {};
  const fs::path folder = folder_of(path);
  std::error_code failed;
  const auto written = fs::last_write_time(folder / "setup.toml", failed);
  if (folder.empty() || failed) return {};
  return folder.string() + " " + std::to_string(written.time_since_epoch().count());
}

}  // namespace

CalibrationFolderWatch::CalibrationFolderWatch(const StationSettings& configured)
    : configured_(configured), seen_(mark_of(configured.calibration_folder)) {}

void CalibrationFolderWatch::look(double now_s) {
  if (reading_.valid()) return take_read();
  if (configured_.calibration_folder.empty() || now_s < looked_s_ + kInterval_s) return;
  looked_s_ = now_s;
  const std::string mark = mark_of(configured_.calibration_folder);
  if (mark.empty() || mark == seen_) return;
  seen_ = mark;
  refused_.clear();
  files_.reset();
  // The folder itself: its link may change again meanwhile.
  const std::string folder = folder_of(configured_.calibration_folder).string();
  reading_ = std::async(std::launch::async, [folder, settings = configured_] {
    return std::make_unique<CalibrationFiles>(read_calibration(folder, settings));
  });
}

void CalibrationFolderWatch::take_read() {
  if (reading_.wait_for(time_source().for_work()) != std::future_status::ready) return;
  try {
    files_ = reading_.get();
  } catch (const std::exception& problem) {
    refuse(problem.what());
  }
}

void CalibrationFolderWatch::refuse(const std::string& why) {
  files_.reset();
  refused_ = why;
}

Alarm CalibrationFolderWatch::alarm() const {
  if (files_) return alarm::calibration_waits(files_->id);
  return refused_.empty() ? Alarm() : alarm::accepted_calibration_not_used(refused_);
}

}  // namespace ols::station
