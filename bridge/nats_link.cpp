#include "bridge/nats_link.h"

#include <nats/nats.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "base/config/toml_config.h"
#include "base/process/clocks.h"
#include "bridge/memory_budget.h"

namespace ols::bridge {
namespace {

constexpr std::int64_t kRetry_ms = 500, kPing_ms = 2000, kWrite_ms = 300;
constexpr int kPingsOut = 2;
constexpr double kRefusal_s = 60.0;        // a refused publication is reported for so long
constexpr std::size_t kLongestText = 200;  // a server may say anything
constexpr int kMostPending = 20'000;
constexpr std::array kKnownHeaders{kTargetHeader, kEpochHeader, kUnconfirmedHeader, kOwnerHeader};

void require(natsStatus status, const std::string& what) {
  if (status == NATS_OK) return;
  const char* detail = nats_GetLastError(nullptr);
  throw ConfigError("nats." + what + ": " + natsStatus_GetText(status) +
                    (detail == nullptr ? "" : std::string(" (") + detail + ")"));
}

const char* or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

// Default: the credential that systemd provides.
std::string seed_of(const NatsConfig& config) {
  if (!config.seed.empty()) return config.seed;
  const char* folder = std::getenv("CREDENTIALS_DIRECTORY");
  return folder == nullptr ? "" : std::string(folder) + "/ols-nats";
}

Headers headers_of(natsMsg* message) {
  Headers headers;
  for (const char* name : kKnownHeaders) {
    const char* value = nullptr;
    if (natsMsgHeader_Get(message, name, &value) == NATS_OK && value != nullptr) {
      headers[name] = value;
    }
  }
  return headers;
}

}  // namespace

NatsLink::NatsLink(const NatsConfig& config, const std::string& name,
                   const std::vector<std::string>& subjects, Handler handler)
    : handler_(std::move(handler)) {
  try {
    configure(config, name);
    connect(config.servers);
    for (const std::string& subject : subjects) hear(subject, kNetworkQueueBytes / subjects.size());
  } catch (...) {
    close();
    throw;
  }
}

NatsLink::~NatsLink() { close(); }

void NatsLink::configure(const NatsConfig& config, const std::string& name) {
  require(natsOptions_Create(&options_), "options");
  require(natsOptions_SetName(options_, name.c_str()), "name");
  require(natsOptions_SetMaxReconnect(options_, -1), "servers");
  require(natsOptions_SetReconnectWait(options_, kRetry_ms), "servers");
  require(natsOptions_SetReconnectJitter(options_, kRetry_ms / 5, kRetry_ms / 5), "servers");
  require(natsOptions_SetPingInterval(options_, kPing_ms), "servers");
  require(natsOptions_SetMaxPingsOut(options_, kPingsOut), "servers");
  require(natsOptions_SetWriteDeadline(options_, kWrite_ms), "servers");
  // Nothing is buffered while there is no connection.
  require(natsOptions_SetReconnectBufSize(options_, 1), "servers");
  require(natsOptions_SetFailRequestsOnDisconnect(options_, true), "servers");
  require(natsOptions_SetNoEcho(options_, true), "servers");
  require(natsOptions_SetReconnectedCB(options_, on_open, this), "servers");
  require(natsOptions_SetDisconnectedCB(options_, on_loss, this), "servers");
  require(natsOptions_SetRetryOnFailedConnect(options_, true, on_open, this), "servers");
  require(natsOptions_SetClosedCB(options_, on_closed, this), "servers");
  // A lambda, because our header does not know the library's type of a status.
  const natsErrHandler refused = [](natsConnection* connection, natsSubscription* subscription,
                                    natsStatus status, void* self) {
    on_refusal(connection, subscription, static_cast<int>(status), self);
  };
  require(natsOptions_SetErrorHandler(options_, refused, this), "servers");
  if (!config.credentials.empty()) {
    require(natsOptions_SetUserCredentialsFromFiles(options_, config.credentials.c_str(), nullptr),
            "credentials");
  }
  if (!config.nkey.empty()) {
    require(natsOptions_SetNKeyFromSeed(options_, config.nkey.c_str(), seed_of(config).c_str()),
            "nkey");
  }
  // With the address alone, the server would decide whether anything is encrypted.
  if (is_over_tls(config)) require(natsOptions_SetSecure(options_, true), "servers");
  if (!config.authority.empty()) {
    require(natsOptions_LoadCATrustedCertificates(options_, config.authority.c_str()), "authority");
  }
  if (!config.certificate.empty()) {
    require(natsOptions_LoadCertificatesChain(options_, or_null(config.certificate),
                                              or_null(config.key)),
            "certificate");
  }
}

void NatsLink::connect(const std::vector<std::string>& servers) {
  std::vector<const char*> urls;
  for (const std::string& server : servers) urls.push_back(server.c_str());
  require(natsOptions_SetServers(options_, urls.data(), static_cast<int>(urls.size())), "servers");
  const natsStatus status = natsConnection_Connect(&connection_, options_);
  if (connection_ != nullptr) begin_callbacks();
  if (status == NATS_OK) {
    on_open(connection_, this);
    return;
  }
  if (status == NATS_NOT_YET_CONNECTED) {
    note("no server answers, or it refuses this user");
    return;
  }
  // What answered is no server of NATS, or one without TLS: the library does not try again by
  // itself.
  note(natsStatus_GetText(status));
  has_ended_ = true;
}

// Messages that come faster than they are handled are displaced, not kept.
void NatsLink::hear(const std::string& subject, std::size_t most_bytes) {
  // A thread of the library may have closed the link meanwhile.
  const auto holds = [this, &subject](natsStatus status) {
    if (status != NATS_CONNECTION_CLOSED && status != NATS_INVALID_SUBSCRIPTION) {
      require(status, "subject " + subject);
      return true;
    }
    has_ended_ = true;
    return false;
  };
  if (connection_ == nullptr) return;
  natsSubscription* subscription = nullptr;
  if (!holds(natsConnection_Subscribe(&subscription, connection_, subject.c_str(), on_message,
                                      this))) {
    return;
  }
  subscriptions_.push_back(subscription);
  if (!holds(natsSubscription_SetOnCompleteCB(subscription, on_complete, this))) return;
  begin_callbacks();
  holds(
      natsSubscription_SetPendingLimits(subscription, kMostPending, static_cast<int>(most_bytes)));
}

void NatsLink::close() {
  if (connection_ != nullptr) natsConnection_Close(connection_);
  {
    // The library closes in threads of its own, which still call back after Close().
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return callers_ == 0; });
  }
  for (natsSubscription* subscription : subscriptions_) natsSubscription_Destroy(subscription);
  subscriptions_.clear();
  natsConnection_Destroy(std::exchange(connection_, nullptr));
  natsOptions_Destroy(std::exchange(options_, nullptr));
}

