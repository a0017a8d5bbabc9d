#include "calibration/procedure/field_procedure.h"

#include <stdexcept>

namespace ols::calibration {

FieldProcedure::FieldProcedure(std::vector<std::unique_ptr<Stage>> stages, Redo redo)
    : stages_(std::move(stages)), redo_(std::move(redo)) {
  if (stages_.empty()) throw std::invalid_argument("a procedure without stages");
}

std::optional<Order> FieldProcedure::next() {
  if (outcome_ != Outcome::kRunning) return std::nullopt;
  if (result_) return decision();
  for (; at_ < stages_.size(); ++at_) {
    if (auto order = stages_[at_]->next()) return order;
  }
  return std::nullopt;
}

Order FieldProcedure::decision() const {
  Order order;
  order.kind = Order::Kind::kAsk;
  order.step = "result";
  order.question.text = result_->text;
  if (!result_->failed) order.question.choices.emplace_back("accept");
  if (!result_->worst.empty() && redo_) order.question.choices.emplace_back("redo");
  order.question.choices.emplace_back("keep");
  return order;
}

void FieldProcedure::answered(const Answer& answer) {
  if (answer.choice == "abort") return abort();
  if (!result_) return stage().answered(answer);
  if (answer.choice == "accept" && !result_->failed) {
    outcome_ = Outcome::kAccepted;
  } else if (answer.choice == "redo" && !result_->worst.empty() && redo_) {
    redo_(result_->worst);
    at_ = stages_.size() - 1;
    result_.reset();
  } else if (answer.choice == "keep") {
    outcome_ = Outcome::kKeptOld;
  }
}

double FieldProcedure::progress() const {
  if (result_ || outcome_ != Outcome::kRunning) return 1.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    sum += i < at_ ? 1.0 : i == at_ ? stages_[i]->progress() : 0.0;
  }
  return sum / static_cast<double>(stages_.size());
}

std::vector<Observation> FieldProcedure::observations() const {
  std::vector<Observation> all;
  for (const auto& one : stages_) {
    const auto own = one->observations();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

std::vector<std::string> FieldProcedure::take_remarks() {
  std::vector<std::string> all;
  for (const auto& one : stages_) {
    for (std::string& sentence : one->take_remarks()) all.push_back(std::move(sentence));
  }
  return all;
}

}  // namespace ols::calibration
