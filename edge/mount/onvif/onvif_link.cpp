#include "edge/mount/onvif/onvif_link.h"

#include <sodium.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/process/clocks.h"
#include "edge/mount/onvif/service_address.h"

namespace ols::onvif {
namespace {

constexpr long kOk = 200, kUnauthorized = 401;
constexpr std::size_t kNonce = 16;

// Refusals of other kinds are left to the reader of the answer.
bool login_refused(const HttpLink::Answer& answer, const Request& request) {
  if (answer.status == kUnauthorized) return true;
  if (answer.status == kOk) return false;
  try {
    check_done(answer.body, request.name());
  } catch (const SoapFault& fault) {
    return fault.not_authorized;
  } catch (const AnswerError&) {  // no SOAP
  }
  return false;
}

}  // namespace

OnvifLink::OnvifLink(const HttpLink::Config& http, std::string url, Credentials credentials)
    : http_(http), url_(std::move(url)), credentials_(std::move(credentials)), ptz_url_(url_) {}

HttpLink::Answer OnvifLink::post(const std::string& url, const Request& request) {
  if (login_ != Login::kToken) {
    return http_.post(url, request.action, envelope(request),
                      login_ == Login::kDigest ? &credentials_ : nullptr);
  }
  Token token{credentials_, std::string(kNonce, '\0'), 0};
  randombytes_buf(token.nonce.data(), kNonce);
  const double utc_s = 1e-9 * static_cast<double>(clock_utc_ns()) + clock_ahead_s_.value_or(0.0);
  token.created_utc_s = std::llround(utc_s);
  return http_.post(url, request.action, envelope(request, token), nullptr);
}

// The first refusal, of a request without a password, says which login the camera wants. The
// password is then tried once.
OnvifLink::Exchange OnvifLink::ask(const std::string& url, const Request& request) {
  Exchange exchange;
  HttpLink::Answer answer;
  const auto exchanged = [&] {
    exchange.sent_s = clock_monotonic_s();
    answer = post(url, request);
    exchange.answered_s = clock_monotonic_s();
    return !login_refused(answer, request);
  };
  if (!exchanged()) {
    if (login_ == Login::kNone && !credentials_.user.empty()) {
      login_ = answer.offers_digest ? Login::kDigest : Login::kToken;
      if (!exchanged()) throw LoginRefused(request.name() + ": user or password refused");
    } else if (logged_in_) {  // the camera has restarted, or its clock was set
      throw HttpError(request.name() + ": the login has expired");
    } else {
      throw LoginRefused(request.name() + (credentials_.user.empty()
                                               ? ": the camera wants user and password"
                                               : ": user or password refused"));
    }
  }
  logged_in_ = login_ != Login::kNone;
  // If there is a fault, the reader of the answer throws its text.
  if (answer.status != kOk && answer.body.find("Fault") == std::string::npos)
    throw AnswerError(request.name() + ": HTTP status " + std::to_string(answer.status));
  exchange.answer = std::move(answer.body);
  return exchange;
}

void OnvifLink::read_clock() {
  const Exchange exchange = ask(url_, get_system_date_and_time());
  clock_ahead_s_.reset();
  if (const auto utc_s = date_and_time(exchange.answer)) {
    constexpr double kHalfSecond = 0.5;  // the clock tells whole seconds
    clock_ahead_s_ =
        static_cast<double>(*utc_s) + kHalfSecond - 1e-9 * static_cast<double>(clock_utc_ns());
  }
}

std::vector<Profile> OnvifLink::read_profiles() {
  read_clock();
  const Services services = onvif::services(ask(url_, get_capabilities()).answer);
  has_ptz_ = !services.ptz.empty();
  ptz_url_ = service_address(url_, services.ptz);
  media_url_ = service_address(url_, services.media);
  try {
    return profiles(ask(media_url_, get_profiles()).answer);
  } catch (const AnswerError&) {  // it has Media2 alone
    if (!services.media.empty()) throw;
  }
  return {};
}

// Only Media2 names H.265. If a camera has none, or gives no usable answer, what Media has stated
// stands.
void OnvifLink::add_media2(std::vector<Profile>& profiles) try {
  const Services services = listed_services(ask(url_, get_services()).answer);
  if (services.media2.empty()) return;
  media2_url_ = service_address(url_, services.media2);
  for (const Profile& profile : media2_profiles(ask(media2_url_, get_media2_profiles()).answer)) {
    const auto known = std::ranges::find(profiles, profile.token, &Profile::token);
    if (known == profiles.end()) {
      profiles.push_back(profile);
    } else if (known->encoding != profile.encoding && !profile.encoding.empty()) {
      const auto [configuration, node] = std::pair{known->configuration, known->node};
      *known = profile;
      if (profile.configuration.empty()) known->configuration = configuration, known->node = node;
    }
  }
} catch (const AnswerError&) {
  return;
}

std::string OnvifLink::read_stream(const Profile& profile) {
  const std::string& token = profile.token;
  if (profile.of_media2)
    return media2_stream_uri(ask(media2_url_, get_media2_stream_uri(token)).answer);
  return stream_uri(ask(media_url_, get_stream_uri(token)).answer);
}

DeviceInformation OnvifLink::read_device() {
  try {
    return device_information(ask(url_, get_device_information()).answer);
  } catch (const AnswerError&) {  // it gives only names
    return {};
  }
}

// Some cameras answer GetConfigurationOptions with another message or with a fault.
PtzOptions OnvifLink::read_options(const Profile& profile) {
  try {
    return options(ask_ptz(get_options(profile.configuration)).answer);
  } catch (const AnswerError&) {
    if (profile.node.empty()) throw;
  }
  return node_options(ask_ptz(get_node(profile.node)).answer);
}

// The stop may be refused by a camera that is at rest.
void OnvifLink::order_stop(const std::string& profile) {
  try {
    check_done(ask_ptz(stop(profile)).answer, "Stop");
  } catch (const AnswerError&) {  // whether the camera moves is judged by its positions
  }
}

void OnvifLink::stop_first(const Access& earlier) {
  ptz_url_ = earlier.ptz_url;
  login_ = earlier.login;
  clock_ahead_s_ = earlier.clock_ahead_s;
  try {
    order_stop(earlier.profile);
  } catch (const LoginRefused&) {  // the camera wants another login, or its clock was set
    login_ = Login::kNone;
  } catch (const HttpError&) {  // or else its PTZ service may have moved to another port
    if (shown_address(ptz_url_) == shown_address(url_)) throw;
  }
}

Learnt OnvifLink::learn(const std::string& wanted) {
  auto all = read_profiles();
  if (!has_ptz_) throw AnswerError("the camera has no PTZ service");
  const auto find = [&] {
    return std::ranges::find_if(all, [&](const Profile& profile) {
      return wanted.empty() ? !profile.configuration.empty() : profile.token == wanted;
    });
  };
  if (find() == all.end()) add_media2(all);
  const auto found = find();
  if (found == all.end() || found->configuration.empty())
    throw AnswerError(wanted.empty() ? "the camera has no profile with PTZ"
                                     : "the camera has no profile " + wanted + " with PTZ");
  order_stop(found->token);
  return {read_device(), *found, read_options(*found)};
}

Offer OnvifLink::offer() {
  Offer offer;
  auto all = read_profiles();
  add_media2(all);
  for (const Profile& profile : all) {
    Offer::Stream stream{profile, stream_address(url_, read_stream(profile)), {}};
    if (stream.url.empty()) continue;
    try {
      if (has_ptz_ && !profile.configuration.empty()) stream.ptz = read_options(profile);
    } catch (const AnswerError&) {  // a stream is enough
    }
    offer.streams.push_back(std::move(stream));
  }
  if (offer.streams.empty()) throw AnswerError("the camera has no stream by RTSP");
  offer.device = read_device().name;
  return offer;
}

}  // namespace ols::onvif
