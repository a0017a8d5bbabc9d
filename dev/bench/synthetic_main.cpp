// ols-bench-tracker: the tracker on synthetic images with exact truth; one row per frame.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>

#include "base/files/atomic_file.h"
#include "dev/bench/program.h"
#include "dev/bench/synthetic_cases.h"
#include "edge/tracker/tracker.h"
#include "tools/offline/tracker_setup.h"

namespace {

using ols::bench::BenchCase;
using ols::bench::BenchPath;

struct Arguments {
  std::string config;
  std::string mode = "full";
  int runs = 20;
  std::uint64_t seed = 1;
  std::vector<std::string> sweeps;
  std::string pictures;
  std::string output;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--config", arguments.config, "TOML file with a table [tracker]");
  app.add_option("--mode", arguments.mode, "of the tracker")
      ->check(CLI::IsMember({"paper", "full"}))
      ->capture_default_str();
  app.add_option("--runs", arguments.runs, "of each point, with different seeds")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--seed", arguments.seed, "of the first run")->capture_default_str();
  app.add_option("--sweeps", arguments.sweeps, "only these, for example size,contrast")
      ->delimiter(',');
  app.add_option("--pictures", arguments.pictures,
                 "folder for one image of each point, as the tracker gets it (PNG)");
  app.add_option(
         "--output", arguments.output,
         "CSV, a row for every frame: place of the target and of the tracker [px, (0, 0) is "
         "the centre of a pixel], covariance and Cramer-Rao bound [px^2]")
      ->required();
}

// One run's images and truth.
class Take {
 public:
  Take(const BenchCase& which, ols::bench::Landscape& landscape, std::uint64_t seed)
      : case_(which),
        landscape_(landscape),
        random_(seed),
        path_(which, landscape, random_),
        target_(which.look) {}

  struct Picture {
    ols::tracker::TrackerInput input;
    Eigen::Matrix2d bound_px2 = Eigen::Matrix2d::Zero();
    bool visible = true;
  };

  Picture picture(int frame, const ols::bench::PixelNoise& noise) {
    const double time_s = frame * ols::bench::kFrameInterval_s;
    Picture result;
    const Eigen::Vector2d centre_px = path_.target_px(time_s);
    result.visible = !path_.hidden(time_s);
    cv::Mat1f light = landscape_.backdrop(case_.backdrop, path_.camera(time_s));
    const int smear = static_cast<int>(std::lround(path_.camera_smear_px()));
    if (smear > 1) cv::blur(light, light, cv::Size(smear, 1));
    if (result.visible) {
      const double growth = path_.growth(time_s);
      const Eigen::Vector2d smear_px = path_.smear_px(time_s);
      // Computed rarely: it changes slowly and costs more than the image.
      if (frame % 5 == 0) bound_px2_ = target_.bound(light, centre_px, smear_px, growth);
      result.bound_px2 = bound_px2_;
      target_.draw(light, centre_px, smear_px, growth);
    }
    result.input = {noise.develop(light, random_), time_s, homography(time_s)};
    return result;
  }

  // What an operator would draw: the box, not quite at its place.
  cv::Rect2d designation() {
    cv::Rect2d box = target_.box(path_.target_px(0.0));
    constexpr double kSd = 0.02;  // of its size
    box.x += kSd * box.width * random_.gaussian();
    box.y += kSd * box.height * random_.gaussian();
    designated_off_px_ = centre(box) - path_.target_px(0.0);
    return box;
  }
  static Eigen::Vector2d centre(const cv::Rect2d& box) {
    return {box.x + 0.5 * box.width - 0.5, box.y + 0.5 * box.height - 0.5};
  }
  // Where the designated point of the target is: it grows with it.
  Eigen::Vector2d truth_px(int frame) const {
    const double time_s = frame * ols::bench::kFrameInterval_s;
    return path_.target_px(time_s) + path_.growth(time_s) * designated_off_px_;
  }

 private:
  std::optional<Eigen::Matrix3d> homography(double time_s) {
    ols::AzimuthElevation now = path_.camera(time_s);
    now.azimuth_rad += ols::bench::kAngleSd_rad * random_.gaussian();
    now.elevation_rad += ols::bench::kAngleSd_rad * random_.gaussian();
    std::optional<Eigen::Matrix3d> result;
    if (case_.angles_given && read_) {
      result = ols::bench::rotation_between(landscape_.camera(), *read_, now);
    }
    read_ = now;
    return result;
  }

