// Drives a lens over VISCA: one request at a time, orders before questions. Pure: bytes and time
// in, bytes and zoom samples out. edge/lens/lens_motor.* connects it to a serial port.
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

  // Takes bytes that had arrived at this instant of the monotonic clock.
  void receive(std::string_view bytes, double time_s);
  // Advances time, and returns the bytes to write, often none. Call every few milliseconds.
  std::string step(double time_s);

  // The newest order for an axis replaces the previous order. A rate ends at its time, even if its
  // sender is lost; the axis then stays where it is.
  void order(const LensOrder& order);

  // The port was reopened: asks everything again, and forgets the orders.
  void restart();
  // True once after the lens left several consecutive requests unanswered: open the port again.
  bool take_link_loss();

  std::vector<ZoomSample> take_samples();
  const LensState& state() const { return state_; }
  LensCounters counters() const;

  static constexpr double kReply_s = 0.3;  // an acknowledgement takes at most one picture's time
  static constexpr int kSilent = 8;
  static constexpr double kIrisStep_s = 0.15;  // between two iris steps at the highest rate

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
    double step_s = 0.0;  // when the next step of the iris is due
    int refusals = 0;     // of the order to stop
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
  std::size_t setup_ = 0;  // number of completed steps
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
