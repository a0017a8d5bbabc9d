// The references of a running procedure. A program, such as a drone's ground station, may append to
// the file of the references during the procedure. The procedure uses a copy of the file in its own
// folder, and updates the copy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/observation.h"
#include "calibration/procedure/sighting_planner.h"

namespace ols::calibration {

class ReferenceFeed {
 public:
  // `copy`: the path of the copy, which gets only complete lines. Throws CsvError naming file, line
  // and column.
  ReferenceFeed(std::filesystem::path source, std::filesystem::path copy);

  // Copies the source again if it has grown. If it is missing or unreadable, the old copy stays,
  // and trouble() says why.
  void refresh();
  const std::string& trouble() const { return trouble_; }

  const std::filesystem::path& path() const { return copy_; }
  const References& references() const { return references_; }
  std::vector<Place> landmarks() const;
  // Empty while there is no trajectory of this name.
  Trajectory trajectory(const std::string& name) const;

 private:
  void take();

  std::filesystem::path source_, copy_;
  References references_;
  std::string trouble_;
  std::uintmax_t size_ = 0;
};

}  // namespace ols::calibration
