// A tripod that is calibrated in simulated time: the station's whole process, `ols-calibrate`, and
// a person at a console who sees the procedure's pictures and answers over the bus.
#pragma once

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/bus/channel_names.h"
#include "base/process/clocks.h"
#include "edge/calibration/calibration_folder.h"
#include "ols_msg/procedure_answer_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "sim/processes/simulated_station.h"
#include "sim/scenario/station_files.h"
#include "tests/unit/temporary_folder.h"
#include "tools/calibrate/procedure_commands.h"
#include "tools/calibrate/station_link.h"
#include "wire/station_status.h"

namespace ols::calibration::test {

inline constexpr std::int64_t kEvening_us = 1'700'000'000'000'000;

class SimulatedTripod {
 public:
  using State = ols_msg::procedure_t;
  // The person's answer to a question; nullopt: no answer yet.
  using Reply = std::function<std::optional<Answer>(const State&)>;

  static sim::Scenario scenario() {
    sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/calibration.toml");
    s.frame_rate_hz = 5.0;
    s.inclinometer.on = s.gnss.on = false;
    return s;
  }

  explicit SimulatedTripod(const sim::Scenario& scenario, std::uint64_t seed = 5,
                           std::int64_t start_utime_us = kEvening_us)
      : time(start_utime_us), world(scenario, seed), bus_("memq://tripod") {
    sim::write_station_files(world, {"memq://tripod", folder.path(), folder / "state"},
                             folder / "configs");
    if (scenario.stations[0].zoom.is_fixed())
      set("[calibration]", "[calibration]\nfolder = \"" + (store() / "current").string() + "\"");
    station::StationSettings settings = station::load_station_settings(config());
    settings.video.address.clear();
    settings.host.silence_s = 1e9;  // the monitor measures the real host, in real time
    spdlog::set_level(spdlog::level::off);
    station.emplace(world, 0, settings, time);
    bus_.subscribe(station_channel(kProcedureChannel, "alfa"),
                   [this](const BusMessage& message) { decode_of_schema(message, state); });
    bus_.subscribe(station_channel(kStatusChannel, "alfa"), [this](const BusMessage& message) {
      if (auto heard = wire::decode_status(message)) status = std::move(*heard);
    });
    time.at_each_step([this](double) { look(); });
    EXPECT_TRUE(time.pass(60.0, [this] {
      return status.image_width_px > 0 && std::isfinite(status.pan_limits_rad[0]);
    }));
  }

  std::string config() const { return folder / "configs/alfa.toml"; }
  std::filesystem::path store() const { return folder / "calibrations"; }

  // Runs a procedure; returns its exit status, or 2 if it throws. `said` then has its output and
  // the text of the exception.
  int run(ProcedureOptions options, Reply reply) {
    options.station = config();
    options.state_folder = store();
    reply_ = std::move(reply);
    state = {};
    answered_ = 0;
    deadline_s_ = time.now_s() + 300.0;
    testing::internal::CaptureStdout();
    int result = 2;
    try {
      result = run_procedure(options);
    } catch (const std::exception& error) {
      said = error.what();
    }
    said = testing::internal::GetCapturedStdout() + (result == 2 ? said : "");
    reply_ = nullptr;
    return result;
  }

  // Runs a procedure and aborts it at this step.
  int run_until_step(const std::string& step, ProcedureOptions options) {
    aborts_at_ = step;
    const int result = run(std::move(options), [](const State&) { return std::nullopt; });
    aborts_at_.clear();
    return result;
  }

  // Writes a file with the positions of the first `signs` signs, as from a surveyor; returns the
  // path.
  std::string references(std::size_t signs) const {
    const std::string path = folder / "references.csv";
    std::ofstream file(path);
    file.precision(12);
    file << "landmark,latitude_deg,longitude_deg,height_m,sd_m\n";
    for (std::size_t i = 0; i < signs; ++i) {
      const sim::Mark& mark = world.scenario().marks[i];
      const Geodetic at = geodetic_from_ecef(world.site().to_ecef(mark.p_enu));
      file << mark.id << "," << degrees(at.latitude_rad) << "," << degrees(at.longitude_rad) << ","
           << at.height_m << ",0.02\n";
    }
    return path;
  }

  // Points at the whitest spot, then confirms the crosshair; accepts the result.
  static std::optional<Answer> point_and_accept(const State& asked) {
    if (is_choice(asked, "accept")) return Answer{.choice = "accept"};
    const cv::Mat picture = cv::imdecode(asked.jpeg, cv::IMREAD_GRAYSCALE);
    std::vector<cv::Point> white;
    cv::findNonZero(picture > 237, white);
    EXPECT_GE(white.size(), 3U) << asked.text;
    if (white.size() < 3) return Answer{.choice = "abort"};
    const auto median = [&white](int cv::Point::*of) {
      std::ranges::nth_element(white, white.begin() + white.size() / 2, {}, of);
      return white[white.size() / 2].*of;
    };
    const Eigen::Vector2d sign =
        Eigen::Vector2d(median(&cv::Point::x), median(&cv::Point::y)) / asked.scale;
    return at_crosshair(asked, sign, "point");
  }
  static std::optional<Answer> at_crosshair(const State& asked, const Eigen::Vector2d& there,
                                            const char* otherwise) {
    const Eigen::Vector2d crosshair(asked.crosshair_px[0], asked.crosshair_px[1]);
    if (asked.has_crosshair && (crosshair - there).norm() < 3.0) return Answer{.choice = "confirm"};
    return Answer{.choice = otherwise, .pixel = there};
  }
  static bool is_choice(const State& asked, const char* choice) {
    return std::ranges::count(asked.choice, choice) > 0;
  }

