#include "sim/scenario/station_truth_file.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files/atomic_file.h"

namespace ols::sim {

std::string station_truth(const StationTruth& station) {
  const StationGeometry& g = station.truth;
  const nlohmann::ordered_json truth = {{"latitude_deg", degrees(g.position.latitude_rad)},
                                        {"longitude_deg", degrees(g.position.longitude_rad)},
                                        {"height_m", g.position.height_m},
                                        {"heading_deg", degrees(g.chain.heading_rad)},
                                        {"tilt_x_deg", degrees(g.chain.tilt_x_rad)},
                                        {"tilt_y_deg", degrees(g.chain.tilt_y_rad)},
                                        {"mount_z_deg", degrees(g.chain.mount_z_rad)},
                                        {"mount_x_deg", degrees(g.chain.mount_x_rad)},
                                        {"mount_y_deg", degrees(g.chain.mount_y_rad)},
                                        {"trunnion_deg", degrees(station.unit.trunnion_rad)},
                                        {"focal_px", g.camera.fx_px},
                                        {"aspect", g.camera.fy_px / g.camera.fx_px},
                                        {"cx_px", g.camera.cx_px},
                                        {"cy_px", g.camera.cy_px},
                                        {"k1", g.camera.k1},
                                        {"k2", g.camera.k2}};
  return truth.dump(2) + "\n";
}

void write_station_truths(const World& world, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (const StationTruth& station : world.stations()) {
    AtomicFile file(folder + "/" + station.id + ".json");
    file.stream() << station_truth(station);
    file.commit();
  }
}

}  // namespace ols::sim
