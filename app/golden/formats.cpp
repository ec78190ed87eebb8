#include "app/golden/formats.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/file/html.h"

namespace tumble {

std::string junitXml(const std::vector<Holding>& holdings) {
  std::string suites;
  long tests = 0, failures = 0;
  for (const Holding& holding : holdings) {
    const long count = static_cast<long>(holding.findings.size());
    const long failed = count - holding.passing();
    tests += count;
    failures += failed;
    suites += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
                          htmlText(holding.folder), count, failed);
    for (const Finding& finding : holding.findings) {
      suites += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", htmlText(finding.subject),
                            htmlText(finding.name));
      if (finding.passes())
        suites += "/>\n";
      else
        suites +=
            fmt::format("><failure message=\"{}\">{}</failure></testcase>\n",
                        htmlText(finding.verdict()), htmlText(holding.approvalOf(finding.subject)));
    }
    suites += "  </testsuite>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"tumble golden\" tests=\"{}\" failures=\"{}\">\n{}</testsuites>\n",
      tests, failures, suites);
}

namespace {

nlohmann::ordered_json jsonOf(const Finding& finding) {
  nlohmann::ordered_json json = {{"subject", finding.subject},
                                 {"name", finding.name},
                                 {"kind", finding.numbers ? "numbers" : "image"},
                                 {"passes", finding.passes()},
                                 {"exact", finding.exact()},
                                 {"verdict", finding.verdict()}};
  if (finding.numbers && !finding.expectedCsv.empty()) {
    const double worst = finding.numbers->worst;
    json["worst"] = std::isfinite(worst) ? nlohmann::ordered_json(worst) : nullptr;
    json["where"] = finding.numbers->where;
  }
  if (finding.expected && finding.actual && finding.image.sameSize) {
    json["share"] = finding.image.share;
    json["mean"] = finding.image.mean;
    json["largest"] = finding.image.largest;
  }
  return json;
}

nlohmann::ordered_json jsonOf(const Renewal& renewal) {
  return {{"subject", renewal.subject},
          {"name", renewal.name},
          {"word", renewal.word},
          {"how", renewal.how}};
}

}  // namespace

std::string goldenJson(const std::vector<Holding>& holdings) {
  nlohmann::ordered_json folders = nlohmann::ordered_json::array();
  long total = 0, passing = 0, exact = 0;
  for (const Holding& holding : holdings) {
    total += static_cast<long>(holding.findings.size());
    passing += holding.passing();
    exact += holding.exact();
    nlohmann::ordered_json findings = nlohmann::ordered_json::array();
    for (const Finding& finding : holding.findings) findings.push_back(jsonOf(finding));
    folders.push_back({{"folder", holding.folder},
                       {"environment", holding.environment()},
                       {"findings", std::move(findings)}});
    for (const Renewal& renewal : holding.renewals)
      folders.back()["updates"].push_back(jsonOf(renewal));
  }
  const nlohmann::ordered_json json = {
      {"goldens", total}, {"pass", passing}, {"exact", exact}, {"folders", std::move(folders)}};
  using Json = nlohmann::ordered_json;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tumble
