// The GenICam description of the simulated camera: its features and their registers. Pure.
#pragma once

#include <string>

namespace ols::sim::gige {

// The names by which clients address the features.
enum class FeatureNames {
  kGt1290c,  // the names of a Prosilica GT1290C, older than GenICam's convention
  kSfnc,     // GenICam's Standard Features Naming Convention 2.x
};

// The description as XML, with the register addresses of gige_registers.h.
std::string description(FeatureNames names);

}  // namespace ols::sim::gige
