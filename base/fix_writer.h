// Writes fixes.csv (csv_files.h), row by row: a million of them need not be in memory.
#pragma once

#include <string>

#include "base/atomic_file.h"
#include "base/csv_files.h"

namespace ols {

class FixWriter {
 public:
  // Until commit(), and on an error (std::system_error), the old file is left unchanged.
  explicit FixWriter(const std::string& path);
  void add(const FixRow& fix);
  void commit();

 private:
  AtomicFile file_;
};

}  // namespace ols
