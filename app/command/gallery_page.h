// The page to leaf through: every demo with its pictures and its claims.
#pragma once

#include <string>
#include <vector>

#include "app/claim/verdict.h"

namespace tumble {

/// A picture of the page; files are named relative to it.
struct Plate {
  std::string file, caption;
  bool wide = false;  ///< many pictures on one page: as wide as there is room
};

/// One demo on the page.
struct Exhibit {
  Scene scene;
  std::vector<Plate> plates;
  std::string film;               ///< or ""
  std::vector<Plate> links = {};  ///< the page that plays it, its scene, numbers
  Verdict verdict;
};

/// One HTML file without anything from elsewhere; the pictures lie beside it, and what is linked.
/// In the order of the lectures, with contents. A click or Enter opens a picture, the arrow keys
/// then leaf through all of them.
std::string galleryPage(const std::vector<Exhibit>& exhibits);

}  // namespace tumble
