// The part of Sony's VISCA protocol that moves a lens (sources: docs/overview.md). Packets have 3
// to 16 bytes and end with FF. Packets to device 1 begin with 81, packets from it with 90. A
// command is answered twice: at once by an acknowledgement, and at its end by a completion. An
// inquiry is answered once, by its value. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/lens/lens_types.h"

namespace ols::lens::visca {

// The values on the wire for the ends of the travel.
// End of the optical zoom; larger values are digital zoom.
inline constexpr int kZoomLongest = 0x4000;
inline constexpr int kFocusFar = 0x1000, kFocusNear = 0xf000;
inline constexpr int kIrisOpen = 0x11;
inline constexpr int kFastest = 7;  // the largest of eight speeds, which start at 0

std::string clear_interface();
std::string ask_version();
// Without these two commands, the lens refuses commands to focus and iris.
std::string focus_by_hand();
std::string exposure_by_hand();

std::string ask_position(Axis axis);
std::string go_to(Axis axis, double position);
// Zoom and focus move at the nearest of eight speeds. The iris moves by one step.
std::string go_on(Axis axis, double rate);
// Empty for the iris, because it stops after each step.
std::string stand(Axis axis);

enum class ReplyKind { kAcknowledged, kCompleted, kValue, kError };
struct Reply {
  ReplyKind kind = ReplyKind::kError;
  std::string data;  // content of a value, without head and end
  std::string text;  // an error in words
};
// Takes a whole packet with its end. nullopt if it is not from device 1, or has an unknown form.
std::optional<Reply> reply(std::string_view packet);

// The share of the travel in an answer to ask_position(); nullopt if the answer has another form.
std::optional<double> position_in(Axis axis, std::string_view data);
// For example "vendor 0020, model 0466, ROM 0105".
std::optional<std::string> version_in(std::string_view data);

// Cuts the received bytes into packets. An overlong packet counts as garbled.
class Packets {
 public:
  std::vector<std::string> receive(std::string_view bytes);
  std::uint64_t garbled() const { return garbled_; }
  void clear() { packet_.clear(); }

 private:
  std::string packet_;
  std::uint64_t garbled_ = 0;
};

}  // namespace ols::lens::visca
