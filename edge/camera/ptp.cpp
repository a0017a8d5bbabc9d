#include "edge/camera/ptp.h"

#include <array>
#include <utility>

namespace ols::camera {
namespace {

using enum PtpState;

constexpr std::array<std::pair<std::string_view, PtpState>, 15> kWords{{
    {"Off", kOff},
    {"Disabled", kOff},
    {"Syncing", kSyncing},
    {"Uncalibrated", kSyncing},
    {"Listening", kSyncing},
    {"Initializing", kSyncing},
    {"PreMaster", kSyncing},
    {"Pre_Master", kSyncing},
    {"Slave", kSlave},
    {"Locked", kSlave},
    {"Master", kMaster},
    {"Passive", kMaster},
    {"Error", kFault},
    {"Faulty", kFault},
    {"Fault", kFault},
}};

}  // namespace

PtpState ptp_state(std::string_view status) {
  for (const auto& [word, state] : kWords)
    if (word == status) return state;
  return kUnknown;
}

}  // namespace ols::camera
