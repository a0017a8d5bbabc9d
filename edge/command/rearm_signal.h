// The signal SIGUSR1 re-arms a station after an emergency stop. A user who is logged in on the
// station's computer counts as a person at the station. A program on the bus cannot send a signal.
#pragma once

namespace ols::station {

void install_rearm_handler();
// True if the signal has arrived since the last call.
bool take_rearm_signal();

}  // namespace ols::station
