// ols-bench-plans: where the product's procedures look, for tools/bench calibration: what is
// measured there is to be what is driven in the field.
#include <cstdio>
#include <string>
#include <vector>

#include "calibration/procedure/star_stage.h"
#include "calibration/procedure/sweep_plan.h"
#include "dev/bench/program.h"
#include "geometry/angles.h"

namespace {

struct Arguments {
  std::string plan;
  int pictures = 0;
  double across_deg = 5.5, up_deg = 4.1;
  double pan_deg = 149.0, lowest_deg = 12.0, highest_deg = 28.6;
};

std::vector<ols::calibration::Shot> shots(const Arguments& arguments) {
  const double pan_rad = ols::radians(arguments.pan_deg);
  if (arguments.plan == "stars") {
    return ols::calibration::plan_stars({.pictures = arguments.pictures,
                                         .pan_min_rad = -pan_rad,
                                         .pan_max_rad = pan_rad,
                                         .lowest_rad = ols::radians(arguments.lowest_deg),
                                         .highest_rad = ols::radians(arguments.highest_deg)});
  }
  ols::calibration::SweepPlanOptions options;
  options.pan_min_rad = -pan_rad;
  options.pan_max_rad = pan_rad;
  options.poses = arguments.pictures;
  options.field_of_view_rad = {ols::radians(arguments.across_deg), ols::radians(arguments.up_deg)};
  return ols::calibration::plan_sweep(options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints where a procedure looks with a unit of this reach.", "ols-bench-plans");
  Arguments arguments;
  app.add_option("plan", arguments.plan)->required()->check(CLI::IsMember({"stars", "sweep"}));
  app.add_option("pictures", arguments.pictures)->required()->check(CLI::Range(1, 1000));
  app.add_option("--across", arguments.across_deg, "[deg] field of view");
  app.add_option("--up", arguments.up_deg, "[deg] field of view");
  app.add_option("--pan", arguments.pan_deg, "[deg] to both sides");
  app.add_option("--lowest", arguments.lowest_deg, "[deg] of stars");
  app.add_option("--highest", arguments.highest_deg, "[deg] of stars");
  return ols::bench::run_program(app, argc, argv, [&] {
    std::puts("pan_deg,tilt_deg,approach_pan,approach_tilt");
    for (const ols::calibration::Shot& shot : shots(arguments)) {
      std::printf("%.9f,%.9f,%d,%d\n", ols::degrees(shot.angles.pan_rad),
                  ols::degrees(shot.angles.tilt_rad), shot.approach_pan, shot.approach_tilt);
    }
  });
}
