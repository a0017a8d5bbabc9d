// ols-golden-paper-mode FOLDER: the tracker in the paper's mode on drawn pictures: a panning
// camera, a target that turns back and is hidden for a second. Writes frames.csv.
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "edge/tracker/tracker.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::golden {
namespace {

using tracker::testing::Backdrop;
using tracker::testing::SyntheticScene;

constexpr int kFrames = 90, kHiddenFrom = 50, kHiddenUntil = 65;

void run(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "frames.csv");
  file.exceptions(std::ios::badbit);
  file << "backdrop,frame,x_px,y_px,width_px,height_px,belief\n" << std::setprecision(8);
  tracker::TrackerConfig config;
  config.mode = tracker::TrackerMode::kPaper;
  for (const Backdrop backdrop : {Backdrop::kTextured, Backdrop::kSky}) {
    SyntheticScene scene(backdrop, 3);
    tracker::Tracker tracker = tracker::testing::started(scene, config);
    for (int frame = 1; frame < kFrames; ++frame) {
      const cv::Point2d camera(400.0 + 3.0 * frame, 300.0);
      const cv::Point2d target(tracker::testing::kStart.x + 60.0 * std::sin(0.07 * frame),
                               tracker::testing::kStart.y - 40.0 * std::sin(0.05 * frame));
      const bool is_hidden = frame >= kHiddenFrom && frame < kHiddenUntil;
      const cv::Mat picture =
          scene.picture(camera, is_hidden ? std::nullopt : std::optional(target));
      const auto output = tracker.track(tracker::testing::frame_at(frame, picture)).output.value();
      file << (backdrop == Backdrop::kSky ? "sky," : "textured,") << frame << "," << output.box.x
           << "," << output.box.y << "," << output.box.width << "," << output.box.height << ","
           << output.belief << "\n";
    }
  }
}

}  // namespace
}  // namespace ols::golden

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: ols-golden-paper-mode FOLDER\n";
    return 2;
  }
  try {
    ols::golden::run(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "ols-golden-paper-mode: " << error.what() << "\n";
    return 2;
  }
}
