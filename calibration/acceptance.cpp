#include "calibration/acceptance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibration/parameter_change.h"
#include "calibration/snooping.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Judgement = Finding::Judgement;

double arcsec(double rad) { return 3600.0 * degrees(rad); }

std::string shown(double value, const char* unit) { return printed("%.2f%s", value, unit); }

Finding at_most(const std::string& name, double value, double limit, const char* unit,
                const std::string& what) {
  Finding finding{name, Judgement::kGood, value, limit, what + ": "};
  if (!std::isfinite(value)) {
    finding.judgement = Judgement::kBad;  // what is not known is within no limit
    finding.sentence += "not known";
    return finding;
  }
  finding.judgement = value <= limit ? Judgement::kGood : Judgement::kBad;
  finding.sentence += shown(value, unit) + ", at most " + shown(limit, unit);
  return finding;
}

std::string label_of(const Group& group) {
  return std::string(name(group.kind)) + " '" + group.name + "'";
}

// What the sightings of a station tell of a calibration.
class Judge {
 public:
  Judge(const Problem& problem, const Adjustment& adjustment, const Calibration& found,
        std::size_t station, const AcceptanceLimits& limits)
      : problem_(problem),
        adjustment_(adjustment),
        found_(found),
        station_(station),
        limits_(limits),
        model_(found.fit.state.stations[station].model) {}

  Acceptance run() {
    coverage();
    volume();
    global();
    for (std::size_t g = 0; g < found_.tests.size(); ++g) reference(g);
    star_clock();
    closing();
    residuals("sweep", Kind::kScene, limits_.sweep_px);
    residuals("stars", Kind::kStar, limits_.stars_px);
    against_known("focal length", kFocal, " px", 1.0);  // a lens that was refocused
    return std::move(result_);
  }

  Acceptance run_instrument() {
    global();
    residuals("sweep", Kind::kScene, limits_.sweep_px);
    against_known("focal length", kFocal, " px", 1.0);
    against_known("backlash of pan", kPanBacklash, "″", arcsec(1.0));
    against_known("backlash of tilt", kTiltBacklash, "″", arcsec(1.0));
    return std::move(result_);
  }

 private:
  void add(Finding finding) { result_.findings.push_back(std::move(finding)); }
  bool is_own(const Group& group) const {
    return std::ranges::any_of(group.observations, [this](std::size_t i) {
      return problem_.observations[i].station == station_;
    });
  }

  void volume() {
    const VolumePrecision precision = volume_precision(
        model_, found_.covariance(adjustment_.network(), station_), result_.volume);
    add(at_most("systematic_rms", arcsec(precision.rms_rad), limits_.rms_arcsec, "″",
                "systematic error, RMS of an axis"));
    add(at_most("systematic_worst", arcsec(precision.worst_rad), limits_.worst_arcsec, "″",
                "systematic error, worst direction"));
  }

  void global() {
    Finding finding = at_most("global_test", found_.global.variance_factor, found_.global.critical,
                              "", "variance factor");
    if (found_.global.redundancy <= 0) finding.judgement = Judgement::kUnchecked;
    add(std::move(finding));
  }

  // A mistake that is not found is no fault of what was found.
  Finding detectable(const std::string& name, double value_arcsec, const std::string& label) const {
    const std::string what = label + ": a mistake that would be found";
    Finding checked =
        at_most("detectable " + name, value_arcsec, limits_.detectable_arcsec, "″", what);
    if (checked.judgement == Judgement::kBad) {
      checked.judgement = Judgement::kUnchecked;
      checked.sentence = (std::isfinite(checked.value) ? checked.sentence : what) + ": unchecked";
    }
    return checked;
  }

  // Stars are hundreds, and each other's check: only what a person has pointed at.
  void reference(std::size_t g) {
    const Group& group = adjustment_.groups()[g];
    if (!group.is_absolute() || group.kind == Kind::kStar || !is_own(group)) return;
    const std::string label = label_of(group);
    const GroupTest& test = found_.tests[g];
    if (test.rejected) {
      add({"rejected " + group.name, Judgement::kBad, test.w, test.critical,
           label + " is rejected as mistaken"});
      return;
    }
    const double bias_rad = test.detectable_rad.maxCoeff();
    Finding checked = detectable(group.name, arcsec(bias_rad), label);
    const bool is_checked = checked.judgement == Judgement::kGood;
    add(std::move(checked));
    without_itself(g, label, is_checked);
  }

