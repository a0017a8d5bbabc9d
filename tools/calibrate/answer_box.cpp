#include "tools/calibrate/answer_box.h"

#include <algorithm>
#include <cmath>

#include "base/text/plain_text.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Message = ols_msg::procedure_answer_t;

// An old answer was not meant for this question, whatever the sender's lease.
bool is_old(const Message& answer, std::int64_t now_utime_us) {
  constexpr double kLongestLease_s = 10.0, kClocks_s = 0.5;
  const double age_s =
      1e-6 * (static_cast<double>(now_utime_us) - static_cast<double>(answer.utime));
  const bool has_lease = answer.lease_s > 0.0;
  return !has_lease || !(std::abs(age_s) <= std::min(answer.lease_s, kLongestLease_s) + kClocks_s);
}

// The limits of typed answers; the numbers of another machine may be anything.
bool is_in_range(const Message& answer) {
  constexpr double kMostTurn_deg = 360.0, kMost_px = 1e6;
  const auto within = [](const double(&pair)[2], double most) {
    return std::abs(pair[0]) <= most && std::abs(pair[1]) <= most;
  };
  return within(answer.turn_deg, kMostTurn_deg) &&
         (!answer.has_pixel || within(answer.pixel_px, kMost_px));
}

}  // namespace

void AnswerBox::ask(std::int64_t question) {
  if (question != question_) answer_.reset();
  question_ = question;
}

void AnswerBox::hear(const Message& message, std::int64_t now_utime_us) {
  if (is_old(message, now_utime_us)) return;
  if (message.choice == "abort") {
    is_aborted_ = true;
    return;
  }
  if (question_ == 0 || message.question != question_ || answer_ || !is_in_range(message)) return;
  if (!heard_.emplace(message.boot_id, message.sequence).second) return;
  answer_ = Answer{plain_text(message.choice), {}, {}};
  if (message.has_pixel) {
    answer_->pixel = Eigen::Vector2d(message.pixel_px[0], message.pixel_px[1]);
  }
  answer_->turn = {radians(message.turn_deg[0]), radians(message.turn_deg[1])};
}

std::optional<Answer> AnswerBox::take(std::int64_t question) {
  if (question != question_) return std::nullopt;
  return std::exchange(answer_, std::nullopt);
}

}  // namespace ols::calibration
