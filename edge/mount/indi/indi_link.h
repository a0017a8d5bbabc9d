// A telescope behind an INDI server (libindiclient): its reports, and orders to it. The library
// receives in its own thread. Call heard() from any thread, all other functions from one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "edge/mount/indi/telescope_axes.h"

namespace ols::indi {

// "no INDI server at localhost:7624"
struct IndiError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The telescope's reports since the connection.
struct Heard {
  bool lost = false;  // server or driver are gone
  bool has_device = false;
  bool is_connected = false;  // the driver, to the telescope
  std::optional<Equatorial> position;
  double position_s = 0.0;  // when it came, CLOCK_MONOTONIC
  bool slews = false;       // on its way to ordered coordinates
  std::optional<Observer> observer;
  std::optional<double> fastest_rad_s;  // track rate of both axes; nullopt: it has none
  bool can_stop_tracking = false;
  bool tracks = false;
  bool is_parked = false, parks = false;  // the latter: on its way there
  std::string pier_side;                  // "PIER_WEST"; empty: it does not say
  std::uint64_t positions_refused = 0, motions_refused = 0, stops_refused = 0;
  std::string message;  // the last one
};

class IndiLink {
 public:
  IndiLink(std::string host, int port, std::string device);
  ~IndiLink();  // closes the connection; the telescope continues its last order
  IndiLink(const IndiLink&) = delete;
  IndiLink& operator=(const IndiLink&) = delete;

  void open();  // waits for the server; throws IndiError
  Heard heard() const;

  void connect_telescope();
  void unpark();
  void set_interval(double interval_s);  // of its reports
  void stop();                           // a slew, and tracking
  void track(const TrackRate& rate);
  void go_to(const Equatorial& to);
  // The rate at which it tracks on our order.
  const std::optional<TrackRate>& ordered() const { return ordered_; }

 private:
  class Client;
  std::unique_ptr<Client> client_;
  std::optional<TrackRate> ordered_;
  double began_s_ = 0.0;  // when it was ordered to track
};

}  // namespace ols::indi
