// The page of a report: one file, figures within, that prints.
#pragma once

#include "app/report/chapter.h"

namespace tumble {

/// The start of a page with that title, up to and with its heading.
std::string pageHead(const std::string& title);

/// A figure of a page, with links to its numbers and its script.
/// @param folder  whose <name>.svg, drawn already, is put into the page; "" leaves it out
/// @throws FileError if it is not there
std::string figureSection(const PageFigure& figure, const std::string& folder);

/// A page in one file: title, machine and build, contents, chapters.
/// @param folder  as above
std::string reportPage(const std::string& title, const std::string& machine,
                       const std::vector<Chapter>& chapters, const std::string& folder);

}  // namespace tumble
