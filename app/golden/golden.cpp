#include "app/golden/golden.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "app/file/file.h"

namespace tumble {

namespace fs = std::filesystem;

bool Finding::exact() const {
  return remark.empty() && (numbers ? numbers->exact : expected && actual && image.exact);
}

bool Finding::passes() const {
  return remark.empty() && (numbers ? numbers->passes() : expected && actual && image.passes());
}

std::string Finding::verdict() const {
  if (!remark.empty()) return remark;
  if (numbers) {
    if (numbers->exact) return "equal to the last bit";
    return fmt::format("{:.3g} times what is allowed at {}", numbers->worst, numbers->where);
  }
  if (!image.sameSize) return "the sizes differ";
  if (image.exact) return "equal to the last bit";
  return fmt::format(
      "{:.4f} % of the pixels off by more than 2 (allowed 0.02), mean {:.5f} (allowed "
      "0.004), largest {}",
      100.0 * image.share, image.mean, image.largest);
}

long Holding::passing() const {
  return std::count_if(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.passes(); });
}

long Holding::exact() const {
  return std::count_if(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.exact(); });
}

std::string Holding::environment() const {
  return expectedBy == actualBy ? "expected and actual: " + actualBy
                                : "expected: " + expectedBy + "; actual: " + actualBy;
}

namespace {

std::string inShell(const Holding& holding, const std::string& subject) {
  const auto scene = holding.scenes.find(subject);
  return " " + (scene == holding.scenes.end() ? subject : scene->second);
}

}  // namespace

std::string Holding::approval() const {
  std::string command = approve, last;
  for (const Finding& finding : findings) {
    if (finding.passes() || finding.subject == last) continue;
    last = finding.subject;
    command += inShell(*this, last);
  }
  return command;
}

std::string Holding::approvalOf(const std::string& subject) const {
  return approve + inShell(*this, subject);
}

namespace {

std::string hashIn(const Manifest& manifest, const std::string& subject, const std::string& name) {
  const auto images = manifest.images.find(subject);
  if (images == manifest.images.end()) return "";
  const auto hash = images->second.find(name);
  return hash == images->second.end() ? "" : hash->second;
}

Finding compareImage(const Golden& now, const NamedImage& drawn, const Manifest& manifest,
                     const fs::path& folder) {
  Finding finding{.subject = now.subject, .name = drawn.name, .actual = drawn.image};
  const fs::path file = folder / now.subject / (drawn.name + ".png");
  if (!fs::exists(file)) {
    finding.remark = "there is no golden of this name";
    return finding;
  }
  try {
    finding.expected = readPng(file.string());
  } catch (const std::runtime_error&) {
    finding.remark = "what stands there is no image";
    return finding;
  }
  finding.image = compare(*finding.expected, drawn.image);
  if (pixelHash(*finding.expected) != hashIn(manifest, now.subject, drawn.name))
    finding.remark = "the golden is not the one in manifest.json";
  return finding;
}

Finding compareTable(const Golden& now, const NamedTable& table, const fs::path& folder) {
  Finding finding{.subject = now.subject, .name = table.name};
  const fs::path file = folder / now.subject / (table.name + ".csv");
  finding.numbers = NumberDifference{};
  finding.actualCsv = table.csv;
  if (!fs::exists(file)) {
    finding.remark = "there are no golden numbers";
    return finding;
  }
  finding.expectedCsv = readFile(file.string());
  finding.numbers = compareNumbers(finding.expectedCsv, table.csv);
  return finding;
}

bool has(const Golden& golden, const std::string& name) {
  return std::any_of(golden.images.begin(), golden.images.end(),
                     [&](const NamedImage& image) { return image.name == name; });
}

}  // namespace

std::vector<Finding> compareGolden(const Golden& now, const Manifest& manifest,
                                   const std::string& folder) {
  std::vector<Finding> findings;
  for (const NamedImage& drawn : now.images)
    findings.push_back(compareImage(now, drawn, manifest, folder));
  for (const NamedTable& table : now.tables) findings.push_back(compareTable(now, table, folder));

  // An image of the manifest that is drawn no more is a loss, too.
  const auto known = manifest.images.find(now.subject);
  if (known == manifest.images.end()) return findings;
  for (const auto& [name, hash] : known->second)
    if (!has(now, name))
      findings.push_back({.subject = now.subject, .name = name, .remark = "no longer drawn"});
  return findings;
}

namespace {

// What a finding about what stands there says of what takes its place.
Renewal renewal(const Finding& before, bool stood) {
  if (!stood) return {before.subject, before.name, "new", ""};
  return {before.subject, before.name, before.exact() ? "ok" : "changed", before.verdict()};
}

Renewal store(const Golden& now, const NamedImage& drawn, Manifest& manifest,
              const fs::path& folder) {
  const std::string file = (folder / now.subject / (drawn.name + ".png")).string();
  const bool stood = fs::exists(file);
  const Finding before = compareImage(now, drawn, manifest, folder);
  writePng(file, drawn.image);
  manifest.images[now.subject][drawn.name] = pixelHash(drawn.image);
  return renewal(before, stood);
}

Renewal store(const Golden& now, const NamedTable& table, const fs::path& folder) {
  const std::string file = (folder / now.subject / (table.name + ".csv")).string();
  const bool stood = fs::exists(file);
  const Finding before = compareTable(now, table, folder);
  writeFile(file, table.csv);
  return renewal(before, stood);
}

}  // namespace

std::vector<Renewal> storeGolden(const Golden& now, Manifest& manifest, const std::string& folder) {
  const fs::path place = fs::path(folder) / now.subject;
  makeFolder(place.string());
  std::vector<Renewal> renewals;
  for (const NamedImage& drawn : now.images)
    renewals.push_back(store(now, drawn, manifest, folder));
  for (const NamedTable& table : now.tables) renewals.push_back(store(now, table, folder));
  std::erase_if(manifest.images[now.subject], [&](const auto& entry) {
    if (has(now, entry.first)) return false;
    fs::remove(place / (entry.first + ".png"));
    renewals.push_back({now.subject, entry.first, "gone", "no longer drawn"});
    return true;
  });
  return renewals;
}

std::vector<Finding> findingsOfStored(const Golden& now) {
  std::vector<Finding> findings;
  for (const NamedImage& drawn : now.images)
    findings.push_back({.subject = now.subject,
                        .name = drawn.name,
                        .expected = drawn.image,
                        .actual = drawn.image,
                        .image = {.exact = true}});
  for (const NamedTable& table : now.tables)
    findings.push_back({.subject = now.subject,
                        .name = table.name,
                        .numbers = NumberDifference{},
                        .expectedCsv = table.csv,
                        .actualCsv = table.csv});
  return findings;
}

std::vector<NamedImage> distinctImages(std::vector<NamedImage> candidates) {
  std::vector<NamedImage> kept;
  for (NamedImage& candidate : candidates) {
    const bool isNew = std::none_of(kept.begin(), kept.end(), [&](const NamedImage& earlier) {
      return compare(earlier.image, candidate.image).passes();
    });
    if (isNew) kept.push_back(std::move(candidate));
  }
  return kept;
}

}  // namespace tumble
