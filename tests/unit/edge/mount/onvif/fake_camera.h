// An ONVIF camera on 127.0.0.1; the test provides its answers.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace ols::onvif {

class FakeCamera {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  struct Answer {
    int status = 200;
    std::string content;  // of the SOAP body
    std::string challenge = {};
  };
  using Script = std::function<Answer(const std::string& name, const Request& request)>;

  explicit FakeCamera(Script script)
      : script_(std::move(script)), acceptor_(context_, {address(), 0}) {
    thread_ = std::thread([this] { accept(); });
  }
  ~FakeCamera() {
    boost::system::error_code ignored;
    ending_ = true;
    Socket(context_).connect(acceptor_.local_endpoint(), ignored);  // wakes accept()
    thread_.join();
    for (auto& socket : sockets_) socket->shutdown(Socket::shutdown_both, ignored);
    for (std::thread& served : served_) served.join();
  }

  std::string url() const {
    return "http://127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port()) +
           "/onvif/device_service";
  }
  // The names of all requests so far, for example "Stop".
  std::vector<std::string> names() const {
    const std::lock_guard lock(mutex_);
    return names_;
  }
  std::size_t count(const std::string& name) const {
    const auto all = names();
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), name));
  }
  std::string all_bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  using Socket = boost::asio::ip::tcp::socket;
  static boost::asio::ip::address address() { return boost::asio::ip::make_address("127.0.0.1"); }

  void accept() {
    while (!ending_) {
      boost::system::error_code failed;
      auto socket = std::make_shared<Socket>(context_);
      acceptor_.accept(*socket, failed);
      if (failed || ending_) continue;
      sockets_.push_back(socket);
      served_.emplace_back([this, socket] { serve(*socket); });
    }
  }

  void serve(Socket& socket) {
    namespace http = boost::beast::http;
    boost::beast::flat_buffer buffer;
    boost::system::error_code failed;
    for (;;) {
      Request request;
      http::read(socket, buffer, request, failed);
      if (failed) return;
      const std::string type(request[http::field::content_type]);
      const std::string action = type.substr(0, type.rfind('"'));
      const std::string name = action.substr(action.rfind('/') + 1);
      {
        const std::lock_guard lock(mutex_);
        names_.push_back(name);
        std::ostringstream text;
        text << request;
        bytes_ += text.str();
      }
      const Answer answer = script_(name, request);
      http::response<http::string_body> response(
          http::int_to_status(static_cast<unsigned>(answer.status)), request.version());
      if (!answer.challenge.empty()) response.set(http::field::www_authenticate, answer.challenge);
      response.body() = "<s:Envelope xmlns:s=\"http://www.w3.org/2003/05/soap-envelope\"><s:Body>" +
                        answer.content + "</s:Body></s:Envelope>";
      response.prepare_payload();
      http::write(socket, response, failed);
      if (failed) return;
    }
  }

  Script script_;
  boost::asio::io_context context_;
  boost::asio::ip::tcp::acceptor acceptor_;
  std::atomic<bool> ending_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> names_;
  std::string bytes_;
  std::vector<std::shared_ptr<Socket>> sockets_;
  std::vector<std::thread> served_;
  std::thread thread_;
};

}  // namespace ols::onvif
