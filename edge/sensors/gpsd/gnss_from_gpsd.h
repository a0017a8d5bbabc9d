// Converts the messages of gpsd to readings of a GNSS receiver. Pure.
//
// Errors are stated in two ways. gpsd computes its own (eph, epx, epy, epv) from the geometry of
// the satellites. These ignore RTK: 13 m for a fix that is accurate to 1 cm. gpsd's manual
// describes their confidence as "guessed to be 95 %, may also be 50 %, one sigma, or two sigma".
// The sentence GST contains the receiver's own 1-sigma of latitude, longitude and altitude. It is
// used if it belongs to the same epoch as the fix.
#pragma once

#include <gps.h>

#include <optional>
#include <vector>

#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

// 1-sigma from a GST sentence.
struct GstSigmas {
  timespec epoch{};
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();
};

// The fix in `data`, with the errors of `gst` if they belong to the same epoch; otherwise with
// gpsd's own errors, which are taken as `error_sigmas` sigmas. A value that is missing, not finite
// or out of range lowers the quality of the fix. Dead reckoning, a manually entered position, and
// simulator mode count as no fix.
GnssReading gnss_from_gpsd(const gps_data_t& data, const std::optional<GstSigmas>& gst,
                           double time_s, double error_sigmas = 1.0);

// Joins TPV messages (fix) and GST messages (errors), which arrive in either order. A fix is
// returned without GST if the next fix arrives first, or after a short time.
class GpsdEpochs {
 public:
  explicit GpsdEpochs(double error_sigmas = 1.0) : error_sigmas_(error_sigmas) {}

  // Takes one message. data.set says which one, and must not include earlier messages.
  void take(const gps_data_t& data, double now_s);
  // The readings that are complete at this time.
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

}  // namespace ols::sensors
