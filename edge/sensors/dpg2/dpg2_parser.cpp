#include "edge/sensors/dpg2/dpg2_parser.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::sensors {

namespace {

constexpr std::size_t kLongestLine = 80;  // a version text; a reading has 9
constexpr double kPairWithin_s = 0.5;     // 22 bytes at 9600 baud take 23 ms

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "+00.430" to the last digit, or nothing: a lost or repeated character must not pass as a value.
std::optional<double> angle_rad(std::string_view text) {
  if (text.size() != 7 || (text[0] != '+' && text[0] != '-') || text[3] != '.') return {};
  int thousandths = 0;
  for (const std::size_t i : {1, 2, 4, 5, 6}) {
    if (!is_digit(text[i])) return {};
    thousandths = 10 * thousandths + (text[i] - '0');
  }
  return radians((text[0] == '-' ? -1e-3 : 1e-3) * thousandths);
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

std::vector<AxisAngles> Dpg2Parser::receive(std::string_view bytes, double now_s) {
  std::vector<AxisAngles> out;
  for (const char c : bytes) {
    if (c == '\r' || c == '\n') {
      if (line_too_long_) {
        ++counters_.garbled;
        drop_half();
      } else if (!line_.empty()) {
        take_line(now_s, out);
      }
      line_.clear();
      line_too_long_ = false;
    } else if (line_.size() < kLongestLine) {
      line_ += c;
    } else {
      line_too_long_ = true;
    }
  }
  return out;
}

void Dpg2Parser::take_line(double now_s, std::vector<AxisAngles>& out) {
  const std::string_view line = line_;
  const bool is_x = line.starts_with("X=");
  const bool is_y = line.starts_with("Y=");
  const auto value_rad = is_x || is_y ? angle_rad(line.substr(2)) : std::nullopt;
  if (!value_rad) {
    take_other_line();
  } else if (is_x) {
    drop_half();
    half_ = HalfPair{now_s, *value_rad};
  } else {
    take_y(*value_rad, now_s, out);
  }
}

void Dpg2Parser::take_y(double y_rad, double now_s, std::vector<AxisAngles>& out) {
  if (!half_ || now_s - half_->time_s > kPairWithin_s) {
    // X and Y this far apart were measured at different times.
    half_.reset();
    ++counters_.unpaired;
    return;
  }
  const AxisAngles angles{now_s, half_->x_rad, y_rad};
  half_.reset();
  if (std::abs(angles.x_rad) > range_rad_ || std::abs(angles.y_rad) > range_rad_) {
    ++counters_.out_of_range;
    return;
  }
  ++counters_.readings;
  out.push_back(angles);
}

void Dpg2Parser::take_other_line() {
  if (version_awaited_ && is_printable(line_) && !line_.starts_with("X=") &&
      !line_.starts_with("Y=")) {
    version_ = line_;
    version_awaited_ = false;
    return;
  }
  ++counters_.garbled;
  drop_half();
}

void Dpg2Parser::drop_half() {
  if (half_) ++counters_.unpaired;
  half_.reset();
}

}  // namespace ols::sensors
