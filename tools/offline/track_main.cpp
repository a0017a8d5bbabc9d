// ols-track: follows one target through a clip and writes boxes.csv; or detects everything that
// flies or moves in it.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <sstream>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/command_line.h"
#include "base/process/progress.h"
#include "edge/tracker/tracker.h"
#include "tools/offline/boxes_csv.h"
#include "tools/offline/detection_run.h"
#include "tools/offline/frame_source.h"
#include "tools/offline/timing_csv.h"
#include "tools/offline/tracker_setup.h"

namespace {

constexpr int kExitLost = 1;

struct Arguments {
  std::string input;
  std::vector<double> init;
  long start_frame = 0;
  std::string config;
  std::string mode;
  std::string timing;
  std::uint64_t seed = 1;
  bool detect = false;
  std::string mount;
  double false_an_hour = 1.0;
  std::string output;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--input", arguments.input,
                 "clip, folder of pictures (by name, numbers as numbers) or pattern such as "
                 "frames/%06d.png")
      ->required();
  auto* const task = app.add_option_group("task");
  auto* const init =
      task->add_option("--init", arguments.init,
                       "the target's box in the start frame: X,Y of the top-left corner, W,H [px]")
          ->expected(4)
          ->delimiter(',');
  auto* const detect = task->add_flag("--detect", arguments.detect,
                                      "no target is given: find everything that flies or moves");
  task->require_option(1);
  app.add_option(
         "--mount", arguments.mount,
         "with --detect: CSV file frame,azimuth_deg,elevation_deg,hfov_deg of a camera that "
         "turns")
      ->needs(detect);
  app.add_option("--false-alarms", arguments.false_an_hour,
                 "with --detect: allowed false objects per hour")
      ->check(CLI::Range(1e-3, 1e4))
      ->needs(detect)
      ->capture_default_str();
  app.add_option("--start-frame", arguments.start_frame, "frame of --init, counted from 0")
      ->needs(init)
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--config", arguments.config, "TOML file with a table [tracker]");
  app.add_option("--mode", arguments.mode,
                 "paper: section 5 of the paper and nothing else; full: the product's tracker. "
                 "Overrides the configuration's [tracker] mode")
      ->check(CLI::IsMember({"paper", "full"}));
  app.add_option("--timing", arguments.timing,
                 "also write the milliseconds of each stage of each frame to this CSV file");
  app.add_option("--seed", arguments.seed,
                 "seed of the random numbers: equal seeds give equal boxes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option(
         "--output", arguments.output,
         "boxes.csv: frame,x,y,w,h [px],belief [0..1],state (tracking, coasting, lost); with "
         "--detect: frame,id,x,y,w,h [px],confidence [0..1],class, a row for each confirmed "
         "object in each frame")
      ->required();
}

// Tracking above the belief limit, coasting for a second below it, then lost. The box stays the
// best estimate even then; its low belief says so.
class State {
 public:
  State(long frame, double start_s) : believed_s_(start_s), believed_frame_(frame) {}

  ols::offline::BoxRow row(long frame, double time_s, const ols::tracker::TrackerOutput& output) {
    if (output.belief >= kBelieved) {
      believed_s_ = time_s;
      believed_frame_ = frame;
      is_lost_ = false;
    }
    ols::offline::BoxRow row{frame, output.box, output.belief, "tracking"};
    if (output.belief < kBelieved) row.state = coasting_or_lost(time_s);
    return row;
  }
  // The row of a frame that the tracker could not use.
  ols::offline::BoxRow row(long frame, double time_s) {
    return {frame, std::nullopt, 0.0, coasting_or_lost(time_s)};
  }

  bool ends_lost() const { return is_lost_; }
  void tell(std::ostream& out) const {
    if (lost_frames_ == 0) return;
    out << "ols-track: the target was lost in " << lost_frames_
        << (lost_frames_ == 1 ? " frame" : " frames");
    if (is_lost_) {
      out << "; it was last seen in frame " << believed_frame_ << " and not found again\n";
    } else {
      out << ", and found again\n";
    }
  }

 private:
  static constexpr double kBelieved = 0.5;
  static constexpr double kCoast_s = 1.0;

  const char* coasting_or_lost(double time_s) {
    is_lost_ = time_s - believed_s_ > kCoast_s;
    if (is_lost_) ++lost_frames_;
    return is_lost_ ? "lost" : "coasting";
  }

  double believed_s_;
  long believed_frame_, lost_frames_ = 0;
  bool is_lost_ = false;  // in the newest frame
};

