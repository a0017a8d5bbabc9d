// ols-track: follows one target through a clip and writes boxes.csv.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>

#include "base/atomic_file.h"
#include "base/command_line.h"
#include "base/toml_config.h"
#include "edge/tracker/tracker.h"
#include "tools/offline/boxes_csv.h"
#include "tools/offline/frame_source.h"

namespace {

struct Arguments {
  std::string input;
  std::vector<double> init;
  long start_frame = 0;
  std::string config;
  std::string mode;
  std::string timing;
  std::uint64_t seed = 1;
  std::string output;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--input", arguments.input,
                 "clip, folder of pictures (by name, numbers as numbers) or pattern such as "
                 "frames/%06d.png")
      ->required();
  app.add_option("--init", arguments.init,
                 "the target's box in the start frame: X,Y of the top-left corner, W,H [px]")
      ->required()
      ->expected(4)
      ->delimiter(',');
  app.add_option("--start-frame", arguments.start_frame, "frame of --init, counted from 0")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--config", arguments.config, "TOML file with a table [tracker]");
  app.add_option("--mode", arguments.mode,
                 "paper: section 5 of the paper and nothing else; full: what measures best. Goes "
                 "before the configuration's [tracker] mode")
      ->check(CLI::IsMember({"paper", "full"}));
  app.add_option("--timing", arguments.timing,
                 "also write the milliseconds of each stage of each frame to this CSV file");
  app.add_option("--seed", arguments.seed, "of the random numbers: the same seed, the same boxes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--output", arguments.output,
                 "boxes.csv: frame,x,y,w,h [px],belief [0..1],state (tracking, coasting, lost)")
      ->required();
}

ols::TrackerConfig load_config(const Arguments& arguments) {
  ols::TrackerConfig config;
  if (!arguments.config.empty()) {
    ols::ConfigFile file(arguments.config);
    config = ols::read_tracker_config(file.root().table("tracker"));
    file.finish();
  }
  if (arguments.mode == "paper") config.mode = ols::TrackerMode::kPaper;
  if (arguments.mode == "full") config.mode = ols::TrackerMode::kFull;
  return config;
}

// frame, total_ms and the milliseconds of each stage.
class TimingFile {
 public:
  TimingFile(const std::string& path, ols::Tracker& tracker) : file_(path) {
    tracker.set_stage_clock([] {
      const auto now = std::chrono::steady_clock::now().time_since_epoch();
      return std::chrono::duration<double>(now).count();
    });
    file_.stream() << "frame,total_ms";
    for (const char* name : ols::kStageNames) file_.stream() << ',' << name << "_ms";
    file_.stream() << '\n';
  }
  void write(long frame, const ols::StageTimes& times) {
    double total_s = 0.0;
    for (const double seconds : times.seconds) total_s += seconds;
    file_.stream() << frame << ',' << 1e3 * total_s;
    for (const double seconds : times.seconds) file_.stream() << ',' << 1e3 * seconds;
    file_.stream() << '\n';
  }
  void commit() { file_.commit(); }

 private:
  ols::AtomicFile file_;
};

// Tracking while believed, coasting for a second after that, then lost.
class State {
 public:
  ols::BoxRow row(long frame, double time_s, const ols::TrackerOutput& output) {
    constexpr double kBelieved = 0.5;
    constexpr double kCoast = 1.0;  // [s]
    if (output.belief >= kBelieved) believed_s_ = time_s;
    const bool lost = time_s - believed_s_ > kCoast;
    ols::BoxRow row{frame, output.box, output.belief, "tracking"};
    if (output.belief < kBelieved) row.state = lost ? "lost" : "coasting";
    if (lost) row.box.reset();
    return row;
  }
  void start(double time_s) { believed_s_ = time_s; }

 private:
  double believed_s_ = 0.0;
};

[[noreturn]] void refuse(long frame, ols::TrackerError error) {
  throw std::runtime_error("frame " + std::to_string(frame) + ": " + ols::to_string(error));
}

void run(const Arguments& arguments) {
  ols::Tracker tracker(load_config(arguments), arguments.seed);
  ols::FrameSource source(arguments.input);
  const cv::Rect2d box(arguments.init[0], arguments.init[1], arguments.init[2], arguments.init[3]);
  ols::AtomicFile file(arguments.output);
  ols::write_boxes_header(file.stream());
  std::optional<TimingFile> timing;
  if (!arguments.timing.empty()) timing.emplace(arguments.timing, tracker);
  State state;
  long frame = 0;
  for (auto picture = source.next(); picture; picture = source.next(), ++frame) {
    if (frame < arguments.start_frame) continue;
    const double time_s = static_cast<double>(frame) / source.frames_per_second();
    const ols::TrackerInput input{*picture, time_s, std::nullopt};
    if (frame == arguments.start_frame) {
      if (const auto error = tracker.initialise(input, box)) refuse(frame, *error);
      state.start(time_s);
      ols::write_box(file.stream(), {frame, box, 1.0, "tracking"});
      continue;
    }
    const ols::TrackerResult result = tracker.track(input);
    if (result.error) refuse(frame, *result.error);
    ols::write_box(file.stream(), state.row(frame, time_s, *result.output));
    if (timing) timing->write(frame, tracker.stage_times());
  }
  if (frame <= arguments.start_frame) {
    throw std::runtime_error(arguments.input + ": has " + std::to_string(frame) +
                             " frames, --start-frame is " + std::to_string(arguments.start_frame));
  }
  file.commit();
  if (timing) timing->commit();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Follows one target through a clip with the particle filter tracker.", "ols-track");
  Arguments arguments;
  declare(app, arguments);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-track")) return *status;
  // The decoder's own chatter is not the one line that the user needs; a value already set stays.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);
  try {
    run(arguments);
  } catch (const std::exception& error) {
    std::cerr << "ols-track: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
  return 0;
}
