#include "sim/lens/lens_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ols::sim {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kKept_s = 4.0;
constexpr int kFocusFar = 0x1000, kFocusNear = 0xf000, kZoomLongest = 0x4000, kIrisOpen = 0x11;

unsigned char at(const std::string& packet, std::size_t i) {
  return static_cast<unsigned char>(packet[i]);
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

std::string value_reply(int value) {
  return bytes(
      {0x90, 0x50, (value >> 12) & 15, (value >> 8) & 15, (value >> 4) & 15, value & 15, 0xff});
}

// Of "... 0p 0q 0r 0s FF"; negative: not four half bytes.
int value_of(const std::string& packet) {
  int value = 0;
  for (std::size_t i = 4; i < 8; ++i) {
    if (at(packet, i) > 15) return -1;
    value = value * 16 + at(packet, i);
  }
  return value;
}

}  // namespace

LensUnit::Drive::Drive(double travel_s, double position, double time_s)
    : travel_s_(travel_s), pieces_{{time_s, position, 0.0, kForever}} {}

double LensUnit::Drive::within(const Piece& piece, double time_s) {
  const double run_s = std::clamp(time_s, piece.from_s, piece.until_s) - piece.from_s;
  return std::clamp(piece.position + piece.speed * run_s, 0.0, 1.0);
}

double LensUnit::Drive::at(double time_s) const {
  const auto after = std::find_if(pieces_.rbegin(), pieces_.rend(),
                                  [&](const Piece& piece) { return piece.from_s <= time_s; });
  return within(after == pieces_.rend() ? pieces_.front() : *after, time_s);
}

void LensUnit::Drive::add(const Piece& piece) {
  pieces_.push_back(piece);
  while (pieces_.size() > 2 && pieces_[1].from_s < piece.from_s - kKept_s) pieces_.pop_front();
}

void LensUnit::Drive::run(double rate, double time_s) {
  add({time_s, at(time_s), rate / travel_s_, kForever});
}

double LensUnit::Drive::go_to(double position, double time_s) {
  const double from = at(time_s);
  const double takes_s = std::abs(position - from) * travel_s_;
  add({time_s, from, std::copysign(1.0 / travel_s_, position - from), time_s + takes_s});
  return time_s + takes_s;
}

LensUnit::LensUnit(const LensUnitConfig& config, double power_up_s)
    : config_(config),
      zoom_(config.zoom_travel_s, config.start_zoom, power_up_s),
      focus_(config.focus_travel_s, 0.0, power_up_s) {}

double LensUnit::zoom_at(double time_s) const { return zoom_.at(time_s); }

void LensUnit::receive(std::string_view bytes_in, double time_s) {
  for (const char c : bytes_in) {
    packet_ += c;
    if (static_cast<unsigned char>(c) != 0xff) continue;
    take(packet_, time_s);
    packet_.clear();
  }
  if (packet_.size() > 16) packet_.clear();
}

std::string LensUnit::transmit(double time_s) {
  std::string text;
  while (!output_.empty() && output_.front().time_s <= time_s) {
    text += output_.front().bytes;
    output_.pop_front();
  }
  return text;
}

std::optional<double> LensUnit::next_output_s() const {
  return output_.empty() ? std::nullopt : std::optional(output_.front().time_s);
}

// Its last bit is on the line then.
void LensUnit::say(std::string text, double time_s) {
  const double on_line_s = 10.0 * static_cast<double>(text.size()) / config_.baud;
  const Output output{time_s + config_.cycle_s + on_line_s, std::move(text)};
  const auto place = std::ranges::upper_bound(output_, output.time_s, {}, &Output::time_s);
  output_.insert(place, output);
}

void LensUnit::acknowledge(double time_s, double done_s) {
  say(bytes({0x90, 0x41, 0xff}), time_s);
  say(bytes({0x90, 0x51, 0xff}), std::max(time_s + config_.cycle_s, done_s));
}

