// The GenICam description of the simulated camera: which features it has and where they lie. Pure.
#pragma once

#include <string>

namespace ols::sim::gige {

// By what names the features go.
enum class FeatureNames {
  kGt1290c,  // those of a Prosilica GT1290C, older than GenICam's convention
  kSfnc,     // GenICam's Standard Features Naming Convention 2.x
};

// XML. Addresses as in gige_registers.h.
std::string description(FeatureNames names);

}  // namespace ols::sim::gige
