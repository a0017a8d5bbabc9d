// The faults of the simulated devices of one station at one instant. Each device receives its part
// by set_faults(), from any thread. sim/scenario/fault_plan.h decides which faults are active at
// which time. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::sim {

struct PtzFaults {           // of an ONVIF PTZ
  double late_s = 0.0;       // age of the reported positions
  double step_deg = 0.0;     // the reported positions are multiples of this; 0: exact
  bool frozen = false;       // it keeps reporting the position that it had when the fault began
  bool no_position = false;  // it reports no position
  bool ignores_timeout = false, ignores_stop = false;
  double clock_off_s = 0.0;  // its clock minus UTC
  double lost_share = 0.0;   // share of requests that are not answered; their connections break
  bool reboots = false;      // when it becomes true, the camera reboots: it does not answer for a
                             // while, and is then at its home position
  bool operator==(const PtzFaults&) const = default;
};

struct PtuFaults {
  PtzFaults ptz;
  bool line_cut = false;   // no byte in either direction; the device node remains
  bool line_gone = false;  // the device itself is gone (an unplugged USB adapter)
  // Share of replies with one error: a lost byte, an inserted byte or a flipped bit.
  double garble_share = 0.0;
  double reply_lost_every_s = 0.0;  // interval at which one reply is lost; 0: never
  bool echo_on = false;             // when it becomes true, the unit's echo is switched on (EE)
  bool power_cycle = false;         // when it becomes true, the unit is switched off and on
  std::optional<bool> homes_then;   // whether the unit homes after this; nullopt: as configured
  // When it changes from 0, the pan axis slips by this angle; the unit's counter does not change.
  double lost_steps_deg = 0.0;
  bool operator==(const PtuFaults&) const = default;
};

struct CameraFaults {
  bool gone = false;         // the camera gives no answers, as if unplugged
  double packet_loss = 0.0;  // share of image packets
  bool no_resend = false;    // the camera does not resend packets
  // RTSP: the camera makes pictures at (1 - missing_rate) times its frame rate, but stamps them at
  // the spacing of the full frame rate.
  double missing_rate = 0.0;
  double clock_off_s = 0.0;  // RTSP: the camera's clock minus UTC
  double clock_drift = 0.0;  // RTSP: drift [s/s] of the camera's clock since power-up
  // Format that the camera enforces from the next connection on; empty: none.
  std::string pixel_format;
  bool operator==(const CameraFaults&) const = default;
};

struct GnssFaults {
  bool silent = false;
  bool no_fix = false;
  double jump_m = 0.0;  // the reported position jumps to the east by this
  double garble_share = 0.0;
  bool operator==(const GnssFaults&) const = default;
};

struct InclinometerFaults {
  bool silent = false;
  bool stuck = false;  // repeats the last value
  double garble_share = 0.0;
  bool operator==(const InclinometerFaults&) const = default;
};

// Things that a person has put in front of the camera or on its lens; they are not faults.
struct ByHand {
  bool level_line = false, cross = false,
       rulers = false;  // rectification targets: sim/world/boards.h
  bool sun_filter = false;
  bool operator==(const ByHand&) const = default;
};

struct StationFaults {
  PtuFaults ptu;
  CameraFaults camera;
  GnssFaults gnss;
  InclinometerFaults inclinometer;
  bool stop_pressed = false;  // emergency stop
  bool rearm_held = false;    // not a fault: a person holds the re-arm button
  ByHand by_hand;
  bool operator==(const StationFaults&) const = default;
};

}  // namespace ols::sim
