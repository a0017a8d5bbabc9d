#include "edge/mount/serial/visca_head.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace ols::serial_mount {
namespace {

constexpr int kFastestPan = 0x18, kFastestTilt = 0x14;
constexpr int kStands = 3;
constexpr int kMost = 0x7fff;

std::string packet(std::initializer_list<int> bytes) {
  std::string text{'\x81'};
  for (const int byte : bytes) text += static_cast<char>(byte);
  return text + '\xff';
}

int speed(double share, int fastest) {
  return static_cast<int>(std::lround(std::min(1.0, std::abs(share)) * fastest));
}

int way(int speed, bool first) { return speed == 0 ? kStands : first ? 1 : 2; }

int counts(double position) {
  return static_cast<int>(std::lround(std::clamp<double>(position, -kMost, kMost)));
}

// Four half bytes.
std::optional<int> value_in(std::string_view data) {
  int value = 0;
  for (const char half : data) {
    if ((static_cast<unsigned char>(half) & 0xf0) != 0) return std::nullopt;
    value = value << 4 | half;
  }
  return static_cast<std::int16_t>(value);
}

}  // namespace

std::vector<std::string> ViscaHead::questions() const { return {packet({0x09, 0x06, 0x12})}; }

std::string ViscaHead::stop() const { return packet({0x01, 0x06, 0x01, 1, 1, kStands, kStands}); }

std::string ViscaHead::velocity(double pan, double tilt) const {
  const int pan_speed = speed(pan, kFastestPan), tilt_speed = speed(tilt, kFastestTilt);
  return packet({0x01, 0x06, 0x01, std::max(1, pan_speed), std::max(1, tilt_speed),
                 way(pan_speed, pan > 0.0), way(tilt_speed, tilt > 0.0)});
}

std::string ViscaHead::place(double pan, double tilt) const {
  const int x = counts(pan), y = counts(tilt);
  return packet({0x01, 0x06, 0x02, kFastestPan, kFastestTilt, (x >> 12) & 15, (x >> 8) & 15,
                 (x >> 4) & 15, x & 15, (y >> 12) & 15, (y >> 8) & 15, (y >> 4) & 15, y & 15});
}

void ViscaHead::receive(std::string_view bytes) {
  constexpr std::size_t kHalfBytes = 4;
  for (const std::string& one : packets_.receive(bytes)) {
    const auto reply = lens::visca::reply(one);
    if (!reply || reply->kind == lens::visca::ReplyKind::kError) ++garbled_;
    if (!reply || reply->kind != lens::visca::ReplyKind::kValue) continue;
    if (reply->data.size() != 2 * kHalfBytes) continue;
    const std::string_view data = reply->data;
    const auto pan = value_in(data.substr(0, kHalfBytes));
    const auto tilt = value_in(data.substr(kHalfBytes));
    if (!pan || !tilt) {
      ++garbled_;
      continue;
    }
    position_ = {static_cast<double>(*pan), static_cast<double>(*tilt)};
  }
}

}  // namespace ols::serial_mount