  // Where the others see it: a group's own residual is drawn towards it. What they hardly check
  // they predict no better, however right it is: there the sigmas alone judge.
  void without_itself(std::size_t g, const std::string& label, bool is_checked) {
    const auto off = bias_without(adjustment_, found_.fit, g);
    if (!off) return;
    const std::string& name = adjustment_.groups()[g].name;
    Finding angle =
        at_most("without_itself " + name, arcsec(off->rad.cwiseAbs().maxCoeff()),
                limits_.without_itself_arcsec, "″", label + ", predicted without itself");
    if (!is_checked && angle.judgement == Judgement::kBad) {
      angle.judgement = Judgement::kUnchecked;
      angle.sentence += ": unchecked";
    }
    add(std::move(angle));
    add(at_most("without_itself_sigma " + name, off->sigmas, limits_.without_itself_sigma, " sigma",
                label + ", predicted without itself"));
  }

  // Stars and sun that were stamped late agree with each other as well as before.
  void star_clock() {
    if (own_kept(Kind::kStar).empty() && own_kept(Kind::kSun).empty()) return;
    constexpr double kSky_arcsec_s = 15.04;
    const ClockCheck check = clock_check(adjustment_.network(), found_.fit, found_.scaled_by);
    add(detectable("clock", kSky_arcsec_s * check.detectable_s(), "the clock"));
    if (!check.is_large()) return;
    add({"clock", Judgement::kBad, check.fast_s, check.sd_s,
         "the clock: " + shown(std::abs(check.fast_s), " s") +
             (check.fast_s > 0.0 ? " fast" : " slow") + " against everything else, " +
             shown(check.sigmas(), " sigma")});
  }

  // First and last sighting of one reference: what has moved meanwhile.
  void closing() {
    double worst_rad = -1.0;
    std::string worst;
    for (const Group& group : adjustment_.groups()) {
      if (group.kind != Kind::kLandmark && group.kind != Kind::kStation) continue;
      std::vector<std::size_t> own;
      std::ranges::copy_if(group.observations, std::back_inserter(own), [this](std::size_t i) {
        return problem_.observations[i].station == station_ && found_.residuals[i];
      });
      if (own.size() < 2) continue;
      const Eigen::Vector2d apart = *found_.residuals[own.back()] - *found_.residuals[own.front()];
      const double apart_rad = apart.norm() / model_.geometry.camera.fx_px;
      if (apart_rad <= worst_rad) continue;
      worst_rad = apart_rad;
      worst = label_of(group);
    }
    if (worst_rad < 0.0) return;
    add(at_most("closing", arcsec(worst_rad), limits_.closing_arcsec, "″",
                worst + ", first and last sighting"));
  }

  void residuals(const std::string& name, Kind kind, double limit_px) {
    double squares = 0.0;
    int count = 0;
    for (const std::size_t i : own_kept(kind)) {
      if (!found_.residuals[i]) continue;
      squares += found_.residuals[i]->squaredNorm();
      count += 2;
    }
    if (count == 0) return;
    add(at_most(name, std::sqrt(squares / count), limit_px, " px", name + ", residuals"));
  }

  // Of the station's groups of a kind that were not rejected.
  std::vector<std::size_t> own_kept(Kind kind) const {
    std::vector<std::size_t> all;
    for (std::size_t g = 0; g < adjustment_.groups().size(); ++g) {
      const Group& group = adjustment_.groups()[g];
      if (group.kind != kind || !found_.fit.kept[g]) continue;
      std::ranges::copy_if(group.observations, std::back_inserter(all), [this](std::size_t i) {
        return problem_.observations[i].station == station_;
      });
    }
    return all;
  }

