#include "central/track_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "central/time_span.h"
#include "geometry/wgs84.h"

namespace ols {
namespace {

constexpr double kLatestS = 2.0;  // a bearing later than this is no longer compared
constexpr double kPlaceS = 1.0;   // who is silent for longer gives its states up to another
constexpr double kLeastProbability = 1e-4;

Eigen::Vector3d moved_on(const KinematicState& state, std::int64_t utime_us) {
  const double dt_s = seconds(utime_us - state.utime_us);
  return state.mean.head<3>() + dt_s * state.mean.segment<3>(3) +
         dt_s * dt_s / 2.0 * state.mean.tail<3>();
}

}  // namespace

// How a station's own states move its bearing on the tangent plane.
struct TrackFilter::StationPart {
  Eigen::Index first = 0;
  bool has_place = false;
  Eigen::Matrix<double, 2, 3> by_rotation;
  Eigen::Matrix3d R_ecef_enu;
};

// A model's expectation of one bearing against it: H = [J, ahead J, curved J] of the target, and of
// the station its pose's and its place's.
struct TrackFilter::Innovation {
  double depth_m = 0.0;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the residual, without noise
  Eigen::Matrix<double, 2, 3> J;
  double ahead_s = 0.0, curved_s2 = 0.0;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // at which a clock's error counts
  Eigen::Matrix<double, 2, kPoseStates> by_pose;
  Eigen::Matrix<double, 2, kPlaceStates> by_place;

  void see_target(const FilterMatrix& P);
  void see_station(const FilterGaussian& state, const StationPart& part);
  FilterMatrix2 cross(const FilterMatrix& P, const StationPart& part) const;
};

TrackFilter::TrackFilter(const FilterConfig& config, std::int64_t utime_us,
                         const FilterStart& start)
    : config_(config), utime_us_(utime_us), mixed_us_(utime_us) {
  if (motions().empty() || motions().size() > kMotions) {
    throw std::invalid_argument("a filter mixes one to three motion models");
  }
  models_.resize(motions().size());
  probabilities_.assign(models_.size(), 1.0 / static_cast<double>(models_.size()));
  for (FilterGaussian& model : models_) {
    model.mean = FilterVector::Zero(9);
    model.mean.head<3>() = start.p_ecef;
    model.mean.segment<3>(3) = start.v_ecef;
    model.covariance = FilterMatrix::Zero(9, 9);
    Vector9 variance;
    variance.head<3>().setConstant(start.position_sd_m * start.position_sd_m);
    variance.segment<3>(3).setConstant(start.velocity_sd_m_s * start.velocity_sd_m_s);
    const double hard = manoeuvre_sd(Eigen::Vector3d::Zero(), config.motion);
    variance.tail<3>().setConstant(hard * hard);
    model.covariance.diagonal() = variance;
  }
  refresh();
}

int TrackFilter::index_of(const std::string& station) const {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (stations_[i].station == station) return static_cast<int>(i);
  }
  return -1;
}

// A station seldom moves, and to find its axes costs as much as a good part of the filter.
RayFrame TrackFilter::frame_of(const Sighting& sighting, int station) const {
  if (station < 0) return ray_frame(sighting.sight);
  const FilterStation& known = stations_[static_cast<std::size_t>(station)];
  const bool same = known.sight.origin_ecef == sighting.sight.origin_ecef;
  return same ? ray_frame(sighting.sight, known.R_ecef_enu) : ray_frame(sighting.sight);
}

Eigen::Index TrackFilter::first_of(int station) const {
  Eigen::Index first = 9;
  for (int i = 0; i < station; ++i) first += states_of(priors_[static_cast<std::size_t>(i)]);
  return first;
}

TrackFilter::StationPart TrackFilter::part_of(int station, const RayFrame& frame) const {
  const auto index = static_cast<std::size_t>(station);
  const Eigen::Matrix3d& R = stations_[index].R_ecef_enu;
  return {first_of(station), priors_[index].place_apart,
          shift_by_rotation(R.transpose() * frame.tangent), R};
}

