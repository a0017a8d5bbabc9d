// What gpsd says, as readings of a GNSS receiver. Pure.
//
// Errors: gpsd computes its own (eph, epx, epy, epv) from the geometry of the satellites and knows
// nothing of RTK: 13 m for a fix that is good to 1 cm. Its manual says of their confidence that it
// is "guessed to be 95 %, may also be 50 %, one sigma, or two sigma"; what a receiver states itself
// is passed on as it is. The sentence GST has the receiver's own 1-sigma of latitude, longitude and
// altitude; where there is one of the same epoch, it is used.
#pragma once

#include <gps.h>

#include <optional>
#include <vector>

#include "edge/sensors/gnss_reading.h"

namespace ols {

// 1-sigma, as the sentence GST has it.
struct GstSigmas {
  timespec epoch{};
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();
};

// The fix in `data` with the errors of `gst` if it is of the same epoch, else with gpsd's, which
// are taken as `error_sigmas` sigmas. What is missing, not finite or out of range lowers the fix;
// dead reckoning, a position keyed in and a receiver in simulator mode are no fix.
GnssReading gnss_from_gpsd(const gps_data_t& data, const std::optional<GstSigmas>& gst,
                           double time_s, double error_sigmas = 1.0);

// Joins gpsd's messages TPV (fix) and GST (errors), which come in either order. A fix whose GST has
// not come when the next fix does, or after a short time, goes without.
class GpsdEpochs {
 public:
  explicit GpsdEpochs(double error_sigmas = 1.0) : error_sigmas_(error_sigmas) {}

  // One message; data.set tells which (and nothing of the messages before it).
  void take(const gps_data_t& data, double now_s);
  // Readings that are complete at this time.
  std::vector<GnssReading> take_readings(double now_s);

 private:
  struct Held {
    gps_fix_t fix;
    int satellites_used;
    double time_s;
  };

  void take_fix(const gps_data_t& data, double now_s);
  void take_errors(const gps_data_t& data);
  void release();

  double error_sigmas_;
  std::optional<GstSigmas> gst_;
  std::optional<Held> held_;
  std::vector<GnssReading> complete_;
};

}  // namespace ols
