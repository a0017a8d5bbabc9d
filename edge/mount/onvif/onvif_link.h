// The connection to one ONVIF camera: logs in by the method that the camera requires, reads its
// capabilities, and exchanges requests and answers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/mount/onvif/http_link.h"
#include "edge/mount/onvif/soap_answer.h"
#include "edge/mount/onvif/soap_request.h"

namespace ols::onvif {

// The camera refuses the user or the password.
struct LoginRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The data of a camera that are read before it is moved.
struct Learnt {
  DeviceInformation device;  // empty if the camera does not state it
  Profile profile;
  PtzOptions options;
};

// How a camera was reached and logged in to: enough to order a stop before anything is asked.
struct Access {
  enum class Login { kNone, kDigest, kToken };
  std::string ptz_url, profile;  // address of the PTZ service, token of the profile
  Login login = Login::kNone;
  std::optional<double> clock_ahead_s;  // OnvifLink::clock_ahead_s()
};

// The capabilities of a camera, for a person who sets up a station.
struct Offer {
  struct Stream {
    Profile profile;
    std::string url;  // rtsp://, without user and password
    // nullopt if the profile has no PTZ, or if the camera does not state the options.
    std::optional<PtzOptions> ptz;
  };
  std::string device;  // maker and model
  std::vector<Stream> streams;
};

class OnvifLink {
 public:
  // `url`: the address of the device service.
  OnvifLink(const HttpLink::Config& http, std::string url, Credentials credentials);

  // Orders a stop as the first request of this connection, by what an earlier connection has found.
  // If the camera refuses this, learn() orders the stop. Throws HttpError.
  void stop_first(const Access& earlier);
  // Reads the camera's clock, the addresses of its services, and a profile. Then orders a stop, and
  // reads the rest. `profile`: the profile's token; empty for the first one with PTZ. Throws
  // HttpError, AnswerError or LoginRefused, as the following methods do.
  Learnt learn(const std::string& profile);
  // The access that this connection has found.
  Access access(const Profile& profile) const {
    return {ptz_url_, profile.token, login_, clock_ahead_s_};
  }

  // Reads all profiles with their options and streams. Does not move the camera.
  Offer offer();

  // An answer, with the times at which the request was sent and answered (CLOCK_MONOTONIC).
  struct Exchange {
    std::string answer;
    double sent_s = 0.0, answered_s = 0.0;
  };
  Exchange ask_ptz(const Request& request) { return ask(ptz_url_, request); }

  HttpLink& http() { return http_; }
  // The camera's clock minus the station's UTC [s]; nullopt if the camera does not state its time.
  std::optional<double> clock_ahead_s() const { return clock_ahead_s_; }

 private:
  using Login = Access::Login;
  Exchange ask(const std::string& url, const Request& request);
  HttpLink::Answer post(const std::string& url, const Request& request);
  void read_clock();
  std::vector<Profile> read_profiles();
  void add_media2(std::vector<Profile>& profiles);
  std::string read_stream(const Profile& profile);
  DeviceInformation read_device();
  PtzOptions read_options(const Profile& profile);
  void order_stop(const std::string& profile);

  HttpLink http_;
  const std::string url_;
  const Credentials credentials_;
  std::string ptz_url_, media_url_, media2_url_;
  bool has_ptz_ = false;
  Login login_ = Login::kNone;
  bool logged_in_ = false;  // the camera has accepted the login on this connection
  std::optional<double> clock_ahead_s_;
};

}  // namespace ols::onvif
