// The connection to a telescope behind an INDI server, by libindiclient: the telescope's reports,
// and orders to it. The library receives in its own thread. heard() may be called from any thread;
// all other functions must be called from one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "edge/mount/indi/telescope_axes.h"

namespace ols::indi {

// For example "no INDI server at localhost:7624".
struct IndiError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The telescope's reports since the connection.
struct Heard {
  bool lost = false;  // the server or the driver is gone
  bool has_device = false;
  bool is_connected = false;  // the driver is connected to the telescope
  std::optional<Equatorial> position;
  double position_s = 0.0;  // arrival of `position`, CLOCK_MONOTONIC
  bool slews = false;       // the telescope is moving to ordered coordinates
  std::optional<Observer> observer;
  // Largest track rate of both axes; nullopt if the telescope takes no track rates.
  std::optional<double> fastest_rad_s;
  bool can_stop_tracking = false;
  bool tracks = false;
  bool is_parked = false, parks = false;  // parks: it is moving to its parking position
  std::string pier_side;                  // "PIER_WEST" or "PIER_EAST"; empty if not stated
  std::uint64_t positions_refused = 0, motions_refused = 0, stops_refused = 0;
  std::string message;  // the driver's last message
};

class IndiLink {
 public:
  IndiLink(std::string host, int port, std::string device);
  ~IndiLink();  // closes the connection; the telescope continues its last order
  IndiLink(const IndiLink&) = delete;
  IndiLink& operator=(const IndiLink&) = delete;

  void open();  // connects to the server and waits for the result; throws IndiError
  Heard heard() const;

  void connect_telescope();
  void unpark();
  void set_interval(double interval_s);  // sets the interval of the telescope's reports
  void stop();                           // ends slewing and tracking
  void track(const TrackRate& rate);
  void go_to(const Equatorial& to);
  // The rate of the last track(); nullopt after stop() or go_to().
  const std::optional<TrackRate>& ordered() const { return ordered_; }

 private:
  class Client;
  std::unique_ptr<Client> client_;
  std::optional<TrackRate> ordered_;
  double began_s_ = 0.0;  // when tracking was last ordered to begin
};

}  // namespace ols::indi
