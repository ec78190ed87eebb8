// Goldens: what passes, what fails, and what a failure leaves behind.
#include "app/golden/golden.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/file/file.h"
#include "app/file/html.h"
#include "app/golden/formats.h"
#include "app/golden/report.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace tumble;
using tumble::test::Folder;
namespace fs = std::filesystem;

namespace {

Image plain(std::uint8_t level) {
  Image image;
  image.width = 48;
  image.height = 27;
  image.rgb.assign(3 * 48 * 27, level);
  return image;
}

Golden sample() {
  return {"drop", {{"start", plain(40)}, {"end", plain(90)}}, {{"numbers", "t,y\n0,2\n1,0.5\n"}}};
}

bool allPass(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& f) { return f.passes(); });
}

}  // namespace

TEST_CASE("what was stored is found again to the last bit") {
  const Folder scratch;
  Manifest manifest;
  storeGolden(sample(), manifest, scratch.path.string());
  writeManifest((scratch.path / "manifest.json").string(), manifest);
  const Manifest again = readManifest((scratch.path / "manifest.json").string());
  const auto findings = compareGolden(sample(), again, scratch.path.string());
  REQUIRE(findings.size() == 3);
  for (const Finding& finding : findings) CHECK(finding.exact());
}

TEST_CASE("a subject without goldens fails in every part") {
  const Folder scratch;
  const auto findings = compareGolden(sample(), Manifest{}, scratch.path.string());
  REQUIRE(findings.size() == 3);
  for (const Finding& finding : findings) CHECK_FALSE(finding.passes());
}

TEST_CASE("one level more of light, an image gone, a hand-made golden and what is none each fail") {
  const Folder scratch;
  Manifest manifest;
  const std::string folder = scratch.path.string();
  storeGolden(sample(), manifest, folder);

  Golden brighter = sample();
  brighter.images[0].image = plain(41);
  CHECK_FALSE(allPass(compareGolden(brighter, manifest, folder)));

  Golden fewer = sample();
  fewer.images.pop_back();
  CHECK_FALSE(allPass(compareGolden(fewer, manifest, folder)));

  writePng((scratch.path / "drop/start.png").string(), plain(41));
  CHECK_FALSE(allPass(compareGolden(brighter, manifest, folder)));

  scratch.file("drop/start.png", "<<<<<<< a merge that was left half done");
  const auto findings = compareGolden(sample(), manifest, folder);
  REQUIRE(findings.size() == 3);
  const auto start = std::find_if(findings.begin(), findings.end(),
                                  [](const Finding& finding) { return finding.name == "start"; });
  CHECK(start->verdict() == "what stands there is no image");
  CHECK(std::count_if(findings.begin(), findings.end(),
                      [](const Finding& finding) { return finding.passes(); }) == 2);
}

TEST_CASE("an update removes images that are no longer drawn") {
  const Folder scratch;
  Manifest manifest;
  storeGolden(sample(), manifest, scratch.path.string());
  Golden fewer = sample();
  fewer.images.pop_back();
  storeGolden(fewer, manifest, scratch.path.string());
  CHECK_FALSE(fs::exists(scratch.path / "drop/end.png"));
  CHECK(allPass(compareGolden(fewer, manifest, scratch.path.string())));
}

TEST_CASE("an update says what is new, changed, gone, and as it was") {
  const Folder scratch;
  Manifest manifest;
  const std::string folder = scratch.path.string();
  const auto words = [&](const Golden& now) {
    std::string all;
    for (const Renewal& one : storeGolden(now, manifest, folder))
      all += one.name + " " + one.word + ", ";
    return all;
  };
  Golden now = sample();
  now.tables = {{"numbers", "t,y\n0,1\n"}};
  CHECK(words(now) == "start new, end new, numbers new, ");
  CHECK(words(now) == "start ok, end ok, numbers ok, ");
  // One level of light in one pixel would pass, and is a change all the same.
  now.images[0].image.rgb[0] ^= 1;
  CHECK(words(now) == "start changed, end ok, numbers ok, ");
  now.tables[0].csv = "t,y\n0,2\n";
  now.images.pop_back();
  CHECK(words(now) == "start ok, numbers changed, end gone, ");
  writeFile(folder + "/drop/start.png", "no image");
  CHECK(words(now) == "start changed, numbers ok, ");
  CHECK(allPass(compareGolden(now, manifest, folder)));
}

