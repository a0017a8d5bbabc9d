// Whether a camera's clock follows a PTP master. Pure.
#pragma once

#include <string_view>

namespace ols::camera {

enum class PtpState {
  kOff,
  kSyncing,  // in progress
  kSlave,    // its clock is the master's: TAI
  kMaster,   // master, or passive next to one: its clock is free
  kFault,
  kUnknown,  // an undocumented word
};

// The words differ between firmwares: AVT's feature reference, GenICam's SFNC 2.x.
PtpState ptp_state(std::string_view status);

}  // namespace ols::camera
