// Letters that no font of the pictures has.
#include "app/command/letters.h"

#include "app/file/data.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

std::vector<std::string> lackingIn(const std::string& title, const std::string& curve,
                                   const std::vector<std::string>& overrides = {}) {
  const std::string text = "title = \"" + title + R"("
claim = "漢"
[world]
duration = 1.0
[[body]]
name = "ball"
mass = 1.0
shape = { sphere = 0.1 }
[[graph]]
title = "height"
body = "ball"
curves = [{ label = ")" + curve +
                           "\" }]\n";
  return lackingLetters(parseScene(text, "scene.toml", overrides), Fonts(dataFolder("fonts")));
}

}  // namespace

// Lato has the first line, DejaVu Sans ∝ and ∥; neither has Chinese.
TEST_CASE("letters that no font has are told once for each text, with its place") {
  using Lines = std::vector<std::string>;
  CHECK(lackingIn("Äpfel: 9.81 m/s², −½ ≤ x", "α ∝ β ∥ γ, Кириллица").empty());
  CHECK(lackingIn("字 and 漢字", "one") ==
        Lines{"scene.toml:1:9: title: the fonts lack 字 (U+5B57), 漢 (U+6F22); a box stands for "
              "each"});
  // What is no part of a picture, as the claim, is not told.
  CHECK(lackingIn("one", "高") ==
        Lines{"scene.toml:12:21: graph.0.curves.0.label: the fonts lack 高 (U+9AD8); a box stands "
              "for each"});
  CHECK(lackingIn("one", "one", {"title=🎈"}) ==
        Lines{"--set title=🎈: title: the fonts lack 🎈 (U+1F388); a box stands for each"});
  CHECK(lackingIn("一二三四五六七八九十", "one").at(0).find("八 (U+516B), …;") !=
        std::string::npos);
}
