#include "edge/calibration/reference_views.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/files/small_file.h"
#include "base/process/time_source.h"
#include "calibration/pictures/view_registration.h"
#include "conditions/alarms.h"
#include "edge/calibration/view_offset.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

constexpr std::size_t kMost_bytes = 4096;
constexpr std::size_t kFewest = 3;  // views

std::string drift_file(const ReferenceViews::Config& config) {
  return config.folder.empty() ? std::string() : config.folder + "/" + config.station + ".drift";
}

// A picture appears whole or not at all.
void save(const cv::Mat& picture, const std::string& path) {
  if (path.empty()) return;
  const std::string partial = path + ".partial.png";
  std::error_code failed;
  if (cv::imwrite(partial, picture)) std::filesystem::rename(partial, path, failed);
}

// A file that cannot be read is none: the view is taken anew.
std::vector<cv::Mat> load(const std::vector<std::string>& paths) {
  std::vector<cv::Mat> pictures;
  pictures.reserve(paths.size());
  for (const std::string& path : paths) {
    pictures.push_back(path.empty() ? cv::Mat() : cv::imread(path, cv::IMREAD_GRAYSCALE));
  }
  return pictures;
}

}  // namespace

ReferenceViews::ReferenceViews(const Config& config, const StationCalibration& calibration)
    : config_(config),
      calibration_(calibration),
      tour_(tour_config()),
      watch_(config.drift, config.calibration_id),
      file_(drift_file(config)) {
  const std::string path = drift_file(config);
  std::error_code failed;
  if (path.empty() || !std::filesystem::exists(path, failed)) return;
  try {
    if (!watch_.restore(read_small_file(path, kMost_bytes))) unreadable_ = path + " is damaged";
  } catch (const std::exception& problem) {
    unreadable_ = problem.what();
  }
}

ViewTour::Config ReferenceViews::tour_config() const {
  ViewTour::Config tour = config_.tour;
  if (config_.sun) {
    tour.forbidden = [this](const PanTilt& at) { return config_.sun(at, turned_rad()); };
  }
  return tour;
}

// By how much the tripod may have turned since it was calibrated. One that no longer recognises its
// views may have been turned by whoever ran into it; further only by someone who sets it up anew.
double ReferenceViews::turned_rad() const {
  constexpr double kSigmas = 3.0, kAstray_rad = 30.0 * kPi / 180.0;
  const bool unclear = watch_.level() == DriftLevel::kRed && watch_.is_unclear();
  if (astray_ || unclear) return kAstray_rad;
  return kSigmas * std::hypot(watch_.heading_doubt_rad(), watch_.tilt_doubt_rad());
}

std::string ReferenceViews::picture(std::size_t view) const {
  if (config_.folder.empty()) return {};
  // Named by where it was taken: with other limits the views are others.
  const auto counts = [](double angle_rad, double count_rad) {
    return std::to_string(std::lround(angle_rad / count_rad));
  };
  const PanTilt& at = tour_.views()[view];
  return config_.folder + "/" + config_.station + ".view-" +
         std::to_string(config_.calibration_id) + "-" + counts(at.pan_rad, count_->pan_rad) + "-" +
         counts(at.tilt_rad, count_->tilt_rad) + ".png";
}

void ReferenceViews::set_limits(const mount::Limits& limits) {
  if (count_ || limits.count.pan_rad <= 0.0) return;
  count_ = limits.count;
  tour_.plan(limits, *count_);
  pictures_.resize(views());
  std::vector<std::string> paths;
  bool any = false;
  for (std::size_t i = 0; i < views(); ++i) {
    std::error_code failed;
    const std::string path = picture(i);
    const bool there = !path.empty() && std::filesystem::exists(path, failed);
    paths.push_back(there ? path : "");
    any = any || there;
  }
  if (any) {
    loading_ = std::async(std::launch::async, [paths] { return load(paths); });
  } else {
    tour_.request();
  }
  if (views() < kFewest) record_.note_too_few();
}