  // The truth about the picture of this stamp.
  const sim::SimulatedStation::Sent& truth_of(std::int64_t utime_us) const {
    return *std::ranges::min_element(station->sent(), {}, [utime_us](const auto& one) {
      return std::abs(one.utime_us - utime_us);
    });
  }
  // The true direction of the picture's middle (east, north, up), from the simulator.
  Eigen::Vector3d looked_enu(const sim::ExposureTruth& exposure) const {
    const sim::StationTruth& truth = world.stations()[0];
    const auto camera = sim::camera_on(truth.truth.chain, truth.unit.trunnion_rad, exposure.mid);
    return camera.linear() * *unproject(truth.truth.camera, middle());
  }
  // The error [arcsec] of the direction that the calibration in use gives for the picture's middle,
  // at these angles.
  double off_arcsec(const PanTilt& at) {
    LcmBus bus("memq://tripod");
    StationLink link(bus, "alfa");
    EXPECT_TRUE(link.status(5.0));
    link.set_out(at);
    std::optional<FrameFile> frame;
    for (int tries = 0; tries < 10 && !frame; ++tries) {
      link.point();
      link.ask_frame(Arrival::kStands, true);
      const double end_s = time.now_s() + 3.0;
      while (!frame && time.now_s() < end_s) {
        link.handle(10);
        frame = link.take_frame();
      }
    }
    EXPECT_TRUE(frame);
    link.release();
    const auto calibration =
        station::read_calibration(store() / "current", station::load_station_settings(config()))
            .calibration;
    const auto found = sight(calibration, {middle(), {}, {}, frame->taken.reading, {}});
    const double azimuth = found->direction.azimuth_rad, up = found->direction.elevation_rad;
    const Eigen::Vector3d believed(std::sin(azimuth) * std::cos(up),
                                   std::cos(azimuth) * std::cos(up), std::sin(up));
    const Eigen::Vector3d true_enu = looked_enu(truth_of(frame->taken.utime_us).exposure);
    return degrees(believed.cross(true_enu).norm()) * 3600.0;
  }

  TemporaryFolder folder;
  sim::SimulatedTime time;
  const sim::World world;
  std::optional<sim::SimulatedStation> station;
  ols_msg::station_status_t status{};
  State state{};
  std::string said;

 private:
  // Replaces a text in the configuration.
  void set(const std::string& old, const std::string& now) const {
    std::ifstream file(config());
    std::string text(std::istreambuf_iterator<char>(file), {});
    text.replace(text.find(old), old.size(), now);
    std::ofstream(config()) << text;
  }
  Eigen::Vector2d middle() const {
    const CameraIntrinsics& camera = world.stations()[0].truth.camera;
    return {0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)};
  }
  void look() {
    bus_.handle(0);
    const bool at_it = !aborts_at_.empty() && state.step.find(aborts_at_) != std::string::npos;
    if (at_it || time.now_s() > deadline_s_) {
      return answer(Answer{.choice = "abort"});
    }
    if (!reply_ || state.state != State::STATE_ASKING || state.question == answered_) return;
    if (const auto given = reply_(state)) answer(*given);
  }
  void answer(const Answer& given) {
    answered_ = state.question;
    ols_msg::procedure_answer_t message{};
    message.utime = clock_utime_us();
    message.schema_version = ols_msg::procedure_answer_t::SCHEMA_VERSION;
    message.boot_id = 7;
    message.sequence = ++sequence_;
    message.station = "alfa";
    message.lease_s = 5.0;
    message.question = state.question;
    message.choice = given.choice;
    message.has_pixel = given.pixel ? 1 : 0;
    if (given.pixel) Eigen::Map<Eigen::Vector2d>(message.pixel_px) = *given.pixel;
    message.turn_deg[0] = degrees(given.turn.pan_rad);
    message.turn_deg[1] = degrees(given.turn.tilt_rad);
    bus_.publish(station_channel(kProcedureAnswerChannel, "alfa"), message);
  }

  LcmBus bus_;
  Reply reply_;
  std::string aborts_at_;
  double deadline_s_ = 60.0;  // of the station's start, then of each procedure
  std::int64_t answered_ = 0, sequence_ = 0;
};

}  // namespace ols::calibration::test
