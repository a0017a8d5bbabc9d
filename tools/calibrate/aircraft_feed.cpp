#include "tools/calibrate/aircraft_feed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cue/sbs_line.h"

namespace ols::calibration {
namespace {

constexpr std::uint8_t kEscape = 0x1a;
constexpr std::size_t kHead = 8;  // type, six bytes of the counter, the signal
constexpr double kFoot_m = 0.3048;

std::size_t length_of(std::uint8_t type) {
  switch (type) {
    case '1':
      return kHead + 2;
    case '2':
      return kHead + 7;
    case '3':
      return kHead + 14;
    default:
      return 0;
  }
}

// "2026/05/28" and "20:26:40.123": days by the civil calendar.
std::optional<std::int64_t> utime_of(const std::string& date, const std::string& time) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0.0;
  if (std::sscanf(date.c_str(), "%4d/%2d/%2d", &year, &month, &day) != 3 ||
      std::sscanf(time.c_str(), "%2d:%2d:%lf", &hour, &minute, &second) != 3) {
    return std::nullopt;
  }
  const bool valid = year >= 1980 && month >= 1 && month <= 12 && day >= 1 && day <= 31 &&
                     hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 &&
                     second < 61.0;
  if (!valid) return std::nullopt;
  const int shifted = month > 2 ? year : year - 1;
  const int century_day = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t days =
      365LL * shifted + shifted / 4 - shifted / 100 + shifted / 400 + century_day - 719468;
  return ((days * 24 + hour) * 60 + minute) * 60'000'000LL + std::llround(1e6 * second);
}

bool is_place(double latitude_deg, double longitude_deg) {
  return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 180.0;
}

}  // namespace

std::vector<BeastFrames::Frame> BeastFrames::take(std::span<const std::uint8_t> bytes) {
  std::vector<Frame> frames;
  for (const std::uint8_t byte : bytes) {
    if (byte == kEscape && !is_escaped_) {
      is_escaped_ = true;
      continue;
    }
    if (is_escaped_ && byte != kEscape) {  // an escape alone begins a frame
      frame_.clear();
      is_inside_ = length_of(byte) > 0;
    }
    is_escaped_ = false;
    if (!is_inside_) continue;
    frame_.push_back(byte);
    if (frame_.size() < length_of(frame_.front())) continue;
    is_inside_ = false;
    if (frame_.front() != '3') continue;
    Frame frame;
    for (std::size_t i = 1; i <= 6; ++i) frame.ticks = (frame.ticks << 8U) | frame_[i];
    frame.message.assign(frame_.begin() + kHead, frame_.end());
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::int64_t TickClock::take(std::uint64_t ticks, std::int64_t arrival_utime_us) {
  constexpr std::int64_t kTicksPerMicrosecond = 12;
  const bool is_first = !first_ticks_;
  if (is_first) first_ticks_ = ticks;
  const std::int64_t since_us =
      static_cast<std::int64_t>(ticks - *first_ticks_) / kTicksPerMicrosecond;
  const std::int64_t first_utime_us = arrival_utime_us - since_us;
  first_utime_us_ = is_first ? first_utime_us : std::min(first_utime_us_, first_utime_us);
  return since_us;
}

void ReceiverDelay::note(std::int64_t stamp_utime_us, std::int64_t arrival_utime_us) {
  const std::int64_t delay_us = arrival_utime_us - stamp_utime_us;
  least_us_ = std::min(delay_us, least_us_.value_or(delay_us));
}

std::optional<AircraftPosition> sbs_position(const std::string& line) {
  const SbsLine sbs(line);
  if (sbs.text(SbsLine::kType) != "MSG") return std::nullopt;
  const auto icao = sbs.icao();
  const auto height_ft = sbs.number(SbsLine::kHeightFt),
             latitude = sbs.number(SbsLine::kLatitudeDeg),
             longitude = sbs.number(SbsLine::kLongitudeDeg);
  const auto utime_us = utime_of(sbs.text(SbsLine::kDate), sbs.text(SbsLine::kTime));
  if (!icao || !height_ft || !latitude || !longitude || !utime_us ||
      !is_place(*latitude, *longitude)) {
    return std::nullopt;
  }
  return AircraftPosition{*icao, *utime_us, *latitude, *longitude, *height_ft * kFoot_m};
}

AircraftSnapshot aircraft_json(const std::string& text) {
  AircraftSnapshot snapshot;
  try {
    const auto root = nlohmann::json::parse(text);
    const double now_s = root.at("now").get<double>();
    constexpr double kGreatest_s = 9e9;
    if (!(now_s > 0.0 && now_s < kGreatest_s)) throw std::runtime_error("now: is no time");
    snapshot.utime_us = std::llround(1e6 * now_s);
    for (const auto& one : root.at("aircraft")) {
      if (!one.contains("lat") || !one.contains("lon") || !one.contains("seen_pos")) continue;
      if (!one.contains("alt_geom")) {
        ++snapshot.barometric_only;
        continue;
      }
      AircraftPosition position;
      position.icao = one.at("hex").get<std::string>();
      position.utime_us =
          std::llround(1e6 * (now_s - std::clamp(one.at("seen_pos").get<double>(), 0.0, 1e6)));
      position.latitude_deg = one.at("lat").get<double>();
      position.longitude_deg = one.at("lon").get<double>();
      position.height_m = one.at("alt_geom").get<double>() * kFoot_m;
      // The name is written to other files as it is, so it must be plain.
      const bool is_plain = std::ranges::all_of(
          position.icao, [](unsigned char c) { return std::isalnum(c) != 0 || c == '~'; });
      if (is_plain && !position.icao.empty() &&
          is_place(position.latitude_deg, position.longitude_deg)) {
        snapshot.positions.push_back(std::move(position));
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("is not an aircraft.json: ") + error.what());
  }
  return snapshot;
}

}  // namespace ols::calibration
