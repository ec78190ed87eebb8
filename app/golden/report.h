// One HTML file that shows what differs, with nothing beside it.
#pragma once

#include <string>
#include <vector>

#include "app/golden/golden.h"

namespace tumble {

/// A page with a list of what fails; of each image expected, actual and difference, under a slider
/// that wipes from one to the other; of numbers the curve of the worst column; and the command that
/// accepts it. Images are embedded: the file can be mailed.
std::string htmlReport(const Holding& holding);

}  // namespace tumble
