#include "calibration/exchange.h"

#include <utility>

#include "calibration/snooping.h"

namespace ols::calibration {
namespace {

bool agree_exchanged(Problem problem, const Adjustment& adjustment, const Calibration& found,
                     std::size_t a, std::size_t b, const Levels& levels) {
  const auto& groups = adjustment.groups();
  std::swap(problem.references.at(groups[a].name), problem.references.at(groups[b].name));
  const Adjustment exchanged(network_of(problem));
  State start = found.fit.state;
  for (const std::size_t g : {a, b}) start.nuisances[groups[g].blocks[0]].setZero();
  const Fit fit = exchanged.fit(std::move(start), found.fit.kept);
  for (const std::size_t g : {a, b}) {
    if (test_statistic(exchanged, fit, g) >
        critical_value(groups[g], groups.size(), levels.mistaken)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::string> exchanged_landmarks(const Problem& problem, const Adjustment& adjustment,
                                             const Calibration& found, const Levels& levels) {
  constexpr std::size_t kMost = 6;  // more are no exchange but another survey
  std::vector<std::size_t> rejected;
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    const bool is_landmark = adjustment.groups()[g].kind == Kind::kLandmark;
    if (found.tests[g].rejected && is_landmark) rejected.push_back(g);
  }
  std::vector<std::string> sentences;
  if (rejected.size() > kMost) return sentences;
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    for (std::size_t j = i + 1; j < rejected.size(); ++j) {
      if (!agree_exchanged(problem, adjustment, found, rejected[i], rejected[j], levels)) continue;
      sentences.push_back("landmarks '" + adjustment.groups()[rejected[i]].name + "' and '" +
                          adjustment.groups()[rejected[j]].name + "' seem to be exchanged");
    }
  }
  return sentences;
}

}  // namespace ols::calibration
