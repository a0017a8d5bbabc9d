// Where one station loses targets that it should see: directions in which something may stand that
// neither the model of the land nor the station's pictures show. Pure.
//
// The station's view is divided into cells of a quarter of a degree. Each pass of a target through
// a cell is a trial: the station either sees the target there, or loses it before the cell and
// finds it again behind. What hides targets stands on the ground. A loss therefore counts for the
// cell and for all cells below it, a pass in sight for the cell and for all cells above it. The
// odds that a cell is hidden begin with 1 : 10 000. A loss multiplies them by 0.9 / p, a pass in
// sight by 0.1 / (1 - p). p is the station's share of losses by chance: the share of the passes
// that were the first loss at their azimuth. The odds are never smaller than at the beginning, so
// that the passes before a crane was put up do not delay its discovery.
#pragma once

#include <array>
#include <compare>
#include <map>
#include <vector>

#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::fusion {

// A region of directions; from_azimuth_rad may be greater than to_azimuth_rad (across north).
struct LostPlace {
  double from_azimuth_rad = 0.0, to_azimuth_rad = 0.0;
  double from_elevation_rad = 0.0, to_elevation_rad = 0.0;
};

class LostPlaces {
 public:
  struct Cell {
    int azimuth = 0;    // clockwise from north
    int elevation = 0;  // from kLowest_rad upwards
    auto operator<=>(const Cell&) const = default;
  };
  static constexpr double kCell_rad = radians(0.25), kLowest_rad = radians(-30.0);

  // Elevations beyond those of the cells are taken as the lowest or the highest cell.
  static Cell cell_of(const AzimuthElevation& direction);

  // A target passed the cell at this distance, in sight or lost.
  void seen(const Cell& cell, double distance_m);
  void lost(const Cell& cell, double distance_m);

  // The probability that something hides a target in this direction, at this distance. It hides
  // nothing that is nearer than the targets that were lost there.
  double probability(const AzimuthElevation& direction, double distance_m) const;
  bool may_hide() const { return !columns_.empty(); }
  // The regions in which targets are lost, from one azimuth to another, if something almost
  // certainly stands there. Their elevations are those at which targets were lost.
  std::vector<LostPlace> places() const;

 private:
  static constexpr int kAround = 1440, kUpwards = 480;

  struct Column {  // of an azimuth
    // Beyond those of the beginning; they do not increase upwards as long as only losses count.
    std::array<double, kUpwards> log_odds{};
    double from_m = 0.0;                 // least distance of a target that was lost
    int lowest = kUpwards, highest = 0;  // at which targets were lost
  };
  static double probability(double log_odds);
  static double most_probable(const Column& column);
  double by_chance() const;
  bool is_probable(int azimuth) const;

  std::map<int, Column> columns_;  // by azimuth; only those with more than the least odds
  int passes_ = 0, first_losses_ = 0;
};

}  // namespace ols::fusion
