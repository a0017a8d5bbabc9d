// Simulated tracks of objects of known class, with which the classifier is trained and tested. The
// same seed gives the same tracks.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "central/classify/class_posterior.h"

namespace ols::bench {

struct SimulatedKind {
  const char* name;
  fusion::ObjectClass object_class;
};
inline constexpr std::array<SimulatedKind, 7> kSimulatedKinds = {{
    {"drone", fusion::ObjectClass::kDrone},
    {"bird", fusion::ObjectClass::kBird},
    {"aeroplane", fusion::ObjectClass::kAircraft},
    {"helicopter", fusion::ObjectClass::kAircraft},
    {"person", fusion::ObjectClass::kOther},
    {"vehicle", fusion::ObjectClass::kOther},
    {"meteor", fusion::ObjectClass::kOther},
}};

// 1-sigma of the errors of the observed features; 0: no error.
struct LookNoise {
  double size = 0.0;       // of the size in one image, relative; independent from image to image
  double size_bias = 0.0;  // of the size, relative; constant over a track, and not stated
  double speed_m_s = 0.0;  // of each axis of the velocity; correlated over a second
  double ground_m = 0.0;   // of the height above the ground; constant over a track
};

struct TimedLook {
  std::int64_t utime_us = 0;
  fusion::ClassLook look;
};

// Observes an object of kSimulatedKinds[kind] four times a second for `duration_s`.
std::vector<TimedLook> simulate_looks(int kind, double duration_s, const LookNoise& noise,
                                      std::mt19937_64& random);

}  // namespace ols::bench
