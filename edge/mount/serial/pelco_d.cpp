#include "edge/mount/serial/pelco_d.h"

#include <algorithm>
#include <cmath>

namespace ols::serial_mount {
namespace {

constexpr std::size_t kLength = 7;
constexpr char kSync = '\xff';
constexpr int kRight = 0x02, kLeft = 0x04, kUp = 0x08, kDown = 0x10;
constexpr int kSetPan = 0x4b, kSetTilt = 0x4d, kAskPan = 0x51, kAskTilt = 0x53;
constexpr int kPanIs = 0x59, kTiltIs = 0x5b;
constexpr int kFastest = 0x3f;
constexpr int kHundredths = 36000;  // of a turn

int byte(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

int speed(double share) {
  return static_cast<int>(std::lround(std::min(1.0, std::abs(share)) * kFastest));
}

int hundredths(double degrees) {
  const auto value = std::llround(100.0 * degrees) % kHundredths;
  return static_cast<int>(value < 0 ? value + kHundredths : value);
}

int sum_of(std::string_view message) {
  int sum = 0;
  for (std::size_t i = 1; i + 1 < kLength; ++i) sum += byte(message, i);
  return sum & 0xff;
}

}  // namespace

std::string PelcoD::message(int command, int data_1, int data_2) const {
  std::string text{kSync};
  for (const int value : {address_, 0, command, data_1, data_2, 0})
    text += static_cast<char>(value);
  text.back() = static_cast<char>(sum_of(text));
  return text;
}

std::vector<std::string> PelcoD::questions() const {
  return {message(kAskPan, 0, 0), message(kAskTilt, 0, 0)};
}

std::string PelcoD::stop() const { return message(0, 0, 0); }

std::string PelcoD::velocity(double pan, double tilt) const {
  const int pan_speed = speed(pan), tilt_speed = speed(tilt);
  int command = 0;
  if (pan_speed > 0) command |= pan > 0.0 ? kLeft : kRight;
  if (tilt_speed > 0) command |= tilt > 0.0 ? kUp : kDown;
  return message(command, pan_speed, tilt_speed);
}

std::string PelcoD::place(double pan, double tilt) const {
  const int to_pan = hundredths(pan), to_tilt = hundredths(tilt);
  return message(kSetPan, to_pan >> 8, to_pan & 0xff) +
         message(kSetTilt, to_tilt >> 8, to_tilt & 0xff);
}

void PelcoD::receive(std::string_view bytes) {
  received_ += bytes;
  while (received_.size() >= kLength) {
    const std::string_view message = received_;
    if (message[0] != kSync || sum_of(message) != byte(message, kLength - 1)) {
      ++garbled_;
      const std::size_t next = received_.find(kSync, 1);
      received_.erase(0, next);
      continue;
    }
    const int value = byte(message, 4) << 8 | byte(message, 5);
    const bool is_ours = byte(message, 1) == address_ && value < kHundredths;
    if (is_ours && byte(message, 3) == kPanIs) position_.pan = 0.01 * value;
    if (is_ours && byte(message, 3) == kTiltIs) position_.tilt = 0.01 * value;
    received_.erase(0, kLength);
  }
}

}  // namespace ols::serial_mount
