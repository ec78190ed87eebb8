// The report as one page: its figures and the headline table.
#pragma once

#include "app/report/convergence.h"
#include "app/report/headline.h"
#include "app/report/profile.h"
#include "app/report/scaling.h"

namespace tumble {

/// A scene of the page on convergence; its figure's study has no points if none can be drawn.
struct SpeedOfScene {
  Convergence convergence;
  Study speed;
};

/// The start of a page with that title, up to and with its heading.
std::string pageHead(const std::string& title);

/// A figure of a page, with links to its numbers and its script.
/// @param figures  whether gnuplot has drawn it
std::string figureSection(const Study& study, bool figures);

/// index.html beside the figures.
/// @param figures  whether gnuplot has drawn them; without them the page links the numbers alone
std::string reportPage(const std::vector<Study>& studies, const std::string& machine, bool figures,
                       const std::vector<Scaling>& scalings = {},
                       const std::vector<Profile>& profiles = {});

/// convergence.html: what halved steps say of each scene.
std::string convergencePage(const std::vector<SpeedOfScene>& demos, const std::string& machine,
                            bool figures);

}  // namespace tumble
