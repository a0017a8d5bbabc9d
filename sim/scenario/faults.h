// The faults of the simulated devices of one station at one instant. Each device gets its part by
// set_faults(), from any thread. sim/scenario/fault_plan.h decides when. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::sim {

struct PtzFaults {           // of an ONVIF PTZ
  double late_s = 0.0;       // age of the positions that it reports
  double step_deg = 0.0;     // its positions are whole multiples of this; 0: exact
  bool frozen = false;       // it keeps reporting the position that it had when this began
  bool no_position = false;  // it reports none
  bool ignores_timeout = false, ignores_stop = false;
  double clock_off_s = 0.0;  // its clock against UTC
  double lost_share = 0.0;   // of requests, lost together with their connections
  bool reboots = false;      // the edge from false to true: it goes home, and is not reachable
  bool operator==(const PtzFaults&) const = default;
};

struct PtuFaults {
  PtzFaults ptz;
  bool line_cut = false;      // no byte in either direction; the device node remains
  bool line_gone = false;     // the device itself is gone (an unplugged USB adapter)
  double garble_share = 0.0;  // share of replies with a wrong byte (lost, flipped or inserted)
  double reply_lost_every_s = 0.0;  // interval of lost replies; 0: none lost
  bool echo_on = false;             // the edge from false to true switches echo on, as EE does
  bool power_cycle = false;         // the edge from false to true: off and on again
  std::optional<bool> homes_then;   // whether it homes when powered; nullopt: as configured
  double lost_steps_deg = 0.0;      // the edge from 0: pan slips by this, unnoticed by the unit
  bool operator==(const PtuFaults&) const = default;
};

struct CameraFaults {
  bool gone = false;          // answers nothing, as if unplugged
  double packet_loss = 0.0;   // share of image packets
  bool no_resend = false;     // a camera without packet resend
  double missing_rate = 0.0;  // of RTSP: share of the stamped pictures that are not sent
  double clock_off_s = 0.0;   // of RTSP: the camera's own clock against UTC
  double clock_drift = 0.0;   // of RTSP: the same, [s/s] since it was switched on
  std::string pixel_format;   // enforced by the camera after the next connection; empty: none
  bool operator==(const CameraFaults&) const = default;
};

struct GnssFaults {
  bool silent = false;
  bool no_fix = false;
  double jump_m = 0.0;  // to the east
  double garble_share = 0.0;
  bool operator==(const GnssFaults&) const = default;
};

struct InclinometerFaults {
  bool silent = false;
  bool stuck = false;  // repeats the last value
  double garble_share = 0.0;
  bool operator==(const InclinometerFaults&) const = default;
};

// These are not faults, but what a person has put in front of the camera, or on its lens.
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
