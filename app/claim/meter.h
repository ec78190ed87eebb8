// A formula over quantities of a run, read off its samples.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/claim/formula.h"
#include "app/claim/quantity.h"

namespace tumble {

/// A formula with what it reads.
class Meter {
 public:
  /// What is wrong with a formula: not one, or of a quantity that the scene does not have.
  struct Fault {
    std::string what;
    int at;  ///< bytes from the start of the text
  };
  /// @param running  whether it may read the certificate so far, by the keys of summary.json
  static std::vector<Fault> faults(const Scene& scene, const std::string& text, bool running);

  /// The scene must outlive it. @param text a formula without faults
  Meter(const Scene& scene, const std::string& text);
  /// @param soFar  what the run says of itself at the sample; without it, its quantities are NaN
  double operator()(const Sample& sample, const Certificate* soFar = nullptr);

  /// Whether an impact can make it jump: it reads a body that is struck, or all of them.
  bool jumpsAt(const Event& impact) const;

  /// The one quantity that is the whole formula, or null.
  const Gauge* alone() const;

 private:
  struct Source {
    std::optional<Gauge> gauge;
    const CertificateField* field = nullptr;
    std::optional<double> setting;  ///< a number of the scene's text
  };
  std::string text_;
  Formula formula_;
  std::vector<Source> sources_;  ///< as in formula_.names()
  std::vector<double> numbers_;
};

}  // namespace tumble
