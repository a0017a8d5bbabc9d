#include "edge/calibration/active_calibration.h"

#include <exception>

#include "conditions/alarms.h"
#include "edge/calibration/unit_count.h"

namespace ols::station {
namespace {

// Of a serial number that a device reports itself.
std::string other_serial(const InstrumentSerials& calibrated, const device::DeviceReport& device) {
  const std::string& there = device.name == "camera" ? calibrated.camera : calibrated.ptu;
  const bool is_part = device.name == "camera" || device.name == "ptu";
  if (!is_part || there.empty() || device.serial.empty() || there == device.serial) return {};
  return "is of " + device.name + " '" + there + "', the " + device.name + " says '" +
         device.serial + "'";
}

}  // namespace

ActiveCalibration::ActiveCalibration(const StationSettings& configured) : configured_(configured) {
  read();
}

void ActiveCalibration::read() {
  settings_ = configured_;
  if (configured_.calibration_folder.empty()) return;
  try {
    files_ = read_calibration(configured_.calibration_folder, configured_);
    settings_ = with_calibration(configured_, *files_);
  } catch (const std::exception& problem) {
    refused_ = problem.what();
  }
}

std::string ActiveCalibration::conflict(const CalibrationFiles& files,
                                        const std::vector<device::DeviceReport>& devices,
                                        const PanTilt& count_rad) {
  for (const device::DeviceReport& device : devices) {
    const std::string why = other_serial(files.serials, device);
    if (!why.empty()) return "instrument.toml: serials." + device.name + ": " + why;
  }
  if (!(count_rad.pan_rad > 0.0 && count_rad.tilt_rad > 0.0)) return {};
  const StationModel& model = files.calibration.model;
  const bool same =
      is_count_of(model.pan, count_rad.pan_rad) && is_count_of(model.tilt, count_rad.tilt_rad);
  return same ? "" : "the unit has another number of counts per turn";
}

std::vector<Alarm> ActiveCalibration::other_devices(
    const InstrumentSerials& configured, const std::vector<device::DeviceReport>& devices) {
  std::vector<Alarm> alarms;
  for (const device::DeviceReport& device : devices) {
    if (other_serial(configured, device).empty()) continue;
    const std::string& there = device.name == "camera" ? configured.camera : configured.ptu;
    alarms.push_back(alarm::other_device(device.name, device.serial, there));
  }
  return alarms;
}

bool ActiveCalibration::refuses(const std::vector<device::DeviceReport>& devices) {
  const std::string why = files_ ? conflict(*files_, devices, {}) : "";
  if (!why.empty()) drop(configured_.calibration_folder + "/" + why);
  return !why.empty();
}

bool ActiveCalibration::refuses(const PanTilt& count_rad) {
  const std::string why = files_ ? conflict(*files_, {}, count_rad) : "";
  if (!why.empty()) drop(why);
  return !why.empty();
}

void ActiveCalibration::adopt(const CalibrationFiles& files) {
  files_ = files;
  refused_.clear();
  settings_ = with_calibration(configured_, files);
}

void ActiveCalibration::drop(const std::string& why) {
  refused_ = why;
  files_.reset();
  settings_ = configured_;
}

CalibrationStatus ActiveCalibration::status() const {
  if (!files_) {
    return {refused_.empty() ? CalibrationState::kNone : CalibrationState::kRefused,
            configured_.calibration_id, 0, 0.0};
  }
  return {CalibrationState::kInUse, files_->id, files_->observed_utime_us, files_->rms_rad};
}

std::vector<Alarm> ActiveCalibration::alarms() const {
  if (refused_.empty()) return {};
  return {alarm::calibration_not_used(refused_)};
}

}  // namespace ols::station
