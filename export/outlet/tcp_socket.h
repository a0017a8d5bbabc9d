// A TCP connection whose every call ends in time.
#pragma once

#include <string>

struct addrinfo;

namespace ols::exports {

// Of any TCP connection: what the receiver has no room for waits here, where a newer message
// displaces it, and not in the system's buffer of megabytes.
void keep_unsent_short(int descriptor);

class TcpSocket {
 public:
  // Connects to the first of the name's addresses that answers. The look-up is the system's and
  // takes as long as its settings allow. Throws LinkError.
  TcpSocket(const std::string& host, int port, double patience_s);
  ~TcpSocket();
  TcpSocket(const TcpSocket&) = delete;
  TcpSocket& operator=(const TcpSocket&) = delete;

  int descriptor() const { return fd_; }
  // Until it can be read or written; false: not in time.
  bool wait(bool to_write, double patience_s) const;

 private:
  int connect(const addrinfo& to, double patience_s);

  int fd_ = -1;
};

}  // namespace ols::exports
