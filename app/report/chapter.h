// What stands on a page of the report: chapters of figures and tables.
#pragma once

#include <string>
#include <vector>

#include "app/report/convergence.h"
#include "app/report/price.h"
#include "app/report/profile.h"
#include "app/report/scaling.h"
#include "app/report/study.h"

namespace tumble {

/// A figure by the name of its files, and what stands above it.
struct PageFigure {
  std::string name, title, subtitle;
};

PageFigure figureOf(const Study& study);

struct Chapter {
  std::string title;
  std::string introduction;  ///< HTML
  std::vector<PageFigure> figures;
  std::string table;  ///< HTML, below the figures, or ""
};

/// The charts of scenes, a chapter for each that a scene names, in the order in which they come;
/// then what it takes to come to an accuracy, as a table and, where methods compete, as profiles.
std::vector<Chapter> chaptersOf(const std::vector<Study>& studies,
                                const std::vector<Profile>& methods);

/// What bends, by preset and step.
Chapter bendingChapter(const std::vector<Study>& studies);

/// How the solvers of the contact problem do.
Chapter solverChapter(const std::vector<Profile>& profiles);

/// How cost grows with size.
Chapter growthChapter(const std::vector<Scaling>& scalings);

/// What scenes that differ by one thing cost.
Chapter priceChapter(const std::vector<Price>& prices);

/// Halved steps of the demos.
Chapter convergenceChapter(const std::vector<SpeedOfScene>& demos);

}  // namespace tumble
