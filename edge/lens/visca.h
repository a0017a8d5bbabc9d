// Encodes and decodes the part of Sony's VISCA protocol that moves a lens (sources:
// docs/overview.md). A packet has 3 to 16 bytes and ends with FF. Packets to device 1 begin with
// 81, packets from device 1 with 90. A command has two answers: an acknowledgement at once, and a
// completion when the motion ends. An inquiry has one answer, the value. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/lens/lens_types.h"

namespace ols::lens::visca {

// The values that represent the ends of the travel in packets. Zoom values above kZoomLongest are
// digital zoom.
inline constexpr int kZoomLongest = 0x4000;
inline constexpr int kFocusFar = 0x1000, kFocusNear = 0xf000;
inline constexpr int kIrisOpen = 0x11;
inline constexpr int kFastest = 7;  // speeds are 0 to 7

std::string clear_interface();
std::string ask_version();
// Switches focus and exposure to manual. Without these two commands, the lens refuses commands to
// focus and iris.
std::string focus_by_hand();
std::string exposure_by_hand();

std::string ask_position(Axis axis);
std::string go_to(Axis axis, double position);
// Begins a motion at this rate. Zoom and focus move until stand(); of the eight speeds, the one
// nearest to the rate is used. The iris moves by a single step.
std::string go_on(Axis axis, double rate);
// Stops the axis. Empty for the iris, because it stops after each step.
std::string stand(Axis axis);

enum class ReplyKind { kAcknowledged, kCompleted, kValue, kError };
struct Reply {
  ReplyKind kind = ReplyKind::kError;
  std::string data;  // bytes of a value, without the packet's head and end
  std::string text;  // an error in words
};
// Decodes a whole packet, including its FF. nullopt if it is not from device 1, or if its form is
// unknown.
std::optional<Reply> reply(std::string_view packet);

// Decodes the answer to ask_position() as a share of the travel; nullopt if the answer's form is
// wrong.
std::optional<double> position_in(Axis axis, std::string_view data);
// For example "vendor 0020, model 0466, ROM 0105".
std::optional<std::string> version_in(std::string_view data);

// Divides the received bytes into packets. A packet that is too long is dropped and counted as
// garbled.
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
