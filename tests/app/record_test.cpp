// Recordings and the files they become.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "app/file/file.h"
#include "app/record/output.h"
#include "app/scene/scene.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace tumble;
using tumble::test::Folder;

namespace {

constexpr const char* kSpinning = R"(
[world]
gravity = [0.0, 0.0, 0.0]
duration = 1.0
[[body]]
name = "post"
shape = { box = [0.1, 0.1, 0.1] }
position = [5.0, 0.0, 0.0]
fixed = true
[[body]]
name = "top"
shape = { sphere = 0.1 }
mass = 1.0
velocity = [0.1, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 40.0]
)";

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) found.push_back(line);
  return found;
}

}  // namespace

TEST_CASE("samples stand at k/rate from 0 to the duration, however the rate divides it") {
  Scene scene = parseScene(kSpinning, "spinning");
  for (const auto& [rate, count] : {std::pair(60.0, 61), {7.0, 8}, {2.5, 3}, {0.1, 1}}) {
    const Recording recording = record(scene, rate);
    REQUIRE(recording.samples.size() == static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) CHECK(recording.samples[k].t == k / rate);
  }
}

// The ball turns 40 rad, more than six full turns: q passes −1 twelve times.
TEST_CASE("an attitude keeps the sign that makes it continuous") {
  const Recording recording = record(parseScene(kSpinning, "spinning"), 60.0);
  for (std::size_t k = 1; k < recording.samples.size(); ++k)
    CHECK(recording.samples[k].bodies[1].q.dot(recording.samples[k - 1].bodies[1].q) > 0.9);
}

