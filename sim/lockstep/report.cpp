#include "sim/lockstep/report.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "base/files/atomic_file.h"
#include "sim/lockstep/recording.h"

namespace ols::sim {
namespace {

constexpr double kTruthRate_hz = 30.0;

void write_position(std::ostream& out, const Geodetic& position) {
  out << std::setprecision(12) << degrees(position.latitude_rad) << ","
      << degrees(position.longitude_rad) << "," << std::fixed << std::setprecision(4)
      << position.height_m << std::defaultfloat << std::setprecision(6);
}

void write_truth(const World& world, double duration_s, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "utime_us,latitude_deg,longitude_deg,height_m\n";
  const auto rows = static_cast<int>(duration_s * kTruthRate_hz);
  for (int i = 0; i < rows; ++i) {
    const double time_s = i / kTruthRate_hz;
    out << Lockstep::kStartUtime_us + std::llround(time_s * 1e6) << ",";
    write_position(out, geodetic_from_ecef(world.target(0, time_s).p_ecef));
    out << "\n";
  }
  file.commit();
}

void write_fixes(const std::vector<Fix>& fixes, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,up_sd_m,"
         "east_north_m2,east_up_m2,north_up_m2,error_east_m,error_north_m,error_up_m,stations\n";
  for (const Fix& fix : fixes) {
    const Eigen::Matrix3d& C = fix.covariance_enu_m2;
    out << fix.utime_us << ",1,";
    write_position(out, fix.position);
    for (int i = 0; i < 3; ++i) out << "," << std::sqrt(C(i, i));
    out << "," << C(0, 1) << "," << C(0, 2) << "," << C(1, 2);
    for (int i = 0; i < 3; ++i) out << "," << fix.error_enu_m[i];
    out << "," << fix.used.size() << "\n";
  }
  file.commit();
}

// (JSON has null in place of NaN.)
nlohmann::ordered_json estimator_json(const EstimatorSummary& s) {
  return {{"fixes", s.fixes},
          {"rmse_m", s.rmse_m},
          {"predicted_rmse_m", s.predicted_rmse_m},
          {"nees_axis", {s.nees_axis.x(), s.nees_axis.y(), s.nees_axis.z()}},
          {"nees", s.nees},
          {"latency_median_s", s.latency_median_s},
          {"latency_p95_s", s.latency_p95_s}};
}

double share(const StationRecord& record, const std::function<bool(const FrameNote&)>& of) {
  const auto count = std::count_if(record.frames.begin(), record.frames.end(), of);
  return static_cast<double>(count) / static_cast<double>(record.frames.size());
}

nlohmann::ordered_json station_json(const std::string& id, const StationRecord& record) {
  nlohmann::ordered_json states;
  for (const station::StationState state :
       {station::StationState::kTracking, station::StationState::kCoasting,
        station::StationState::kLost, station::StationState::kSlewed}) {
    states[to_string(state)] =
        share(record, [&](const FrameNote& note) { return note.state == state; });
  }
  return {{"id", id},
          {"frames", record.frames.size()},
          {"frames_lost", record.frames_lost},
          {"central_third", share(record, [](const FrameNote& n) { return n.inside_third; })},
          {"states", states}};
}

void write_frames(const World& world, const LockstepResult& result, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "station,time_s,state,belief,true_x_px,true_y_px,width_px,height_px,error_x_px,"
         "error_y_px,box_x_px,box_y_px,box_width_px,box_height_px\n";
  for (std::size_t i = 0; i < result.stations.size(); ++i) {
    for (const FrameNote& note : result.stations[i].frames) {
      out << world.stations()[i].id << "," << std::setprecision(9) << note.mid_s
          << std::setprecision(6) << "," << to_string(note.state) << "," << note.belief << ","
          << note.view.centre_px.x() << "," << note.view.centre_px.y() << "," << note.view.box.width
          << "," << note.view.box.height << ",";
      if (note.error_px)
        out << note.error_px->x() << "," << note.error_px->y();
      else
        out << ",";
      if (note.box)
        out << "," << note.box->x << "," << note.box->y << "," << note.box->width << ","
            << note.box->height << "\n";
      else
        out << ",,,,\n";
    }
  }
  file.commit();
}

void write_slews(const std::vector<fusion::Slew>& slews, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "utime_us,station,target,effect_utime_us,azimuth_deg,elevation_deg,azimuth_rate_deg_s,"
         "elevation_rate_deg_s,direction_sd_deg\n"
      << std::setprecision(9);
  for (const fusion::Slew& slew : slews) {
    out << slew.utime_us << "," << slew.station << "," << slew.target_id << ","
        << slew.effect_utime_us;
    for (const double angle_rad :
         {slew.direction.azimuth_rad, slew.direction.elevation_rad, slew.azimuth_rate_rad_s,
          slew.elevation_rate_rad_s, slew.direction_sd_rad})
      out << "," << degrees(angle_rad);
    out << "\n";
  }
  file.commit();
}

void write_counters(const World& world, const LockstepResult& result, const std::string& path) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "of,counter,value\n";
  for (const auto& [name, value] : result.counters)
    out << "fusion," << name << "," << value << "\n";
  for (std::size_t i = 0; i < result.stations.size(); ++i) {
    for (const auto& [name, value] : result.stations[i].counters)
      out << world.stations()[i].id << "," << name << "," << value << "\n";
  }
  file.commit();
}

void write_summary(const World& world, const LockstepResult& result, double duration_s,
                   const std::string& path) {
  const PixelSummary pixels = summarise_pixels(result.stations);
  MeasurementNoise noise;
  noise.pixel_sd_px = pixels.white_sd_px;
  const BoundSummary bound = summarise_bound(world, result.joint, noise);
  nlohmann::ordered_json stations = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < result.stations.size(); ++i) {
    stations.push_back(station_json(world.stations()[i].id, result.stations[i]));
  }
  const nlohmann::ordered_json summary{{"scenario", world.scenario().name},
                                       {"seed", world.seed()},
                                       {"seconds", duration_s},
                                       {"designated_s", result.designated_s},
                                       {"joint", estimator_json(summarise(result.joint))},
                                       {"paper", estimator_json(summarise(result.paper))},
                                       {"crb_rmse_m", bound.crb_rmse_m},
                                       {"crb_horizontal_rmse_m", bound.crb_horizontal_rmse_m},
                                       {"crb_floor_rmse_m", bound.crb_floor_rmse_m},
                                       {"pixel_white_sd_px", pixels.white_sd_px},
                                       {"pixel_mean_px", pixels.mean_px},
                                       {"stations", stations}};
  AtomicFile file(path);
  file.stream() << summary.dump(2) << "\n";
  file.commit();
}

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

