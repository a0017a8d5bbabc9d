#include "console/web_server.h"

#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/process/clocks.h"
#include "console/connection_limit.h"
#include "console/land_skylines.h"
#include "console/live_socket.h"

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using tcp = net::ip::tcp;

namespace ols::console {
namespace {

constexpr std::size_t kMostLive = 64;
constexpr std::size_t kMostHeaderBytes = 8192;
constexpr int kMostHashing = 4;    // each takes 64 MB and a tenth of a second
constexpr int kMostLookUps = 200;  // that wait for the disk, or for the land

using PlainStream = beast::tcp_stream;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;

}  // namespace

struct WebServer::Shared {
  Shared(const ConsoleConfig& of, land::TerrainFolder of_land, WebApi& web_api, Console& of_console)
      : config(of),
        api(web_api),
        console(of_console),
        maps(of.maps_folder),
        skylines(of_land.version, of_land.terrain),
        land(std::move(of_land)) {}

  ConsoleConfig config;
  WebApi& api;
  Console& console;
  net::io_context io{1};
  net::ssl::context tls{net::ssl::context::tls_server};
  std::optional<tcp::acceptor> acceptor;
  std::vector<std::weak_ptr<Live>> live;
  ConnectionLimit limit;
  int hashing = 0;
  int reading = 0;
  MapLibrary maps;        // of the thread of `readers`
  LandSkylines skylines;  // computed in the thread of `skyliners`
  SiteLand land;          // of the thread of `surveyors`
  // Declared last, so that they end before what their tasks use.
  net::thread_pool hashers{1}, readers{1}, surveyors{1}, skyliners{1};

  void accept();
  // Computes in another thread, then calls back in this one. False if too many wait already.
  template <class Work, class Done>
  bool hash(Work work, Done done) {
    if (hashing >= kMostHashing) return false;
    ++hashing;
    net::post(hashers, [this, work = std::move(work), done = std::move(done)]() mutable {
      net::post(io, [this, result = work(), done = std::move(done)] {
        --hashing;
        done(result);
      });
    });
    return true;
  }
  // Answers at once; a skyline that is not known yet is computed in another thread.
  WebResponse skyline(const LandTask& task) {
    auto answer = skylines.answer(task);
    if (!answer.begins) return std::move(answer.response);
    net::post(skyliners, [this, task] {
      net::post(io, [this, task, computed = skylines.compute(task)]() mutable {
        skylines.keep(task, std::move(computed));
      });
    });
    return std::move(answer.response);
  }
  // Reads from a disk, or computes, in that thread. False if too many requests wait already.
  template <class Source, class Task>
  bool look_up(net::thread_pool& thread, Source& source, const Task& task,
               std::function<void(const WebResponse&)> done) {
    if (reading >= kMostLookUps) return false;
    ++reading;
    net::post(thread, [this, &source, task, done = std::move(done)]() mutable {
      net::post(io, [this, response = source.answer(task), done = std::move(done)]() mutable {
        --reading;
        done(response);
      });
    });
    return true;
  }
};

namespace {

using Shared = WebServer::Shared;

template <class Stream>
class HttpConnection : public std::enable_shared_from_this<HttpConnection<Stream>> {
 public:
  HttpConnection(Stream&& stream, Shared& shared, std::string remote, ConnectionLimit::Place place)
      : stream_(std::move(stream)),
        shared_(shared),
        remote_(std::move(remote)),
        place_(std::move(place)) {}

  void start() {
    beast::get_lowest_layer(stream_).expires_after(kPatience);
    if constexpr (std::is_same_v<Stream, TlsStream>) {
      stream_.async_handshake(net::ssl::stream_base::server,
                              [self = this->shared_from_this()](beast::error_code error) {
                                if (!error) self->read();
                              });
    } else {
      read();
    }
  }

 private:
  void read() {
    parser_.emplace();
    parser_->body_limit(kMostBodyBytes);
    parser_->header_limit(kMostHeaderBytes);
    beast::get_lowest_layer(stream_).expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](beast::error_code error, std::size_t) {
                       self->on_read(error);
                     });
  }