bool TrackFilter::place_matters(const LineOfSight& sight) const {
  const double range_m = (models_[0].mean.head<3>() - sight.origin_ecef).norm();
  const double all = stated_covariance(sight, range_m).trace();
  const double of_place = all - sight.covariance_systematic.trace();
  return of_place > 0.0 && of_place >= config_.place_share * all;
}

// New states, or those of the station that is silent longest where all are given away; -1: none.
int TrackFilter::take_place(const Sighting& sighting) {
  if (stations_.size() < kFilterStations) {
    stations_.emplace_back();
    priors_.push_back({.place_apart = place_matters(sighting.sight)});
    const Eigen::Index n = models_[0].mean.size(), more = states_of(priors_.back());
    for (FilterGaussian& model : models_) insert_states(n, more, model);
    return static_cast<int>(stations_.size()) - 1;
  }
  const auto silent = std::ranges::min_element(stations_, {}, &FilterStation::offered_us);
  if (seconds(sighting.utime_us - silent->offered_us) < kPlaceS) return -1;
  const int station = static_cast<int>(silent - stations_.begin());
  silent->sight = sighting.sight;
  if (place_matters(sighting.sight)) tell_place_apart(station);
  return station;
}

void TrackFilter::enter(int station, const Sighting& sighting, const StationErrors& errors) {
  stations_[static_cast<std::size_t>(station)] = {
      .station = sighting.station,
      .sight = sighting.sight,
      .R_ecef_enu = R_ecef_enu(sighting.sight.origin_ecef),
      .calibration_id = sighting.calibration_id,
      .track_id = sighting.track_id};
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  const double range_m = (models_[0].mean.head<3>() - sighting.sight.origin_ecef).norm();
  prior = errors.prior(sighting.station, sighting.sight, range_m, prior.place_apart);
  const Eigen::Index at = first_of(station), n = states_of(prior);
  for (FilterGaussian& model : models_) {
    model.mean.segment(at, n).setZero();
    model.covariance.middleRows(at, n).setZero();
    model.covariance.middleCols(at, n).setZero();
    model.covariance.diagonal().segment<3>(at) = prior.rotation;
    if (!prior.place_apart) continue;
    model.covariance.diagonal().segment<kPlaceStates>(at + kPoseStates) = prior.place_m2;
  }
}

// The part of the target's own states.
void TrackFilter::Innovation::see_target(const FilterMatrix& P) {
  Eigen::Matrix3d position = whole_block<3>(P, 0);
  if (ahead_s != 0.0) {
    const Matrix9 all = whole_block<9>(P, 0);
    const Eigen::Matrix<double, 9, 3> then =
        all.leftCols<3>() + ahead_s * all.middleCols<3>(3) + curved_s2 * all.rightCols<3>();
    position =
        then.topRows<3>() + ahead_s * then.middleRows<3>(3) + curved_s2 * then.bottomRows<3>();
  }
  covariance = J * position * J.transpose();
}

// That of the station's states.
void TrackFilter::Innovation::see_station(const FilterGaussian& state, const StationPart& part) {
  const Eigen::Index pose = part.first, place = part.first + kPoseStates;
  const FilterMatrix& P = state.covariance;
  const auto with_target = [&]<int K>(const Eigen::Matrix<double, 2, K>& H, Eigen::Index at) {
    Eigen::Matrix<double, K, 3> then = P.block<K, 3>(at, 0);
    if (ahead_s != 0.0) then += ahead_s * P.block<K, 3>(at, 3) + curved_s2 * P.block<K, 3>(at, 6);
    return Eigen::Matrix2d(H * then * J.transpose());
  };
  by_pose << part.by_rotation, -J * velocity;
  Eigen::Matrix2d mixed = with_target(by_pose, pose);
  residual -= by_pose * state.mean.segment<kPoseStates>(pose);
  covariance += by_pose * whole_block<kPoseStates>(P, pose) * by_pose.transpose();
  if (part.has_place) {
    by_place = -J * part.R_ecef_enu;
    residual -= by_place * state.mean.segment<kPlaceStates>(place);
    covariance += by_place * whole_block<kPlaceStates>(P, place) * by_place.transpose();
    mixed += with_target(by_place, place);
    mixed += by_place * P.block<kPlaceStates, kPoseStates>(place, pose) * by_pose.transpose();
  }
  covariance += mixed + mixed.transpose();
}

