#include "tools/calibrate/procedure_journal.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ols::calibration {
namespace {

using Json = nlohmann::ordered_json;
using Event = JournalEntry::Kind;

JournalEntry entry_of(const Json& line) {
  JournalEntry entry;
  entry.step = line.value("step", "");
  entry.ordered_utime_us = line.value("ordered_utime_us", std::int64_t{0});
  if (line.contains("taken")) {
    entry.pose = line.at("taken").get<std::int64_t>();
  } else if (line.contains("not_taken")) {
    entry.kind = Event::kNotTaken;
    entry.why = line.at("not_taken").get<std::string>();
  } else if (line.contains("resumed")) {
    entry.kind = Event::kResumed;
  } else {
    entry.kind = Event::kAnswered;
    entry.answer.choice = line.at("answer").get<std::string>();
    if (line.contains("pixel_px")) {
      const auto& pixel = line.at("pixel_px");
      entry.answer.pixel = Eigen::Vector2d(pixel.at(0).get<double>(), pixel.at(1).get<double>());
    }
    const auto& turn = line.at("turn_rad");
    entry.answer.turn = {turn.at(0).get<double>(), turn.at(1).get<double>()};
    entry.answer.utime_us = line.at("utime_us").get<std::int64_t>();
  }
  return entry;
}

std::string without_figures(const std::string& step) { return step.substr(0, step.find(';')); }

}  // namespace

std::string journal_line(const JournalEntry& entry) {
  Json line{{"step", entry.step}};
  if (entry.ordered_utime_us != 0) line["ordered_utime_us"] = entry.ordered_utime_us;
  switch (entry.kind) {
    case Event::kTaken:
      line["taken"] = entry.pose;
      break;
    case Event::kNotTaken:
      line["not_taken"] = entry.why;
      break;
    case Event::kResumed:
      line["resumed"] = true;
      break;
    case Event::kAnswered:
      line["answer"] = entry.answer.choice;
      if (entry.answer.pixel) {
        line["pixel_px"] = {entry.answer.pixel->x(), entry.answer.pixel->y()};
      }
      line["turn_rad"] = {entry.answer.turn.pan_rad, entry.answer.turn.tilt_rad};
      line["utime_us"] = entry.answer.utime_us;
      break;
  }
  return line.dump();
}

std::vector<JournalEntry> journal_entries(const std::string& text, const std::string& path) {
  std::vector<JournalEntry> entries;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    try {
      entries.push_back(entry_of(Json::parse(text.substr(begin, end - begin))));
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(path + ":" + std::to_string(entries.size() + 1) + ": " +
                               error.what());
    }
    begin = end + 1;
  }
  return entries;
}

bool answers(const JournalEntry& entry, const Order& order) {
  const bool is_answer = entry.kind == Event::kAnswered;
  return entry.kind != Event::kResumed && is_answer == (order.kind == Order::Kind::kAsk) &&
         without_figures(entry.step) == without_figures(order.step);
}

}  // namespace ols::calibration
