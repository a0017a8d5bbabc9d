// Estimates one target's position at an instant. Several estimators share one interface and are
// chosen by name:
//  - filter: the track's own filter (track_filter.h), over time, with velocity;
//  - least-squares: the joint maximum likelihood of all rays at the instant (least_squares.h);
//  - paper: the estimator of the OLS paper (paper_triangulation.h); PaperConfig switches its parts
//    on and off.
// Which bearings belong to the target is decided before, by the track manager (track_manager.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "central/estimators/alignment.h"
#include "central/estimators/least_squares.h"
#include "central/estimators/paper_triangulation.h"
#include "central/tracking/track.h"

namespace ols::fusion {

struct EstimatorConfig {
  AlignmentConfig alignment{};
  LeastSquaresConfig least_squares{};
  PaperConfig paper{};
};

struct ContributingStation {
  std::string station;
  bool used = false;
  double weight = 0.0;
  double age_s = 0.0;
};

struct Located {
  Estimate estimate;
  std::vector<ContributingStation> stations;  // sorted by id
};

// The number of instants without a position, by reason.
using Unlocated = std::map<Solution, std::size_t>;

// The data of one target. Only the "filter" estimator needs the filter.
struct TrackView {
  const StationBearings& bearings;
  const BiasModel& errors;
  const TrackFilter* filter = nullptr;
};

// The estimator of one target. It may keep state from earlier instants.
class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual const char* name() const = 0;
  // Must be called with instants in order of time.
  virtual Located locate(const TrackView& target, std::int64_t epoch_us) = 0;
};

inline constexpr const char* kEstimators[] = {"filter", "least-squares", "paper"};

// Whether the estimator predicts the target's motion. Such an estimator is nearly as accurate
// shortly after a station's last bearing as at that bearing. Other estimators have to extrapolate
// the bearings.
inline bool predicts(std::string_view name) { return name == "filter"; }

// Returns null for an unknown name.
std::unique_ptr<Estimator> make_estimator(std::string_view name, const EstimatorConfig& config);

// The stations whose bearings the filter used recently, sorted by id.
std::vector<ContributingStation> contributing(const TrackFilter& filter, std::int64_t epoch_us);

// Makes an estimate from a filter's state. First checks the geometry with judge_position(). The
// covariance includes the systematic part. The crossing angle and the residual are those of the
// stations whose bearings were used shortly before state.utime_us.
Estimate estimate_of(const TrackFilter& filter, const KinematicState& state,
                     const SystematicPart& systematic);

}  // namespace ols::fusion
