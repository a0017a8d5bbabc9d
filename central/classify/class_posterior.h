// What kind of object a target is, by its size and its motion over its life. Pure.
//
// Each kind (class_table.h) has a density of five features of a look, a mixture of normal
// distributions: size, speed, climb, acceleration across the path, and flicker, the relative
// variance of the size within a second (wings and rotors seen as one: a bird's outline changes with
// its wing beat of 2 to 15 Hz, a rigid body's does not). The error of each feature is added to the
// variance of the density, so that a look that says little decides little; a feature that is not
// known is left out.
//
// Looks of one track are alike: a drone that hovers now hovers in a tenth of a second, too. Their
// log-likelihoods are therefore averaged, and the average counts as 1 + t / kCorrelation_s
// independent looks after t seconds, at most kMostLooks. Looks are forgotten within kMemory_s, so
// that a track that passes to another object changes its class.
//
// The rule: a target is 'unknown' until it has been looked at for a second and one class has a
// posterior of at least 0.9. A look without a size does not count: by motion alone a balloon, a
// hovering drone and a parked car are one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace ols::fusion {

// As target_t's CLASS_*.
enum class ObjectClass { kUnknown, kDrone, kBird, kAircraft, kOther };
inline constexpr int kObjectClasses = 5;

inline constexpr double kCorrelation_s = 4.0, kMostLooks = 5.0, kMemory_s = 20.0;
inline constexpr double kSure = 0.9, kLeastSeen_s = 1.0;

struct Measured {
  double value = 0.0, sd = 0.0;  // 1-sigma; 0: not known
};

struct ClassLook {
  Measured size_m;       // largest extent
  Measured speed_m_s;    // horizontal
  Measured climb_m_s;    // up
  Measured across_m_s2;  // acceleration across the path
  Measured flicker;      // relative variance of the size within a second, without that of its noise
};

// A look at a target: the sizes that one station saw within the last second [m], the velocities now
// and `apart_s` before (east, north, up) and the 1-sigma of each of their axes.
ClassLook look_at(const std::vector<Measured>& sizes_m, const std::array<double, 3>& velocity_m_s,
                  const std::array<double, 3>& before_m_s, double apart_s, double velocity_sd_m_s);

inline constexpr int kFeatures = 5;
using Features = std::array<Measured, kFeatures>;
// The features in which the densities are stated: ln size, ln(1 + speed), asinh climb,
// ln(1 + across), flicker.
Features features_of(const ClassLook& look);

struct ClassBelief {
  ObjectClass object_class = ObjectClass::kUnknown;
  double probability = 0.0;  // of this class; 0: unknown
};

class ClassPosterior {
 public:
  // Takes a look. One that is not newer than the last, or without a size, is ignored.
  void add(std::int64_t utime_us, const ClassLook& look);
  // Of each class, in the order of ObjectClass; of unknown: 0.
  std::array<double, kObjectClasses> posterior() const;
  // The most probable class if it is sure.
  ClassBelief belief() const;

 private:
  static constexpr int kMostKinds = 12;
  std::optional<std::int64_t> first_us_, last_us_;
  double weight_ = 0.0;
  std::array<double, kMostKinds> sum_{};  // of the weighted log-likelihoods, by kind
};

}  // namespace ols::fusion