// Frames that the tracker refused: they get no box, and are reported.
class Skipped {
 public:
  void add(long frame, ols::tracker::TrackerError error) {
    Kind& kind = kinds_[error];
    if (kind.frames++ == 0) kind.first = frame;
  }
  std::optional<ols::tracker::TrackerError> any() const {
    return kinds_.empty() ? std::nullopt : std::optional(kinds_.begin()->first);
  }
  void tell(std::ostream& out) const {
    for (const auto& [error, kind] : kinds_) {
      out << "ols-track: skipped " << kind.frames << (kind.frames == 1 ? " frame" : " frames")
          << ", the first is " << kind.first << ": " << to_string(error) << '\n';
    }
  }

 private:
  struct Kind {
    long frames = 0;
    long first = 0;
  };
  std::map<ols::tracker::TrackerError, Kind> kinds_;
};

// Tracks frame by frame and writes the rows of boxes.csv.
class Run {
 public:
  explicit Run(const Arguments& arguments)
      : arguments_(arguments),
        tracker_(ols::offline::load_tracker_config(arguments.config, arguments.mode),
                 arguments.seed),
        file_(arguments.output) {
    if (!arguments.timing.empty()) timing_.emplace(arguments.timing, tracker_);
    ols::offline::write_boxes_header(file_.stream());
  }

  void take(long frame, const ols::tracker::TrackerInput& input) {
    if (frame < arguments_.start_frame) return;
    if (frame == arguments_.start_frame) return begin(frame, input);
    const double began_s = ols::offline::thread_time_s();
    const ols::tracker::TrackerResult result = tracker_.track(input);
    const double taken_s = ols::offline::thread_time_s() - began_s;
    if (result.error) {
      skipped_.add(frame, *result.error);
      ols::offline::write_box(file_.stream(), state_->row(frame, input.time_s));
      return;
    }
    ++tracked_;
    ols::offline::write_box(file_.stream(), state_->row(frame, input.time_s, *result.output));
    if (timing_) timing_->write(frame, taken_s, tracker_.stage_times());
  }

  // Throws when no frame at all could be tracked. False: the target is lost at the end.
  bool commit() {
    if (tracked_ == 0 && skipped_.any()) {
      throw std::runtime_error(arguments_.input + ": no frame after the first can be used: " +
                               to_string(*skipped_.any()));
    }
    skipped_.tell(std::cerr);
    file_.commit();
    if (timing_) timing_->commit();
    state_->tell(std::cerr);
    return !state_->ends_lost();
  }

 private:
  void begin(long frame, const ols::tracker::TrackerInput& input) {
    const auto& init = arguments_.init;
    const cv::Rect2d box(init[0], init[1], init[2], init[3]);
    if (const auto error = tracker_.initialise(input, box)) {
      std::ostringstream reason;
      reason << "frame " << frame << ", " << input.gray.cols << " by " << input.gray.rows
             << " pixels: " << to_string(*error);
      throw std::runtime_error(reason.str());
    }
    state_.emplace(frame, input.time_s);
    ols::offline::write_box(file_.stream(), {frame, box, 1.0, "tracking"});
  }

  const Arguments& arguments_;
  ols::tracker::Tracker tracker_;
  ols::AtomicFile file_;
  std::optional<ols::offline::TimingFile> timing_;
  std::optional<State> state_;
  Skipped skipped_;
  long tracked_ = 0;
};

void check_files(const Arguments& arguments, const ols::offline::FrameSource& source) {
  std::vector<ols::NamedFile> inputs{{"--input", arguments.input}, {"--config", arguments.config}};
  for (const std::string& picture : source.files()) inputs.push_back({"--input", picture});
  ols::check_outputs(inputs, {{"--output", arguments.output}, {"--timing", arguments.timing}});
}

// False: the target is lost at the end.
bool run(const Arguments& arguments) {
  ols::offline::FrameSource source(arguments.input);
  check_files(arguments, source);
  Run following(arguments);
  ols::Progress progress("ols-track", "frames");
  long frame = 0;
  for (auto picture = source.next(); picture; picture = source.next(), ++frame) {
    const double time_s = static_cast<double>(frame) / source.frames_per_second();
    following.take(frame, {*picture, time_s, std::nullopt, {source.colour()}});
    progress(static_cast<std::size_t>(frame) + 1, source.announced());
  }
  if (frame <= arguments.start_frame) {
    throw std::runtime_error(arguments.input + ": has " + std::to_string(frame) +
                             " frames, --start-frame is " + std::to_string(arguments.start_frame));
  }
  return following.commit();
}

int detect(const Arguments& arguments) {
  ols::offline::run_detection({arguments.input, arguments.mount, arguments.output, arguments.timing,
                               arguments.false_an_hour});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app("Follows one target through a clip with the particle filter tracker.", "ols-track");
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  declare(app, arguments);
  // Silences the decoder, so that an error is one line; a value set by the user is kept.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::setNumThreads(1);
  return ols::run_command(app, argc, argv, "ols-track", [&] {
    if (arguments.detect) return detect(arguments);
    return run(arguments) ? 0 : kExitLost;
  });
}