// P H^T, the covariance of the whole state with the residual.
FilterMatrix2 TrackFilter::Innovation::cross(const FilterMatrix& P, const StationPart& part) const {
  FilterMatrix2 result = FilterMatrix2::Zero(P.rows(), 2);
  add_product<3>(P, 0, J, result);
  if (ahead_s != 0.0) {
    add_product<3>(P, 3, ahead_s * J, result);
    add_product<3>(P, 6, curved_s2 * J, result);
  }
  add_product<kPoseStates>(P, part.first, by_pose, result);
  if (part.has_place) add_product<kPlaceStates>(P, part.first + kPoseStates, by_place, result);
  return result;
}

// Without the station's part where the filter has no states of it.
TrackFilter::Innovation TrackFilter::innovation(std::size_t which, const Sighting& sighting,
                                                const RayFrame& frame,
                                                const StationPart* station) const {
  const Motion motion = motions()[which];
  const FilterGaussian& model = models_[which];
  Innovation result;
  result.ahead_s = seconds(sighting.utime_us - utime_us_);  // < 0: late
  if (motion != Motion::kConstantVelocity) result.curved_s2 = std::pow(result.ahead_s, 2) / 2.0;
  result.velocity = model.mean.segment<3>(3);
  if (about_) result.velocity = about_->mean.segment<3>(3);
  const Eigen::Vector3d p_ecef = model.mean.head<3>() + result.ahead_s * model.mean.segment<3>(3) +
                                 result.curved_s2 * model.mean.segment<3>(6);
  const Eigen::Vector3d about_ecef = about_ ? moved_on(*about_, sighting.utime_us) : p_ecef;
  const Eigen::Vector3d line = about_ecef - sighting.sight.origin_ecef;
  result.depth_m = frame.direction.dot(line);
  if (!(result.depth_m > 0.0)) return result;
  result.residual = -frame.tangent.transpose() * line / result.depth_m;
  result.J =
      (frame.tangent.transpose() + result.residual * frame.direction.transpose()) / result.depth_m;
  result.residual -= result.J * (p_ecef - about_ecef);
  result.see_target(model.covariance);
  if (result.ahead_s != 0.0) {
    const Transition between =
        transition(motion, model.mean.head<9>(), std::abs(result.ahead_s), config_.motion);
    result.covariance += between.q(0, 0) * result.J * result.J.transpose();
  }
  if (station != nullptr) result.see_station(model, *station);
  return result;
}

double TrackFilter::nis(const Sighting& sighting, const StationErrors& errors) const {
  const int station = index_of(sighting.station);
  const RayFrame frame = frame_of(sighting, station);
  Eigen::Matrix2d more = sighting.sight.covariance_white * errors.noise_scale(sighting.station);
  std::optional<StationPart> part;
  if (station < 0) {
    const double range_m = (position() - sighting.sight.origin_ecef).norm();
    more += errors.prior(sighting.station, sighting.sight, range_m).covariance;
  } else {  // what it knows of its bias may be of another pose, or of another point
    part = part_of(station, frame);
    const FilterStation& known = stations_[static_cast<std::size_t>(station)];
    const bool same =
        known.calibration_id == sighting.calibration_id && known.track_id == sighting.track_id;
    if (!same) more += priors_[static_cast<std::size_t>(station)].covariance;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const auto seen = innovation(m, sighting, frame, part ? &*part : nullptr);
    if (!(seen.depth_m > 0.0)) continue;
    Eigen::Matrix2d S = seen.covariance + more;
    if (!part) {
      const Eigen::Vector2d clock = seen.J * seen.velocity * sighting.clock_sd_s;
      S += clock * clock.transpose();
    }
    least = std::min(least, seen.residual.dot(S.llt().solve(seen.residual)));
  }
  return least;
}

