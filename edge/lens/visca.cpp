#include "edge/lens/visca.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "conditions/printed.h"

namespace ols::lens::visca {
namespace {

constexpr std::size_t kLongest = 16, kShortest = 3;
constexpr char kEnd = '\xff';

std::string packet(std::initializer_list<int> bytes) {
  std::string text;
  for (const int byte : bytes) text += static_cast<char>(byte);
  return text + kEnd;
}

int byte(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

// Where the travel's ends are on the wire: zoom and focus as four half bytes, the iris as two.
struct Travel {
  int at_0, at_1;
};
Travel travel(Axis axis) {
  if (axis == Axis::kZoom) return {0, kZoomLongest};
  return axis == Axis::kFocus ? Travel{kFocusFar, kFocusNear} : Travel{0, kIrisOpen};
}

int direct_code(Axis axis) {
  return axis == Axis::kZoom ? 0x47 : axis == Axis::kFocus ? 0x48 : 0x4b;
}
int drive_code(Axis axis) {
  return axis == Axis::kZoom ? 0x07 : axis == Axis::kFocus ? 0x08 : 0x0b;
}

const char* error_text(int code) {
  switch (code) {
    case 0x01:
      return "message length error";
    case 0x02:
      return "syntax error";
    case 0x03:
      return "command buffer full";
    case 0x04:
      return "command cancelled";
    case 0x05:
      return "no such socket";
    case 0x41:
      return "not executable now";
    default:
      return "unknown error";
  }
}

}  // namespace

std::string clear_interface() { return packet({0x81, 0x01, 0x00, 0x01}); }
std::string ask_version() { return packet({0x81, 0x09, 0x00, 0x02}); }
std::string focus_by_hand() { return packet({0x81, 0x01, 0x04, 0x38, 0x03}); }
std::string exposure_by_hand() { return packet({0x81, 0x01, 0x04, 0x39, 0x03}); }

std::string ask_position(Axis axis) { return packet({0x81, 0x09, 0x04, direct_code(axis)}); }

std::string go_to(Axis axis, double position) {
  const auto [at_0, at_1] = travel(axis);
  const int at = at_0 + static_cast<int>(std::lround(std::clamp(position, 0.0, 1.0) *
                                                     static_cast<double>(at_1 - at_0)));
  return packet({0x81, 0x01, 0x04, direct_code(axis), (at >> 12) & 15, (at >> 8) & 15,
                 (at >> 4) & 15, at & 15});
}

// Longer, nearer, more open: the directions of zoom, focus and iris with a higher position.
std::string go_on(Axis axis, double rate) {
  const bool up = rate > 0.0;
  if (axis == Axis::kIris) return packet({0x81, 0x01, 0x04, 0x0b, up ? 0x02 : 0x03});
  const int speed = static_cast<int>(std::lround(std::min(1.0, std::abs(rate)) * kFastest));
  const bool first = axis == Axis::kZoom ? up : !up;  // tele, far
  return packet({0x81, 0x01, 0x04, drive_code(axis), (first ? 0x20 : 0x30) | speed});
}

std::string stand(Axis axis) {
  if (axis == Axis::kIris) return {};
  return packet({0x81, 0x01, 0x04, drive_code(axis), 0x00});
}

std::optional<Reply> reply(std::string_view packet) {
  const bool whole = packet.size() >= kShortest && packet.size() <= kLongest &&
                     packet.back() == kEnd && byte(packet, 0) == 0x90;
  if (!whole) return std::nullopt;
  const std::string_view data = packet.substr(2, packet.size() - 3);
  switch (byte(packet, 1) >> 4) {
    case 4:
      if (!data.empty()) return std::nullopt;
      return Reply{ReplyKind::kAcknowledged, "", ""};
    case 5:
      if (data.empty()) return Reply{ReplyKind::kCompleted, "", ""};
      return Reply{ReplyKind::kValue, std::string(data), ""};
    case 6:
      if (data.size() != 1) return std::nullopt;
      return Reply{ReplyKind::kError, "", error_text(byte(data, 0))};
    default:
      return std::nullopt;
  }
}

std::optional<double> position_in(Axis axis, std::string_view data) {
  if (data.size() != 4) return std::nullopt;
  int at = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (byte(data, i) > 15) return std::nullopt;
    at = at * 16 + byte(data, i);
  }
  const auto [at_0, at_1] = travel(axis);
  return std::clamp(static_cast<double>(at - at_0) / (at_1 - at_0), 0.0, 1.0);
}

std::optional<std::string> version_in(std::string_view data) {
  if (data.size() != 7) return std::nullopt;
  return printed("vendor %02x%02x, model %02x%02x, ROM %02x%02x", byte(data, 0), byte(data, 1),
                 byte(data, 2), byte(data, 3), byte(data, 4), byte(data, 5));
}

std::vector<std::string> Packets::receive(std::string_view bytes) {
  std::vector<std::string> packets;
  for (const char c : bytes) {
    packet_ += c;
    if (c == kEnd) {
      packets.push_back(std::exchange(packet_, {}));
    } else if (packet_.size() >= kLongest) {
      ++garbled_;
      packet_.clear();
    }
  }
  return packets;
}

}  // namespace ols::lens::visca
