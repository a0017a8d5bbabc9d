// One line of SBS, a format of aircraft receivers. A line consists of cells that are separated by
// commas; the first cell is the type of the message. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols {

class SbsLine {
 public:
  // Positions of the cells that are read.
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

  // The text of a cell; empty if the line has no such cell.
  const std::string& text(Cell cell) const;
  // nullopt if the cell is empty or holds no finite number.
  std::optional<double> number(Cell cell) const;
  // The aircraft's address: six hexadecimal digits, in lower case; nullopt: the line has none.
  std::optional<std::string> icao() const;

 private:
  std::vector<std::string> cells_;
};

}  // namespace ols
