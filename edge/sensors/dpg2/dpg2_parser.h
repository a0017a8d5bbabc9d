// Parses the output of a TE (MEAS) DPG2 inclinometer: lines "X=+00.430" and "Y=-00.084", in
// degrees, without checksum or time. Checks three things: every character of a line, that each Y
// directly follows its X, and the range of the angles. Pure: takes bytes and their arrival time,
// and returns angles. The result does not depend on how the bytes are split into calls.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/sensors/inclinometer.h"

namespace ols::sensors {

// Counters that only increase.
struct Dpg2Counters {
  std::uint64_t readings = 0;
  std::uint64_t garbled = 0;       // lines that are neither X, nor Y, nor the version
  std::uint64_t unpaired = 0;      // an X without its Y or a Y without its X
  std::uint64_t out_of_range = 0;  // pairs of X and Y with an angle out of range
};

class Dpg2Parser {
 public:
  explicit Dpg2Parser(double range_rad) : range_rad_(range_rad) {}

  // Takes bytes that have arrived at `now_s`. Returns the pairs of X and Y that they complete.
  std::vector<AxisAngles> receive(std::string_view bytes, double now_s);

  // Commands to the sensor: start to send readings; send the version.
  static constexpr const char* kStart = "S";
  static constexpr const char* kAskVersion = "V";

  // Call when kAskVersion is sent. The next line that is not a reading is then taken as the
  // version.
  void expect_version() { version_awaited_ = true; }
  const std::string& version() const { return version_; }

  const Dpg2Counters& counters() const { return counters_; }

 private:
  struct HalfPair {
    double time_s;
    double x_rad;
  };

  void take_line(double now_s, std::vector<AxisAngles>& out);
  void take_y(double y_rad, double now_s, std::vector<AxisAngles>& out);
  void take_other_line();
  void drop_half();

  double range_rad_;
  std::string line_;
  bool line_too_long_ = false;
  std::optional<HalfPair> half_;
  bool version_awaited_ = false;
  std::string version_;
  Dpg2Counters counters_;
};

}  // namespace ols::sensors
