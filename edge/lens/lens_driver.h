// Drives a lens with the VISCA protocol: one request at a time, orders before questions. Pure:
// bytes and time in, bytes and zoom samples out. edge/lens/lens_motor.* connects it to a serial
// port.
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

  // Takes bytes that had arrived by this instant of the monotonic clock.
  void receive(std::string_view bytes, double time_s);
  // Advances time. Returns the bytes to write, which are often none. Call every few milliseconds.
  std::string step(double time_s);

  // The newest order for an axis replaces the previous one. A rate ends at its own time, even if
  // its sender is lost; the axis then stops where it is.
  void order(const LensOrder& order);

  // Notes that the port was reopened: asks for everything again, and forgets the orders.
  void restart();
  // True once after the lens has left several consecutive requests unanswered; the caller must open
  // the port again.
  bool take_link_loss();

  std::vector<ZoomSample> take_samples();
  const LensState& state() const { return state_; }
  LensCounters counters() const;

  // An acknowledgement takes at most the time of one picture.
  static constexpr double kReply_s = 0.3;
  static constexpr int kSilent = 8;
  static constexpr double kIrisStep_s = 0.15;  // time between two iris steps at the highest rate

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
    int refusals = 0;     // number of times that the order to stop was refused
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