BearingUse TrackFilter::update(const Sighting& sighting, StationErrors& errors) {
  if (seconds(utime_us_ - sighting.utime_us) > kLatestS) return BearingUse::kTooLate;
  move_to(sighting.utime_us, errors);
  const BearingUse use = take(sighting, errors);
  refresh();
  return use;
}

// The target was designated to the station anew, and it follows another point of it: its bias may
// be as great as before any bearing, but what it shares with the other states stays. Of a station
// which changes its mind with each frame the bias would else seem new each time, and average out.
void TrackFilter::show_anew(int station, std::int64_t track_id) {
  stations_[static_cast<std::size_t>(station)].track_id = track_id;
  const BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  for (FilterGaussian& model : models_) {
    auto variance = model.covariance.diagonal().segment<3>(first_of(station)).array();
    variance = variance.max(prior.rotation);
  }
}

// The station's states, new where it is new or has another calibration; its clock as it states it
// now. -1: it has none.
int TrackFilter::station_of(const Sighting& sighting, const StationErrors& errors) {
  int station = index_of(sighting.station);
  const bool is_new = station < 0;
  if (is_new) station = take_place(sighting);
  if (station < 0) return station;
  const FilterStation& known = stations_[static_cast<std::size_t>(station)];
  if (is_new || known.calibration_id != sighting.calibration_id) {
    enter(station, sighting, errors);
  } else if (known.track_id != sighting.track_id) {
    show_anew(station, sighting.track_id);
  }
  FilterStation& entry = stations_[static_cast<std::size_t>(station)];
  entry.offered_us = std::max(entry.offered_us, sighting.utime_us);
  entry.weight = 0.0;
  // A worse clock counts at once, a better one as the old error fades.
  if (sighting.clock_sd_s > entry.clock_sd_s) {
    const Eigen::Index at = first_of(station) + 3;
    const double more = std::pow(sighting.clock_sd_s, 2) - std::pow(entry.clock_sd_s, 2);
    for (FilterGaussian& model : models_) model.covariance(at, at) += more;
  }
  entry.clock_sd_s = sighting.clock_sd_s;
  return station;
}

// Against all models: the least squared normalised residual, and what the bearing shows of its
// noise's variance, over the one that is supposed: nothing behind a camera.
std::optional<TrackFilter::Judged> TrackFilter::judge(const Innovations& seen,
                                                      const Eigen::Matrix2d& white) const {
  Judged judged;
  double squared = 0.0, expected = 0.0;  // of the noise's own part of the residual
  for (std::size_t m = 0; m < models_.size(); ++m) {
    if (!(seen[m].depth_m > 0.0)) return std::nullopt;
    const Eigen::LLT<Eigen::Matrix2d> S(seen[m].covariance + white);
    const Eigen::Vector2d scaled = S.solve(seen[m].residual);
    const double here = seen[m].residual.dot(scaled);
    if (here >= judged.nis) continue;
    judged.nis = here;
    squared = scaled.dot(white * scaled);
    expected = S.solve(white).trace();
  }
  // One far off counts as one at the gate (Huber): where noise is many times what is stated, most
  // are, and the others would never show it.
  squared *= std::min(1.0, config_.gate_nis / judged.nis);
  judged.noise = 1.0 + (squared - expected) / 2.0;
  return judged;
}

