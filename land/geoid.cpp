#include "land/geoid.h"

#include <proj.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::land {

struct Geoid::Grid {
  ~Grid() {
    proj_destroy(shift);
    proj_context_destroy(context);
  }
  PJ_CONTEXT* context = proj_context_create();
  PJ* shift = nullptr;
};

Geoid::Geoid(const std::string& grid) : grid_(std::make_unique<Grid>()) {
  if (grid.empty() || grid.find_first_of(" ,+=\"") != std::string::npos) {
    throw std::invalid_argument("\"" + grid + "\" is not the name of a grid file");
  }
  proj_log_level(grid_->context, PJ_LOG_NONE);
  proj_context_set_enable_network(grid_->context, 0);
  grid_->shift = proj_create(grid_->context, ("+proj=vgridshift +grids=" + grid).c_str());
  if (grid_->shift == nullptr) {
    throw std::invalid_argument(
        "\"" + grid +
        "\" does not exist or is not a grid; egm96_15.gtx comes with Debian's proj-data");
  }
}

Geoid::~Geoid() = default;

double Geoid::height_m(double latitude_deg, double longitude_deg) const {
  const PJ_COORD on_ellipsoid = proj_coord(radians(longitude_deg), radians(latitude_deg), 0.0, 0.0);
  const double above_sea_m = proj_trans(grid_->shift, PJ_FWD, on_ellipsoid).lpz.z;
  proj_errno_reset(grid_->shift);
  return std::isfinite(above_sea_m) ? -above_sea_m : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ols::land
