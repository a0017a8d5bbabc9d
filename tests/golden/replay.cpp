// ols-golden-replay STATIONS BEARINGS FOLDER: a bearing log through the messages and the fusion, as
// ols-fusion takes it but in the log's own time. Writes targets.csv, slews.csv and counters.csv.
#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "central/app/messages.h"
#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"

namespace ols::golden {
namespace {

// Of every station; as tests/golden/make_log.py drew its noise.
constexpr double kWhite_rad2 = 5.624999999999999e-09;
constexpr double kAlongHeading_rad2 = 8.999999999999999e-08, kUp_rad2 = 9.999999999999999e-09;

using Places = std::map<std::string, std::array<double, 3>>;  // of cameras, by station [m] ECEF

Places read_places(const std::string& path) {
  io::CSVReader<4> rows(path);
  rows.read_header(io::ignore_no_column, "station", "x_ecef_m", "y_ecef_m", "z_ecef_m");
  Places places;
  // CSVReader's own numbers are off by their last digit.
  std::string station, x, y, z;
  while (rows.read_row(station, x, y, z)) {
    places[station] = {std::stod(x), std::stod(y), std::stod(z)};
  }
  return places;
}

// What is the same in all bearings of a station.
ols_msg::bearing_t message_at(const std::array<double, 3>& camera_ecef_m) {
  ols_msg::bearing_t message{};
  message.schema_version = ols_msg::bearing_t::SCHEMA_VERSION;
  std::ranges::copy(camera_ecef_m, message.camera_ecef_m);
  message.covariance_white_rad2[0] = message.covariance_white_rad2[2] = kWhite_rad2;
  message.covariance_systematic_rad2[0] = kAlongHeading_rad2;
  message.covariance_systematic_rad2[2] = kUp_rad2;
  std::ranges::copy(std::array{0.02, 0.02, 0.03}, message.camera_position_sd_m);
  message.clock_state = ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  message.clock_error_s = 5e-4;
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
    for (const Alarm& alarm : health.alarms) tell("alarm", alarm.text, 1.0);
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

void run(const std::string& stations, const std::string& bearings,
         const std::filesystem::path& folder) {
  const Places places = read_places(stations);
  io::CSVReader<7> rows(bearings);
  rows.read_header(io::ignore_no_column, "utime_us", "station", "boot_id", "track_id", "belief",
                   "azimuth_rad", "elevation_rad");
  std::filesystem::create_directories(folder);
  Output output(folder);
  fusion::Fusion fusion(fusion::FusionConfig{});
  std::int64_t utime_us = 0, boot_id = 0, track_id = 0, sequence = 0;
  std::string station, belief, azimuth_rad, elevation_rad;
  while (rows.read_row(utime_us, station, boot_id, track_id, belief, azimuth_rad, elevation_rad)) {
    ols_msg::bearing_t message = message_at(places.at(station));
    message.utime = utime_us;
    message.station = station;
    message.boot_id = boot_id;
    message.sequence = ++sequence;
    message.track_id = track_id;
    message.belief = std::stod(belief);
    message.azimuth_rad = std::stod(azimuth_rad);
    message.elevation_rad = std::stod(elevation_rad);
    output.add(fusion.add(decoded(message)));
  }
  output.end(fusion.health());
}

}  // namespace
}  // namespace ols::golden

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: ols-golden-replay STATIONS BEARINGS FOLDER\n";
    return 2;
  }
  try {
    ols::golden::run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::cerr << "ols-golden-replay: " << error.what() << "\n";
    return 2;
  }
}
