// One line of SBS, the format of aircraft receivers: cells separated by commas. The first is the
// type of the message. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

class SbsLine {
 public:
  // The cells in use: the time of the message, as text, and the data of the aircraft.
  enum Cell : std::size_t {
    kType = 0,
    kAddress = 4,
    kDate = 6,
    kTime = 7,
    kCallsign = 10,
    kHeightFt = 11,  // pressure altitude
    kSpeedKt = 12,
    kTrackDeg = 13,
    kLatitudeDeg = 14,
    kLongitudeDeg = 15,
    kClimbFtMin = 16,
  };

  explicit SbsLine(const std::string& line);

  // Empty if the line has no such cell.
  const std::string& text(Cell cell) const;
  // nullopt if the cell is empty or no finite number.
  std::optional<double> number(Cell cell) const;
  // The aircraft's address: six hexadecimal digits, in lower case; nullopt: none.
  std::optional<std::string> icao() const;

 private:
  std::vector<std::string> cells_;
};

}  // namespace ols
