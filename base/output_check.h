// Checks that no output of a program overwrites one of its inputs.
#pragma once

#include <string>
#include <vector>

namespace ols {

// A file that an option of the command line names; an empty path: the option was not given.
struct NamedFile {
  std::string option;
  std::string path;
};

// std::invalid_argument, naming both options, where an output is one of the inputs or another
// output: the same file, by whatever name or link.
void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace ols
