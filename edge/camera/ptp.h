// Interprets what a camera states about its PTP clock. Pure.
#pragma once

#include <string_view>

namespace ols::camera {

enum class PtpState {
  kOff,
  kSyncing,  // synchronisation is in progress
  kSlave,    // the camera's clock is that of the master: TAI
  kMaster,   // the camera is master, or passive next to one; its clock runs free
  kFault,
  kUnknown,  // an undocumented word
};

// The words differ between firmware versions; sources: AVT's feature reference, GenICam's SFNC 2.x.
PtpState ptp_state(std::string_view status);

}  // namespace ols::camera
