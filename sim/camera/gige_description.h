// The GenICam description of the simulated camera: its features and their registers. Pure.
#pragma once

#include <string>

namespace ols::sim::gige {

// The naming of the features.
enum class FeatureNames {
  kGt1290c,  // those of a Prosilica GT1290C, older than GenICam's convention
  kSfnc,     // GenICam's Standard Features Naming Convention 2.x
};

// XML. Addresses as in gige_registers.h.
std::string description(FeatureNames names);

}  // namespace ols::sim::gige
