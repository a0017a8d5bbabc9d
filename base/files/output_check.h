// Checks that no output of a program overwrites one of its inputs.
#pragma once

#include <string>
#include <vector>

namespace ols {

// A file named by a command line option. Empty path: the option was not given.
struct NamedFile {
  std::string option;
  std::string path;
};

// Throws std::invalid_argument, naming both options, if an output is the same file as an input or
// another output, even under another name or through a link.
void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

}  // namespace ols
