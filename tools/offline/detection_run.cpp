#include "tools/offline/detection_run.h"

#include <cmath>
#include <iostream>
#include <optional>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "conditions/printed.h"
#include "edge/detector/detector.h"
#include "tools/offline/frame_source.h"
#include "tools/offline/mount_csv.h"
#include "tools/offline/timing_csv.h"

namespace ols::offline {
namespace {

void check_files(const DetectionArguments& arguments, const FrameSource& source) {
  std::vector<NamedFile> inputs{{"--input", arguments.input}, {"--mount", arguments.mount}};
  for (const std::string& picture : source.files()) inputs.push_back({"--input", picture});
  check_outputs(inputs, {{"--output", arguments.output}, {"--timing", arguments.timing}});
}

void write(std::ostream& out, long frame, const detector::Tracklet& tracklet) {
  const Eigen::Vector2d corner = tracklet.pixel() - 0.5 * tracklet.size_px();
  const double confidence = 1.0 / (1.0 + std::exp(-tracklet.log_ratio()));
  const std::string text =
      printed("%ld,%ld,%.2f,%.2f,%.2f,%.2f,%.4f,other\n", frame, tracklet.id(), corner.x() + 0.5,
              corner.y() + 0.5, tracklet.size_px().x(), tracklet.size_px().y(), confidence);
  out << text;
}

}  // namespace

void run_detection(const DetectionArguments& arguments) {
  FrameSource source(arguments.input);
  check_files(arguments, source);
  const MountFile mount = arguments.mount.empty() ? MountFile() : MountFile(arguments.mount);
  AtomicFile file(arguments.output);
  file.stream() << "frame,id,x,y,w,h,confidence,class\n";
  std::optional<AtomicFile> timing;
  if (!arguments.timing.empty()) timing.emplace(arguments.timing).stream() << "frame,total_ms\n";
  detector::DetectorConfig config;
  config.tracklets.false_an_hour = arguments.false_an_hour;
  std::optional<detector::Detector> detector;
  Progress progress("ols-track", "frames");
  long frame = 0;
  for (auto picture = source.next(); picture; picture = source.next(), ++frame) {
    if (!detector) detector.emplace(config, picture->size());
    const double time_s = static_cast<double>(frame) / source.frames_per_second();
    const double began_s = thread_time_s();
    detector->advance(*picture, time_s, mount.motion_to(frame, picture->size()));
    const double taken_s = thread_time_s() - began_s;
    if (timing) timing->stream() << frame << ',' << 1e3 * taken_s << '\n';
    for (const detector::Tracklet& tracklet : detector->tracklets()) {
      if (tracklet.confirmed()) write(file.stream(), frame, tracklet);
    }
    progress(static_cast<std::size_t>(frame) + 1, source.announced());
  }
  if (detector && detector->suspended_images() > 0) {
    std::cerr << "ols-track: everything changed at once in " << detector->suspended_images()
              << " frames; no movers are taken from these\n";
  }
  file.commit();
  if (timing) timing->commit();
}

}  // namespace ols::offline
