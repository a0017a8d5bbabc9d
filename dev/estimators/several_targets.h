// A scenario of several targets, with crossings, misses and false bearings: measures how well the
// fusion keeps the targets apart.
#pragma once

#include <cstdint>

namespace ols::bench {

struct SeveralTargets {
  int targets = 5;
  int stations = 4;
  double duration_s = 40.0;
  double missed = 0.1;
  double false_per_frame = 1.0;
  bool tracklets = false;  // true: the bearings belong to tracklets of detectors in fixed cameras
                           // with 15 images a second
};

struct IdentityScore {
  double by_right_identity = 0.0;  // share of the targets' time with a track of the right identity
  double longest_ghost_s = 0.0;    // longest time that a confirmed track was far from every target
  int switches = 0;                // how often a target's track got another id
  double rms_m = 0.0;
  double found = 0.0;                   // share of the targets' time with any track
  int ghosts = 0;                       // number of identities that were never near a target
  double predicted_ghosts_a_day = 0.0;  // predicted by the fusion's own model, at the end
};

IdentityScore run_several(const SeveralTargets& scenario, std::uint64_t seed);

}  // namespace ols::bench
