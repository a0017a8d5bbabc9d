#include "edge/calibration/instrument_file.h"

#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/edge/calibration/calibration_files.h"

namespace ols::calibration {
namespace {

TEST(InstrumentFile, ReadsWhatItWrites) {
  const station::test::CalibrationFolder files("instrument_file");
  const Instrument fallback = new_instrument(station::test::settings());
  const Instrument read = read_instrument(files.path + "/instrument.toml", fallback);
  EXPECT_NEAR(read.values[kFocal], 13300.0, 1e-6);
  EXPECT_NEAR(read.values[kTrunnion], 1e-4, 1e-12);
  EXPECT_EQ(read.serials.camera, "C7");
  EXPECT_EQ(read.pan.counts_per_turn, 112000);
  const StationModel model = with_instrument(station::test::settings().station.geometry, read);
  EXPECT_NEAR(model.geometry.chain.trunnion_rad, 1e-4, 1e-12);
}

// Files from before k3 was adjusted have it in [lens].
TEST(InstrumentFile, AnOlderFileHasItsK3) {
  const station::test::CalibrationFolder files("instrument_file_older");
  std::string text = files.instrument;
  for (const char* line :
       {"model = \"pinhole\"\n", "k3 = 0\n", "k4 = 0\n", "k3 = 0\n", "k4 = 0\n"}) {
    text.erase(text.find(line), std::string(line).size());
  }
  text.insert(text.find("p1 = "), "k3 = 0.25\n");
  files.put("instrument.toml", text);
  const Instrument read =
      read_instrument(files.path + "/instrument.toml", new_instrument(station::test::settings()));
  EXPECT_EQ(read.values[kK3], 0.25);
}

TEST(InstrumentFile, OfAFixedWideCamera) {
  station::StationSettings settings = station::test::settings();
  settings.station.geometry.camera.model = LensModel::kPolynomial;
  settings.station.geometry.camera.k4 = 0.125;
  settings.station.moves = false;
  settings.station.limits.count = {radians(1e-4), radians(1e-4)};
  const Instrument fresh = new_instrument(settings);
  EXPECT_EQ(fresh.pan.counts_per_turn, 3600000);
  EXPECT_EQ(fresh.covariance(kPanWormCos, kPanWormCos), 0.0);
  EXPECT_GT(fresh.covariance(kK4, kK4), 0.0);
  const station::test::CalibrationFolder files("instrument_file_wide");
  const std::string path = files.path + "/instrument.toml";
  files.put("instrument.toml", instrument_text(fresh));
  const Instrument read = read_instrument(path, new_instrument(settings));
  const CameraIntrinsics camera = with_instrument({}, read).geometry.camera;
  EXPECT_EQ(camera.model, LensModel::kPolynomial);
  EXPECT_EQ(camera.k4, 0.125);
  settings.station.geometry.camera.model = LensModel::kFisheye;
  EXPECT_THROW(read_instrument(path, new_instrument(settings)), ConfigError);
}

TEST(InstrumentFile, AnUnknownKeyIsNamed) {
  const station::test::CalibrationFolder files("instrument_file_bad");
  files.put("instrument.toml", files.instrument + "\nbent_deg = 1\n");
  EXPECT_THROW(
      read_instrument(files.path + "/instrument.toml", new_instrument(station::test::settings())),
      ConfigError);
}

TEST(InstrumentFile, ASerialNumberOfOneSideAloneIsNotCompared) {
  const station::InstrumentSerials stated{.camera = "C7", .lens = "", .ptu = "P9"};
  EXPECT_EQ(uncompared_serials(stated, stated), "");
  EXPECT_EQ(uncompared_serials({.camera = "C7", .lens = "L1", .ptu = ""}, stated),
            "serials.lens, serials.ptu");
  EXPECT_NO_THROW(check_serials({}, stated, "instrument.toml"));
}

}  // namespace
}  // namespace ols::calibration
