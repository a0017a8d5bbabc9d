#include "console/procedures.h"

#include <algorithm>
#include <utility>

namespace ols::console {
namespace {

constexpr std::size_t kMostAnswers = 64;  // of one turn
constexpr const char* kAbort = "abort";

}  // namespace

Json Procedures::hear(ProcedureHeard heard) {
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

std::string Procedures::answer(const ProcedureAnswer& answer) {
  const auto kept = kept_.find(answer.station);
  if (kept == kept_.end()) return "refused: no procedure is running at this station";
  const ProcedureHeard& heard = kept->second.heard;
  if (!heard.is_at_work) return "refused: the procedure has ended";
  if (answer.choice != kAbort) {
    if (heard.question == 0 || answer.question != heard.question) {
      return "refused: this question is no longer open";
    }
    if (std::ranges::find(heard.choices, answer.choice) == heard.choices.end()) {
      return "refused: the question has no such answer";
    }
    const bool points = answer.choice == "point" || answer.choice == "exactly";
    if (points && !answer.pixel_px) return "refused: a pixel of the picture is needed";
  }
  if (answers_.size() >= kMostAnswers) return "refused: too many answers";
  answers_.push_back(answer);
  return "";
}

void Procedures::keep_only(const std::function<bool(const std::string&)>& is_known) {
  std::erase_if(kept_, [&](const auto& one) { return !is_known(one.first); });
}

}  // namespace ols::console