void LensUnit::take(const std::string& packet, double time_s) {
  const bool clear = packet == bytes({0x81, 0x01, 0x00, 0x01, 0xff});
  if (clear) return say(bytes({0x90, 0x50, 0xff}), time_s);
  if (packet.size() < 4 || at(packet, 0) != 0x81) return;  // for another device
  if (at(packet, 1) == 0x01) return obey(packet, time_s);
  if (at(packet, 1) == 0x09) return answer(packet, time_s);
  say(bytes({0x90, 0x60, 0x02, 0xff}), time_s);
}

void LensUnit::drive(Drive& drive, int what, bool up_is_2, double time_s) {
  const int speed = what & 15;
  const bool up = (what >> 4 == 2) == up_is_2;
  const double rate = what == 0 ? 0.0 : (1.0 + speed) / 8.0;
  drive.run(up ? rate : -rate, time_s);
  acknowledge(time_s, time_s);
}

void LensUnit::obey(const std::string& packet, double time_s) {
  const int what = packet.size() > 3 ? at(packet, 3) : 0;
  const bool is_short = packet.size() == 6, is_long = packet.size() == 9;
  const int value = is_long ? value_of(packet) : -1;
  const int argument = is_short ? at(packet, 4) : -1;
  const auto not_now = [&] { say(bytes({0x90, 0x61, 0x41, 0xff}), time_s); };
  if (is_short && what == 0x38 && argument == 3) {
    focus_by_hand_ = true;
    acknowledge(time_s, time_s);
  } else if (is_short && what == 0x39 && argument == 3) {
    exposure_by_hand_ = true;
    acknowledge(time_s, time_s);
  } else if (is_short && what == 0x07) {
    drive(zoom_, argument, true, time_s);
  } else if (is_long && what == 0x47 && value >= 0 && value <= kZoomLongest) {
    acknowledge(time_s, zoom_.go_to(static_cast<double>(value) / kZoomLongest, time_s));
  } else if (is_short && what == 0x08) {
    if (!focus_by_hand_) return not_now();
    drive(focus_, argument, false, time_s);
  } else if (is_long && what == 0x48 && value >= kFocusFar && value <= kFocusNear) {
    if (!focus_by_hand_) return not_now();
    const double share = static_cast<double>(value - kFocusFar) / (kFocusNear - kFocusFar);
    acknowledge(time_s, focus_.go_to(share, time_s));
  } else if (is_short && what == 0x0b && (argument == 2 || argument == 3)) {
    if (!exposure_by_hand_) return not_now();
    iris_ = std::clamp(iris_ + (argument == 2 ? 1 : -1), 0, kIrisOpen);
    acknowledge(time_s, time_s);
  } else if (is_long && what == 0x4b && value >= 0 && value <= kIrisOpen) {
    if (!exposure_by_hand_) return not_now();
    iris_ = value;
    acknowledge(time_s, time_s);
  } else {
    say(bytes({0x90, 0x60, 0x02, 0xff}), time_s);
  }
}

void LensUnit::answer(const std::string& packet, double time_s) {
  const int category = packet.size() == 5 ? at(packet, 2) : -1, what = at(packet, 3);
  if (category == 0x00 && what == 0x02) {
    say(bytes({0x90, 0x50, 0x00, 0x20, 0x04, 0x66, 0x01, 0x05, 0x02, 0xff}), time_s);
  } else if (category == 0x04 && what == 0x47) {
    say(value_reply(static_cast<int>(std::lround(zoom_.at(time_s) * kZoomLongest))), time_s);
  } else if (category == 0x04 && what == 0x48) {
    const double travel = kFocusNear - kFocusFar;
    say(value_reply(kFocusFar + static_cast<int>(std::lround(focus_.at(time_s) * travel))), time_s);
  } else if (category == 0x04 && what == 0x4b) {
    say(value_reply(iris_), time_s);
  } else {
    say(bytes({0x90, 0x60, 0x02, 0xff}), time_s);
  }
}

}  // namespace ols::sim
