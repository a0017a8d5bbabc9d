// What ols-stationing prints: its tests as comments, then the configuration's tables.
#include <cmath>
#include <iomanip>

#include "geometry/angles.h"
#include "tools/calibrate/stationing_files.h"

namespace ols::calibration {
namespace {

// Rounded for printing, without -0.00.
double rounded(double value, int digits) {
  const double unit = std::pow(10.0, -digits);
  return std::abs(value) < 0.5 * unit ? 0.0 : value;
}

void write_global_test(std::ostream& out, const Stationing& found) {
  const ModelTest& test = found.global;
  out << std::setprecision(2) << "# Global test (5 %): variance factor " << test.variance_factor
      << ", critical " << test.critical << ", redundancy " << test.redundancy << ": ";
  if (found.scaled_by > 1.0) {
    out << "REJECTED, the sightings disagree by more than stated;\n#   all deviations below "
           "are "
           "scaled up by "
        << found.scaled_by << ".\n";
  } else {
    out << "accepted.\n";
  }
}

void write_detectable(std::ostream& out, const Eigen::Vector2d& least_m) {
  constexpr const char* kSides[] = {"across", "up"};
  out << "; detectable: ";
  for (int k = 0; k < 2; ++k) {
    if (k == 1) out << ", ";
    if (std::isinf(least_m[k])) {
      out << "nothing " << kSides[k];
    } else {
      out << std::setprecision(least_m[k] < 10.0 ? 2 : 0) << least_m[k] << " m " << kSides[k];
    }
  }
  out << '\n';
}

// One sighting's residual, in degrees and in deviations.
void write_residual(std::ostream& out, const Stationing& found, std::size_t i) {
  const Eigen::Vector2d& rad = found.residuals_rad[i];
  const Eigen::Vector2d& over = found.residuals[i];
  out << std::setprecision(4) << "off by " << rounded(degrees(rad.x()), 4) << " deg across, "
      << rounded(degrees(rad.y()), 4) << " up (" << std::setprecision(1) << rounded(over.x(), 1)
      << " and " << rounded(over.y(), 1) << " deviations)";
}

void write_landmarks(std::ostream& out, const StationingCase& before, const Stationing& found) {
  out << "# w-test of each landmark (data snooping, 0.1 % for all), its residuals, and the "
         "minimal\n"
         "# detectable bias of its place (80 %):\n";
  for (const LandmarkTest& test : found.landmarks) {
    const SightingName& first = before.names[test.sightings.front()];
    out << "#   " << first.landmark << ": w " << std::setprecision(1) << test.w << " of "
        << test.critical;
    if (test.rejected) out << ", REJECTED as mistaken or mistyped (line " << first.line << ")";
    for (const std::size_t i : test.sightings) {
      out << "; ";
      if (test.sightings.size() > 1) out << "line " << before.names[i].line << " ";
      write_residual(out, found, i);
    }
    write_detectable(out, test.detectable_m);
  }
}

// Two-sided 0.1 % each.
void write_stated(std::ostream& out, const Stationing& found) {
  constexpr double kCritical = 3.29;
  constexpr const char* kStated[] = {"tilt x",     "tilt y", "mounting z", "mounting x",
                                     "mounting y", "east",   "north",      "height"};
  for (std::size_t k = 0; k < found.stated_w.size(); ++k) {
    if (std::abs(found.stated_w[k]) <= kCritical) continue;
    out << "#   The station's " << kStated[k] << " is not as stated: w " << std::setprecision(1)
        << std::abs(found.stated_w[k]) << " of " << kCritical << '\n';
  }
}

void write_determined(std::ostream& out, const Stationing& found) {
  const auto towards = [&](const HorizonSd& sd) {
    out << std::setprecision(4) << degrees(sd.elevation_sd_rad) << " deg towards azimuth "
        << std::setprecision(0) << degrees(sd.azimuth_rad);
  };
  constexpr double kMuchWorse = 3.0;
  out << "# Elevations along the horizon are known to ";
  towards(found.best);
  out << ", to ";
  towards(found.worst);
  out << '\n';
  if (found.worst.elevation_sd_rad > kMuchWorse * found.best.elevation_sd_rad) {
    out << "#   NOT DETERMINED there by these landmarks: it is as level as it was believed to "
           "be.\n";
  }
  std::size_t used = 0;
  for (const LandmarkTest& test : found.landmarks) used += test.rejected ? 0 : 1;
  if (used == 1) out << "#   ONE LANDMARK ALONE: nothing checks the heading.\n";
}

}  // namespace

std::vector<std::string> stationing_warnings(const StationingCase& before,
                                             const Stationing& found) {
  std::vector<std::string> lines;
  for (const LandmarkTest& test : found.landmarks) {
    if (!test.rejected) continue;
    const SightingName& name = before.names[test.sightings.front()];
    lines.push_back(before.path + ":" + std::to_string(name.line) + ": landmark: '" +
                    name.landmark + "' is rejected as mistaken");
  }
  if (found.scaled_by > 1.0) {
    lines.push_back(before.path +
                    ": the sightings disagree by more than was stated: deviations are scaled up");
  }
  return lines;
}

void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position) {
  const StationGeometry& station = found.station;
  const auto line = [&out](const char* key, double value, int digits) {
    out << key << " = " << std::setprecision(digits) << rounded(value, digits) << '\n';
  };
  const auto angle = [&](const char* key, double rad) { line(key, degrees(rad), 5); };
  out << std::fixed << "# Station " << before.settings.id << " by " << before.names.size()
      << " sightings of " << found.landmarks.size() << " landmarks.\n";
  write_global_test(out, found);
  write_landmarks(out, before, found);
  write_stated(out, found);
  write_determined(out, found);
  out << "\n[pose]\n";
  if (with_position) {
    line("latitude_deg", degrees(station.position.latitude_rad), 9);
    line("longitude_deg", degrees(station.position.longitude_rad), 9);
    line("height_m", station.position.height_m, 3);
  }
  angle("heading_deg", station.chain.heading_rad);
  angle("tilt_x_deg", station.chain.tilt_x_rad);
  angle("tilt_y_deg", station.chain.tilt_y_rad);
  out << "\n[chain]\n";
  angle("mount_z_deg", station.chain.mount_z_rad);
  angle("mount_x_deg", station.chain.mount_x_rad);
  angle("mount_y_deg", station.chain.mount_y_rad);
  out << "\n[calibration]\nid = " << before.settings.calibration_id + 1 << "\n\n[calibration.sd]\n";
  angle("heading_deg", station.sd.heading_rad);
  angle("tilt_deg", station.sd.tilt_rad);
  angle("mount_deg", station.sd.mount_rad);
  angle("mount_roll_deg", station.sd.mount_roll_rad);
  line("position_m", station.sd.position_m, 3);
}

}  // namespace ols::calibration
