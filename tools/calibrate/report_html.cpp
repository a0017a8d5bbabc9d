// report.html: one page that a surveyor reads, with its plots in it.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "calibration/rectification.h"
#include "calibration/systematic.h"
#include "geometry/angles.h"
#include "tools/calibrate/result_files.h"

namespace ols::calibration {
namespace {

constexpr const char* kHead =
    "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Calibration</title>"
    "<style>body{font:15px/1.45 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;"
    "color:#1b1f24}h1{font-size:1.6em;margin-bottom:.2em}h2{font-size:1.15em;margin-top:2em}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}"
    "td,th{padding:.2em .8em .2em 0;text-align:right;border-bottom:1px solid #e3e6ea}"
    "td:first-child,th:first-child{text-align:left}.bad{color:#b42318;font-weight:600}"
    ".big{font-size:1.5em;font-weight:600}.note{color:#57606a}svg text{font:12px system-ui}"
    "</style></head><body>\n";

double arcsec(double rad) { return 3600.0 * degrees(rad); }

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

// The first characters of a name, none of them cut.
std::string shortened(const std::string& text, std::size_t most) {
  std::size_t end = std::min(most, text.size());
  const auto continues = [&text](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  while (end > 0 && end < text.size() && continues(end)) --end;
  return text.substr(0, end);
}

// White to dark blue, 0..1.
std::string shade(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  std::ostringstream out;
  out << "rgb(" << std::lround(240 - 215 * s) << ',' << std::lround(246 - 170 * s) << ','
      << std::lround(252 - 105 * s) << ')';
  return out.str();
}

void write_volume(std::ostream& out, const StationResult& result) {
  const VolumePrecision volume = volume_precision(result.state.model, result.covariance);
  const WorkingVolume range;
  constexpr double kWidth = 720.0, kHeight = 150.0, kLeft = 60.0, kTop = 10.0;
  const auto x_of = [&](double pan) { return kLeft + kWidth * (pan / range.pan_deg + 1.0) / 2.0; };
  const auto y_of = [&](double tilt) {
    return kTop + kHeight * (range.highest_deg - tilt) / (range.highest_deg - range.lowest_deg);
  };
  out << "<h2>Predicted systematic error over the working volume</h2>\n<svg width=\"880\" "
         "height=\"210\" role=\"img\">";
  for (const VolumePoint& point : volume.points) {
    out << "<rect x=\"" << x_of(point.pan_deg) - 15 << "\" y=\"" << y_of(point.tilt_deg) - 8
        << "\" width=\"30\" height=\"21\" fill=\"" << shade(point.rms_rad / volume.worst_rad)
        << "\"><title>" << arcsec(point.rms_rad) << " arc seconds</title></rect>";
  }
  out << std::setprecision(0);
  for (const double pan : {-150.0, -100.0, -50.0, 0.0, 50.0, 100.0, 150.0}) {
    out << "<text x=\"" << x_of(pan) << "\" y=\"190\" text-anchor=\"middle\">" << pan << "°</text>";
  }
  for (const double tilt : {-5.0, 10.0, 30.0}) {
    out << "<text x=\"40\" y=\"" << y_of(tilt) + 6 << "\" text-anchor=\"end\">" << tilt
        << "°</text>";
  }
  out << std::setprecision(1)
      << "<text x=\"420\" y=\"207\" text-anchor=\"middle\">pan of the unit</text>";
  for (int i = 0; i <= 4; ++i) {
    out << "<rect x=\"805\" y=\"" << 20 + 30 * i << "\" width=\"16\" height=\"28\" fill=\""
        << shade(0.25 * i) << "\"/><text x=\"826\" y=\"" << 38 + 30 * i << "\">"
        << arcsec(0.25 * i * volume.worst_rad) << "″</text>";
  }
  out << "</svg>\n";
}

// Residuals of all sightings of a group, as dots on two lines: x and y.
void write_residuals(std::ostream& out, const Adjustment& adjustment, const Calibration& found) {
  constexpr std::size_t kMost = 60;
  constexpr double kMiddle = 500.0, kHalf = 270.0;
  std::vector<std::size_t> shown;
  double most = 0.5;
  const auto each = [&](const Group& group, const auto& take) {
    for (const std::size_t i : group.observations) {
      if (i < found.residuals.size() && found.residuals[i]) take(*found.residuals[i]);
    }
  };
  for (std::size_t g = 0; g < found.tests.size() && shown.size() < kMost; ++g) {
    const Group& group = adjustment.groups()[g];
    if (group.kind == Kind::kInclinometer) continue;
    shown.push_back(g);
    if (found.tests[g].rejected) continue;
    each(group, [&](const Eigen::Vector2d& v) {
      most = std::max({most, std::abs(v.x()), std::abs(v.y())});
    });
  }
  out << "<h2>Residuals [px]</h2>\n<p class=\"note\">Measured less adjusted; blue: x, orange: y. A "
         "rejected reference is red; what lies outside is drawn at the edge.</p>\n"
      << "<svg width=\"800\" height=\"" << 30 + 18 * shown.size() << "\" role=\"img\">"
      << "<line x1=\"" << kMiddle << "\" x2=\"" << kMiddle << "\" y1=\"0\" y2=\""
      << 10 + 18 * shown.size() << "\" stroke=\"#c4c9d0\"/>";
  for (std::size_t row = 0; row < shown.size(); ++row) {
    const Group& group = adjustment.groups()[shown[row]];
    const double y = 12.0 + 18.0 * static_cast<double>(row);
    const bool rejected = found.tests[shown[row]].rejected;
    out << "<text x=\"0\" y=\"" << y + 4 << "\"" << (rejected ? " fill=\"#b42318\"" : "") << ">"
        << name(group.kind) << ' ' << escaped(shortened(group.name, 16)) << "</text>";
    each(group, [&](const Eigen::Vector2d& v) {
      for (const int k : {0, 1}) {
        const double x = kMiddle + kHalf * std::clamp(v[k] / most, -1.05, 1.05);
        out << "<circle cx=\"" << x << "\" cy=\"" << y + (k == 0 ? -3 : 3)
            << "\" r=\"2.6\" fill-opacity=\".7\" fill=\"" << (k == 0 ? "#1f6feb" : "#e36209")
            << "\"/>";
      }
    });
  }
  const std::size_t base = 25 + 18 * shown.size();
  out << "<text x=\"" << kMiddle - kHalf << "\" y=\"" << base << "\" text-anchor=\"middle\">"
      << -most << "</text><text x=\"" << kMiddle << "\" y=\"" << base
      << "\" text-anchor=\"middle\">0</text><text x=\"" << kMiddle + kHalf << "\" y=\"" << base
      << "\" text-anchor=\"middle\">" << most << "</text></svg>\n";
}

std::string detectable(const Group& group, double rad) {
  if (group.kind == Kind::kInclinometer || is_rectification_target(group.kind)) return "–";
  if (!std::isfinite(rad)) return "unchecked";
  std::ostringstream out;
  out << std::fixed << std::setprecision(0) << arcsec(rad) << "″";
  return out.str();
}

void write_tests(std::ostream& out, const Adjustment& adjustment, const Calibration& found) {
  constexpr std::size_t kMost = 60;
  out << "<h2>Tests of the references</h2>\n<p class=\"note\">Each against all the others; beyond "
         "its critical value it is rejected. Detectable: the smallest mistake of its direction "
         "that "
         "the test would find with 80 %.</p>\n<table><tr><th>reference</th><th>sightings</th>"
         "<th>w</th><th>critical</th><th>detectable across</th><th>up</th></tr>\n";
  std::size_t rows = 0;
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    const Group& group = adjustment.groups()[g];
    const GroupTest& test = found.tests[g];
    if (!group.is_tested() || (++rows > kMost && !test.rejected)) continue;
    out << (test.rejected ? "<tr class=\"bad\"><td>" : "<tr><td>") << name(group.kind) << ' '
        << escaped(group.name) << (test.rejected ? " REJECTED" : "") << "</td><td>"
        << group.observations.size() << "</td><td>" << test.w << "</td><td>" << test.critical
        << "</td><td>" << detectable(group, test.detectable_rad[0]) << "</td><td>"
        << detectable(group, test.detectable_rad[1]) << "</td></tr>\n";
  }
  out << "</table>\n";
}

void write_parameters(std::ostream& out, const StationResult& result) {
  StationVector values;
  const ChainParameters& chain = result.state.model.geometry.chain;
  values << instrument_of(result.state.model), chain.heading_rad, chain.tilt_x_rad,
      chain.tilt_y_rad, result.state.change.segment<3>(kEast), result.state.refraction,
      result.state.air;
  out << "<h2>Parameters</h2>\n<p class=\"note\">The standard deviation of a single value may be "
         "large although directions are known well: the errors are correlated, as covariance.csv "
         "shows.</p>\n<table><tr><th>parameter</th><th>value</th><th>1-sigma</th><th>before</th></"
         "tr>\n";
  for (int i = 0; i < kStationParameters; ++i) {
    const ParameterText& text = parameter_texts()[static_cast<std::size_t>(i)];
    const auto sd = [&](const StationMatrix& C) {
      const double value = to_file(i, std::sqrt(C(i, i)));
      std::ostringstream cell;
      cell << std::setprecision(3) << (text.is_angle ? 3600.0 * value : value)
           << (text.is_angle ? "″" : "");
      return cell.str();
    };
    out << "<tr><td>" << text.key << " <span class=\"note\">" << text.sentence << "</span></td><td>"
        << std::setprecision(7) << to_file(i, values[i]) << "</td><td>" << sd(result.covariance)
        << "</td><td>" << (i == kHeading ? "unknown" : sd(result.prior_covariance))
        << "</td></tr>\n";
  }
  out << "</table>\n";
}

void write_rectification(std::ostream& out, const Case& what, const Adjustment& adjustment,
                         const Calibration& found, std::size_t station) {
  const auto angles = rectified_angles(what.problem, adjustment, found, station);
  if (angles.empty()) return;
  out << "<h2>Rectification</h2>\n<p class=\"note\">How the camera is mounted on its unit, "
         "according to the paper's "
         "targets.</p>\n<table><tr><th>angle</th><th>value</th><th>1-sigma</th></tr>\n";
  for (const RectifiedAngle& one : angles) {
    out << "<tr><td>" << to_string(one.kind) << "</td><td>" << std::setprecision(4)
        << degrees(one.rad) << "°</td><td>" << std::setprecision(0) << arcsec(one.sd_rad)
        << "″</td></tr>\n";
  }
  out << "</table>\n";
}

void write_instrument_summary(std::ostream& out, const StationResult& result) {
  out << "<h1>Instrument of station " << escaped(result.id) << "</h1>\n<p class=\"note\">Without a "
      << "setup: the observations do not determine where it points.</p>\n";
}

void write_summary(std::ostream& out, const StationResult& result, const Calibration& found) {
  const VolumePrecision volume = volume_precision(result.state.model, result.covariance);
  out << "<h1>Station " << escaped(result.id) << "</h1>\n<p class=\"note\">Calibration "
      << result.calibration_id << "</p>\n<p><span class=\"big\">" << std::setprecision(1)
      << arcsec(volume.rms_rad) << "″</span> systematic RMS of an axis over pan ±150°, tilt "
      << "−5…30°; worst " << arcsec(volume.worst_rad) << "″. Heading " << std::setprecision(4)
      << degrees(wrap_two_pi(result.state.model.geometry.chain.heading_rad)) << "°.</p>\n"
      << std::setprecision(2) << "<p>Global test: variance factor " << found.global.variance_factor
      << ", critical " << found.global.critical << ", redundancy " << found.global.redundancy
      << (found.scaled_by > 1.0 ? ": <span class=\"bad\">rejected</span>" : ": accepted")
      << ".</p>\n";
}

// Each finding under the heading that is true of it, the bad ones first.
void write_acceptance(std::ostream& out, const Acceptance& acceptance) {
  using Judgement = Finding::Judgement;
  constexpr std::array<std::pair<Judgement, const char*>, 3> kHeadings{
      {{Judgement::kBad, "Not within the limits"},
       {Judgement::kUnchecked, "Unchecked"},
       {Judgement::kGood, "Within the limits"}}};
  for (const auto& [judgement, heading] : kHeadings) {
    std::vector<std::string> sentences;
    for (const Finding& one : acceptance.findings) {
      if (one.judgement == judgement) sentences.push_back(one.sentence);
    }
    if (sentences.empty()) continue;
    out << "<h2>" << heading << "</h2>\n<table>\n";
    const char* const row = judgement == Judgement::kBad ? "<tr class=\"bad\"><td>" : "<tr><td>";
    for (const std::string& one : sentences) out << row << escaped(one) << "</td></tr>\n";
    out << "</table>\n";
  }
}

}  // namespace

std::string report_html(const Case& what, const Adjustment& adjustment, const Calibration& found,
                        const std::vector<StationResult>& results) {
  std::ostringstream out;
  out << kHead << std::fixed << std::setprecision(1);
  for (const StationResult& result : results) {
    if (found.headings_known) {
      write_summary(out, result, found);
    } else {
      write_instrument_summary(out, result);
    }
    if (&result == &results.front()) {
      out << "<ul>";
      for (const std::string& remark : found.remarks) {
        out << "<li class=\"bad\">" << escaped(remark) << "</li>";
      }
      for (const std::string& warning : what.warnings) out << "<li>" << escaped(warning) << "</li>";
      out << "</ul>\n" << std::setprecision(1);
    }
    out << std::setprecision(1);
    if (found.headings_known) write_volume(out, result);
    write_acceptance(out, result.acceptance);
    const auto station = static_cast<std::size_t>(&result - results.data());
    write_rectification(out, what, adjustment, found, station);
  }
  write_residuals(out, adjustment, found);
  out << std::setprecision(1);
  write_tests(out, adjustment, found);
  out << std::defaultfloat;
  for (const StationResult& result : results) write_parameters(out, result);
  out << "</body></html>\n";
  return out.str();
}

}  // namespace ols::calibration
