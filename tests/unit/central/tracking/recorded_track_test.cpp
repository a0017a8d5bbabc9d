#include "central/tracking/recorded_track.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "central/offline/offline_fusion.h"
#include "tests/unit/central/wrong_heading.h"

namespace ols::fusion {
namespace {

using test::HeadingError;
using test::kStart;
using test::off_by;
using test::slow_error_m;
using test::watch;

constexpr double kNoise = 2e-4;

OfflineConfig ten_hertz(bool smooth = false) {
  OfflineConfig config;
  config.rate_hz = 10.0;
  config.smooth = smooth;
  return config;
}

struct Fixes {
  std::size_t count = 0;
  double worst_m = 0.0;
  double worst_sigmas = 0.0;
  std::string beside;  // stations that point elsewhere
};

Fixes fuse(const std::vector<BearingMeasurement>& measurements,
           const OfflineConfig& config = ten_hertz()) {
  Fixes fixes;
  OfflineReport report;
  for (const FusedTarget& target : fuse_offline(measurements, config, &report)) {
    const double sd_m = std::sqrt(target.estimate.covariance_ecef.trace());
    const double error = slow_error_m(target);
    ++fixes.count;
    fixes.worst_m = std::max(fixes.worst_m, error);
    fixes.worst_sigmas = std::max(fixes.worst_sigmas, error / sd_m);
  }
  for (const auto& [station, why] : report.beside) fixes.beside += station;
  return fixes;
}

TEST(RecordedTrack, ARecordingWithOneWrongStationOfFour) {
  for (const char wrong : std::string("abcd")) {
    for (const double off_deg : {1.0, -1.0, 2.0, -2.0, 5.0, -5.0}) {
      const Fixes fixes = fuse(watch("abcd", 6.0, kNoise, off_by(wrong, off_deg)));
      EXPECT_GE(fixes.count, 57U) << wrong << ' ' << off_deg;
      EXPECT_LT(fixes.worst_sigmas, 3.0) << wrong << ' ' << off_deg;
      EXPECT_LT(fixes.worst_m, 0.5) << wrong << ' ' << off_deg;
      EXPECT_EQ(fixes.beside, std::string(1, wrong)) << off_deg;
    }
  }
}

// With three stations, its rays miss those of the others.
TEST(RecordedTrack, ARecordingWithOneWrongStationOfThree) {
  for (const char wrong : std::string("abc")) {
    for (const double off_deg : {1.0, -1.0, 2.0, -2.0, 5.0, -5.0}) {
      const Fixes fixes = fuse(watch("abc", 6.0, kNoise, off_by(wrong, off_deg)));
      EXPECT_GE(fixes.count, 50U) << wrong << ' ' << off_deg;
      EXPECT_LT(fixes.worst_sigmas, 3.0) << wrong << ' ' << off_deg;
      EXPECT_LT(fixes.worst_m, 0.5) << wrong << ' ' << off_deg;
      EXPECT_EQ(fixes.beside, std::string(1, wrong)) << off_deg;
    }
  }
}

// Such a small error is learnt as that station's noise and bias, and no station is named. Three
// stations distinguish the two poorly: the error is bounded, but larger than stated.
TEST(RecordedTrack, ARecordingWithAStationThatIsHalfADegreeOff) {
  for (const std::string stations : {"abcd", "abc"}) {
    for (const char wrong : stations) {
      for (const double off_deg : {0.5, -0.5}) {
        const Fixes fixes = fuse(watch(stations, 6.0, kNoise, off_by(wrong, off_deg)));
        EXPECT_GE(fixes.count, 50U) << stations << wrong << ' ' << off_deg;
        EXPECT_LT(fixes.worst_sigmas, stations.size() > 3 ? 3.0 : 6.0) << stations << wrong;
        EXPECT_LT(fixes.worst_m, stations.size() > 3 ? 0.5 : 2.5) << stations << wrong;
      }
    }
  }
}

TEST(RecordedTrack, ARecordingWithAStationThatIsWrongAtFirst) {
  for (const std::string stations : {"abcd", "abc"}) {
    for (const char wrong : stations) {
      const HeadingError at_first = [=](char name, double t_s) {
        return name == wrong && t_s < 0.3 ? radians(1.0) : 0.0;
      };
      const Fixes fixes = fuse(watch(stations, 4.0, kNoise, at_first));
      EXPECT_GE(fixes.count, 35U) << stations << ' ' << wrong;
      EXPECT_LT(fixes.worst_sigmas, 3.0) << stations << ' ' << wrong;
      EXPECT_LT(fixes.worst_m, 0.5) << stations << ' ' << wrong;
      EXPECT_EQ(fixes.beside, "");
    }
  }
}

// At its end the backward filter has only begun, on two rays of which one may be wrong.
TEST(RecordedTrack, ASmoothedRecordingWithOneWrongStation) {
  for (const std::string stations : {"abcd", "abc"}) {
    for (const char wrong : stations) {
      const auto measurements = watch(stations, 4.0, kNoise, off_by(wrong, 1.0));
      const Fixes fixes = fuse(measurements, ten_hertz(true));
      EXPECT_GE(fixes.count, 35U) << stations << ' ' << wrong;
      EXPECT_LT(fixes.worst_sigmas, 3.0) << stations << ' ' << wrong;
      EXPECT_LT(fixes.worst_m, 0.5) << stations << ' ' << wrong;
    }
  }
}

// Three of four stations turn together: most contradict the track.
TEST(RecordedTrack, ATrackThatMostStationsContradictIsBegunAnew) {
  const HeadingError wrong_then_right = [](char name, double t_s) {
    return t_s < 2.0 && name != 'd' ? radians(20.0) : 0.0;
  };
  auto measurements = watch("abcd", 6.0, kNoise, wrong_then_right);
  const auto targets = fuse_offline(measurements, ten_hertz());
  ASSERT_FALSE(targets.empty());
  for (const FusedTarget& target : targets) {
    EXPECT_EQ(target.target_id, 1);
    if (target.utime_us > kStart + 4'000'000) {
      EXPECT_LT(slow_error_m(target), 0.5);
    }
  }
  EXPECT_GT(targets.back().utime_us, kStart + 5'500'000);
}

// One station alone has no range. A track that lived on would have a wrong one, and reject the
// second station when that returns.
TEST(RecordedTrack, ATrackThatOneStationAloneSeesIsBegunAnewByTwo) {
  auto measurements = watch("ab", 10.0, kNoise, off_by('x', 0.0));
  const auto after_s = [](std::int64_t utime_us) {
    return static_cast<double>(utime_us - kStart) * 1e-6;
  };
  std::erase_if(measurements, [&](const BearingMeasurement& measurement) {
    const double t_s = after_s(measurement.utime_us);
    return measurement.station == "b" && t_s > 2.0 && t_s < 8.0;
  });
  std::size_t later = 0;
  for (const FusedTarget& target : fuse_offline(measurements, ten_hertz())) {
    const double t_s = after_s(target.utime_us);
    EXPECT_FALSE(t_s > 4.1 && t_s < 7.8) << t_s;
    if (t_s < 8.5) continue;
    ++later;
    EXPECT_LT(slow_error_m(target), 0.5) << t_s;
  }
  EXPECT_GE(later, 14U);
}

// A position from two rays on, until something contradicts it.
TEST(RecordedTrack, ARecordingIsLocatedFromItsFirstRays) {
  OfflineConfig config;
  const auto targets = fuse_offline(watch("abcd", 1.0, kNoise, off_by('x', 0.0)), config);
  ASSERT_FALSE(targets.empty());
  EXPECT_LT(targets.front().utime_us, kStart + 100'000);
}

}  // namespace
}  // namespace ols::fusion
