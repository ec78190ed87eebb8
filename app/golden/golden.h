// Goldens: small images and numbers of scenes that the next version has to reproduce.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/golden/manifest.h"
#include "app/golden/numbers.h"
#include "render/image.h"

namespace tumble {

/// An image with the name of its file, without ending.
struct NamedImage {
  std::string name;
  Image image;
};

/// Numbers with the name of their file, without ending.
struct NamedTable {
  std::string name;
  std::string csv;  ///< 17 digits
};

/// What one subject – a scene, or the window – looks like now.
struct Golden {
  std::string subject;
  std::vector<NamedImage> images;
  std::vector<NamedTable> tables;
};

/// One comparison. An image without an expected one is missing, and fails.
struct Finding {
  std::string subject, name;
  std::optional<Image> expected = {}, actual = {};  ///< of an image
  ImageDifference image = {};
  std::optional<NumberDifference> numbers = {};  ///< of a table
  std::string expectedCsv = {}, actualCsv = {};  ///< of a table
  std::string remark = {};                       ///< what is wrong besides pixels or numbers
  bool exact() const;
  bool passes() const;
  /// One line for people: passed how, or failed why.
  std::string verdict() const;
};

/// What became of one golden that was stored.
struct Renewal {
  std::string subject, name;
  std::string word;  ///< "new", "changed", "gone", or "ok" if it stood there to the last bit
  std::string how;   ///< how it is the same, or how far off what stood there was; nothing if new
};

/// What came of comparing subjects with the goldens of one folder.
struct Holding {
  std::string folder;
  std::string approve;  ///< the command that accepts what is drawn now, but for the subjects
  std::vector<Finding> findings;
  std::vector<Renewal> renewals = {};              ///< by an update
  std::map<std::string, std::string> scenes = {};  ///< subject → its name in a shell, if another
  std::string expectedBy = {}, actualBy = {};      ///< programs that drew the images
  long passing() const;
  long exact() const;
  /// What drew the images: said once where both were drawn by the same.
  std::string environment() const;
  /// `approve` for all subjects that fail.
  std::string approval() const;
  /// `approve` for one subject.
  std::string approvalOf(const std::string& subject) const;
};

/// Holds what is drawn now against folder/<subject>/*.png and *.csv.
/// @throws FileError if a golden that is there cannot be read.
std::vector<Finding> compareGolden(const Golden& now, const Manifest& manifest,
                                   const std::string& folder);

/// Puts a subject's images and numbers into the folder, enters them in the manifest, and removes
/// images that are no longer drawn. @throws FileError
std::vector<Renewal> storeGolden(const Golden& now, Manifest& manifest, const std::string& folder);

/// What compareGolden finds once the subject has been stored: all of it, equal to the last bit.
std::vector<Finding> findingsOfStored(const Golden& now);

/// Images from the candidates that show something new: each fails against all that are kept before
/// it.
std::vector<NamedImage> distinctImages(std::vector<NamedImage> candidates);

}  // namespace tumble
