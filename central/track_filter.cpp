#include "central/track_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "central/time_span.h"
#include "geometry/wgs84.h"

namespace ols {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLatestS = 2.0;  // a bearing later than this is no longer compared
constexpr double kPlaceS = 1.0;   // who is silent for longer gives its states up to another
constexpr int kUpset = 6;         // set-aside bearings in a row, of two stations
constexpr double kLeastProbability = 1e-4;

using MatrixN2 = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kFilterStates, 2>;

// The gain and the residual whitened by the same factor. Without `all` the stations' states stay as
// they are and are only considered. Two columns: Eigen's blocked product is slower.
void add(const MatrixN2& gain, const Eigen::Vector2d& whitened, bool all, FilterVector& mean,
         FilterMatrix& covariance) {
  if (all) {
    mean += gain * whitened;
    covariance.noalias() -= gain.lazyProduct(gain.transpose());
    return;
  }
  const Eigen::Matrix<double, 9, 2> own = gain.topRows<9>();
  const Eigen::Index stations = gain.rows() - 9;
  mean.head<9>() += own * whitened;
  covariance.topLeftCorner<9, 9>() -= own.lazyProduct(own.transpose());
  covariance.topRightCorner(9, stations) -= own.lazyProduct(gain.bottomRows(stations).transpose());
  covariance.bottomLeftCorner(stations, 9) = covariance.topRightCorner(9, stations).transpose();
}

}  // namespace

// A model's expectation of one bearing against it.
struct TrackFilter::Innovation {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of the residual, without noise
  MatrixN2 cross;                                        // covariance of state and residual
  double depth_m = 0.0;

  void see(const StationPart& part, const Model& model, const Eigen::Matrix<double, 2, 3>& J);
};

// How a station's own states move its bearing on the tangent plane.
struct TrackFilter::StationPart {
  Eigen::Index first = 0;
  bool has_place = false;
  Eigen::Matrix<double, 2, 3> by_rotation;
  Eigen::Matrix3d R_ecef_enu;
};

TrackFilter::TrackFilter(const FilterConfig& config, std::int64_t utime_us,
                         const FilterStart& start)
    : config_(config), utime_us_(utime_us), mixed_us_(utime_us) {
  for (Model& model : models_) {
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
          bias_by_rotation(R.transpose() * frame.tangent), R};
}

bool TrackFilter::place_matters(const SightLine& sight) const {
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
    const Eigen::Index n = models_[0].mean.size() + states_of(priors_.back());
    for (Model& model : models_) {
      model.mean.conservativeResize(n);
      model.covariance.conservativeResize(n, n);
    }
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
  for (Model& model : models_) {
    model.mean.segment(at, n).setZero();
    model.covariance.middleRows(at, n).setZero();
    model.covariance.middleCols(at, n).setZero();
    model.covariance.diagonal().segment<3>(at) = prior.rotation;
    if (!prior.place_apart) continue;
    model.covariance.diagonal().segment<kPlaceStates>(at + kPoseStates) = prior.place_m2;
  }
}

// Adds what the station's states have to do with the residual.
void TrackFilter::Innovation::see(const StationPart& part, const Model& model,
                                  const Eigen::Matrix<double, 2, 3>& J) {
  const auto& P = model.covariance;
  const Eigen::Index at = part.first;
  const Eigen::Vector2d clock = -J * model.mean.segment<3>(3);
  const Eigen::Matrix<double, 3, 2> Bt = part.by_rotation.transpose();
  cross += P.middleCols<3>(at).lazyProduct(Bt);
  cross += P.col(at + 3) * clock.transpose();
  residual -= part.by_rotation * model.mean.segment<3>(at) + clock * model.mean(at + 3);
  if (part.has_place) {
    const Eigen::Matrix<double, 2, 3> by_place = -J * part.R_ecef_enu;
    const Eigen::Matrix<double, 3, 2> by_place_t = by_place.transpose();
    cross += P.middleCols<3>(at + kPoseStates).lazyProduct(by_place_t);
    residual -= by_place * model.mean.segment<3>(at + kPoseStates);
    covariance = by_place * cross.middleRows<3>(at + kPoseStates);
  }
  covariance += part.by_rotation * cross.middleRows<3>(at) + clock * cross.row(at + 3);
}

