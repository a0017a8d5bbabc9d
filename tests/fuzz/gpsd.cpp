// What gpsd may say, as libgps hands it on, up to the pose: whatever the numbers are, the pose
// stays finite and its uncertainty positive. (libgps' own reader is left out: it runs for ever on
// some malformed messages. gpsd is a process of the same computer, and a station whose reader hangs
// says that the receiver is silent.)
#include <cmath>
#include <cstring>

#include "edge/sensors/gpsd/gnss_from_gpsd.h"
#include "edge/sensors/pose_estimator.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

// Any double at all, or a usual number.
double number(ols::fuzz::Input& input) {
  const std::uint8_t kind = input.byte();
  if (kind < 200) return (kind - 100.0) * 0.9;
  const std::string_view bits = input.take(sizeof(double));
  double value = 0.0;
  std::memcpy(&value, bits.data(), bits.size());
  return value;
}

// One message: which, and its fields.
gps_data_t message(ols::fuzz::Input& input, long second) {
  gps_data_t data{};
  const std::uint8_t kind = input.byte();
  data.set =
      PACKET_SET | ((kind & 1) != 0 ? GST_SET : TIME_SET | LATLON_SET | MODE_SET | STATUS_SET);
  data.fix.mode = input.byte() % 5;
  data.fix.status = input.byte() % 11 - 1;
  data.fix.time = data.gst.utctime = {second + (kind >> 6), (kind & 2) != 0 ? 0 : 500'000'000};
  for (double* field : {&data.fix.latitude, &data.fix.longitude, &data.fix.altHAE, &data.fix.epx,
                        &data.fix.epy, &data.fix.epv, &data.fix.eph, &data.gst.lat_err_deviation,
                        &data.gst.lon_err_deviation, &data.gst.alt_err_deviation}) {
    *field = number(input);
  }
  data.satellites_used = input.byte() - 10;
  return data;
}

void check(const ols::sensors::StationPose& pose) {
  if (pose.position_source == ols::sensors::PoseSource::kNone) return;
  ols::fuzz::require(std::isfinite(pose.position.latitude_rad) &&
                         std::isfinite(pose.position.longitude_rad) &&
                         std::isfinite(pose.position.height_m),
                     "a position is finite");
  ols::fuzz::require(
      pose.position_sd_enu_m.allFinite() && (pose.position_sd_enu_m.array() >= 0.0).all(),
      "and so is its uncertainty");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::fuzz::Input input(data, size);
  ols::sensors::GpsdEpochs epochs;
  ols::sensors::PoseEstimator estimator({});
  double now_s = 1.0;
  for (long second = 1'700'000'000; !input.empty(); ++second) {
    now_s += 0.6;
    epochs.take(message(input, second), now_s);
    for (const auto& reading : epochs.take_readings(now_s)) estimator.add(reading);
    check(estimator.pose(now_s));
    static_cast<void>(estimator.alarms(now_s));
  }
  return 0;
}
