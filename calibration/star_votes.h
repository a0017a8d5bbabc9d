// Finds candidates for the heading: pairs of a detection and a star vote for turns about the
// vertical. This is the first, rough step of calibration/star_identification.h.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "calibration/star_identification.h"

namespace ols::calibration {

// A frame's detections, as directions at heading 0, and the stars that could appear in the frame at
// some heading.
struct SeenFrame {
  struct Detection {
    std::size_t index = 0;  // in the frame's detections
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    AzimuthElevation at;
  };
  struct SkyStar {
    std::size_t index = 0;  // in the table
    Eigen::Vector3d enu = Eigen::Vector3d::UnitY();
    AzimuthElevation at;
  };
  UnitReading reading;
  std::vector<Detection> detections;
  std::vector<SkyStar> sky;
  AzimuthElevation axis;                        // direction of the image centre, at heading 0
  double across_sd_rad = 0.0, up_sd_rad = 0.0;  // 1-sigma, from the station's parameters
};

// A detection of a frame and a star, by their indices.
struct StarPair {
  std::size_t frame = 0, seen = 0, star = 0;
};

struct StarHypothesis {
  double heading_rad = 0.0;
  int votes = 0;  // sum over all frames
  std::vector<StarPair> pairs;
};

class StarVotes {
 public:
  StarVotes(const StationPrior& station, std::span<const StarFrame> frames,
            const StarConditions& conditions, std::span<const TableStar> table);

  const std::vector<SeenFrame>& frames() const { return frames_; }
  // The headings with the most votes, best first.
  std::vector<StarHypothesis> hypotheses() const;

 private:
  // The votes of one frame, on a grid of cells over the heading (turn) and a shift of elevation
  // (lift). One row of turns for each lift.
  struct Cells {
    int turns = 0, lifts = 0;
    std::vector<int> votes;
    int wrapped(int turn) const { return (turn % turns + turns) % turns; }
    // The sum of 2 x 2 cells: the votes for one turn may lie on both sides of a cell's edge.
    int block(int turn, int lift) const;
  };
  struct Peak {
    std::size_t frame = 0;
    int turn = 0, lift = 0, votes = 0;
  };
  SeenFrame seen(const StationPrior& station, const StarFrame& frame,
                 const StarConditions& conditions, const std::vector<Star>& stars) const;
  Cells cells_of(const SeenFrame& frame) const;
  std::pair<int, int> cell(const SeenFrame& frame, const Cells& cells, std::size_t seen,
                           std::size_t star) const;
  std::vector<Peak> peaks(std::size_t frame) const;
  // The best cell of a frame near this heading.
  Peak nearby(std::size_t frame, double heading_rad, double slack_rad) const;
  StarHypothesis hypothesis(const Peak& peak) const;
  void add_pairs(const Peak& peak, StarHypothesis& to) const;

  std::vector<SeenFrame> frames_;
  std::vector<Cells> cells_;
};

}  // namespace ols::calibration