// Until the stored pictures are read, no round begins.
bool ReferenceViews::loaded() {
  if (!loading_.valid()) return count_.has_value();
  if (loading_.wait_for(time_source().for_work()) != std::future_status::ready) return false;
  pictures_ = loading_.get();
  stored_ = static_cast<std::size_t>(
      std::ranges::count_if(pictures_, [](const cv::Mat& one) { return !one.empty(); }));
  if (stored_ < views()) tour_.request();
  return true;
}

std::optional<mount::Goal> ReferenceViews::step(const ViewTour::Situation& situation) {
  record_.note(situation.now_s);
  if (!loaded()) return std::nullopt;
  const bool was = tour_.under_way();
  const auto goal = tour_.step(situation);
  if (!was && tour_.under_way()) looks_.clear();
  record_.note_late(tour_.late());
  if (tour_.take_finished()) {
    judged_ = false;
    tally_.left_out += tour_.left_out().size();
  }
  if (!judged_) finish();
  return goal;
}

void ReferenceViews::see(const camera::Frame& frame) {
  const auto view = tour_.see(frame.mid_exposure_s);
  if (!view) return;
  if (pictures_[*view].empty()) {
    // One that is not recognised in itself, of the night or of fog, would never be in any other.
    const auto store = [seen = frame.gray.clone(), path = picture(*view)] {
      if (!calibration::register_view(seen, seen)) return Seen{};
      save(seen, path);
      return Seen{std::nullopt, seen};
    };
    looks_.push_back({*view, true, std::async(std::launch::async, store)});
    return;
  }
  const auto compare = [stored = pictures_[*view], seen = frame.gray.clone(),
                        at = tour_.views()[*view], calibration = calibration_] {
    const auto offset =
        offset_of({stored, at}, {seen, at}, calibration.model.geometry, calibration.angle_sd_rad);
    return Seen{offset, {}};
  };
  looks_.push_back({*view, false, std::async(std::launch::async, compare)});
}

std::vector<ViewOffset> ReferenceViews::take_looks() {
  std::vector<ViewOffset> offsets;
  for (Look& look : looks_) {
    const Seen seen = look.result.get();
    if (seen.offset) offsets.push_back(*seen.offset);
    if (!look.storing && !seen.offset) ++tally_.unrecognised;
    if (seen.picture.empty()) continue;
    pictures_[look.view] = seen.picture;
    ++stored_;
  }
  looks_.clear();
  return offsets;
}

void ReferenceViews::finish() {
  for (const Look& look : looks_) {
    if (look.result.wait_for(time_source().for_work()) != std::future_status::ready) return;
  }
  judged_ = true;
  const std::uint64_t unrecognised = tally_.unrecognised;
  const std::vector<ViewOffset> offsets = take_looks();
  const bool by_sun = views() - tour_.left_out().size() < kFewest;
  if (!by_sun) astray_ = offsets.size() < kFewest && tally_.unrecognised > unrecognised;
  if (offsets.size() < kFewest) {
    by_sun ? record_.note_sun() : record_.note_unrecognised();
    return;
  }
  record_.note_judged();
  ++tally_.checks;
  if (watch_.add(find_drift(offsets, motor_steps(calibration_.model)))) tour_.request();
  file_.write(watch_.to_text());
}

std::vector<Alarm> ReferenceViews::alarms() const {
  std::vector<Alarm> alarms;
  if (Alarm alarm = watch_.alarm(); !alarm.empty()) alarms.push_back(std::move(alarm));
  if (Alarm alarm = record_.alarm(); !alarm.empty()) alarms.push_back(std::move(alarm));
  if (!unreadable_.empty() && tally_.checks == 0) {
    alarms.push_back(alarm::checks_unknown(unreadable_));
  }
  if (const std::string trouble = file_.trouble(); !trouble.empty()) {
    alarms.push_back(alarm::findings_unsaved(trouble));
  }
  return alarms;
}

}  // namespace ols::station