EstimatorSummary summarise(const std::vector<Fix>& fixes) {
  EstimatorSummary s;
  double squared = 0.0, trace = 0.0;
  std::vector<double> latencies_s;
  for (const Fix& fix : fixes) {
    latencies_s.push_back(fix.published_s - fix.time_s);
    const Eigen::Matrix3d& C = fix.covariance_enu_m2;
    const Eigen::Vector3d& e = fix.error_enu_m;
    if (!C.allFinite()) continue;
    s.fixes += 1;
    squared += e.squaredNorm();
    trace += C.trace();
    s.nees_axis += (e.array().square() / C.diagonal().array()).matrix();
    s.nees += e.dot(C.inverse() * e) / 3.0;
  }
  s.rmse_m = std::sqrt(squared / s.fixes);
  s.predicted_rmse_m = std::sqrt(trace / s.fixes);
  s.nees_axis /= s.fixes;
  s.nees /= s.fixes;
  s.latency_median_s = percentile(latencies_s, 0.5);
  s.latency_p95_s = percentile(latencies_s, 0.95);
  return s;
}

BoundSummary summarise_bound(const World& world, const std::vector<Fix>& fixes,
                             const MeasurementNoise& noise, std::size_t stride) {
  MeasurementNoise floor = noise;
  floor.white_share = 0.0;
  double trace = 0.0, horizontal = 0.0, floor_trace = 0.0;
  int counted = 0;
  for (std::size_t i = 0; i < fixes.size(); i += stride) {
    const auto bound = position_bound_enu(world, fixes[i].time_s, fixes[i].used, noise);
    const auto lowest = position_bound_enu(world, fixes[i].time_s, fixes[i].used, floor);
    if (!bound || !lowest) continue;
    trace += bound->trace();
    horizontal += bound->topLeftCorner<2, 2>().trace();
    floor_trace += lowest->trace();
    ++counted;
  }
  return {std::sqrt(trace / counted), std::sqrt(horizontal / counted),
          std::sqrt(floor_trace / counted)};
}

PixelSummary summarise_pixels(const std::vector<StationRecord>& stations) {
  double white = 0.0, mean = 0.0;
  int pixels = 0, counted = 0;
  for (const StationRecord& station : stations) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squared = Eigen::Vector2d::Zero();
    int own = 0;
    for (const FrameNote& note : station.frames) {
      if (!note.error_px) continue;
      sum += *note.error_px;
      squared += note.error_px->cwiseAbs2();
      ++own;
    }
    if (own == 0) continue;
    const Eigen::Vector2d average = sum / own;
    white += (squared - own * average.cwiseAbs2()).sum();
    mean += average.squaredNorm();
    pixels += own;
    counted += 1;
  }
  return {std::sqrt(white / (2.0 * pixels)), std::sqrt(mean / (2.0 * counted))};
}

void write_report(const World& world, const LockstepResult& result, double duration_s,
                  const std::string& folder) {
  std::filesystem::create_directories(folder);
  write_truth(world, duration_s, folder + "/truth.csv");
  write_fixes(result.joint, folder + "/fixes.csv");
  write_fixes(result.paper, folder + "/fixes_paper.csv");
  write_frames(world, result, folder + "/frames.csv");
  write_slews(result.slews, folder + "/slews.csv");
  write_counters(world, result, folder + "/counters.csv");
  write_summary(world, result, duration_s, folder + "/summary.json");
  write_recording(world, result, folder + "/sightings.lcm");
}

}  // namespace ols::sim
