// The adjustment against Ceres: the same least squares, all unknowns beside each other and every
// prior a residual, derivatives by differences, solved and propagated by somebody else's code.
#include <gtest/gtest.h>

#ifndef OLS_HAS_CERES

TEST(AdjustmentWithCeres, Agrees) {
  GTEST_SKIP() << "libceres-dev is not installed: tools/install-dependencies tests";
}

#else

#include <ceres/ceres.h>

#include <cmath>
#include <list>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "calibration/target.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

constexpr double kHeadingUnit_rad = 1e-3;  // it has no prior
// So that a step of a difference is a fixed share of a deviation: each unknown stands near it.
constexpr double kOrigin = 1.0;
constexpr double kStep = 1e-3;

// What a sighting depends on: the station, the place's error, the errors of its two angles; each in
// units of its deviation.
struct Sight {
  const Problem* problem;
  const Observation* one;
  TargetPtr target;
  StationVector unit;

  State state(const double* station) const {
    StationVector change;
    for (int i = 0; i < kStationParameters; ++i) change[i] = unit[i] * (station[i] - kOrigin);
    State state;
    state.stations = {station_at(problem->stations[0], change)};
    return state;
  }
  bool operator()(double const* const* x, double* residuals) const {
    const State at = state(x[0]);
    const Eigen::VectorXd sd = target->prior_sd();
    Eigen::VectorXd nuisance(sd.size());
    for (Eigen::Index i = 0; i < sd.size(); ++i) nuisance[i] = sd[i] * (x[1][i] - kOrigin);
    const Sighting sighting{0, one->utime_us, one->reading, one->pixel, one->sd_px, {}, 0.0};
    const TargetView seen = target->view(at, sighting, nuisance);
    const auto image = predict_pixel(at.stations[0].model, one->reading, seen.point);
    if (!image) return false;
    const Eigen::Vector2d shafts(x[2][0] - kOrigin, x[2][1] - kOrigin);
    const Eigen::Vector2d pixel =
        image->pixel + problem->stations[0].pose_sd_rad * image->by_shafts * shafts;
    for (int i = 0; i < 2; ++i) residuals[i] = (pixel[i] - one->pixel[i]) / one->sd_px;
    return true;
  }
};

// Of unknowns in units of their deviations; the heading has none.
struct Prior {
  int size;
  int free;  // without a prior; -1: none
  bool operator()(double const* const* x, double* residuals) const {
    for (int i = 0; i < size; ++i) residuals[i] = i == free ? 0.0 : x[0][i] - kOrigin;
    return true;
  }
};

template <class Cost>
auto cost(Cost what, const std::vector<int>& blocks, int residuals) {
  ceres::NumericDiffOptions options;
  options.relative_step_size = kStep;
  auto* function = new ceres::DynamicNumericDiffCostFunction<Cost, ceres::CENTRAL>(
      new Cost(std::move(what)), ceres::TAKE_OWNERSHIP, options);
  for (const int size : blocks) function->AddParameterBlock(size);
  function->SetNumResiduals(residuals);
  return function;
}

class AdjustmentWithCeres : public testing::Test {
 protected:
  AdjustmentWithCeres() {
    std::mt19937_64 random(20260119);
    std::normal_distribution<double> noise;
    for (Observation& one : problem.observations) {
      for (int i = 0; i < 2; ++i) one.pixel[i] += 0.4 * noise(random);
      one.reading.pan.approach = noise(random) > 0.0 ? 1 : -1;
    }
    StationMatrix& C = problem.stations[0].covariance;
    for (const int k : {kK3, kK4}) C(k, k) = 1.0;
    for (int i = 0; i < kStationParameters; ++i) unit[i] = std::sqrt(C(i, i));
    unit[kHeading] = kHeadingUnit_rad;
  }

  void solve() {
    ceres::Problem::Options options;
    ceres::Problem equations(options);
    station.assign(kStationParameters, kOrigin);
    add_prior(equations, station, kHeading);
    for (const Observation& one : problem.observations) {
      const auto target = fixed_target(std::get<FixedPoint>(problem.references.at(one.reference)));
      auto& place = places[one.reference];
      if (place.empty()) {
        place.assign(static_cast<std::size_t>(target->unknowns()), kOrigin);
        add_prior(equations, place, -1);
      }
      auto& pose = poses.emplace_back(2, kOrigin);
      add_prior(equations, pose, -1);
      equations.AddResidualBlock(cost(Sight{&problem, &one, target, unit},
                                      {kStationParameters, static_cast<int>(place.size()), 2}, 2),
                                 nullptr,
                                 std::vector<double*>{station.data(), place.data(), pose.data()});
    }
    ceres::Solver::Options how;
    how.linear_solver_type = ceres::DENSE_QR;
    how.function_tolerance = how.gradient_tolerance = how.parameter_tolerance = 1e-14;
    how.max_num_iterations = 200;
    how.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(how, &equations, &summary);
    ASSERT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
    misfit = 2.0 * summary.final_cost;
    ceres::Covariance::Options exact;
    exact.algorithm_type = ceres::DENSE_SVD;
    ceres::Covariance propagated(exact);
    const std::vector<std::pair<const double*, const double*> > wanted{
        {station.data(), station.data()}};
    ASSERT_TRUE(propagated.Compute(wanted, &equations));
    Eigen::Matrix<double, kStationParameters, kStationParameters, Eigen::RowMajor> C;
    propagated.GetCovarianceBlock(station.data(), station.data(), C.data());
    covariance = unit.asDiagonal() * C * unit.asDiagonal();
  }
  static void add_prior(ceres::Problem& equations, std::vector<double>& x, int free) {
    const int size = static_cast<int>(x.size());
    equations.AddResidualBlock(cost(Prior{size, free}, {size}, size), nullptr, x.data());
  }

  Problem problem = test::landmarks_around(test::crooked(), test::hill(), 7);
  StationVector unit;
  std::vector<double> station;
  std::map<std::string, std::vector<double> > places;
  std::list<std::vector<double> > poses;
  StationMatrix covariance;
  double misfit = 0.0;
};

TEST_F(AdjustmentWithCeres, Agrees) {
  solve();
  if (HasFatalFailure()) return;
  const Adjustment adjustment(network_of(problem));
  const Fit fit = adjustment.fit(adjustment.start({test::hill().geometry.chain.heading_rad}),
                                 std::vector<bool>(adjustment.groups().size(), true));
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.misfit, misfit, 1e-3 * misfit);
  for (int i = 0; i < kStationParameters; ++i) {
    const char* key = parameter_texts()[static_cast<std::size_t>(i)].key;
    const double sd = std::sqrt(fit.covariance(i, i));
    const double by_ceres = unit[i] * (station[static_cast<std::size_t>(i)] - kOrigin);
    // The adjustment takes the weights of a step as constants; what the shafts' errors weigh
    // follows the focal length a little.
    EXPECT_NEAR(fit.state.stations[0].change[i] / sd, by_ceres / sd, 0.05) << key;
    for (int j = 0; j <= i; ++j) {
      const double both = sd * std::sqrt(fit.covariance(j, j));
      EXPECT_NEAR(fit.covariance(i, j) / both, covariance(i, j) / both, 5e-3) << key << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace ols::calibration

#endif
