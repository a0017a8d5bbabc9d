#include "console/messages_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "console/rounded.h"
#include "geometry/lens.h"
#include "ols_msg/preview_t.hpp"
#include "ols_msg/video_frame_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "ols_msg/video_stream_request_t.hpp"

namespace ols::console {
namespace {

// What a preview and a frame of the video have in common.
template <class Message>
Json header_of(const Message& m) {
  Json box = nullptr;
  if (m.has_box) {
    box = {rounded(m.box_px[0], 1), rounded(m.box_px[1], 1), rounded(m.box_px[2], 1),
           rounded(m.box_px[3], 1)};
  }
  return {{"station", m.station},
          {"utime_us", m.utime},
          {"boot", number_text(m.boot_id)},
          {"sequence", m.sequence},
          {"full_px", {m.full_width_px, m.full_height_px}},
          {"scale", rounded(m.scale, 6)},
          {"box_px", box}};
}

// Null while the unit's angles are unknown, and for a lens that only a newer station knows.
Json camera_of(const ols_msg::video_frame_t& f) {
  if (!std::isfinite(f.camera_from_ecef[0])) return nullptr;
  const auto model = static_cast<std::size_t>(f.lens_model);
  if (model >= kLensModelNames.size()) return nullptr;
  Json distortion = rounded_all(f.distortion, 6);
  distortion.push_back(rounded(f.lens_k4, 6));
  return {{"ecef_m", rounded_all(f.camera_ecef_m, 3)},
          {"from_ecef", rounded_all(f.camera_from_ecef, 9)},
          {"matrix_px", rounded_all(f.camera_matrix_px, 4)},
          {"lens", kLensModelNames[model]},
          {"distortion", distortion}};
}

template <class Request>
Request request_for(std::int64_t after_utime_us, int max_width_px, int quality) {
  Request request{};
  request.schema_version = Request::SCHEMA_VERSION;
  request.after_utime = after_utime_us;
  request.max_width_px = max_width_px;
  request.quality = quality;
  return request;
}

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// Whether an access unit (Annex B) can be decoded without those before it: it then has the stream's
// parameters first (H.264, table 7-1: 7 is a sequence parameter set).
bool begins_a_stream(std::span<const std::uint8_t> unit) {
  constexpr std::array<std::uint8_t, 3> kStart{0, 0, 1};
  constexpr int kTypeBits = 0x1f, kSequenceParameters = 7;
  // Not std::ranges::search: clang 14 does not compile the range that it returns.
  const auto found = std::search(unit.begin(), unit.end(), kStart.begin(), kStart.end());
  if (unit.end() - found <= std::ssize(kStart)) return false;
  return (found[std::ssize(kStart)] & kTypeBits) == kSequenceParameters;
}

}  // namespace

std::optional<Picture> picture_from(const BusMessage& message) {
  ols_msg::preview_t p;
  if (!decode_of_schema(message, p) ||
      message.channel != station_channel(kPreviewChannel, p.station)) {
    return std::nullopt;
  }
  return Picture{p.station, header_of(p), std::string(p.jpeg.begin(), p.jpeg.end())};
}

std::vector<std::uint8_t> video_request(std::int64_t after_utime_us, int max_width_px,
                                        int quality) {
  return encoded(request_for<ols_msg::video_request_t>(after_utime_us, max_width_px, quality));
}

std::vector<std::uint8_t> stream_request(std::int64_t after_utime_us, int max_width_px, int quality,
                                         bool key_frame) {
  auto request =
      request_for<ols_msg::video_stream_request_t>(after_utime_us, max_width_px, quality);
  request.key_frame = static_cast<std::int8_t>(key_frame);
  return encoded(request);
}

std::optional<Picture> video_picture_from(std::span<const std::uint8_t> bytes, Codec codec) {
  ols_msg::video_frame_t f;
  const auto size = static_cast<int>(bytes.size());
  if (f.decode(bytes.data(), 0, size) != size ||
      f.schema_version != ols_msg::video_frame_t::SCHEMA_VERSION) {
    return std::nullopt;
  }
  Json header = header_of(f);
  header["belief"] = rounded(f.belief, 3);
  header["track"] = f.track_id;
  header["camera"] = camera_of(f);
  return Picture{f.station,
                 std::move(header),
                 std::string(f.jpeg.begin(), f.jpeg.end()),
                 true,
                 codec,
                 codec == Codec::kH264 && begins_a_stream(f.jpeg)};
}

}  // namespace ols::console
