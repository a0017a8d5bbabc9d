// Sends packets one after the other over TCP or TLS. Data from the receiver are always read, even
// if they are not used, so that the receiver never has to wait.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "export/address.h"
#include "export/outlet/link.h"
#include "export/outlet/tcp_socket.h"

namespace ols::exports {

// Paths of PEM files. Empty `certificate` and `key`: no client certificate. Empty `ca`: the
// system's authorities.
struct TlsFiles {
  std::string ca, certificate, key;
};

class StreamLink : public Link {
 public:
  // With the scheme tls, the receiver's certificate must be from an authority in `ca`, and must be
  // issued for the host of `address`.
  StreamLink(const Address& address, TlsFiles files);
  ~StreamLink() override;

  void open() override;
  void send(const Packet& packet) override;
  void wait(int wake_fd, double seconds) override;
  void close() override;

 protected:
  // Data from the receiver, in any pieces.
  virtual void heard(std::string_view bytes) { static_cast<void>(bytes); }
  LinkError error(const std::string& what) const;

 private:
  struct Tls;
  void shake_hands();
  bool wait_until(double end_s, bool to_write) const;
  long write_some(const std::string& bytes, std::size_t from);
  // Reads all available data; throws if the receiver has closed the connection.
  void drain();
  void drain_tls();

  Address address_;
  TlsFiles files_;
  std::optional<TcpSocket> socket_;
  std::unique_ptr<Tls> tls_;
};

}  // namespace ols::exports
