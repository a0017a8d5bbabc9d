#include "edge/calibration/drift_watch.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

constexpr double kArcsec = kPi / 648000.0;
constexpr double kSigmas = 3.0;
constexpr const char* kFormat = "drift 1";

bool shown(double value_rad, double sd_rad) { return std::abs(value_rad) > kSigmas * sd_rad; }

// Larger, beyond what two checks differ by.
bool is_worse(const DriftFinding& now, const DriftFinding& before) {
  const auto grown = [](double now_rad, double now_sd_rad, double before_rad,
                        double before_sd_rad) {
    return std::abs(now_rad) - std::abs(before_rad) >
           kSigmas * std::hypot(now_sd_rad, before_sd_rad);
  };
  return grown(now.heading_rad, now.heading_sd_rad, before.heading_rad, before.heading_sd_rad) ||
         grown(now.tilt_rad, now.tilt_sd_rad, before.tilt_rad, before.tilt_sd_rad);
}

}  // namespace

// By how much a bearing is wrong, as far as that is certain.
double DriftWatch::size_rad(const DriftFinding& finding) const {
  if (finding.cause == DriftCause::kNone || finding.cause == DriftCause::kScene) return 0.0;
  if (finding.cause == DriftCause::kLostSteps || finding.cause == DriftCause::kUnclear) {
    return config_.red_rad;
  }
  const bool turned = shown(finding.heading_rad, finding.heading_sd_rad);
  const bool tilted = shown(finding.tilt_rad, finding.tilt_sd_rad);
  return std::hypot(turned ? finding.heading_rad : 0.0, tilted ? finding.tilt_rad : 0.0);
}

DriftLevel DriftWatch::judge(const DriftFinding& finding) const {
  if (finding.cause == DriftCause::kScene) return DriftLevel::kAmber;
  const double size = size_rad(finding);
  if (size >= config_.red_rad) return DriftLevel::kRed;
  return size >= config_.amber_rad ? DriftLevel::kAmber : DriftLevel::kNone;
}

// Ended by a new calibration only: somebody has touched the tripod. Lost steps end with homing.
bool DriftWatch::stays() const {
  return level_ == DriftLevel::kRed && finding_.cause != DriftCause::kLostSteps;
}

bool DriftWatch::add(const DriftFinding& finding) {
  const DriftLevel level = judge(finding);
  if (level == DriftLevel::kNone) {
    suspected_ = false;
    constexpr int kQuiet = 2;
    if (++quiet_ >= kQuiet && level_ != DriftLevel::kNone && !stays()) {
      take(DriftLevel::kNone, finding);
    }
    return false;
  }
  quiet_ = 0;
  const bool known =
      level == level_ && finding.cause == finding_.cause && !is_worse(finding, finding_);
  if (known) {
    suspected_ = false;
    return false;
  }
  if (!suspected_) {
    suspected_ = true;
    return true;
  }
  suspected_ = false;
  if (!stays() || level == DriftLevel::kRed) take(level, finding);
  return false;
}

void DriftWatch::take(DriftLevel level, const DriftFinding& finding) {
  level_ = level;
  finding_ = finding;
  quiet_ = 0;
  ++revision_;
}

double DriftWatch::heading_doubt_rad() const {
  if (level_ == DriftLevel::kNone || finding_.cause == DriftCause::kScene) return 0.0;
  const double least = finding_.cause == DriftCause::kUnclear ? config_.red_rad : 0.0;
  return std::max(least, std::hypot(finding_.heading_rad, finding_.heading_sd_rad));
}

double DriftWatch::tilt_doubt_rad() const {
  if (level_ == DriftLevel::kNone || finding_.cause == DriftCause::kScene) return 0.0;
  const double least = finding_.cause == DriftCause::kUnclear ? config_.red_rad : 0.0;
  return std::max(least, std::hypot(finding_.tilt_rad, finding_.tilt_sd_rad));
}

Alarm DriftWatch::alarm() const {
  if (level_ == DriftLevel::kNone) return {};
  switch (finding_.cause) {
    case DriftCause::kTripod:
      return alarm::tripod_moved(finding_.heading_rad / kArcsec, finding_.tilt_rad / kArcsec,
                                 level_ == DriftLevel::kRed
                                     ? "calibrate its setup again"
                                     : "check its feet; calibrate its setup again if it stays");
    case DriftCause::kScene:
      return alarm::view_changed(finding_.view + 1);
    case DriftCause::kLostSteps:
      return alarm::steps_lost(finding_.pan ? "pan" : "tilt", finding_.steps);
    case DriftCause::kUnclear:
      return alarm::views_contradict();
    case DriftCause::kNone:
      break;
  }
  return {};
}

std::string DriftWatch::to_text() const {
  std::ostringstream out;
  out.precision(17);
  out << kFormat << ' ' << calibration_id_ << ' ' << static_cast<int>(level_) << ' '
      << static_cast<int>(finding_.cause) << ' ' << finding_.heading_rad << ' ' << finding_.tilt_rad
      << ' ' << finding_.heading_sd_rad << ' ' << finding_.tilt_sd_rad << ' ' << finding_.view
      << ' ' << finding_.pan << ' ' << finding_.steps << ' ' << suspected_ << '\n';
  return out.str();
}

bool DriftWatch::restore(const std::string& text) {
  std::istringstream in(text);
  std::string word, version;
  std::int64_t id = 0;
  int level = 0, cause = 0;
  bool suspected = false;
  DriftFinding f;
  in >> word >> version >> id >> level >> cause >> f.heading_rad >> f.tilt_rad >>
      f.heading_sd_rad >> f.tilt_sd_rad >> f.view >> f.pan >> f.steps >> suspected;
  const bool read = static_cast<bool>(in) && word + ' ' + version == kFormat && level >= 0 &&
                    level <= static_cast<int>(DriftLevel::kRed) && cause >= 0 &&
                    cause <= static_cast<int>(DriftCause::kUnclear);
  if (!read) return false;
  if (id != calibration_id_) return true;
  f.cause = static_cast<DriftCause>(cause);
  suspected_ = suspected;
  if (level != 0) take(static_cast<DriftLevel>(level), f);
  return true;
}

}  // namespace ols::station
