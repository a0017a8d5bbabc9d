// A connection that may make its caller wait, for a thread of its own (queued_outlet.h).
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "export/encoder.h"

namespace ols::exports {

// In words for a person: "10.0.0.9:8089: its certificate is not that of the authority in ca".
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Link {
 public:
  virtual ~Link() = default;
  // These throw LinkError, after kPatience_s at the latest; the link is then closed.
  virtual void open() = 0;
  virtual void send(const Packet& packet) = 0;
  // Until there is something to do: `wake_fd` is readable, or the time is over. Takes what the
  // receiver says.
  virtual void wait(int wake_fd, double seconds) = 0;
  virtual void close() = 0;
  // Before an open connection is closed because the program ends; throws as the others do.
  virtual void say_goodbye() {}
  // Whether what waited while it was closed is old news.
  virtual bool forgets() const { return true; }
  // What the receiver finds wrong while the connection holds; empty: nothing.
  virtual std::string trouble() const { return {}; }
  virtual std::uint64_t complaints() const { return 0; }  // of the receiver; only goes up

  static constexpr double kPatience_s = 3.0;
};

}  // namespace ols::exports