TrackFilter::Innovation TrackFilter::innovation(const Model& model, const Sighting& sighting,
                                                const RayFrame& frame, int station,
                                                const BiasPrior& prior) const {
  const auto motion = static_cast<Motion>(&model - models_.data());
  const double ahead_s = seconds(sighting.utime_us - utime_us_);  // < 0: late
  const Eigen::Vector3d v = model.mean.segment<3>(3);
  const double curved = motion == Motion::kConstantVelocity ? 0.0 : ahead_s * ahead_s / 2.0;
  const Eigen::Vector3d line = model.mean.head<3>() + ahead_s * v +
                               curved * model.mean.segment<3>(6) - sighting.sight.origin_ecef;
  Innovation result;
  result.depth_m = frame.direction.dot(line);
  if (!(result.depth_m > 0.0)) return result;
  const Eigen::Vector2d predicted = frame.tangent.transpose() * line / result.depth_m;
  const Eigen::Matrix<double, 2, 3> J =
      (frame.tangent.transpose() - predicted * frame.direction.transpose()) / result.depth_m;
  // H = [J, ahead J, curved J]; products of so few columns without Eigen's blocking.
  const auto& P = model.covariance;
  const Eigen::Matrix<double, 3, 2> Jt = J.transpose();
  result.cross = P.leftCols<3>().lazyProduct(Jt);
  if (ahead_s != 0.0) {
    result.cross += ahead_s * P.middleCols<3>(3).lazyProduct(Jt);
    result.cross += curved * P.middleCols<3>(6).lazyProduct(Jt);
  }
  result.residual = -predicted;
  if (station >= 0) {
    result.see(part_of(station, frame), model, J);
  } else {
    const Eigen::Vector2d clock = J * v * sighting.clock_sd_s;
    result.covariance = prior.covariance + clock * clock.transpose();
  }
  result.covariance += J * (result.cross.topRows<3>() + ahead_s * result.cross.middleRows<3>(3) +
                            curved * result.cross.middleRows<3>(6));
  if (ahead_s != 0.0) {
    const Transition between =
        transition(motion, model.mean.head<9>(), std::abs(ahead_s), config_.motion);
    result.covariance += between.q(0, 0) * J * J.transpose();
  }
  return result;
}

