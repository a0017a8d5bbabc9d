// The references of a procedure at work: a copy in its folder, taken again while a program still
// appends to the file, as one does that writes where a drone flies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/observation.h"
#include "calibration/procedure/sighting_planner.h"

namespace ols::calibration {

class ReferenceFeed {
 public:
  // `copy`: written here, whole lines only. CsvError naming file, line and column.
  ReferenceFeed(std::filesystem::path source, std::filesystem::path copy);

  // Takes the source's lines again if it has grown. A source that is gone or cannot be read leaves
  // what there was; trouble() says why.
  void refresh();
  const std::string& trouble() const { return trouble_; }

  const std::filesystem::path& path() const { return copy_; }
  const References& references() const { return references_; }
  std::vector<Place> landmarks() const;
  // Empty where nothing of this name is known yet.
  Trajectory trajectory(const std::string& name) const;

 private:
  void take();

  std::filesystem::path source_, copy_;
  References references_;
  std::string trouble_;
  std::uintmax_t size_ = 0;
};

}  // namespace ols::calibration
