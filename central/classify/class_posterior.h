// Estimates what kind of object a target is, from its size and its motion over its life. Pure.
//
// A look is one set of measurements of the target. A look has six features: size, speed, climb,
// acceleration across the path, height above the ground, and flicker. For each kind of object
// (class_table.h), the probability density of the features is a mixture of normal distributions.
// Flicker is the sum of two relative variances within a second: that of the outline's largest
// extent, and that of the smaller side of the upright box around the outline. Wings and rotors are
// part of the outline. A bird's outline changes with its wing beat of 2 to 15 Hz, a rigid body's
// does not. Seen from the side, wings change only the smaller side. The variance of each feature's
// error is added to the variance of the density: an uncertain look therefore has little influence.
// An unknown feature is left out.
//
// Looks at one track are correlated: a bird that glides now still glides a tenth of a second later.
// Their log-likelihoods are therefore averaged, and the average has the weight of N independent
// looks. For the features that change little over an object's life (size, cruising speed, height),
// N is 1. For the other features, given these, N is 1 + t / kCorrelation_s after t seconds, at most
// kMostLooks. The flicker has an average and a t of its own, over the looks in which it is known:
// looks in which it is unknown do not make the known ones count less. The weight of a look falls to
// 37 % in kMemory_s, and so does that of a flicker which is no longer seen. Therefore, if a track
// passes to another object, the class changes, too.
//
// A target is 'unknown' until it has been looked at for a second and one class has a posterior of
// at least 0.9. A look without a size is ignored, because motion alone does not distinguish a
// balloon, a hovering drone and a parked car.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "wire/object_class.h"

namespace ols::fusion {

using wire::ObjectClass;
inline constexpr int kObjectClasses = wire::kObjectClasses.size();

inline constexpr double kCorrelation_s = 4.0, kMostLooks = 5.0, kMemory_s = 20.0;
inline constexpr double kSure = 0.9, kLeastSeen_s = 1.0;

struct Measured {
  double value = 0.0, sd = 0.0;  // 1-sigma; 0 if the value is unknown
};

// The size of an object in one image [m]. value_m: its largest extent. sd_m: 1-sigma of the extent.
// noise_m: the part of sd_m that is independent from image to image; 0 if unknown. across_m: the
// smaller side of the upright box, with the same relative noise; 0 if unknown. time_s: of the
// image, counted from any instant.
struct SeenSize {
  double value_m = 0.0, sd_m = 0.0, noise_m = 0.0, across_m = 0.0, time_s = 0.0;
};

struct ClassLook {
  Measured size_m;       // largest extent
  Measured speed_m_s;    // horizontal speed
  Measured climb_m_s;    // vertical speed, positive up
  Measured across_m_s2;  // acceleration across the path
  Measured height_m;     // above the ground
  // The sum of the relative variances of the outline's largest extent and of its smaller side,
  // within a second, without the variance that noise causes.
  Measured flicker;
};

// Sizes of the last second, measured by one station, in the order of time.
using StationSizes = std::vector<SeenSize>;

// Makes a look from the stations' sizes and from two velocities (east, north, up): the present one,
// and before_m_s, which is apart_s older. velocity_sd_m_s: 1-sigma of each component. The size is
// that of the station whose newest size is the most certain. The flicker is that of the station
// whose outlines have the least noise: a station that sees the object before trees measures a size,
// but no outlines. The caller adds the height.
ClassLook look_at(const std::vector<StationSizes>& by_station,
                  const std::array<double, 3>& velocity_m_s,
                  const std::array<double, 3>& before_m_s, double apart_s, double velocity_sd_m_s);

inline constexpr int kFeatures = 6;
using Features = std::array<Measured, kFeatures>;
// The features, transformed as the densities of class_table.h need them: ln size, ln(1 + speed),
// asinh climb, ln(1 + across), flicker, asinh(height / 10 m).
Features features_of(const ClassLook& look);

struct ClassBelief {
  ObjectClass object_class = ObjectClass::kUnknown;
  double probability = 0.0;  // of object_class; 0 if unknown
};

class ClassPosterior {
 public:
  // Takes a look. A look that is not newer than the last one, or that has no size, is ignored.
  void add(std::int64_t utime_us, const ClassLook& look);
  bool has_looked() const { return last_us_.has_value(); }
  // The probability of each class, in the order of ObjectClass; 0 for kUnknown.
  std::array<double, kObjectClasses> posterior() const;
  // The most probable class, if its probability is at least kSure.
  ClassBelief belief() const;

 private:
  static constexpr int kMostKinds = 12;
  // Looks in which certain features are known, and for each kind the weighted sum of the
  // log-likelihoods of these features.
  struct Sum {
    std::int64_t first_us = 0, last_us = 0;  // the first and the last of these looks
    double weight = 0.0;
    std::array<double, kMostKinds> log{};

    void fade(double kept);
    double mean(int kind) const { return weight > 0.0 ? log[kind] / weight : 0.0; }
    // The number N of independent looks, never more than were made; less once the last of them is
    // long ago.
    double looks(std::int64_t now_us) const;
  };
  std::optional<std::int64_t> first_us_, last_us_;
  // lasting_: size, speed and height. moving_: climb and acceleration, given the former. beating_:
  // flicker, given all others.
  Sum lasting_, moving_, beating_;
};

}  // namespace ols::fusion