TEST_CASE("what an update says is found is what is read again") {
  const Folder scratch;
  Manifest manifest;
  Golden now = sample();
  now.tables = {{"more", "t,y\n0,1\n"}};
  storeGolden(now, manifest, scratch.path.string());
  const auto said = findingsOfStored(now);
  const auto read = compareGolden(now, manifest, scratch.path.string());
  REQUIRE(said.size() == read.size());
  for (std::size_t k = 0; k < said.size(); ++k) {
    CHECK(said[k].exact());
    CHECK(said[k].passes());
    CHECK(said[k].subject == read[k].subject);
    CHECK(said[k].name == read[k].name);
    CHECK(said[k].verdict() == read[k].verdict());
    CHECK(said[k].numbers.has_value() == read[k].numbers.has_value());
  }
}

TEST_CASE("only images that show something new are kept") {
  const auto kept = distinctImages({{"a", plain(10)}, {"b", plain(10)}, {"c", plain(200)}});
  REQUIRE(kept.size() == 2);
  CHECK(kept[1].name == "c");
}

TEST_CASE("the report holds the failing images themselves and no link to anything outside") {
  const Folder scratch;
  Manifest manifest;
  storeGolden(sample(), manifest, scratch.path.string());
  Golden now = sample();
  now.images[0].image = plain(60);
  const auto findings = compareGolden(now, manifest, scratch.path.string());
  const std::string html = htmlReport({.folder = "goldens",
                                       .approve = "tumble golden --update",
                                       .findings = findings,
                                       .actualBy = "llvmpipe <22.3>"});
  CHECK(html.find(base64(encodePng(plain(40)))) != std::string::npos);
  CHECK(html.find(base64(encodePng(plain(60)))) != std::string::npos);
  CHECK(html.find("drop: start") != std::string::npos);
  CHECK(html.find("drop: end") == std::string::npos);
  CHECK(html.find("<code>tumble golden --update drop</code>") != std::string::npos);
  CHECK(html.find("llvmpipe &lt;22.3&gt;") != std::string::npos);
  CHECK(html.find("http") == std::string::npos);
}

TEST_CASE("what programs read counts what passes and quotes what people wrote") {
  Golden now = sample();
  now.subject = "a \"drop\" & <more>";
  Holding holding{"goldens", "tumble golden --update", {}};
  holding.findings = compareGolden(now, Manifest{}, "no such folder");
  holding.findings.push_back({.subject = "drop", .name = "numbers"});
  holding.findings.back().numbers = NumberDifference{};
  const std::string xml = junitXml({holding});
  CHECK(xml.find("<testsuites name=\"tumble golden\" tests=\"4\" failures=\"3\">") !=
        std::string::npos);
  CHECK(xml.find("classname=\"a &quot;drop&quot; &amp; &lt;more&gt;\"") != std::string::npos);
  CHECK(xml.find("<testcase classname=\"drop\" name=\"numbers\"/>") != std::string::npos);
  const auto json = nlohmann::json::parse(goldenJson({holding}));
  CHECK(json["goldens"] == 4);
  CHECK(json["pass"] == 1);
  CHECK(json["folders"][0]["findings"][0]["subject"] == "a \"drop\" & <more>");
  CHECK_FALSE(json["folders"][0].contains("updates"));

  holding.renewals = {{"drop", "start", "changed", "the sizes differ"},
                      {"drop", "end", "gone", ""}};
  const auto updates = nlohmann::json::parse(goldenJson({holding}))["folders"][0]["updates"];
  REQUIRE(updates.size() == 2);
  CHECK(updates[0]["subject"] == "drop");
  CHECK(updates[0]["name"] == "start");
  CHECK(updates[0]["word"] == "changed");
  CHECK(updates[0]["how"] == "the sizes differ");
  CHECK(updates[1]["word"] == "gone");
}

TEST_CASE("base64 agrees with the examples of RFC 4648, section 10") {
  const auto encode = [](const std::string& text) {
    return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  CHECK(encode("") == "");
  CHECK(encode("f") == "Zg==");
  CHECK(encode("fo") == "Zm8=");
  CHECK(encode("foo") == "Zm9v");
  CHECK(encode("foobar") == "Zm9vYmFy");
}
