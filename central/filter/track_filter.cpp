#include "central/filter/track_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "central/filter/bias_observability.h"
#include "central/measurement/time_span.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

// Without the directions in which it is negative. Reads the lower triangle.
Eigen::Matrix3d positive_part(const Eigen::Matrix3d& difference) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(difference);
  const Eigen::Vector3d values = axes.eigenvalues().cwiseMax(0.0);
  return axes.eigenvectors() * values.asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace

TrackFilter::TrackFilter(const FilterConfig& config, std::int64_t utime_us,
                         const FilterStart& start)
    : config_(config), models_(config.motion, utime_us, start), mixed_us_(utime_us) {
  refresh();
}

// A station seldom moves, and computing its axes costs as much as a good part of the filter.
RayFrame TrackFilter::frame_of(const BearingMeasurement& measurement, int station) const {
  if (station < 0) return ray_frame(measurement.sight);
  const FilterStation& known = stations_[static_cast<std::size_t>(station)];
  const bool same = known.sight.origin_ecef == measurement.sight.origin_ecef;
  return same ? ray_frame(measurement.sight, known.R_ecef_enu) : ray_frame(measurement.sight);
}

Eigen::Index TrackFilter::first_of(int station) const {
  Eigen::Index first = 9;
  for (int i = 0; i < station; ++i) first += states_of(priors_[static_cast<std::size_t>(i)]);
  return first;
}

StationPart TrackFilter::part_of(int station, const RayFrame& frame) const {
  const auto index = static_cast<std::size_t>(station);
  const Eigen::Matrix3d& R = stations_[index].R_ecef_enu;
  return {first_of(station), priors_[index].position_states,
          shift_by_rotation(R.transpose() * frame.tangent), R};
}

bool TrackFilter::place_matters(const LineOfSight& sight) const {
  const double range_m = (models_[0].mean.head<3>() - sight.origin_ecef).norm();
  const double all = stated_covariance(sight, range_m).trace();
  const double of_place =
      all - sight.covariance_systematic.trace() + 2.0 * std::pow(sight.aim_sd_rad, 2);
  return of_place > 0.0 && of_place >= config_.place_share * all;
}

// New states, or those of the station that is silent longest if all are in use; -1: none free.
int TrackFilter::claim_station_states(const BearingMeasurement& measurement) {
  if (stations_.size() < kFilterStations) {
    stations_.emplace_back();
    priors_.push_back({.position_states = place_matters(measurement.sight)});
    const Eigen::Index n = models_[0].mean.size(), more = states_of(priors_.back());
    for (FilterGaussian& model : models_.each()) insert_states(n, more, model);
    return static_cast<int>(stations_.size()) - 1;
  }
  const auto silent = std::ranges::min_element(
      stations_, {}, [](const FilterStation& s) { return s.last_offered.last_us; });
  if (silent->last_offered.age_s(measurement.utime_us) < Activity::kFollowsS) return -1;
  const int station = static_cast<int>(silent - stations_.begin());
  without_states_.erase(measurement.station);
  silent->sight = measurement.sight;
  if (place_matters(measurement.sight)) add_position_states(station);
  return station;
}

BiasPrior TrackFilter::prior_of(const BearingMeasurement& measurement, const BiasModel& priors,
                                bool position_states) const {
  const double range_m = (models_[0].mean.head<3>() - measurement.sight.origin_ecef).norm();
  return priors.prior(measurement.station, measurement.sight, range_m, position_states);
}

