// Interprets the status word of a camera's PTP clock. Pure.
#pragma once

#include <string_view>

namespace ols::camera {

enum class PtpState {
  kOff,
  kSyncing,  // synchronisation is in progress
  kSlave,    // the camera's clock follows the master's clock, which is TAI
  kMaster,   // the camera is the master, or passive beside another master; its clock runs free
  kFault,
  kUnknown,  // the word is not documented
};

// The words differ between firmware versions. Sources: AVT's feature reference, GenICam's SFNC 2.x.
PtpState ptp_state(std::string_view status);

}  // namespace ols::camera
