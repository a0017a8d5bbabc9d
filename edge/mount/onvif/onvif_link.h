// The services of one ONVIF camera: logs in with the method that the camera wants, and reads what
// the camera can do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/mount/onvif/http_link.h"
#include "edge/mount/onvif/soap_answer.h"
#include "edge/mount/onvif/soap_request.h"

namespace ols::onvif {

// The camera refuses user or password.
struct LoginRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What is learnt about a camera before anything moves.
struct Learnt {
  std::string device;  // maker and model; empty if the camera does not state them
  Profile profile;
  PtzOptions options;
};

// What a camera has, for a person who sets a station up.
struct Offer {
  struct Stream {
    Profile profile;
    std::string url;  // rtsp://, without user and password
    // Empty: its profile does not turn the camera, or the camera does not say how.
    std::optional<PtzOptions> ptz;
  };
  std::string device;  // maker and model
  std::vector<Stream> streams;
};

class OnvifLink {
 public:
  // `url`: the address of the device service.
  OnvifLink(const HttpLink::Config& http, std::string url, Credentials credentials);

  // Reads the clock, the addresses and the profile. `profile`: its token; empty for the first one
  // with PTZ. Throws HttpError, AnswerError or LoginRefused, as all methods do.
  Learnt learn(const std::string& profile);

  // Reads the same of all profiles, and their streams. Nothing is moved.
  Offer offer();

  // When the request left and its answer came, CLOCK_MONOTONIC [s].
  struct Exchange {
    std::string answer;
    double sent_s = 0.0, answered_s = 0.0;
  };
  Exchange ask_ptz(const Request& request) { return ask(ptz_url_, request); }

  HttpLink& http() { return http_; }
  // How far the camera's clock is ahead of the station's UTC [s]; nullopt if the camera does not
  // state its time.
  std::optional<double> clock_ahead_s() const { return clock_ahead_s_; }

 private:
  enum class Login { kNone, kDigest, kToken };
  Exchange ask(const std::string& url, const Request& request);
  HttpLink::Answer post(const std::string& url, const Request& request);
  void read_clock();
  std::vector<Profile> read_profiles();
  std::string read_device();
  PtzOptions read_options(const Profile& profile);

  HttpLink http_;
  const std::string url_;
  const Credentials credentials_;
  std::string ptz_url_, media_url_;
  bool has_ptz_ = false;
  Login login_ = Login::kNone;
  bool logged_in_ = false;  // the camera has accepted the login on this connection
  std::optional<double> clock_ahead_s_;
};

}  // namespace ols::onvif