void TrackFilter::enter(int station, const BearingMeasurement& measurement,
                        const BiasModel& priors) {
  stations_[static_cast<std::size_t>(station)] = {
      .station = measurement.station,
      .sight = measurement.sight,
      .R_ecef_enu = R_ecef_enu(measurement.sight.origin_ecef),
      .last_used = {},
      .last_offered = {},
      .calibration_id = measurement.calibration_id,
      .track_id = measurement.track_id};
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  prior = prior_of(measurement, priors, prior.position_states);
  const Eigen::Index at = first_of(station), n = states_of(prior);
  for (FilterGaussian& model : models_.each()) {
    model.mean.segment(at, n).setZero();
    model.covariance.middleRows(at, n).setZero();
    model.covariance.middleCols(at, n).setZero();
    model.covariance.diagonal().segment<3>(at) = prior.rotation;
    model.covariance(at + kCameraState, at + kCameraState) = prior.camera;
    if (!prior.position_states) continue;
    model.covariance.block<kPlaceStates, kPlaceStates>(at + kPoseStates, at + kPoseStates) =
        prior.place_m2;
  }
}

// Without the station's part if the filter has no states of it.
Innovation TrackFilter::compare(const BearingMeasurement& measurement, int station) const {
  Innovation seen;
  seen.state = state_;
  seen.frame = frame_of(measurement, station);
  if (station >= 0) seen.part = part_of(station, seen.frame);
  const StationPart* const part = seen.part ? &*seen.part : nullptr;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    seen.models[m] = innovation_of(models_, m, measurement, seen.frame, part, about_);
  }
  return seen;
}

Innovation TrackFilter::innovation(const BearingMeasurement& measurement,
                                   const BiasModel& priors) const {
  const int station = index_of(measurement.station);
  Innovation seen = compare(measurement, station);
  Eigen::Matrix2d more =
      measurement.sight.covariance_white * priors.noise_scale(measurement.station);
  if (station < 0) {
    more += prior_of(measurement, priors, false).covariance;
  } else {  // its bias may be that of another pose or of another point of the target
    const FilterStation& known = stations_[static_cast<std::size_t>(station)];
    const bool same = known.calibration_id == measurement.calibration_id &&
                      known.track_id == measurement.track_id;
    if (!same) more += prior_of(measurement, priors, false).covariance;
  }
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const ModelInnovation& own = seen.models[m];
    if (!(own.depth_m > 0.0)) continue;
    Eigen::Matrix2d S = own.covariance + more;
    if (!seen.part) {
      const Eigen::Vector2d clock = own.J * own.velocity * measurement.clock_sd_s;
      S += clock * clock.transpose();
    }
    seen.nis = std::min(seen.nis, own.residual.dot(S.llt().solve(own.residual)));
  }
  return seen;
}

FilterUpdate TrackFilter::update(const BearingMeasurement& measurement, const BiasModel& priors,
                                 const Innovation* known) {
  FilterUpdate update{.evidence = BiasModel::evidence_on(priors)};
  constexpr double kLatestS = 2.0;  // a bearing later than this is not compared any more
  if (seconds(utime_us() - measurement.utime_us) > kLatestS) return update;
  predict(measurement.utime_us, update.evidence);
  take(measurement, known, update);
  refresh();
  return update;
}

// The target was designated again at the station, which now follows another point of it: its bias
// variance returns to the prior of the new designation, but the correlation with the other states
// stays. Otherwise a station that changes the point with each frame would seem to have a new bias
// each time, and it would average out.
void TrackFilter::reset_bias(int station, const BearingMeasurement& measurement,
                             const BiasModel& priors) {
  stations_[static_cast<std::size_t>(station)].track_id = measurement.track_id;
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  prior = prior_of(measurement, priors, prior.position_states);
  const Eigen::Index at = first_of(station);
  for (FilterGaussian& model : models_.each()) {
    auto variance = model.covariance.diagonal().segment<kPoseStates>(at).array();
    variance.head<3>() = variance.head<3>().max(prior.rotation);
    variance(kCameraState) = std::max(variance(kCameraState), prior.camera);
    if (!prior.position_states) continue;
    auto place =
        model.covariance.block<kPlaceStates, kPlaceStates>(at + kPoseStates, at + kPoseStates);
    place += positive_part(prior.place_m2 - place);
  }
}

