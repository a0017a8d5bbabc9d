// Whether a camera's clock follows a PTP master. Pure.
#pragma once

#include <string_view>

namespace ols::camera {

enum class PtpState {
  kOff,
  kSyncing,  // on its way
  kSlave,    // its clock is the master's: TAI
  kMaster,   // a master itself, or passive beside one: its clock is its own
  kFault,
  kUnknown,  // a word that nobody has written down
};

// The words vary with the firmware: those of AVT's feature reference and of GenICam's SFNC 2.x.
PtpState ptp_state(std::string_view status);

}  // namespace ols::camera
