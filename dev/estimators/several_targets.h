// The scenario of several targets: crossings, misses, false bearings. Measures how well the fusion
// keeps the targets apart.
#pragma once

#include <cstdint>

namespace ols::bench {

struct SeveralTargets {
  int targets = 5;
  int stations = 4;
  double duration_s = 40.0;
  double missed = 0.1;
  double false_per_frame = 1.0;
  bool tracklets = false;  // whether bearings are tracklets of detectors, in 15 images a second of
                           // staring cameras
};

struct IdentityScore {
  double by_right_identity = 0.0;  // share of the targets' time in which the right track has them
  double longest_ghost_s = 0.0;    // longest life of a confirmed track far from every target
  int switches = 0;                // how often a target's track has got another id
  double rms_m = 0.0;
  double found = 0.0;                   // share of the targets' time in which any track has them
  int ghosts = 0;                       // identities that were never near a target
  double predicted_ghosts_a_day = 0.0;  // by the fusion's own model, at the end
};

IdentityScore run_several(const SeveralTargets& scenario, std::uint64_t seed);

}  // namespace ols::bench