// The station's states, new for a new station or calibration, with its clock error as currently
// stated. -1: none free.
int TrackFilter::station_of(const BearingMeasurement& measurement, const BiasModel& priors) {
  int station = index_of(measurement.station);
  const bool is_new = station < 0;
  if (is_new) station = claim_station_states(measurement);
  if (station < 0) return station;
  const FilterStation& known = stations_[static_cast<std::size_t>(station)];
  if (is_new || known.calibration_id != measurement.calibration_id) {
    enter(station, measurement, priors);
    ++state_;
  } else if (known.track_id != measurement.track_id) {
    reset_bias(station, measurement, priors);
    ++state_;
  }
  FilterStation& entry = stations_[static_cast<std::size_t>(station)];
  entry.last_offered.note(measurement.utime_us);
  entry.weight = 0.0;
  entry.stated_clock_sd_s = measurement.clock_sd_s;
  const double clock_sd_s =
      measurement.clock_sd_s * std::sqrt(priors.clock_scale(measurement.station));
  // A worse clock counts at once, a better one as the old error fades.
  if (clock_sd_s > entry.clock_sd_s) {
    const Eigen::Index at = first_of(station) + kClockState;
    const double more = std::pow(clock_sd_s, 2) - std::pow(entry.clock_sd_s, 2);
    for (FilterGaussian& model : models_.each()) model.covariance(at, at) += more;
    ++state_;
  }
  entry.clock_sd_s = clock_sd_s;
  return station;
}

// At the state's own instant, or for a late bearing.
void TrackFilter::take(const BearingMeasurement& measurement, const Innovation* known,
                       FilterUpdate& update) {
  const int station = station_of(measurement, update.evidence);
  if (station < 0) {
    take_without_states(measurement, update);
    return;
  }
  const Eigen::Matrix2d white =
      measurement.sight.covariance_white * update.evidence.noise_scale(measurement.station);
  const bool at_hand = known != nullptr && known->state == state_;
  const Innovation own = at_hand ? Innovation() : compare(measurement, station);
  const Innovation& seen = at_hand ? *known : own;
  const auto judged = judge(seen, models_.size(), white, config_.gate_nis);
  update.use = BearingUse::kBehindCamera;
  if (!judged) return;
  update.nis = judged->nis;
  update.evidence.observe_residual(measurement.station, judged->noise);
  FilterStation& entry = stations_[static_cast<std::size_t>(station)];
  ++state_;
  update.use = BearingUse::kRejected;
  // Written so that a NIS that is not a number is rejected, too.
  if (!(judged->nis <= config_.gate_nis)) return reject(entry);
  rejections_.clear();
  update.use = BearingUse::kUsed;
  entry.note_use(measurement, judged->nis, weight_of(judged->nis));
  // What turns two lines of sight to meet is what shows an inconsistent pair: it is estimated.
  const bool judges_pairs = std::isfinite(config_.two_stations_nis);
  const bool redundant = is_redundant(stations_, entry);
  const bool may_learn =
      (judges_pairs || redundant) &&
      is_linear(*seen.part, seen.frame, seen.models[0].depth_m,
                summary_.covariance.topLeftCorner<3, 3>(), models_[0].covariance, white);
  // Without redundancy, coloured noise looks like motion: what is not new in each bearing counts as
  // bias, and does not smooth the track.
  const double coloured = entry.noise.observe(measurement, seen.frame, update.evidence);
  const double inflation =
      redundant ? coloured : update.evidence.greatest_white_share(measurement.station);
  correct(seen, white * (inflation / entry.weight), may_learn ? &seen.frame.direction : nullptr);
}

