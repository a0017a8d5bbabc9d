// Reads the positions in a CSV file of ols-fuse, as targets.
#pragma once

#include <string>
#include <vector>

#include "export/messages.h"

namespace ols::exports {

// The columns are those that tools/offline/fix_writer.h writes; columns of standard deviations may
// be missing. The file has no covariances between axes; they are taken as 0. Throws CsvError
// (FILE:LINE: COLUMN: what is wrong).
std::vector<Target> read_fixes(const std::string& path, const SiteContext& site);

}  // namespace ols::exports
