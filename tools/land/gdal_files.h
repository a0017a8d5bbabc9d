// GDAL's files, which are closed at the end of their scope, and GDAL's messages, for the texts of
// exceptions.
#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>

#include <memory>
#include <string>

namespace ols::land {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

// While this object lives, GDAL writes nothing to the terminal.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

inline std::string gdal_error() {
  const std::string text = CPLGetLastErrorMsg();
  return text.empty() ? "no reason is given" : text;
}

}  // namespace ols::land
