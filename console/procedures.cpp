#include "console/procedures.h"

#include <algorithm>
#include <utility>

#include "conditions/sayings.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostAnswers = 64;  // of one turn
constexpr const char* kAbort = "abort";

}  // namespace

Json Procedures::receive(ReceivedProcedure heard) {
  Kept& kept = kept_[heard.station];
  if (heard.jpeg.empty()) {
    kept.picture = 0;
  } else if (kept.picture == 0 || heard.jpeg != kept.heard.jpeg) {
    kept.picture = ++pictures_;
  }
  kept.heard = std::move(heard);
  Json fields = kept.heard.fields;
  fields["picture"] = kept.picture;
  return fields;
}

const std::string* Procedures::picture(const std::string& station) const {
  const auto kept = kept_.find(station);
  return kept == kept_.end() || kept->second.picture == 0 ? nullptr : &kept->second.heard.jpeg;
}

Outcome Procedures::answer(const ProcedureAnswer& answer) {
  const auto kept = kept_.find(answer.station);
  if (kept == kept_.end()) return outcome::no_procedure();
  const ReceivedProcedure& heard = kept->second.heard;
  if (!heard.is_at_work) return outcome::procedure_ended();
  if (answer.choice != kAbort) {
    if (heard.question == 0 || answer.question != heard.question) {
      return outcome::question_closed();
    }
    if (std::ranges::find(heard.choices, answer.choice) == heard.choices.end()) {
      return outcome::no_such_choice();
    }
    const bool points = answer.choice == "point" || answer.choice == "exactly";
    if (points && !answer.pixel_px) return outcome::pixel_needed();
  }
  if (answers_.size() >= kMostAnswers) return outcome::too_many_answers();
  answers_.push_back(answer);
  return {};
}

void Procedures::keep_only(const std::function<bool(const std::string&)>& is_known) {
  std::erase_if(kept_, [&](const auto& one) { return !is_known(one.first); });
}

}  // namespace ols::console
