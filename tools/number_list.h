#pragma once
// Lists of numbers on the command line.

#include <string>
#include <vector>

namespace arcus::tools {

/// "0,90,180" or "BEGIN:END:STEP" (END included where a step meets it). Throws bad_input that names the option.
std::vector<double> number_list(const std::string& text, const std::string& option);

}  // namespace arcus::tools
