// Drives a lens with the VISCA protocol. It sends one request at a time; orders precede questions.
// Pure: it takes bytes and the time, and returns bytes and zoom samples. edge/lens/lens_motor.*
// connects it to a serial port.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/lens/lens_types.h"
#include "edge/lens/visca.h"

namespace ols::lens {

class LensDriver {
 public:
  explicit LensDriver(double poll_interval_s) : poll_interval_s_(poll_interval_s) {}

  // Takes the received bytes. `time_s`: a monotonic time by which all of them had arrived.
  void receive(std::string_view bytes, double time_s);
  // Returns the bytes to send now, often none. Call every few milliseconds.
  std::string step(double time_s);

  // Takes an order. For each axis, the newest order replaces the previous one. A rate ends at its
  // until_s unless the sender renews it; the axis then stops where it is.
  void order(const LensOrder& order);

  // Notes that the port was reopened. Discards the orders, and sets the lens up again.
  void restart();
  // Returns true, once, after the lens has not answered kSilent consecutive requests. The caller
  // must then reopen the port.
  bool take_link_loss();

  std::vector<ZoomSample> take_samples();
  const LensState& state() const { return state_; }
  LensCounters counters() const;

  // Longest wait for an answer. A lens acknowledges a command within one frame period of its video.
  static constexpr double kReply_s = 0.3;
  static constexpr int kSilent = 8;
  static constexpr double kIrisStep_s = 0.15;  // time between two iris steps at the maximum rate

 private:
  enum class Question { kSetup, kVersion, kPosition, kOrder };
  struct Request {
    Question question = Question::kSetup;
    Axis axis = Axis::kZoom;
    std::string bytes;
    double sent_s = 0.0;
  };
  struct Pending {
    AxisOrder order;
    bool sent = false;
    double step_s = 0.0;  // time at which the next step of the iris is due
    int refusals = 0;     // number of times that the lens refused to stop
  };

  static bool is_stand(const std::optional<Pending>& pending);
  std::optional<Request> next(double time_s);
  std::optional<Request> next_order(Axis axis, double time_s);
  std::optional<Request> next_question(double time_s);
  void take(const visca::Reply& reply, double time_s);
  void take_value(const Request& request, const std::string& data, double time_s);
  void give_up(double time_s);

  double poll_interval_s_;
  visca::Packets packets_;
  std::size_t setup_ = 0;  // number of completed steps of the lens's setup
  std::optional<Request> waiting_;
  ByAxis<std::optional<Pending>> orders_;
  double polled_s_ = -1e9;
  int polls_ = 0;
  int silent_ = 0;
  bool link_lost_ = false;
  LensState state_;
  LensCounters counters_;
  std::vector<ZoomSample> samples_;
};

}  // namespace ols::lens
