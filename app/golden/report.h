// One HTML file that shows what differs, with nothing beside it.
#pragma once

#include <string>
#include <vector>

#include "app/golden/golden.h"

namespace tumble {

/// A page with expected, actual and difference of every image that fails, under a slider that wipes
/// from one to the other, and the numbers that fail. Images are embedded: the file can be mailed.
std::string htmlReport(const std::vector<Finding>& findings, const std::string& environment);

/// RFC 4648, with padding.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace tumble
