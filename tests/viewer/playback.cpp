// The viewer's clock.
#include "app/viewer/playback.h"

#include "tests/catch.h"

using tumble::Playback;

TEST_CASE("time stands still until play, then runs at its speed, and stops at the end") {
  Playback playback(120, 60.0);
  playback.advance(1.0);
  CHECK(playback.time() == 0.0);
  playback.toggle();
  playback.speed = 0.5;
  playback.advance(1.0);
  CHECK(playback.time() == 0.5);
  CHECK(playback.sample() == 30);
  playback.advance(100.0);
  CHECK(playback.time() == 2.0);
  CHECK_FALSE(playback.playing());
}

TEST_CASE("play at the end starts over") {
  Playback playback(120, 60.0);
  playback.seek(2.0);
  playback.toggle();
  CHECK(playback.playing());
  CHECK(playback.time() == 0.0);
}

TEST_CASE("steps visit every sample once, forwards and back, whatever the rate") {
  const double rate = GENERATE(60.0, 59.94, 30.0, 240.0, 7.0);
  Playback playback(200, rate);
  for (int k = 1; k <= 200; ++k) {
    playback.step(1);
    REQUIRE(playback.sample() == k);
  }
  for (int k = 199; k >= 0; --k) {
    playback.step(-1);
    REQUIRE(playback.sample() == k);
  }
}

TEST_CASE("a step pauses, and neither steps nor seeks leave the recording") {
  Playback playback(10, 10.0);
  playback.toggle();
  playback.step(-5);
  CHECK_FALSE(playback.playing());
  CHECK(playback.sample() == 0);
  playback.seek(7.0);
  CHECK(playback.sample() == 10);
}

TEST_CASE("play waits at the end of what is known, and goes on when there is more") {
  Playback playback(0, 60.0);
  playback.growing = true;
  playback.toggle();
  playback.advance(1.0);
  CHECK(playback.time() == 0.0);
  CHECK(playback.playing());
  playback.extend(30);
  playback.advance(0.25);
  CHECK(playback.time() == 0.25);
  playback.growing = false;
  playback.advance(9.0);
  CHECK(playback.time() == 0.5);
  CHECK_FALSE(playback.playing());
}

TEST_CASE("what shows sample k of a recording shows the same one when others before it are gone") {
  Playback playback(100, 60.0);
  playback.seek(80.0 / 60.0);
  playback.forget(30);
  CHECK(playback.sample() == 50);
  CHECK(playback.last() == 70);
  playback.forget(60);
  CHECK(playback.sample() == 0);
}
