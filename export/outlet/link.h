// A connection to a receiver. It may make its caller wait; therefore it is used in a thread of its
// own (queued_outlet.h).
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "export/encoder.h"

namespace ols::exports {

// The reason in words for a person: "10.0.0.9:8089: its certificate is not that of the authority in
// ca".
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Link {
 public:
  virtual ~Link() = default;
  // open() and send() throw LinkError if they do not succeed within kPatience_s. The link is then
  // closed.
  virtual void open() = 0;
  virtual void send(const Packet& packet) = 0;
  // Waits until the descriptor `wake_fd` is readable or the time is over. Meanwhile reads what the
  // receiver sends.
  virtual void wait(int wake_fd, double seconds) = 0;
  virtual void close() = 0;
  // Called before an open connection is closed because the program ends. Throws LinkError.
  virtual void say_goodbye() {}
  // Whether packets that waited while the link was closed are dropped when it opens.
  virtual bool forgets() const { return true; }
  // What the receiver complains about over the open connection; empty: nothing.
  virtual std::string trouble() const { return {}; }
  virtual std::uint64_t complaints() const {
    return 0;
  }  // number of the receiver's complaints;
     // only increases

  static constexpr double kPatience_s = 3.0;
};

}  // namespace ols::exports
