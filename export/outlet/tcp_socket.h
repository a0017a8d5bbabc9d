// A TCP connection. Each call has a time limit.
#pragma once

#include <string>

struct addrinfo;

namespace ols::exports {

// Call for any TCP connection. Limits the unsent data in the system's buffer, which otherwise takes
// megabytes. The rest stays in our queue, where a newer message replaces an older one.
void keep_unsent_short(int descriptor);

class TcpSocket {
 public:
  // Connects to the first of the name's addresses that answers. Looking up the name takes as long
  // as the system's settings allow. Throws LinkError.
  TcpSocket(const std::string& host, int port, double patience_s);
  ~TcpSocket();
  TcpSocket(const TcpSocket&) = delete;
  TcpSocket& operator=(const TcpSocket&) = delete;

  int descriptor() const { return fd_; }
  // Waits until the socket can be read or written. False: it cannot within this time.
  bool wait(bool to_write, double patience_s) const;

 private:
  int connect(const addrinfo& to, double patience_s);

  int fd_ = -1;
};

}  // namespace ols::exports