double TrackFilter::nis(const Sighting& sighting, const StationErrors& errors) const {
  const int station = index_of(sighting.station);
  BiasPrior prior;
  if (station < 0) {
    const double range_m = (position() - sighting.sight.origin_ecef).norm();
    prior = errors.prior(sighting.station, sighting.sight, range_m);
  }
  Eigen::Matrix2d white = sighting.sight.covariance_white * errors.noise_scale(sighting.station);
  if (station >= 0) {  // what it knows of its bias may be of another pose, or of another point
    const FilterStation& known = stations_[static_cast<std::size_t>(station)];
    const bool same =
        known.calibration_id == sighting.calibration_id && known.track_id == sighting.track_id;
    if (!same) white += priors_[static_cast<std::size_t>(station)].covariance;
  }
  const RayFrame frame = frame_of(sighting, station);
  double least = kNever;
  for (const Model& model : models_) {
    const Innovation seen = innovation(model, sighting, frame, station, prior);
    if (seen.depth_m <= 0.0) continue;
    const Eigen::Matrix2d S = seen.covariance + white;
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

// The target was designated to the station anew, and it follows another point of it. Added to what
// is known of the station, and not in its place: of one which changes its mind with each frame the
// bias would seem new each time, and average out.
void TrackFilter::show_anew(int station, std::int64_t track_id) {
  stations_[static_cast<std::size_t>(station)].track_id = track_id;
  const BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  for (Model& model : models_) {
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
    for (Model& model : models_) model.covariance(at, at) += more;
  }
  entry.clock_sd_s = sighting.clock_sd_s;
  return station;
}

// At the state's own instant, or late.
BearingUse TrackFilter::take(const Sighting& sighting, StationErrors& errors) {
  const int station = station_of(sighting, errors);
  if (station < 0) {
    return nis(sighting, errors) < config_.gate_nis ? BearingUse::kNoPlace : BearingUse::kSetAside;
  }
  FilterStation& entry = stations_[static_cast<std::size_t>(station)];
  const Eigen::Matrix2d white =
      sighting.sight.covariance_white * errors.noise_scale(sighting.station);
  const RayFrame frame = frame_of(sighting, station);
  Innovations seen;
  double nis = kNever, squared = 0.0, expected = 0.0;  // of the noise's own part of the residual
  for (std::size_t m = 0; m < models_.size(); ++m) {
    seen[m] = innovation(models_[m], sighting, frame, station, {});
    if (seen[m].depth_m <= 0.0) return BearingUse::kBehindCamera;
    const Eigen::LLT<Eigen::Matrix2d> S(seen[m].covariance + white);
    const Eigen::Vector2d scaled = S.solve(seen[m].residual);
    const double here = seen[m].residual.dot(scaled);
    if (here >= nis) continue;
    nis = here;
    squared = scaled.dot(white * scaled);
    expected = S.solve(white).trace();
  }
  // One far off counts as one at the gate (Huber): where noise is many times what is stated, most
  // are, and the others would never show it.
  squared *= std::min(1.0, config_.gate_nis / nis);
  errors.observe_residual(sighting.station, 1.0 + (squared - expected) / 2.0);
  if (!passes_gate(sighting, nis)) return BearingUse::kSetAside;
  entry.weight = nis > config_.robust_nis ? config_.robust_nis / nis : 1.0;
  if (entry.sight.origin_ecef != sighting.sight.origin_ecef) {
    entry.R_ecef_enu = R_ecef_enu(sighting.sight.origin_ecef);
  }
  entry.sight = sighting.sight;
  entry.utime_us = std::max(entry.utime_us, sighting.utime_us);
  entry.mean_nis += 0.05 * (nis - entry.mean_nis);
  const bool finds_bias = shows_bias(station, frame, seen[0].depth_m, white);
  const double inflation = observe_noise(entry, sighting, frame, errors);
  correct(seen, white * (inflation / entry.weight), finds_bias);
  return BearingUse::kUsed;
}

// Bias times relative error of the range is what linearisation leaves out. While that is not small
// against the noise, the filter would find in it what the geometry hides, and be sure of it: two
// stations side by side "learn" the difference of their headings, and a wrong range with it. Biases
// are then considered but not learnt (the Schmidt-Kalman filter, 1966).
bool TrackFilter::shows_bias(int station, const RayFrame& frame, double depth_m,
                             const Eigen::Matrix2d& white) const {
  constexpr double kSmall = 0.1;
  const Eigen::Matrix3d P = summary_.covariance.topLeftCorner<3, 3>();
  const double depth_variance = frame.direction.dot(P * frame.direction);
  const StationPart part = part_of(station, frame);
  const FilterMatrix& own = models_[0].covariance;
  double bias_variance =
      (part.by_rotation * own.block<3, 3>(part.first, part.first) * part.by_rotation.transpose())
          .diagonal()
          .maxCoeff();
  if (part.has_place) {
    const Eigen::Matrix<double, 2, 3> across = frame.tangent.transpose() * part.R_ecef_enu;
    const Eigen::Index at = part.first + kPoseStates;
    bias_variance += (across * own.block<3, 3>(at, at) * across.transpose()).diagonal().maxCoeff() /
                     (depth_m * depth_m);
  }
  const double second_order = bias_variance * depth_variance / (depth_m * depth_m);
  return second_order < kSmall * kSmall * white.trace() / 2.0;
}

void TrackFilter::correct(const Innovations& seen, const Eigen::Matrix2d& noise, bool finds_bias) {
  std::array<double, kMotions> log_likelihood{};
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const Eigen::LLT<Eigen::Matrix2d> S(seen[m].covariance + noise);
    const Eigen::Matrix2d L = S.matrixL();
    const Eigen::Vector2d whitened = S.matrixL().solve(seen[m].residual);
    const MatrixN2 gain = S.matrixL().solve(seen[m].cross.transpose()).transpose();
    add(gain, whitened, finds_bias, models_[m].mean, models_[m].covariance);
    log_likelihood[m] = -whitened.squaredNorm() / 2.0 - std::log(L(0, 0) * L(1, 1));
  }
  weigh_models(log_likelihood);
}

bool TrackFilter::passes_gate(const Sighting& sighting, double nis) {
  if (nis <= config_.gate_nis) {
    upset_ = 0;
    two_upset_ = false;
    return true;
  }
  if (upset_ == 0) upset_station_ = sighting.station;
  two_upset_ = two_upset_ || upset_station_ != sighting.station;
  if (++upset_ >= kUpset && two_upset_) give_room();
  return false;
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

void TrackFilter::weigh_models(const std::array<double, kMotions>& log_likelihood) {
  const double most = *std::ranges::max_element(log_likelihood);
  double sum = 0.0;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    models_[m].probability *= std::exp(log_likelihood[m] - most);
    models_[m].probability = std::max(models_[m].probability, kLeastProbability);
    sum += models_[m].probability;
  }
  for (Model& model : models_) model.probability /= sum;
}

// The target has done what no model allows: any of its accelerations, for the models' own time.
void TrackFilter::give_room() {
  upset_ = 0;
  two_upset_ = false;
  const double hard = manoeuvre_sd(velocity(), config_.motion);
  const double time_s = config_.motion.acceleration_time_s;
  const double speed = 2.0 * hard * time_s;
  for (Model& model : models_) {
    model.covariance.diagonal().head<3>().array() += std::pow(speed * time_s / 2.0, 2);
    model.covariance.diagonal().segment<3>(3).array() += speed * speed;
    model.covariance.diagonal().segment<3>(6).array() += 4.0 * hard * hard;
  }
}

}  // namespace ols
