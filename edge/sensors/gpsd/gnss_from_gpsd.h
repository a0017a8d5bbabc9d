// Converts gpsd's messages to readings of a GNSS receiver. Pure.
//
// The errors of a fix are available from two sources. gpsd computes errors (eph, epx, epy, epv)
// from the geometry of the satellites. These do not take account of RTK: they are 13 m for a fix
// that is accurate to 1 cm. gpsd's manual describes their confidence as "guessed to be 95 %, may
// also be 50 %, one sigma, or two sigma". The NMEA sentence GST contains the receiver's own 1-sigma
// of latitude, longitude and altitude. GST is used if it belongs to the same epoch as the fix.
#pragma once

#include <gps.h>

#include <optional>
#include <vector>

#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

// The 1-sigmas from a GST sentence.
struct GstSigmas {
  timespec epoch{};
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();
};

// The fix in `data` as a reading. The errors are those of `gst` if it belongs to the same epoch;
// otherwise they are gpsd's errors divided by `error_sigmas`. If a value is missing, not finite or
// out of range, the reading states a worse fix. Dead reckoning, a manually entered position and
// simulator mode count as no fix.
GnssReading gnss_from_gpsd(const gps_data_t& data, const std::optional<GstSigmas>& gst,
                           double time_s, double error_sigmas = 1.0);

// Combines TPV messages (fix) with GST messages (errors) of the same epoch, which may arrive in
// either order. A fix waits for its GST for 0.3 s, but not beyond the next fix; then it is returned
// without GST.
class GpsdEpochs {
 public:
  explicit GpsdEpochs(double error_sigmas = 1.0) : error_sigmas_(error_sigmas) {}

  // Takes one message. `data.set` must contain only the flags of this message.
  void take(const gps_data_t& data, double now_s);
  // The readings since the last call that are complete by `now_s`.
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
