// ols-golden-replay LOG.json FOLDER: a recorded bearing log through the messages and the fusion, as
// ols-fusion takes it but in the log's own time. Writes targets.csv, slews.csv and counters.csv.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "central/app/messages.h"
#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"

namespace ols::golden {
namespace {

using nlohmann::json;

void copy(const json& from, double* to) {
  for (const json& value : from) *to++ = value.get<double>();
}

// A row is utime, station, boot_id, track_id, belief, azimuth and elevation; null is NaN.
ols_msg::bearing_t message_of(const json& row, const json& stations, std::int64_t sequence) {
  const auto number = [](const json& value) {
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  };
  ols_msg::bearing_t message{};
  message.utime = row[0];
  message.schema_version = ols_msg::bearing_t::SCHEMA_VERSION;
  message.station = row[1];
  message.boot_id = row[2];
  message.sequence = sequence;
  message.track_id = row[3];
  message.belief = row[4];
  message.azimuth_rad = number(row[5]);
  message.elevation_rad = number(row[6]);
  const json& station = stations.at(message.station);
  copy(station.at("camera_ecef_m"), message.camera_ecef_m);
  copy(station.at("covariance_white_rad2"), message.covariance_white_rad2);
  copy(station.at("covariance_systematic_rad2"), message.covariance_systematic_rad2);
  copy(station.at("camera_position_sd_m"), message.camera_position_sd_m);
  message.clock_state = ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  message.clock_error_s = station.at("clock_error_s");
  return message;
}

fusion::BearingMeasurement decoded(const ols_msg::bearing_t& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int size = message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return std::get<fusion::BearingMeasurement>(
      fusion::measurement_from(std::string(kBearingChannel) + message.station, bytes.data(), size));
}

class Output {
 public:
  explicit Output(const std::filesystem::path& folder)
      : targets_(folder / "targets.csv"),
        slews_(folder / "slews.csv"),
        counters_(folder / "counters.csv") {
    targets_ << "utime_us,estimator,target,state,solution,latitude_deg,longitude_deg,height_m,"
                "vx_m_s,vy_m_s,vz_m_s,ee_m2,nn_m2,uu_m2,azimuth_deg,elevation_deg,residual,used\n";
    slews_ << "utime_us,station,target,effect_utime_us,azimuth_deg,elevation_deg,"
              "azimuth_rate_deg_s,elevation_rate_deg_s,direction_sd_deg\n";
    counters_ << "of,counter,value\n";
    for (std::ofstream* file : {&targets_, &slews_, &counters_}) file->exceptions(std::ios::badbit);
  }

  void add(const fusion::FusionOutput& output) {
    for (const fusion::FusedTarget& target : output.targets) add(to_message(target, {}));
    for (const fusion::FusedTarget& target : output.targets_paper) add(to_message(target, {}));
    for (const fusion::Slew& slew : output.slews) add(to_message(slew, {}));
  }

  void end(const fusion::FusionHealth& health) {
    for (const auto& [name, value] : health.counters) tell("fusion", name, value);
    for (const fusion::StationHealth& station : health.stations) {
      tell(station.station, "bearings", static_cast<double>(station.bearings));
      tell(station.station, "quarantined", station.quarantine.empty() ? 0.0 : 1.0);
    }
    for (const std::string& alarm : health.alarms) tell("alarm", alarm, 1.0);
  }

 private:
  void add(const ols_msg::target_t& m) {
    targets_ << m.utime << "," << m.estimator << "," << m.target_id << "," << int(m.track_state)
             << "," << int(m.solution) << std::setprecision(11) << "," << m.latitude_deg << ","
             << m.longitude_deg << std::setprecision(9) << "," << m.height_m
             << std::setprecision(6);
    for (const double v : m.velocity_ecef_m_s) targets_ << "," << v;
    for (const int i : {0, 3, 5}) targets_ << "," << m.position_covariance_enu_m2[i];
    targets_ << "," << degrees(m.azimuth_rad) << "," << degrees(m.elevation_rad) << ","
             << m.residual << ",";
    for (int i = 0; i < m.stations; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (m.used[at]) targets_ << m.station[at][0];
    }
    targets_ << "\n";
  }
  void add(const ols_msg::slew_t& m) {
    slews_ << m.utime << "," << m.station << "," << m.target_id << "," << m.effect_utime
           << std::setprecision(9) << "," << degrees(m.azimuth_rad) << ","
           << degrees(m.elevation_rad) << "," << degrees(m.azimuth_rate_rad_s) << ","
           << degrees(m.elevation_rate_rad_s) << "," << degrees(m.direction_sd_rad) << "\n";
  }
  void tell(const std::string& of, const std::string& name, double value) {
    counters_ << of << ",\"" << name << "\"," << value << "\n";
  }

  std::ofstream targets_, slews_, counters_;
};

void run(const std::string& log_path, const std::filesystem::path& folder) {
  std::ifstream file(log_path);
  const json log = json::parse(file);
  std::filesystem::create_directories(folder);
  Output output(folder);
  fusion::Fusion fusion(fusion::FusionConfig{});
  std::int64_t sequence = 0;
  for (const json& row : log.at("bearings")) {
    output.add(fusion.add(decoded(message_of(row, log.at("stations"), ++sequence))));
  }
  output.end(fusion.health());
}

}  // namespace
}  // namespace ols::golden

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: ols-golden-replay LOG.json FOLDER\n";
    return 2;
  }
  try {
    ols::golden::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "ols-golden-replay: " << error.what() << "\n";
    return 2;
  }
}
