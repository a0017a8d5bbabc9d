// What an RTSP camera may send beside its pictures: heads of packets and times of sender reports.
// Whatever they are, a picture's time is finite, and so is its error.
#include <bit>
#include <cmath>

#include "edge/camera/rtsp/rtp_pictures.h"
#include "edge/camera/rtsp/rtsp_clock.h"
#include "edge/camera/rtsp/rtsp_codec.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace camera = ols::camera;
using ols::fuzz::Input;
using ols::fuzz::require;

std::uint32_t word(Input& input) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | input.byte();
  return value;
}

// As GStreamer gives a sender report's time: seconds since 1900 and a fraction.
std::int64_t report_utc_ns(Input& input) {
  constexpr std::int64_t kNtpToUtc_s = 2'208'988'800;
  const std::int64_t seconds = word(input);
  return (seconds - kNtpToUtc_s) * 1'000'000'000 + word(input) / 5;
}

// The time of a picture by arrivals and reports.
void stamp(camera::RtspClock& clock, const camera::RtpPicture& picture) {
  constexpr std::int64_t kUtcMinusMonotonic_ns = 1'800'000'000'000'000'000;
  const camera::FrameTime time = clock.stamp({.device_ns = picture.device_ns,
                                              .arrival_s = picture.arrival_s,
                                              .report_utc_ns = picture.report_utc_ns},
                                             kUtcMinusMonotonic_ns);
  require(std::isfinite(time.mid_exposure_s), "a time is finite");
  require(std::isfinite(time.sd_s) && time.sd_s > 0.0, "its error is finite");
  require(std::isfinite(clock.delay().delay_s) && std::isfinite(clock.delay().sd_s),
          "a delay is finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const int clock_hz = static_cast<int>(word(input));
  if (!camera::is_rtp_clock(clock_hz)) return 0;
  camera::RtpPictures pictures(clock_hz);
  camera::RtspClock clock({});
  double now_s = 1000.0;
  std::optional<std::int64_t> report;
  while (!input.empty()) {
    const std::uint8_t what = input.byte();
    now_s += (what & 0x0f) == 0x0f ? 40.0 : 0.02 * (what & 0x0f);
    if ((what & 0x10) != 0) report = report_utc_ns(input);
    if ((what & 0x20) != 0) clock.restart();
    const std::string_view head = input.take(8);
    auto packet =
        camera::rtp_packet({reinterpret_cast<const std::uint8_t*>(head.data()), head.size()});
    require(packet.has_value() == (head.size() == 8), "eight bytes are a head");
    if (!packet) break;
    packet->pts_ns = (what & 0x40) != 0 ? packet->stamp : input.byte();
    packet->report_utc_ns = report;
    // A hostile stream is long: one byte stands for 300 packets whose stamps leap on.
    const std::uint32_t leap = packet->stamp;
    for (int left = (what & 0x0f) == 0x0e ? 300 : 1; left > 0; --left) {
      packet->arrival_s = now_s;
      pictures.add(*packet);
      pictures.decoding(packet->pts_ns, (what & 0x80) != 0);
      if (const auto picture = pictures.take(packet->pts_ns)) stamp(clock, *picture);
      ++packet->sequence, packet->stamp += leap, packet->pts_ns += leap, now_s += 0.001;
    }
  }
  return 0;
}
