#include "edge/sensors/gpsd/gnss_from_gpsd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/angles.h"

namespace ols::sensors {

namespace {

constexpr double kAwaitGst_s = 0.3;

// By gpsd's numbers: 3 is RTK fixed and 4 RTK float, the reverse of NMEA's GGA.
GnssFix fix_of_status(int status) {
  switch (status) {
    case STATUS_DGPS_FIX:
      return GnssFix::kDifferential;
    case STATUS_RTK_FIX:
      return GnssFix::kRtkFixed;
    case STATUS_RTK_FLT:
      return GnssFix::kRtkFloat;
    case STATUS_DR:
    case STATUS_TIME:
    case STATUS_SIM:
      return GnssFix::kNone;
    default:  // plain, or not stated by gpsd
      return GnssFix::k3D;
  }
}

bool on_earth(const gps_fix_t& fix) {
  return std::abs(fix.latitude) <= 90.0 && std::abs(fix.longitude) <= 360.0;  // false for NaN
}

bool has_height(const gps_fix_t& fix) { return std::abs(fix.altHAE) < 1e5; }

bool is_sd(double sd_m) { return sd_m > 0.0 && sd_m < 1e6; }

bool all_sd(const Eigen::Vector3d& sd_m) {
  return is_sd(sd_m.x()) && is_sd(sd_m.y()) && is_sd(sd_m.z());
}

// gpsd's own errors; zero if missing.
Eigen::Vector3d gpsd_sd_enu_m(const gps_fix_t& fix, double error_sigmas) {
  Eigen::Vector3d e(fix.epx, fix.epy, fix.epv);
  if (!is_sd(e.x()) || !is_sd(e.y())) e.x() = e.y() = fix.eph / std::numbers::sqrt2;
  return all_sd(e) ? Eigen::Vector3d(e / error_sigmas) : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

bool same_epoch(const timespec& a, const timespec& b) {
  return a.tv_sec != 0 && a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

GnssReading reading_of(const gps_fix_t& fix, int satellites_used,
                       const std::optional<GstSigmas>& gst, double time_s, double error_sigmas) {
  GnssReading reading;
  reading.time_s = time_s;
  reading.satellites_used = std::clamp(satellites_used, 0, MAXCHANNELS);
  if (fix.mode < MODE_2D || !on_earth(fix)) return reading;
  const GnssFix kind = fix_of_status(fix.status);
  if (kind == GnssFix::kNone) return reading;
  reading.antenna.latitude_rad = radians(fix.latitude);
  reading.antenna.longitude_rad = wrap_pi(radians(fix.longitude));
  const bool gst_fits = gst && same_epoch(gst->epoch, fix.time);
  reading.sd_enu_m = gst_fits ? gst->sd_enu_m : gpsd_sd_enu_m(fix, error_sigmas);
  if (fix.mode < MODE_3D || !has_height(fix) || !all_sd(reading.sd_enu_m)) {
    reading.fix = GnssFix::k2D;  // not to be used as a position in space
    return reading;
  }
  reading.antenna.height_m = fix.altHAE;
  reading.fix = kind;
  return reading;
}

}  // namespace

GnssReading gnss_from_gpsd(const gps_data_t& data, const std::optional<GstSigmas>& gst,
                           double time_s, double error_sigmas) {
  return reading_of(data.fix, data.satellites_used, gst, time_s, error_sigmas);
}

void GpsdEpochs::take(const gps_data_t& data, double now_s) {
  if ((data.set & STATUS_SET) != 0) take_fix(data, now_s);
  if ((data.set & GST_SET) != 0) take_errors(data);
}

void GpsdEpochs::take_fix(const gps_data_t& data, double now_s) {
  // gpsd may report one epoch in several parts; later parts are more complete.
  if (held_ && !same_epoch(held_->fix.time, data.fix.time)) release();
  held_ = Held{data.fix, data.satellites_used, now_s};
  if (gst_ && same_epoch(gst_->epoch, data.fix.time)) release();
}

void GpsdEpochs::take_errors(const gps_data_t& data) {
  const gst_t& in = data.gst;
  gst_ = GstSigmas{in.utctime, {in.lon_err_deviation, in.lat_err_deviation, in.alt_err_deviation}};
  if (!all_sd(gst_->sd_enu_m)) gst_.reset();
  if (gst_ && held_ && same_epoch(held_->fix.time, gst_->epoch)) release();
}

void GpsdEpochs::release() {
  complete_.push_back(
      reading_of(held_->fix, held_->satellites_used, gst_, held_->time_s, error_sigmas_));
  held_.reset();
}

std::vector<GnssReading> GpsdEpochs::take_readings(double now_s) {
  if (held_ && now_s - held_->time_s > kAwaitGst_s) release();
  return std::exchange(complete_, {});
}

}  // namespace ols::sensors