bool NatsLink::send(const Outgoing& outgoing, Bytes bytes) {
  bool is_sent = false;
  natsMsg* message = nullptr;
  if (is_open_ && natsMsg_Create(&message, outgoing.subject.c_str(), nullptr,
                                 reinterpret_cast<const char*>(bytes.data()),
                                 static_cast<int>(bytes.size())) == NATS_OK) {
    for (const auto& [name, value] : outgoing.headers) {
      natsMsgHeader_Set(message, name.c_str(), value.c_str());
    }
    is_sent = natsConnection_PublishMsg(connection_, message) == NATS_OK;
    natsMsg_Destroy(message);
  }
  ++(is_sent ? tally_.sent : tally_.unsent);
  return is_sent;
}

LinkReport NatsLink::report() const {
  LinkReport report;
  report.is_open = is_open_;
  report.has_ended = has_ended_;
  report.openings = tally_.openings;
  report.losses = tally_.losses;
  report.sent = tally_.sent;
  report.unsent = tally_.unsent;
  report.refusals = tally_.refusals;
  for (natsSubscription* subscription : subscriptions_) {
    std::int64_t dropped = 0;
    if (natsSubscription_GetDropped(subscription, &dropped) == NATS_OK) {
      report.displaced += static_cast<std::uint64_t>(dropped);
    }
  }
  const std::lock_guard lock(mutex_);
  if (!report.is_open) report.trouble = said_.trouble;
  report.refusal = said_.unheard;
  if (clock_monotonic_s() - said_.refused_s < kRefusal_s) {
    report.refusal.append(said_.unheard.empty() ? "" : "; ").append(said_.refusal);
  }
  return report;
}

void NatsLink::begin_callbacks() {
  const std::lock_guard lock(mutex_);
  ++callers_;
}

// Notified under the lock: once the waiting thread has the lock, nothing of this object is used.
void NatsLink::end_callbacks() {
  const std::lock_guard lock(mutex_);
  --callers_;
  ended_.notify_all();
}

void NatsLink::note(const char* trouble) {
  const std::lock_guard lock(mutex_);
  said_.trouble = std::string(trouble).substr(0, kLongestText);
}

void NatsLink::on_message(natsConnection*, natsSubscription*, natsMsg* message, void* self) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(natsMsg_GetData(message));
  const auto size = static_cast<std::size_t>(natsMsg_GetDataLength(message));
  static_cast<NatsLink*>(self)->handler_(natsMsg_GetSubject(message), headers_of(message),
                                         {data, size});
  natsMsg_Destroy(message);
}

void NatsLink::on_open(natsConnection*, void* self) {
  auto* link = static_cast<NatsLink*>(self);
  ++link->tally_.openings;
  link->is_open_ = true;
  const std::lock_guard lock(link->mutex_);
  link->said_.unheard.clear();
  link->said_.refused_s = -1e9;
}

void NatsLink::on_loss(natsConnection* connection, void* self) {
  auto* link = static_cast<NatsLink*>(self);
  const char* why = nullptr;
  natsConnection_GetLastError(connection, &why);
  link->note(why == nullptr || *why == '\0' ? "the server does not answer" : why);
  if (link->is_open_.exchange(false)) ++link->tally_.losses;
}

// An error of an open connection: the user has no right to a publication or a subscription.
void NatsLink::on_refusal(natsConnection* connection, natsSubscription*, int status, void* self) {
  if (status == NATS_SLOW_CONSUMER) return;  // counted as displaced
  auto* link = static_cast<NatsLink*>(self);
  const char* why = nullptr;
  natsConnection_GetLastError(connection, &why);
  if (why == nullptr || *why == '\0') why = natsStatus_GetText(static_cast<natsStatus>(status));
  ++link->tally_.refusals;
  const std::lock_guard lock(link->mutex_);
  const std::string text = std::string(why).substr(0, kLongestText);
  if (text.find("Subscription") != std::string::npos) {
    link->said_.unheard = text;
    return;
  }
  link->said_.refusal = text;
  link->said_.refused_s = clock_monotonic_s();
}

// The library's last call for the connection, after the loss.
void NatsLink::on_closed(natsConnection* connection, void* self) {
  auto* link = static_cast<NatsLink*>(self);
  const char* why = nullptr;
  // That there is no server says less than the trouble before.
  const bool says_more = natsConnection_GetLastError(connection, &why) != NATS_NO_SERVER;
  if (says_more && why != nullptr && *why != '\0') link->note(why);
  link->has_ended_ = true;
  link->end_callbacks();
}

// The library's last call for a subscription.
void NatsLink::on_complete(void* self) { static_cast<NatsLink*>(self)->end_callbacks(); }

}  // namespace ols::bridge