TEST_CASE(
    "the trajectory holds a row per moving body and sample, and its numbers come back whole") {
  const Scene scene = parseScene(kSpinning, "spinning");
  const Recording recording = record(scene, 3.0);
  const std::vector<std::string> rows = lines(trajectoryCsv(recording, scene));
  REQUIRE(rows.size() == 5);
  CHECK(rows[0] == "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  CHECK(rows[1] == "0,top,0,0,0,1,0,0,0,0.10000000000000001,0,0,0,0,40");
  std::istringstream row(rows[2]);
  std::string cell;
  std::getline(row, cell, ',');
  CHECK(std::stod(cell) == recording.samples[1].t);
  std::getline(row, cell, ',');
  CHECK(cell == "top");
  std::getline(row, cell, ',');
  CHECK(std::stod(cell) == recording.samples[1].bodies[1].x.x());
}

TEST_CASE("events and contacts name their bodies and list every quantity") {
  const Scene scene = parseScene(kSpinning, "spinning");
  Recording recording;
  recording.report.events = {
      {0.5, EventKind::Slip, 1, 0, {1.0, 2.0, 3.0}, {0.0, 1.0, 0.0}, -0.25, 4.0}};
  Sample sample;
  sample.t = 0.125;
  sample.contacts = {{1, 0, {1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}, -1e-9, {4.0, 5.0, 6.0}}};
  recording.samples = {sample};
  CHECK(eventsCsv(recording, scene) ==
        "t,kind,a,b,px,py,pz,nx,ny,nz,vrel,j\n0.5,slip,top,post,1,2,3,0,1,0,-0.25,4\n");
  CHECK(contactsCsv(recording, scene) ==
        "t,a,b,px,py,pz,nx,ny,nz,separation,fx,fy,fz\n"
        "0.125,top,post,1,2,3,0,0,1,-1.0000000000000001e-09,4,5,6\n");
}

TEST_CASE("a file is written whole or not at all") {
  const std::string folder = std::filesystem::temp_directory_path() / "tumble-record-test";
  std::filesystem::remove_all(folder);
  makeFolder(folder + "/deep");
  writeFile(folder + "/deep/a.txt", "first");
  writeFile(folder + "/deep/a.txt", "second");
  CHECK(readFile(folder + "/deep/a.txt") == "second");
  CHECK_THROWS_AS(writeFile(folder + "/deep/a.txt/b", "x"), FileError);
  CHECK_THROWS_AS(makeFolder(folder + "/deep/a.txt/c"), FileError);
  CHECK_THROWS_AS(makeFolder(folder + "/deep/a.txt"), FileError);
  CHECK_THROWS_AS(writeFile(folder + "/deep", "x"), FileError);
  CHECK_THROWS_AS(readFile(folder + "/none"), FileError);
  // Nothing but the file itself is left behind.
  CHECK(std::distance(std::filesystem::directory_iterator(folder + "/deep"), {}) == 1);
  CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
  std::filesystem::remove_all(folder);
}

TEST_CASE("what is written to a link is found behind it, and a pipe gets it and stays a pipe") {
  const Folder folder;
  writeFile(folder / "a.txt", "first");
  std::filesystem::create_symlink("a.txt", folder / "link");
  writeFile(folder / "link", "second");
  CHECK(readFile(folder / "a.txt") == "second");
  CHECK(std::filesystem::is_symlink(folder / "link"));

  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const int end = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  prepareFile(folder / "pipe");
  writeFile(folder / "pipe", "third");
  char told[16] = {};
  CHECK(::read(end, told, sizeof told) == 5);
  CHECK(std::string(told) == "third");
  ::close(end);
  CHECK(std::filesystem::is_fifo(folder / "pipe"));
  CHECK(folder.files() == 3);
}

TEST_CASE("a run of more samples than fit in memory is refused before it begins") {
  const Scene scene = parseScene(kSpinning, "top.toml", {"world.duration=1e6"});
  CHECK(sampleCount(scene, 0.5) == 500'001);
  CHECK_THROWS_WITH(
      record(scene, 1e5),
      Catch::Matchers::Contains("top.toml") &&
          Catch::Matchers::Contains("100000000001 samples, and 2 bodies allow 1000000"));
}

TEST_CASE("the certificate's penetration is no less than that of any sample") {
  // On a penalty floor of 100 N/m a ball of 1 kg that comes at 2 m/s sinks in by 0.2 m.
  const Recording recording =
      record(readScene(TUMBLE_SOURCE_DIR "/assets/demos/soft-to-hard.toml"), 240.0);
  double deepest = 0.0;
  for (const Sample& sample : recording.samples)
    for (const ContactSample& contact : sample.contacts)
      deepest = std::max(deepest, -contact.separation);
  CHECK(deepest > 0.19);
  CHECK(recording.report.certificate.max_penetration >= deepest);
  CHECK(recording.report.certificate.max_penetration < 0.2 + 1e-9);
}

// Oracle: bit-equal rerun. Boxes that stand on a turntable, one on the other, and a ball that is
// thrown at them: the certificate is that of the motion, whoever looks at it and how often.
TEST_CASE("how often a run is looked at changes no bit of its certificate and its events") {
  constexpr const char* kTurning = R"(
[world]
duration = 0.5
[materials.stone]
density = 1000.0
friction = 0.4
restitution = 0.3
[[body]]
name = "table"
shape = { cylinder = [2.0, 0.2] }
position = [0.0, -0.1, 0.0]
angular_velocity = [0.0, 2.0, 0.0]
material = "stone"
fixed = true
[[body]]
name = "lower"
shape = { box = [0.4, 0.2, 0.4] }
material = "stone"
position = [0.5, 0.1, 0.0]
[[body]]
name = "ball"
shape = { sphere = 0.1 }
material = "stone"
position = [0.5, 0.6, 0.1]
velocity = [0.1, -1.0, 0.0]
)";
  for (const char* method : {"course", "stepping", "exact"}) {
    const Scene scene = parseScene(kTurning, "turning", {std::string("world.method=") + method});
    const Report often = record(scene, 500.0).report, seldom = record(scene, 7.0).report;
    CAPTURE(method);
    for (const auto& [key, number] : kCertificateFields) {
      CAPTURE(key);
      // The audit looks at the parts that a run is advanced in.
      if (std::string_view(key).starts_with("audit")) continue;
      std::visit([&](auto field) { CHECK(often.certificate.*field == seldom.certificate.*field); },
                 number);
    }
    REQUIRE(often.events.size() == seldom.events.size());
    for (std::size_t k = 0; k < often.events.size(); ++k) {
      CHECK(often.events[k].t == seldom.events[k].t);
      CHECK(often.events[k].kind == seldom.events[k].kind);
    }
  }
}
