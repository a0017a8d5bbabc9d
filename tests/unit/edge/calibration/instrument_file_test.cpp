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
