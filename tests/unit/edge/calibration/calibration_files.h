// Makes the folder of a calibration, as `ols-calibrate adjust` does.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "calibration/parameters.h"
#include "edge/calibration/calibration_folder.h"
#include "edge/calibration/instrument_file.h"
#include "geometry/angles.h"

namespace ols::station::test {

inline constexpr const char* kSetup =
    "station = \"alfa\"\nobserved_utime_us = 1780000000000000\n\n[pose]\n"
    "latitude_deg = 49.225\nlongitude_deg = 16.596\nheight_m = 250.5\nheading_deg = 33.3\n"
    "tilt_x_deg = 0.2\ntilt_y_deg = -0.1\n\n[air]\nrefraction_k = 0.13\nair = 1.0\n";

inline StationSettings settings() {
  StationSettings settings;
  settings.id = "alfa";
  settings.serials.camera = "C7";
  settings.station.geometry.position = {radians(49.2), radians(16.6), 240.0};
  settings.station.geometry.chain.ground_to_origin_m.z() = 1.7;
  settings.calibration_id = 5;
  return settings;
}

// A diagonal covariance as CSV; the i-th variance is i times `scale`, with i from 1.
inline std::string covariance_text(double scale) {
  std::ostringstream out;
  out << "parameter";
  for (const auto& text : calibration::parameter_texts()) out << ',' << text.key;
  for (int i = 0; i < calibration::kStationParameters; ++i) {
    out << '\n' << calibration::parameter_texts()[static_cast<std::size_t>(i)].key;
    for (int j = 0; j < calibration::kStationParameters; ++j) {
      out << ',' << (i == j ? scale * (i + 1) : 0.0);
    }
  }
  out << '\n';
  return out.str();
}

class CalibrationFolder {
 public:
  explicit CalibrationFolder(const std::string& name)
      : path(std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path);
    calibration::Instrument of = calibration::new_instrument(settings());
    of.covariance_file = "covariance.csv";
    of.values[kTrunnion] = 1e-4;
    of.values[kFocal] = 13300.0;
    instrument = calibration::instrument_text(of);
    write();
  }
  CalibrationFolder(const CalibrationFolder&) = delete;
  CalibrationFolder& operator=(const CalibrationFolder&) = delete;
  ~CalibrationFolder() { std::filesystem::remove_all(path); }

  void write() const {
    const auto id = calibration_id_of(instrument, setup, covariance);
    put("setup.toml", "# A setup.\ncalibration_id = " + std::to_string(id) + "\n" + setup);
    put("instrument.toml", instrument);
    put("covariance.csv", covariance);
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path + "/" + name) << text;
  }

  std::string path;
  std::string instrument, covariance = covariance_text(1e-8), setup = kSetup;
};

}  // namespace ols::station::test