// A bias without states counts as noise of which every bearing within the filter's memory has the
// same.
void TrackFilter::take_without_states(const BearingMeasurement& measurement, FilterUpdate& update) {
  constexpr double kMemoryS = 0.3;
  const auto [own, is_new] = without_states_.try_emplace(measurement.station);
  FilterStation& entry = own->second;
  if (is_new) {
    entry.station = measurement.station;
    entry.sight = measurement.sight;
  }
  const double interval_s =
      std::clamp(entry.last_offered.age_s(measurement.utime_us), 1e-3, kMemoryS);
  entry.last_offered.note(measurement.utime_us);
  entry.weight = 0.0;
  const Innovation seen = compare(measurement, -1);
  const double range_m = (position() - measurement.sight.origin_ecef).norm();
  Eigen::Matrix2d bias =
      update.evidence.prior(measurement.station, measurement.sight, range_m).covariance;
  const Eigen::Vector2d clock = seen.models[0].J * velocity() * measurement.clock_sd_s;
  bias += clock * clock.transpose();
  const Eigen::Matrix2d white =
      measurement.sight.covariance_white * update.evidence.noise_scale(measurement.station);
  update.use = BearingUse::kBehindCamera;
  const auto judged = judge(seen, models_.size(), white + bias, config_.gate_nis);
  if (!judged) return;
  update.nis = judged->nis;
  update.evidence.observe_residual(measurement.station, judged->noise);
  update.use = BearingUse::kRejected;
  if (!(judged->nis <= config_.gate_nis)) {
    ++entry.rejected;
    return;
  }
  ++state_;
  update.use = BearingUse::kUsed;
  entry.note_use(measurement, judged->nis, weight_of(judged->nis));
  const Eigen::Matrix2d noise = white + bias * (1.0 + 2.0 * kMemoryS / interval_s);
  correct(seen, noise / weight_of(judged->nis), nullptr);
}

// Where biases are not observable, the stations' states are only considered, not estimated.
void TrackFilter::correct(const Innovation& seen, const Eigen::Matrix2d& noise,
                          const Eigen::Vector3d* along) {
  bool finds_bias = along != nullptr;
  std::array<double, kMotions> log_likelihood{};
  for (std::size_t m = 0; m < models_.size(); ++m) {
    FilterGaussian& model = models_.each()[m];
    const ModelInnovation& own = seen.models[m];
    const Eigen::LLT<Eigen::Matrix2d> S(own.covariance + noise);
    const Eigen::Matrix2d L = S.matrixL();
    const Eigen::Vector2d whitened = S.matrixL().solve(own.residual);
    // The gain is G L^-1 with G = P H^T L^-T.
    const Eigen::Vector2d by = L.diagonal().cwiseInverse();
    Eigen::Matrix2d inverse_t;  // written out: a solver for any size takes twenty times as long
    inverse_t << by(0), -(L(1, 0) * by(1)) * by(0), 0.0, by(1);
    const FilterMatrix2 G = own.cross(model.covariance, seen.part).lazyProduct(inverse_t);
    if (m == 0 && finds_bias) {
      const double off_share = (1.0 - S.solve(noise).trace() / 2.0) / own.depth_m;
      finds_bias = shows_bias(G, model.covariance, *seen.part, *along, off_share);
    }
    const Eigen::Index found = finds_bias ? G.rows() : 9;
    model.mean.head(found) += G.topRows(found) * whitened;
    subtract_square(G, found, model.covariance);
    log_likelihood[m] = -whitened.squaredNorm() / 2.0 - std::log(L(0, 0) * L(1, 1));
  }
  models_.weigh(std::span(log_likelihood).first(models_.size()));
}

void TrackFilter::reject(FilterStation& entry) {
  ++entry.rejected;
  if (rejections_.add(entry.station)) {
    inflate(config_.motion.acceleration_time_s, Eigen::Matrix3d::Identity());
  } else if (entry.rejected % ConsecutiveRejections::kMany == 0) {
    inflate_unseen_by_other(entry);
  }
}

// One station alone never disagrees: its bearings move the target along its line of sight. Where
// the target has turned hard along one line of sight, only the other of two stations sees it.
void TrackFilter::inflate_unseen_by_other(const FilterStation& entry) {
  if (entry.used == 0 || agreed_since(entry) != 1) return;
  const auto other = std::ranges::max_element(
      stations_, {}, [](const FilterStation& s) { return s.last_used.last_us; });
  const Eigen::Vector3d line = (position() - other->sight.origin_ecef).normalized();
  const double since_s = entry.last_used.age_s(utime_us());
  inflate(std::min(since_s, config_.motion.acceleration_time_s), line * line.transpose());
}

