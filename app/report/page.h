// The report as one page: its figures and the headline table.
#pragma once

#include "app/report/headline.h"
#include "app/report/profile.h"
#include "app/report/scaling.h"

namespace tumble {

/// index.html beside the figures.
/// @param figures  whether gnuplot has drawn them; without them the page links the numbers alone
std::string reportPage(const std::vector<Study>& studies, const std::string& machine, bool figures,
                       const std::vector<Scaling>& scalings = {},
                       const std::vector<Profile>& profiles = {});

}  // namespace tumble
