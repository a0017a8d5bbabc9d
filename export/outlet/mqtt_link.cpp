#include "export/outlet/mqtt_link.h"

#include <mosquitto.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <optional>
#include <utility>

#include "base/files/small_file.h"
#include "base/process/clocks.h"
#include "export/outlet/tcp_socket.h"

namespace ols::exports {
namespace {

constexpr int kKeepAlive_s = 5;  // the least that the library takes
constexpr std::size_t kLongestPassword = 4096;

std::string first_line(const std::string& path) {
  try {
    const std::string text = read_small_file(path, kLongestPassword);
    return text.substr(0, text.find_first_of("\r\n"));
  } catch (const std::exception& failure) {
    throw LinkError(failure.what());
  }
}

// All that a broker says to a client without subscriptions, each with its length: that the log-in
// is accepted, and that it is alive.
constexpr unsigned char kLoginAnswer = 0x20, kAlive = 0xd0;
using Head = std::array<unsigned char, 4>;

// The number of bytes that have arrived, without taking them; < 0: the library must go on, or
// report what is wrong.
int peek(mosquitto* session, Head& head) {
  auto* const tls = static_cast<SSL*>(mosquitto_ssl_get(session));
  if (tls != nullptr) {
    if (SSL_is_init_finished(tls) == 0) return -1;
    const int there = SSL_peek(tls, head.data(), static_cast<int>(head.size()));
    if (there > 0) return there;
    return SSL_get_error(tls, there) == SSL_ERROR_WANT_READ ? 0 : -1;
  }
  const auto there =
      ::recv(mosquitto_socket(session), head.data(), head.size(), MSG_PEEK | MSG_DONTWAIT);
  if (there > 0) return static_cast<int>(there);
  return there < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : -1;
}

const char* or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

struct Library {
  Library() { mosquitto_lib_init(); }
  ~Library() { mosquitto_lib_cleanup(); }
};

}  // namespace

struct MqttLink::Client {
  explicit Client(const std::string& name) : session(mosquitto_new(name.c_str(), true, this)) {
    if (session == nullptr) throw LinkError("no memory for an MQTT client");
    mosquitto_connect_callback_set(session, [](mosquitto*, void* self, int code) {
      static_cast<Client*>(self)->answer = code;
    });
    mosquitto_log_callback_set(session, [](mosquitto*, void* self, int level, const char* text) {
      if (level == MOSQ_LOG_ERR) static_cast<Client*>(self)->error = text;
    });
  }
  ~Client() { mosquitto_destroy(session); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  mosquitto* session;
  std::optional<int> answer;  // of the broker to our log-in
  std::string error;          // the library's last; its results do not say what is wrong with TLS
};

MqttLink::MqttLink(const Address& address, TlsFiles files, MqttLogin login)
    : address_(address), files_(std::move(files)), login_(std::move(login)) {
  static const Library library;
}

MqttLink::~MqttLink() { close(); }

void MqttLink::check(int result, const std::string& doing) const {
  if (result == MOSQ_ERR_SUCCESS) return;
  const bool says_more = result == MOSQ_ERR_TLS && client_ && !client_->error.empty();
  throw LinkError(address_.host + ":" + std::to_string(address_.port) + ": " + doing + ": " +
                  mosquitto_strerror(result) + (says_more ? " " + client_->error : ""));
}

void MqttLink::open() {
  close();
  // The library's own connection would wait for minutes for a host that does not answer.
  static_cast<void>(TcpSocket(address_.host, address_.port, kPatience_s));
  client_ = std::make_unique<Client>(login_.client);
  mosquitto* const session = client_->session;
  mosquitto_int_option(session, MOSQ_OPT_TCP_NODELAY, 1);
  check(mosquitto_will_set(session, login_.status_topic.c_str(), 7, "offline", 0, true), "will");
  if (!login_.user.empty()) {
    const std::string password =
        login_.password_file.empty() ? "" : first_line(login_.password_file);
    check(mosquitto_username_pw_set(session, login_.user.c_str(), or_null(password)), "user");
  }
  if (address_.scheme == Scheme::kMqtts) {
    const char* const folder = files_.ca.empty() ? "/etc/ssl/certs" : nullptr;
    check(mosquitto_tls_set(session, or_null(files_.ca), folder, or_null(files_.certificate),
                            or_null(files_.key), nullptr),
          "TLS");
  }
  check(mosquitto_connect(session, address_.host.c_str(), address_.port, kKeepAlive_s), "connect");
  keep_unsent_short(mosquitto_socket(session));
  log_in();
}

void MqttLink::log_in() {
  const double end_s = clock_monotonic_s() + kPatience_s;
  while (!client_->answer && clock_monotonic_s() < end_s) {
    const short wanted = mosquitto_want_write(client_->session) ? POLLIN | POLLOUT : POLLIN;
    pollfd ready{mosquitto_socket(client_->session), wanted, 0};
    ::poll(&ready, 1, 100);
    if ((ready.revents & POLLOUT) != 0) check(mosquitto_loop_write(client_->session, 1), "log-in");
    if ((ready.revents & ~POLLOUT) == 0) continue;
    const int result = take();
    if (!client_->answer) check(result, "log-in");
  }
  if (!client_->answer) check(MOSQ_ERR_CONN_PENDING, "does not answer");
  if (*client_->answer != 0) {
    throw LinkError(address_.host + ": " + mosquitto_connack_string(*client_->answer));
  }
  send({"", "online", login_.status_topic, true});
}

// The library would keep a message of up to 256 MB in memory, even one that nobody subscribed to.
int MqttLink::take() {
  constexpr int kMostAtOnce = 100;
  for (int i = 0; i < kMostAtOnce; ++i) {
    Head head{};
    const int there = peek(client_->session, head);
    if (there == 0) break;
    if (there > 0) {
      const int length = head[0] == kLoginAnswer ? 2 : 0;
      const bool is_asked_for = head[0] == kLoginAnswer || head[0] == kAlive;
      if (!is_asked_for || (there > 1 && head[1] != length)) {
        throw LinkError(address_.host + ":" + std::to_string(address_.port) +
                        ": sends unasked messages");
      }
      if (there < 2 + length) {
        ::poll(nullptr, 0, 10);  // the rest is on its way
        break;
      }
    }
    const int result = mosquitto_loop_read(client_->session, 1);
    if (there < 0 || result != MOSQ_ERR_SUCCESS) return result;
  }
  return MOSQ_ERR_SUCCESS;
}

void MqttLink::send(const Packet& packet) {
  check(mosquitto_publish(client_->session, nullptr, packet.where.c_str(),
                          static_cast<int>(packet.bytes.size()), packet.bytes.data(), 0,
                          packet.is_retained),
        "publish");
  write_all();
}

// The library would keep in memory what the broker does not read. A broker that reads little by
// little gets no more time.
void MqttLink::write_all() {
  const double end_s = clock_monotonic_s() + kPatience_s;
  while (mosquitto_want_write(client_->session)) {
    pollfd ready{mosquitto_socket(client_->session), POLLOUT, 0};
    const double left_s = end_s - clock_monotonic_s();
    if (left_s <= 0.0 || ::poll(&ready, 1, static_cast<int>(1e3 * left_s)) == 0) {
      throw LinkError(address_.host + ": does not read");
    }
    check(mosquitto_loop_write(client_->session, 1), "write");
  }
}

void MqttLink::wait(int wake_fd, double seconds) {
  std::array<pollfd, 2> ready{
      {{mosquitto_socket(client_->session), POLLIN, 0}, {wake_fd, POLLIN, 0}}};
  ::poll(ready.data(), ready.size(), static_cast<int>(1e3 * seconds));
  if (ready[0].revents != 0) check(take(), "read");
  const int result = mosquitto_loop_misc(client_->session);
  if (result == MOSQ_ERR_KEEPALIVE) {
    throw LinkError(address_.host + ":" + std::to_string(address_.port) + ": does not answer");
  }
  check(result, "keep alive");
}

// Without a farewell, which would cancel the last will: by it, the broker reports "offline".
void MqttLink::close() { client_.reset(); }

}  // namespace ols::exports