// At the state's own instant, or late.
BearingUse TrackFilter::take(const Sighting& sighting, StationErrors& errors) {
  const int station = station_of(sighting, errors);
  if (station < 0) {
    return nis(sighting, errors) < config_.gate_nis ? BearingUse::kNoPlace : BearingUse::kSetAside;
  }
  const Eigen::Matrix2d white =
      sighting.sight.covariance_white * errors.noise_scale(sighting.station);
  const RayFrame frame = frame_of(sighting, station);
  const StationPart part = part_of(station, frame);
  Innovations seen;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    seen[m] = innovation(m, sighting, frame, &part);
  }
  const auto judged = judge(seen, white);
  if (!judged) return BearingUse::kBehindCamera;
  errors.observe_residual(sighting.station, judged->noise);
  FilterStation& entry = stations_[static_cast<std::size_t>(station)];
  if (!passes_gate(entry, judged->nis)) return BearingUse::kSetAside;
  note_use(entry, sighting, judged->nis);
  const bool may_learn = is_linear(part, frame, seen[0].depth_m, white);
  const double inflation = observe_noise(entry, sighting, frame, errors);
  correct(seen, part, white * (inflation / entry.weight), may_learn ? &frame.direction : nullptr);
  return BearingUse::kUsed;
}

void TrackFilter::note_use(FilterStation& entry, const Sighting& sighting, double nis) const {
  entry.weight = nis > config_.robust_nis ? config_.robust_nis / nis : 1.0;
  if (entry.sight.origin_ecef != sighting.sight.origin_ecef) {
    entry.R_ecef_enu = R_ecef_enu(sighting.sight.origin_ecef);
  }
  entry.sight = sighting.sight;
  entry.utime_us = std::max(entry.utime_us, sighting.utime_us);
  ++entry.used;
  entry.mean_nis += 0.05 * (nis - entry.mean_nis);
}

// A base that is short for the range hides the difference of its headings, and a linear filter
// would find one in it and be sure: two stations side by side "learn" it, and a wrong range with
// it. There are two ways to that. Biases are then considered but not learnt (the Schmidt-Kalman
// filter, 1966). One is that bias times relative error of the range, which linearisation leaves
// out, is not small against the noise.
bool TrackFilter::is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
                            const Eigen::Matrix2d& white) const {
  constexpr double kSmall = 0.1;
  const Eigen::Matrix3d P = summary_.covariance.topLeftCorner<3, 3>();
  const double depth_variance = frame.direction.dot(P * frame.direction);
  const FilterMatrix& own = models_[0].covariance;
  const auto greatest = [&](const Eigen::Matrix<double, 2, 3>& H, Eigen::Index first) {
    return (H * whole_block<3>(own, first) * H.transpose()).diagonal().maxCoeff();
  };
  double bias_variance = greatest(part.by_rotation, part.first);
  if (part.has_place) {
    bias_variance +=
        greatest(frame.tangent.transpose() * part.R_ecef_enu / depth_m, part.first + kPoseStates);
  }
  const double second_order = bias_variance * depth_variance / (depth_m * depth_m);
  return second_order < kSmall * kSmall * white.trace() / 2.0;
}

// The other is a drift. A bearing's equation is linear about the predicted direction, whose
// error is also in the residual. What a state gains from it is therefore off to one side, in
// every bearing anew, by what goes with the depth, over the depth. Where a bearing tells less
// than that of a state, its mean goes away by sigmas while its variance stays (the same in
// mapping by a moving camera: Huang, Mourikis and Roumeliotis, 2010). Of the states of the
// station's own pose and place, over their sigmas: the drift, and what the bearing tells along
// that. The depth is that from the place, which moves the target along with it.
bool TrackFilter::shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                             const Eigen::Vector3d& along, double off_share) {
  constexpr double kSmall = 3.0;
  const Eigen::Index place = part.first + kPoseStates, clock = part.first + 3;
  double drift = 0.0;  // squared
  Eigen::RowVector2d told = Eigen::RowVector2d::Zero();
  for (Eigen::Index at = part.first; at < (part.has_place ? place + kPlaceStates : clock); ++at) {
    if (at == clock || !(P(at, at) > 0.0)) continue;
    double with_depth = P.block<1, 3>(at, 0).dot(along);
    if (part.has_place) {
      const Eigen::RowVector3d own = at < place ? P.block<3, 1>(place, at).transpose().eval()
                                                : whole_block<3>(P, place).row(at - place).eval();
      with_depth -= own.dot(part.R_ecef_enu.transpose() * along);
    }
    drift += with_depth * with_depth / P(at, at);
    told += with_depth / P(at, at) * G.row(at);
  }
  return drift * std::sqrt(drift) * off_share <= kSmall * told.squaredNorm();
}

