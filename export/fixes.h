// Reads positions that ols-fuse has written, as targets.
#pragma once

#include <string>
#include <vector>

#include "export/messages.h"

namespace ols::exports {

// Columns as in tools/offline/fix_writer.h; standard deviations may be missing. Covariances between
// axes are not in the file and are taken as 0. Throws CsvError (FILE:LINE: COLUMN: what).
std::vector<Target> read_fixes(const std::string& path, const SiteContext& site);

}  // namespace ols::exports