  BenchCase case_;
  ols::bench::Landscape& landscape_;
  ols::tracker::Random random_;
  BenchPath path_;
  ols::bench::SyntheticTarget target_;
  Eigen::Matrix2d bound_px2_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d designated_off_px_ = Eigen::Vector2d::Zero();  // from the target's middle
  std::optional<ols::AzimuthElevation> read_;  // the PTU's angles at the frame before
};

void write_row(std::ostream& out, const BenchCase& which, std::uint64_t seed, int frame,
               const Take::Picture& picture, const Eigen::Vector2d& truth_px,
               const ols::tracker::TrackerOutput& output) {
  std::array<char, 320> text{};
  const auto& c = output.covariance_px2;
  const auto& b = picture.bound_px2;
  std::snprintf(text.data(), text.size(),
                "%s,%g,%lu,%d,%d,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.4g,%.4g,%.4f,%.4g,%.4g\n",
                which.sweep.c_str(), which.value, static_cast<unsigned long>(seed), frame,
                picture.visible ? 1 : 0, truth_px.x(), truth_px.y(), output.pixel.x(),
                output.pixel.y(), output.box.width, output.box.height, c(0, 0), c(1, 1),
                output.belief, b(0, 0), b(1, 1));
  out << text.data();
}

[[noreturn]] void refused(const BenchCase& which, ols::tracker::TrackerError error) {
  throw std::runtime_error(which.sweep + ": " + to_string(error));
}

void run_case(const BenchCase& which, std::uint64_t seed, const ols::tracker::TrackerConfig& config,
              ols::bench::Landscape& landscape, const ols::bench::PixelNoise& noise,
              std::ostream& out) {
  Take take(which, landscape, seed);
  ols::tracker::Tracker tracker(config, seed);
  Take::Picture picture = take.picture(0, noise);
  const cv::Rect2d box = take.designation();
  if (const auto error = tracker.initialise(picture.input, box)) refused(which, *error);
  ols::tracker::TrackerOutput output;
  output.box = box;
  // What the position is relative to.
  output.pixel = Take::centre(box);
  output.covariance_px2.setZero();
  output.belief = 1.0;
  write_row(out, which, seed, 0, picture, take.truth_px(0), output);
  const int frames = static_cast<int>(which.seconds / ols::bench::kFrameInterval_s);
  for (int frame = 1; frame < frames; ++frame) {
    picture = take.picture(frame, noise);
    const ols::tracker::TrackerResult result = tracker.track(picture.input);
    if (result.error) refused(which, *result.error);
    write_row(out, which, seed, frame, picture, take.truth_px(frame), *result.output);
  }
}

// Half a second into the first run.
void write_picture(const std::string& folder, const BenchCase& which, std::uint64_t seed,
                   ols::bench::Landscape& landscape, const ols::bench::PixelNoise& noise) {
  constexpr int kFrame = 15;
  std::filesystem::create_directories(folder);
  Take take(which, landscape, seed);
  std::ostringstream name;
  name << folder << '/' << which.sweep << '_' << which.value << ".png";
  if (!cv::imwrite(name.str(), take.picture(kFrame, noise).input.gray)) {
    throw std::runtime_error(name.str() + ": cannot be written");
  }
}

// Throws on a name that no case has.
std::set<std::string> known_sweeps(const std::vector<std::string>& names,
                                   const std::vector<BenchCase>& cases) {
  for (const std::string& name : names) {
    if (std::ranges::find(cases, name, &BenchCase::sweep) == cases.end()) {
      throw std::runtime_error("--sweeps: no sweep is named " + name);
    }
  }
  return {names.begin(), names.end()};
}

void run(const Arguments& arguments) {
  const ols::tracker::TrackerConfig config =
      ols::offline::load_tracker_config(arguments.config, arguments.mode);
  ols::bench::Landscape landscape(ols::bench::bench_camera());
  const ols::bench::PixelNoise noise;
  const std::vector<BenchCase> cases = ols::bench::bench_cases();
  const std::set<std::string> wanted = known_sweeps(arguments.sweeps, cases);
  ols::AtomicFile file(arguments.output);
  file.stream() << "sweep,value,seed,frame,visible,true_x,true_y,x,y,w,h,var_x,var_y,belief,"
                   "bound_x,bound_y\n";
  for (const BenchCase& which : cases) {
    if (!arguments.sweeps.empty() && wanted.count(which.sweep) == 0) continue;
    std::cerr << which.sweep << ' ' << which.value << '\n';
    if (!arguments.pictures.empty()) {
      write_picture(arguments.pictures, which, arguments.seed, landscape, noise);
    }
    for (int i = 0; i < arguments.runs; ++i) {
      const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(i);
      run_case(which, seed, config, landscape, noise, file.stream());
    }
  }
  file.commit();
  std::cout << "seeds " << arguments.seed << " to "
            << arguments.seed + static_cast<std::uint64_t>(arguments.runs) - 1 << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app("Runs the tracker on synthetic images with exact truth.", "ols-bench-tracker");
  Arguments arguments;
  declare(app, arguments);
  cv::setNumThreads(1);
  return ols::bench::run_program(app, argc, argv, [&] { run(arguments); });
}
