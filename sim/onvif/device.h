// A simulated ONVIF PTZ camera: requests and time in, answers out (ONVIF Core, Media and PTZ
// service 2.x; SOAP 1.2). Pure: sim/onvif/server.* serves it by HTTP.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "sim/onvif/config.h"
#include "sim/onvif/login.h"
#include "sim/onvif/ptz_spaces.h"
#include "sim/onvif/ptz_unit.h"
#include "sim/onvif/soap.h"

namespace ols::sim {

struct OnvifRequest {
  std::string method, target, authorization;  // of HTTP
  std::string body;
};

struct OnvifAnswer {
  int status = 200;
  std::string body;
  std::string challenge;  // header WWW-Authenticate; empty: none
};

class OnvifDevice {
 public:
  OnvifDevice(const OnvifConfig& config, std::uint64_t seed, double time_s);

  void set_faults(const PtzFaults& faults, double time_s);

  // Answers a request; nullopt: the connection breaks. `time_s`: the unit's clock, which never
  // decreases; `utime_us`: UTC.
  std::optional<OnvifAnswer> answer(const OnvifRequest& request, double time_s,
                                    std::int64_t utime_us);

  PanTilt angles_at(double time_s) const { return unit_.angles_at(time_s); }

 private:
  struct Operation {
    const char *space, *name;
    bool open;  // true: the operation needs no login
    std::string (OnvifDevice::*run)(pugi::xml_node request);
  };
  static const Operation* operation(const XmlName& name);

  OnvifAnswer answer(const pugi::xml_document& message, const OnvifRequest& request);
  std::optional<OnvifAnswer> refusal(pugi::xml_node envelope, const OnvifRequest& request);

  std::string date_and_time(pugi::xml_node);
  std::string services(pugi::xml_node request);
  std::string capabilities(pugi::xml_node);
  std::string device_capabilities(pugi::xml_node);
  std::string device_information(pugi::xml_node);
  std::string scopes(pugi::xml_node);
  std::string media_capabilities(pugi::xml_node);
  std::string video_sources(pugi::xml_node);
  std::string profiles(pugi::xml_node);
  std::string profile(pugi::xml_node request);
  std::string stream_uri(pugi::xml_node request);
  std::string media2_capabilities(pugi::xml_node);
  std::string media2_profiles(pugi::xml_node);
  std::string media2_stream_uri(pugi::xml_node request);
  std::string ptz_capabilities(pugi::xml_node);
  std::string nodes(pugi::xml_node);
  std::string node(pugi::xml_node request);
  std::string configurations(pugi::xml_node);
  std::string configuration(pugi::xml_node request);
  std::string configuration_options(pugi::xml_node request);
  std::string status(pugi::xml_node request);
  std::string continuous_move(pugi::xml_node request);
  std::string absolute_move(pugi::xml_node request);
  std::string relative_move(pugi::xml_node request);
  std::string stop(pugi::xml_node request);
  void go_to(const std::optional<PtzVector>& position, pugi::xml_node request);

  const OnvifConfig config_;
  Login login_;
  PtzUnit unit_;
  PtzFaults faults_;
  std::mt19937_64 random_;
  // Of the request being answered.
  double time_s_ = 0.0;
  std::int64_t utime_us_ = 0;  // the camera's clock
};

}  // namespace ols::sim
