// A TCP connection. Each call has a time limit, except for looking up a name.
#pragma once

#include <string>

struct addrinfo;

namespace ols::exports {

// Limits the unsent data in the system's buffer, which otherwise takes megabytes. What does not fit
// stays in our queue, where a newer message replaces an older one. Call for every TCP connection.
void keep_unsent_short(int descriptor);

class TcpSocket {
 public:
  // Connects to the first address of the host that answers, within patience_s. The time to look up
  // the name is not limited by patience_s, but by the system's settings. Throws LinkError.
  TcpSocket(const std::string& host, int port, double patience_s);
  ~TcpSocket();
  TcpSocket(const TcpSocket&) = delete;
  TcpSocket& operator=(const TcpSocket&) = delete;

  int descriptor() const { return fd_; }
  // Waits until the socket can be read (or written, if to_write). False: it cannot within this
  // time.
  bool wait(bool to_write, double patience_s) const;

 private:
  int connect(const addrinfo& to, double patience_s);

  int fd_ = -1;
};

}  // namespace ols::exports
