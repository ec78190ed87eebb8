// Runs held to the bits of others.
#include "tests/catch.h"
#include "tests/program/program.h"

TEST_CASE("a run is verified by the hashes of another, and a bit flipped there is told with time") {
  const Folder scratch;
  REQUIRE(tumbleRun(scratch, "simulate overhang -q -o out --rate 20 --hash bits.txt").code == 0);
  const Outcome same = tumbleRun(scratch, "verify overhang bits.txt");
  CHECK(same.code == 0);
  CHECK(same.out.find("the same bits") != std::string::npos);

  // The last digit of the state at 0.15 s.
  std::string text = textOf(scratch.path / "bits.txt");
  char& digit = text[text.find("\n0.15 ") + 6 + 15];
  digit = digit == '0' ? '1' : '0';
  scratch.file("flipped.txt", text);
  const Outcome flipped = tumbleRun(scratch, "verify overhang flipped.txt");
  CHECK(flipped.code == 1);
  CHECK(flipped.says("flipped.txt: t = 0.15 s: "));
  CHECK(flipped.lines() == 1);

  // Up to the sample before it the run is the same; what comes later is not looked at.
  const Outcome begun = tumbleRun(scratch, "verify overhang flipped.txt --until 0.12");
  CHECK(begun.code == 0);
  CHECK(begun.out.find("3 samples to 0.12 s") != std::string::npos);
  CHECK(tumbleRun(scratch, "verify overhang flipped.txt --until 0.15").code == 1);

  // Another physics of the same bodies.
  CHECK(tumbleRun(scratch, "verify overhang bits.txt --set world.gravity=[0,-9.8,0]").code == 1);
}

TEST_CASE("verify refuses what holds no hashes of this scene in one line with its place") {
  const Folder scratch;
  scratch.file("garbage.txt", "tumble hashes 1\nrate 10 bodies x\n");
  REQUIRE(tumbleRun(scratch, "simulate cradle -q -o out --rate 10 --hash other.txt").code == 0);
  const auto refused = [&](const std::string& file, const std::string& words) {
    const Outcome outcome = tumbleRun(scratch, "verify overhang " + file);
    CAPTURE(file, outcome.err);
    CHECK(outcome.code == 5);
    CHECK(outcome.lines() == 1);
    CHECK(outcome.says(words));
  };
  refused("missing.txt", "missing.txt");
  refused("garbage.txt", "garbage.txt:2:16: expected a number of bodies, found 'x'");
  refused("other.txt", "other.txt:2:");
  CHECK(tumbleRun(scratch, "verify overhang").code == 2);
  CHECK(tumbleRun(scratch, "simulate overhang -q -o out --hash garbage.txt/hash.txt").code == 5);
}
