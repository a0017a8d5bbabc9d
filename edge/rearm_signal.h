// SIGUSR1 re-arms a station after an emergency stop: the hand at the station of who is logged in on
// its computer. Nobody on the bus can send a signal.
#pragma once

namespace ols::station {

void install_rearm_handler();
// Whether the signal came since the last call.
bool take_rearm_signal();

}  // namespace ols::station