// Where biases are not found the stations' states stay as they are and are only considered.
void TrackFilter::correct(const Innovations& seen, const StationPart& part,
                          const Eigen::Matrix2d& noise, const Eigen::Vector3d* along) {
  bool finds_bias = along != nullptr;
  std::array<double, kMotions> log_likelihood{};
  for (std::size_t m = 0; m < models_.size(); ++m) {
    FilterGaussian& model = models_[m];
    const Eigen::LLT<Eigen::Matrix2d> S(seen[m].covariance + noise);
    const Eigen::Matrix2d L = S.matrixL();
    const Eigen::Vector2d whitened = S.matrixL().solve(seen[m].residual);
    // The gain is G L^-1 with G = P H^T L^-T.
    const Eigen::Matrix2d inverse_t = S.matrixU().solve(Eigen::Matrix2d::Identity());
    const FilterMatrix2 G = seen[m].cross(model.covariance, part).lazyProduct(inverse_t);
    if (m == 0 && finds_bias) {
      const double off_share = (1.0 - S.solve(noise).trace() / 2.0) / seen[m].depth_m;
      finds_bias = shows_bias(G, model.covariance, part, *along, off_share);
    }
    const Eigen::Index found = finds_bias ? G.rows() : 9;
    model.mean.head(found) += G.topRows(found) * whitened;
    subtract_square(G, found, model.covariance);
    log_likelihood[m] = -whitened.squaredNorm() / 2.0 - std::log(L(0, 0) * L(1, 1));
  }
  weigh_models(std::span(log_likelihood).first(models_.size()));
}

// Tells the errors how much a bearing differs from the line between its neighbours, and gives how
// much less than stated it is worth.
double TrackFilter::observe_noise(FilterStation& entry, const Sighting& sighting,
                                  const RayFrame& frame, StationErrors& errors) {
  constexpr double kNearS = 0.3;  // further apart the target's own motion shows
  const double first_s = seconds(entry.before_us[1] - entry.before_us[0]);
  const double second_s = seconds(sighting.utime_us - entry.before_us[1]);
  if (second_s <= 0.0) return 1.0;
  if (entry.before_us[0] > 0 && first_s + second_s < kNearS) {
    const double w = second_s / (first_s + second_s);
    const Eigen::Vector3d off = entry.before[1] - w * entry.before[0] - (1.0 - w) * frame.direction;
    const double white = (1.0 + w * w + (1.0 - w) * (1.0 - w)) *
                         errors.noise_scale(sighting.station) *
                         sighting.sight.covariance_white.trace();
    errors.observe_noise(sighting.station, (frame.tangent.transpose() * off).squaredNorm() / white);
  }
  entry.before_us = {entry.before_us[1], sighting.utime_us};
  entry.before = {entry.before[1], frame.direction};
  return first_s + second_s < kNearS ? errors.inflation(sighting.station, second_s) : 1.0;
}

void TrackFilter::weigh_models(std::span<const double> log_likelihood) {
  const double most = *std::ranges::max_element(log_likelihood);
  double sum = 0.0;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    probabilities_[m] *= std::exp(log_likelihood[m] - most);
    probabilities_[m] = std::max(probabilities_[m], kLeastProbability);
    sum += probabilities_[m];
  }
  for (double& probability : probabilities_) probability /= sum;
}

}  // namespace ols
