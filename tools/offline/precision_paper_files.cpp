#include "tools/offline/precision_paper_files.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/files/atomic_file.h"
#include "base/files/csv_files.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "geometry/precision_paper.h"

namespace ols::offline {
namespace {

using Eigen::Vector3d;

struct PaperOptions {
  PixelError error;
  double pixel_um = 3.75, focal_length_mm = 50.0;
  double base_m = 30.0;
  double far_m = 1000.0;
  double greatest_base_m = 100.0;
  int steps = 100;
  std::string input, output;

  PixelError pixel_error() const { return {error.pixels, pixel_um * 1e-6, focal_length_mm * 1e-3}; }
  double angle_rad() const { return std::atan(pixel_error().tangent()); }
};

std::shared_ptr<PaperOptions> add_common(CLI::App& command, double pixels) {
  auto o = std::make_shared<PaperOptions>();
  o->error.pixels = pixels;
  const auto positive = CLI::Range(1e-3, 1e6);
  command.add_option("--pixels", o->error.pixels, "[px] p, the random error")
      ->check(positive)
      ->capture_default_str();
  command.add_option("--pixel-um", o->pixel_um, "[um] r, the size of a pixel")
      ->check(positive)
      ->capture_default_str();
  command.add_option("--focal-length-mm", o->focal_length_mm, "[mm] f")
      ->check(positive)
      ->capture_default_str();
  command.add_option("--output", o->output, "CSV")->required();
  return o;
}

void add_length(CLI::App& command, const char* name, double& value, const char* text) {
  command.add_option(name, value, text)->check(CLI::Range(1e-3, 1e7))->capture_default_str();
}

void add_steps(CLI::App& command, PaperOptions& o) {
  command.add_option("--steps", o.steps, "steps along each axis of the grid")
      ->check(CLI::Range(2, 2000))
      ->capture_default_str();
}

constexpr const char* kRows = "rows of the grid";

// An empty cell if the error is unbounded.
std::ostream& cell(std::ostream& out, double value) {
  out << ',';
  return std::isfinite(value) ? out << value : out;
}

void write_figure3(const PaperOptions& o) {
  AtomicFile file(o.output);
  std::ostream& out = file.stream();
  out << "base_m,distance_m,rotating_pair_m,canonical_m,both_cameras_m\n" << std::setprecision(9);
  Progress progress("ols-precision", kRows);
  for (int i = 1; i <= o.steps; ++i) {
    const double base_m = o.greatest_base_m * i / o.steps;
    for (int k = 1; k <= o.steps; ++k) {
      const double distance_m = o.far_m * k / o.steps;
      out << base_m << ',' << distance_m;
      cell(out, rotating_pair_error_m(o.pixel_error(), base_m, distance_m));
      cell(out, canonical_stereo_error_m(o.pixel_error(), base_m, distance_m));
      cell(out, pair_error_m({0, 0, 0}, {base_m, 0, 0}, {0, distance_m, 0}, o.angle_rad()));
      out << '\n';
    }
    progress(static_cast<std::size_t>(i), static_cast<std::size_t>(o.steps));
  }
  file.commit();
}

void write_figure4(const PaperOptions& o) {
  const Vector3d left(-0.5 * o.base_m, 0, 0), right(0.5 * o.base_m, 0, 0);
  const Vector3d top(0, std::sqrt(0.75) * o.base_m, 0);
  const std::array<Baseline, 3> baselines = {Baseline{left, right}, {right, top}, {top, left}};
  AtomicFile file(o.output);
  std::ostream& out = file.stream();
  out << "x_m,y_m,two_cameras_m,three_cameras_m,baseline,best_possible_m\n" << std::setprecision(9);
  Progress progress("ols-precision", kRows);
  for (int i = 0; i <= o.steps; ++i) {
    for (int k = 0; k <= o.steps; ++k) {
      const Vector3d target(o.far_m * (2.0 * k / o.steps - 1.0),
                            o.far_m * (2.0 * i / o.steps - 1.0), 0.0);
      std::array<double, 3> errors{};
      for (std::size_t n = 0; n < baselines.size(); ++n) {
        errors.at(n) =
            pair_error_m(baselines.at(n).first, baselines.at(n).second, target, o.angle_rad());
      }
      const std::size_t chosen = best_baseline(baselines, target);
      out << target.x() << ',' << target.y();
      cell(out, errors[0]);
      cell(out, errors.at(chosen)) << ',' << chosen + 1;
      cell(out, *std::ranges::min_element(errors)) << '\n';
    }
    progress(static_cast<std::size_t>(i) + 1, static_cast<std::size_t>(o.steps) + 1);
  }
  file.commit();
}

void write_table(const PaperOptions& o) {
  check_outputs({{"--input", o.input}}, {{"--output", o.output}});
  AtomicFile file(o.output);
  std::ostream& out = file.stream();
  out << "object,distance_m,alpha_rad,side,estimated_m,estimated_by_side_m,paper_estimated_m,"
         "paper_measured_m\n"
      << std::setprecision(6);
  const Vector3d first(-0.5 * o.base_m, 0, 0), second(0.5 * o.base_m, 0, 0);
  for (const LandmarkRow& row : read_landmarks(o.input)) {
    if (row.distance_m <= 0.5 * o.base_m) {
      throw std::invalid_argument(o.input + ": object " + row.object +
                                  ": distance_m is not over half of the base");
    }
    const auto estimate = [&](int side) {
      return pair_error_m(first, second,
                          table_target(o.base_m, row.distance_m, row.alpha_rad, side),
                          o.angle_rad());
    };
    out << row.object << ',' << row.distance_m << ',' << row.alpha_rad << ',' << row.side;
    cell(out, estimate(0));
    cell(out, estimate(row.side));
    cell(out, row.estimated_m.value_or(NAN));
    cell(out, row.measured_m.value_or(NAN)) << '\n';
  }
  file.commit();
}

}  // namespace

void add_figure3(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "figure3", "The paper's Figure 3: the error over the base and the distance.");
  const auto o = add_common(*command, 10.0);
  add_length(*command, "--greatest-base", o->greatest_base_m, "[m]");
  add_length(*command, "--greatest-distance", o->far_m, "[m]");
  add_steps(*command, *o);
  command->callback([o] { write_figure3(*o); });
}

void add_figure4(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "figure4", "The paper's Figure 4: two and three cameras, the error over the plane.");
  const auto o = add_common(*command, 4.0);
  o->base_m = 20.0;
  o->far_m = 100.0;
  o->steps = 200;
  add_length(*command, "--base", o->base_m, "[m] side of the regular triangle");
  add_length(*command, "--half-width", o->far_m, "[m] of the square around the first base");
  add_steps(*command, *o);
  command->callback([o] { write_figure4(*o); });
}

void add_table(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "table", "The paper's Table 1: the estimated error of landmarks before a base.");
  const auto o = add_common(*command, 4.0);
  add_length(*command, "--base", o->base_m, "[m]");
  command
      ->add_option("--input", o->input,
                   "CSV: object,distance_m,alpha_rad[,side,estimated_m,measured_m]; alpha from the "
                   "base's normal; side 0: distance from the base's centre, -1 or +1: from the "
                   "first camera, the landmark on its side or on the other's")
      ->required();
  command->callback([o] { write_table(*o); });
}

}  // namespace ols::offline