  // `scale`: from the natural unit to the shown one.
  void against_known(const std::string& name, int parameter, const char* unit, double scale) {
    const ParameterChange change =
        parameter_change(adjustment_.network(), found_.fit, station_, parameter);
    const double value = scale * instrument_of(model_)[parameter];
    Finding finding{name, Judgement::kGood, scale * change.by, scale * change.sd,
                    printed("%s: %.2f%s, by %+.2f%s from what was known, ", name.c_str(), value,
                            unit, scale * change.by, unit)};
    if (!change.is_told) {
      finding.judgement = Judgement::kUnchecked;
      finding.sentence += "hardly determined by the pictures";
    } else {
      if (change.is_large()) finding.judgement = Judgement::kBad;
      finding.sentence += shown(change.sigmas(), " sigma");
    }
    add(std::move(finding));
  }

  // Three sectors of azimuth and some elevation, or the volume is cut to what was seen.
  void coverage() {
    constexpr int kSectors = 6;
    constexpr double kAround_deg = 30.0, kAbove_deg = 5.0;
    std::set<int> sectors;
    double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
    for (std::size_t g = 0; g < adjustment_.groups().size(); ++g) {
      const Group& group = adjustment_.groups()[g];
      if (!group.is_absolute() || !found_.fit.kept[g]) continue;
      for (const std::size_t i : group.observations) {
        const Observation& one = problem_.observations[i];
        if (one.station != station_) continue;
        const PanTilt at = corrected_angles(model_, one.reading);
        const double pan_deg = degrees(at.pan_rad), tilt_deg = degrees(at.tilt_rad);
        sectors.insert(static_cast<int>(std::floor((pan_deg + 180.0) / 360.0 * kSectors)));
        left = std::min(left, pan_deg);
        right = std::max(right, pan_deg);
        low = std::min(low, tilt_deg);
        high = std::max(high, tilt_deg);
      }
    }
    const auto count = static_cast<double>(sectors.size());
    const bool wide = count >= limits_.sectors, tall = high - low >= limits_.elevation_deg;
    add({"sectors", wide ? Judgement::kGood : Judgement::kUnchecked, count,
         static_cast<double>(limits_.sectors),
         "references stand in " + std::to_string(sectors.size()) + " sectors of 60 deg, " +
             std::to_string(limits_.sectors) + " are needed"});
    add({"elevations", tall ? Judgement::kGood : Judgement::kUnchecked, high - low,
         limits_.elevation_deg,
         "references span " + shown(std::max(0.0, high - low), " deg") + " of elevation, " +
             shown(limits_.elevation_deg, " deg") + " are needed"});
    cut(wide, tall, {left - kAround_deg, right + kAround_deg},
        {low - kAbove_deg, high + kAbove_deg});
  }

  void cut(bool wide, bool tall, std::pair<double, double> pan, std::pair<double, double> tilt) {
    WorkingVolume& volume = result_.volume;
    result_.volume_is_cut = !wide || !tall;
    if (!wide) {
      volume.pan_deg =
          std::min(volume.pan_deg, std::max(std::abs(pan.first), std::abs(pan.second)));
    }
    if (!tall) {
      volume.lowest_deg = std::max(volume.lowest_deg, tilt.first);
      volume.highest_deg = std::min(volume.highest_deg, tilt.second);
    }
  }

  const Problem& problem_;
  const Adjustment& adjustment_;
  const Calibration& found_;
  std::size_t station_;
  const AcceptanceLimits& limits_;
  const StationModel& model_;
  Acceptance result_;
};

}  // namespace

const char* to_string(Finding::Judgement judgement) {
  switch (judgement) {
    case Judgement::kGood:
      return "good";
    case Judgement::kUnchecked:
      return "unchecked";
    case Judgement::kBad:
      break;
  }
  return "bad";
}

bool Acceptance::acceptable() const {
  return std::ranges::none_of(findings,
                              [](const Finding& one) { return one.judgement == Judgement::kBad; });
}

Acceptance judge_instrument(const Problem& problem, const Adjustment& adjustment,
                            const Calibration& found, std::size_t station,
                            const AcceptanceLimits& limits) {
  return Judge(problem, adjustment, found, station, limits).run_instrument();
}

Acceptance judge_calibration(const Problem& problem, const Adjustment& adjustment,
                             const Calibration& found, std::size_t station,
                             const AcceptanceLimits& limits) {
  return Judge(problem, adjustment, found, station, limits).run();
}

}  // namespace ols::calibration
