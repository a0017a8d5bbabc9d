#include "edge/skyline/skyline_part.h"

namespace ols::skyline {

SkylinePart SkylineParts::next(const HidingSkyline& skyline, bool heading_disagrees) {
  using land::SeenSkyline;
  SkylinePart part{skyline.begun_us, skyline.camera_ecef, heading_disagrees, 0, {}};
  for (int i = 0; i < SeenSkyline::kSectors && part.columns.empty(); ++i) {
    sector_ = (sector_ + 1) % SeenSkyline::kSectors;
    part.columns = skyline.crests.sector(sector_);
  }
  part.sector = sector_;
  return part;
}

}  // namespace ols::skyline