  void on_read(beast::error_code error) {
    if (error == http::error::body_limit) return refuse(413, "the content is too long");
    if (error == http::error::header_limit) return refuse(431, "the header is too long");
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      return refuse(400, "not a HTTP request: " + error.message());
    }
    if (error) return close();
    const auto& request = parser_->get();
    asked_ = web_request(request);
    keep_alive_ = request.keep_alive();
    if (websocket::is_upgrade(request)) return upgrade();
    const WebAnswer answer = shared_.api.answer(asked_, clock_now());
    if (const auto* response = std::get_if<WebResponse>(&answer)) return respond(*response);
    if (const auto* task = std::get_if<LoginTask>(&answer)) return log_in(*task);
    if (const auto* task = std::get_if<UserTask>(&answer)) return enter(*task);
    if (const auto* task = std::get_if<MapTask>(&answer)) {
      return look_up(shared_.readers, shared_.maps, *task);
    }
    const auto& task = std::get<LandTask>(answer);
    if (task.what == LandTask::What::kSkyline) return respond(shared_.skyline(task));
    look_up(shared_.surveyors, shared_.land, task);
  }

  WebRequest web_request(const http::request<http::string_body>& request) const {
    const auto text = [&request](http::field name) { return std::string(request[name]); };
    return {std::string(request.method_string()),
            std::string(request.target()),
            text(http::field::host),
            text(http::field::origin),
            text(http::field::cookie),
            text(http::field::content_type),
            request.body(),
            remote_};
  }

  void upgrade() {
    auto admitted = shared_.api.admit(asked_, clock_now());
    if (const auto* refusal = std::get_if<WebResponse>(&admitted)) return respond(*refusal);
    if (shared_.live.size() >= kMostLive) return refuse(503, "too many browsers are connected");
    std::make_shared<LiveSocket<Stream, Shared>>(
        std::move(stream_), shared_, std::get<Session>(admitted), token_in(asked_.cookies), place_)
        ->start(parser_->release());
  }

  void log_in(const LoginTask& task) {
    beast::get_lowest_layer(stream_).expires_after(kPatience);
    const bool is_begun =
        shared_.hash([task] { return verify_password(task.hash, task.password); },
                     [self = this->shared_from_this(), task](bool is_verified) {
                       self->respond(self->shared_.api.finish(task, is_verified, clock_now()));
                     });
    if (!is_begun) refuse(503, "too many people log in: try again");
  }

  void enter(const UserTask& task) {
    beast::get_lowest_layer(stream_).expires_after(kPatience);
    const bool is_begun =
        shared_.hash([password = task.password] { return hash_password(password); },
                     [self = this->shared_from_this(), task](const std::string& hash) {
                       self->respond(self->shared_.api.finish(task, hash, clock_now()));
                     });
    if (!is_begun) refuse(503, "too many people log in: try again");
  }

  template <class Source, class Task>
  void look_up(net::thread_pool& thread, Source& source, const Task& task) {
    beast::get_lowest_layer(stream_).expires_after(kPatience);
    const bool is_begun = shared_.look_up(
        thread, source, task,
        [self = this->shared_from_this()](const WebResponse& found) { self->respond(found); });
    if (!is_begun) refuse(503, "too many maps and heights are asked for");
  }

  // Answers in the form of the other refusals, and ends the connection.
  void refuse(int status, const std::string& why) {
    keep_alive_ = false;
    respond({status, "application/json", Json{{"error", why}}.dump(), {}});
  }

  void respond(const WebResponse& response) {
    response_ = {};
    response_.version(11);
    response_.result(static_cast<unsigned>(response.status));
    response_.set(http::field::content_type, response.content_type);
    if (response.content_type == "application/json") {
      response_.set(http::field::cache_control, "no-store");
    }
    for (const auto& [name, value] :
         WebApi::security_headers(!shared_.config.certificate.empty())) {
      response_.set(name, value);
    }
    for (const auto& [name, value] : response.headers) response_.set(name, value);
    response_.keep_alive(keep_alive_);
    response_.body() = asked_.method == "HEAD" ? std::string() : response.body;
    response_.content_length(response.body.size());
    http::async_write(stream_, response_,
                      [self = this->shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error && self->keep_alive_) return self->read();
                        self->close();
                      });
  }

  void close() {
    beast::error_code ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  Stream stream_;
  Shared& shared_;
  std::string remote_;
  ConnectionLimit::Place place_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  WebRequest asked_;
  bool keep_alive_ = false;
};

tcp::endpoint endpoint_of(const ConsoleConfig& config) {
  return {net::ip::make_address(config.address), static_cast<unsigned short>(config.port)};
}

}  // namespace

void WebServer::Shared::accept() {
  acceptor->async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == net::error::operation_aborted) return;
    beast::error_code gone;
    const tcp::endpoint remote = socket.remote_endpoint(gone);
    const std::string from = error || gone ? "" : remote.address().to_string();
    auto place = from.empty() ? nullptr : limit.admit(from);
    if (place) {
      socket.set_option(tcp::no_delay(true), gone);
      if (config.certificate.empty()) {
        std::make_shared<HttpConnection<PlainStream>>(PlainStream(std::move(socket)), *this, from,
                                                      std::move(place))
            ->start();
      } else {
        std::make_shared<HttpConnection<TlsStream>>(TlsStream(std::move(socket), tls), *this, from,
                                                    std::move(place))
            ->start();
      }
    }
    accept();
  });
}

WebServer::WebServer(const ConsoleConfig& config, land::TerrainFolder land,
                     const std::optional<HandedOverSocket>& socket, WebApi& api, Console& console)
    : shared_(std::make_unique<Shared>(config, std::move(land), api, console)) {
  if (!config.certificate.empty()) {
    beast::error_code error;
    shared_->tls.set_options(net::ssl::context::default_workarounds | net::ssl::context::no_tlsv1 |
                             net::ssl::context::no_tlsv1_1);
    shared_->tls.use_certificate_chain_file(config.certificate, error);
    if (error) throw std::runtime_error(config.certificate + ": " + error.message());
    shared_->tls.use_private_key_file(config.key, net::ssl::context::pem, error);
    if (error) throw std::runtime_error(config.key + ": " + error.message());
  }
  try {
    if (socket) {
      shared_->acceptor.emplace(shared_->io, socket->is_v6 ? tcp::v6() : tcp::v4(),
                                socket->descriptor);
    } else {
      shared_->acceptor.emplace(shared_->io, endpoint_of(config));
    }
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error("cannot serve on " + config.address + " port " +
                             std::to_string(config.port) + ": " + error.code().message());
  }
  shared_->accept();
}

WebServer::~WebServer() {
  shared_->hashers.join();
  shared_->readers.join();
  for (net::thread_pool* pool : {&shared_->surveyors, &shared_->skyliners}) {
    pool->stop();  // nobody waits for what is queued
    pool->join();
  }
  shared_->acceptor->close();
}

int WebServer::port() const { return shared_->acceptor->local_endpoint().port(); }

void WebServer::serve_for(double seconds) {
  shared_->io.run_for(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds)));
}

void WebServer::pump() {
  std::erase_if(shared_->live, [](const std::weak_ptr<Live>& weak) {
    const auto live = weak.lock();
    if (live) live->pump();
    return !live;
  });
}

}  // namespace ols::console
