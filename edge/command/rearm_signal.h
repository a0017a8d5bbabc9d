// SIGUSR1 re-arms a station after an emergency stop: a user logged in on its computer counts as a
// person at the station. No program on the bus can send a signal.
#pragma once

namespace ols::station {

void install_rearm_handler();
// True if the signal has come since the last call.
bool take_rearm_signal();

}  // namespace ols::station