void TrackFilter::inflate(double time_s, const Eigen::Matrix3d& along) {
  rejections_.clear();
  models_.inflate(time_s, along, velocity());
}

void TrackFilter::predict(std::int64_t utime_us, BiasModel& evidence) {
  if (utime_us <= models_.utime_us()) return;
  ++state_;
  models_.predict(utime_us);
  const double since_s = seconds(utime_us - mixed_us_);
  if (since_s < config_.mixing_s) return;
  mixed_us_ = utime_us;
  refresh();
  move_biases(since_s, evidence);
  models_.interact(since_s);
}

// Each station's bias estimate is reported as evidence, then propagated by its prior.
void TrackFilter::move_biases(double dt_s, BiasModel& evidence) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    FilterStation& station = stations_[i];
    const int index = static_cast<int>(i);
    if (!priors_[i].position_states && place_matters(station.sight)) add_position_states(index);
    const double range_m = (position() - station.sight.origin_ecef).norm();
    if (station.last_used.age_s(utime_us()) < 2.0 * config_.mixing_s + dt_s) {
      const StationBias now = bias(i);
      evidence.observe(station.station, station.sight,
                       {now.bias_rad, now.covariance_rad2.diagonal(), now.prior_rad2.diagonal()},
                       dt_s, range_m);
      evidence.observe_clock(station.station, now.clock_s, std::pow(now.clock_sd_s, 2),
                             std::pow(now.clock_prior_sd_s, 2),
                             std::pow(station.stated_clock_sd_s, 2), dt_s);
    }
    priors_[i] =
        evidence.prior(station.station, station.sight, range_m, priors_[i].position_states);
  }
  fade_biases(dt_s, evidence.clock_time_s());
}

// The station gets position states: a target has come nearer.
void TrackFilter::add_position_states(int station) {
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  if (prior.position_states) return;
  const Eigen::Index first = first_of(station) + kPoseStates;
  prior.position_states = true;
  const LineOfSight& sight = stations_[static_cast<std::size_t>(station)].sight;
  prior.place_m2 = place_covariance(sight, (position() - sight.origin_ecef).norm());
  for (FilterGaussian& model : models_.each()) {
    insert_states(first, kPlaceStates, model);
    model.covariance.block<kPlaceStates, kPlaceStates>(first, first) = prior.place_m2;
  }
}

// Each of the stations' states decays, and gets the noise that keeps its prior variance.
void TrackFilter::fade_biases(double dt_s, double clock_time_s) {
  const Eigen::Index n = models_[0].mean.size();
  FilterVector rate = FilterVector::Zero(n), variance = FilterVector::Zero(n);
  Eigen::Index at = 9;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const BiasPrior& prior = priors_[i];
    rate.segment<kPoseStates>(at) << Eigen::Array3d::Constant(1.0 / prior.time_s),
        1.0 / clock_time_s, 1.0 / prior.time_s;
    variance.segment<kPoseStates>(at) << prior.rotation, std::pow(stations_[i].clock_sd_s, 2),
        prior.camera;
    if (prior.position_states) {
      rate.segment<kPlaceStates>(at + kPoseStates).setConstant(1.0 / prior.place_time_s);
      variance.segment<kPlaceStates>(at + kPoseStates) = prior.place_m2.diagonal();
    }
    at += states_of(prior);
  }
  const FilterVector decay = (-dt_s * rate.array()).exp();
  const FilterVector added = (1.0 - decay.array().square()) * variance.array();
  for (FilterGaussian& model : models_.each()) {
    scale(decay, model);
    model.covariance.diagonal() += added;
  }
}

StationBias TrackFilter::bias(std::size_t station) const {
  const FilterStation& entry = stations_[station];
  const double range_m = (position() - entry.sight.origin_ecef).norm();
  auto bias = station_bias(models_, first_of(static_cast<int>(station)), priors_[station],
                           entry.sight, range_m);
  bias.clock_prior_sd_s = entry.clock_sd_s;
  return bias;
}

}  // namespace ols::fusion
