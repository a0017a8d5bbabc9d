// A simulated ONVIF camera and the product's driver of it (mount::Drive), in simulated time. Camera
// and driver exchange real SOAP texts; each text takes some time to arrive. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "edge/mount/driven/drive.h"
#include "edge/mount/onvif/soap_request.h"
#include "sim/onvif/device.h"

namespace ols::sim {

// The driver's configuration, with the values that the camera's data sheet would give.
mount::DriveConfig drive_config(const PtzUnitConfig& unit);

class OnvifInHand {
 public:
  OnvifInHand(const OnvifConfig& device, const mount::DriveConfig& drive, std::uint64_t seed,
              double now_s);

  // Call every few milliseconds.
  void advance(double now_s);

  mount::Drive& drive() { return drive_; }
  const mount::Drive& drive() const { return drive_; }
  PanTilt angles_at(double time_s) const { return device_.angles_at(time_s); }  // the true angles
  void set_faults(const PtzFaults& faults, double now_s);
  // Another client of the camera sends a request.
  void order_by_another(const onvif::Request& request, double now_s);

  struct Wire {
    double least_s = 0.005, most_s = 0.03;  // delay in each direction
    bool cut = false;
  };
  Wire wire;

 private:
  double way_s() { return std::uniform_real_distribution(wire.least_s, wire.most_s)(random_); }
  std::string ask(const onvif::Request& request);
  void connect(double now_s);
  void lose(double now_s);
  onvif::Request request_of(const mount::Order& order) const;
  void send(const mount::Order& order, double now_s);
  void finish(double now_s);

  const OnvifConfig device_config_;
  const mount::DriveConfig drive_config_;
  OnvifDevice device_;
  mount::Drive drive_;
  std::mt19937_64 random_;
  double device_s_ = 0.0;  // when the last request arrived at the device
  double sent_s_ = 0.0, again_s_ = 0.0;
  std::optional<mount::Order> pending_;
  std::string answer_;
  bool lost_ = false;
  int nonce_ = 0;
};

}  // namespace ols::sim
