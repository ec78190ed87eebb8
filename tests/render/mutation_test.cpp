// The comparison of images must see what an eye might miss.
#include <cmath>

#include "tests/render/plates.h"
#include "tests/render/studio.h"

using namespace tumble;

namespace {

Image expected() {
  return studio().draw(plates::pile(), golden());
}

void checkCaught(const Picture& picture, const RenderOptions& options) {
  const ImageDifference difference = compare(expected(), studio().draw(picture, options));
  INFO("share " << difference.share << ", mean " << difference.mean << ", largest "
                << difference.largest);
  CHECK_FALSE(difference.passes());
}

/// A body that stands in front of the others: the one nearest to the camera.
std::size_t foremost(const Picture& picture) {
  std::size_t best = 0;
  const auto distance = [&](std::size_t i) {
    return (picture.instances[i].position - picture.camera.eye).norm();
  };
  for (std::size_t i = 1; i < picture.instances.size(); ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

}  // namespace

TEST_CASE("the same picture twice gives the same pixels") {
  const ImageDifference difference = compare(expected(), expected());
  CHECK(difference.exact);
  CHECK(difference.passes());
}

// Measured: share 0, mean 0.2; the mean may be 0.004.
TEST_CASE("a light 1 % brighter is caught") {
  RenderOptions options = golden();
  options.lightScale = 1.01;
  checkCaught(plates::pile(), options);
}

TEST_CASE("a missing body is caught, and so is one moved by 5 cm") {
  Picture missing = plates::pile(), moved = missing;
  missing.instances.erase(missing.instances.begin() +
                          static_cast<std::ptrdiff_t>(foremost(missing)));
  checkCaught(missing, golden());
  moved.instances[foremost(moved)].position.x() += 0.05;
  checkCaught(moved, golden());
}

TEST_CASE("a camera turned by 0.1 mrad is caught") {
  Picture picture = plates::pile();
  const Eigen::Vector3d sight = picture.camera.target - picture.camera.eye;
  picture.camera.target =
      picture.camera.eye + Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitY()) * sight;
  checkCaught(picture, golden());
}

TEST_CASE("a shadow map of half the size is caught") {
  RenderOptions options = golden();
  options.shadowMapSize /= 2;
  checkCaught(plates::pile(), options);
}

// Oracle: arithmetic on made-up images of 100 x 100 pixels, a grey field with a rim of paper.
TEST_CASE("a comparison passes up to its limits and fails beyond") {
  Image grey{100, 100, std::vector<std::uint8_t>(30000, 100)};
  for (int y = 0; y < 100; ++y) grey.rgb[300 * y] = 250;  // 9900 pixels are drawn
  Image other = grey;
  CHECK(compare(grey, other).exact);
  other.rgb[3] = 103, other.rgb[6] = 97;  // two pixels of 10 000: 0.02 %
  ImageDifference difference = compare(grey, other);
  CHECK(difference.share == 2e-4);
  CHECK(difference.mean == Approx(6.0 / 29700.0));
  CHECK(difference.largest == 3);
  CHECK(difference.passes());
  other.rgb[9] = 103;  // a third
  CHECK_FALSE(compare(grey, other).passes());
  other = grey;
  for (int i = 1; i <= 118; ++i) other.rgb[10 * i + 5] = 101;  // mean 118/29700 = 0.00397
  CHECK(compare(grey, other).passes());
  other.rgb[5] = 102;
  CHECK(compare(grey, other).share == 0.0);
  CHECK_FALSE(compare(grey, other).passes());
  CHECK_FALSE(compare(grey, Image{100, 99, std::vector<std::uint8_t>(29700, 100)}).passes());
}

// A change of one level all over a body that covers a thousandth of the page.
TEST_CASE("the mean is over what is drawn, however empty the page") {
  Image page{100, 100, std::vector<std::uint8_t>(30000, 240)};
  for (int y = 0; y < 100; ++y)  // a page that grows darker downward is paper all the same
    for (int i = 0; i < 300; ++i) page.rgb[300 * y + i] = static_cast<std::uint8_t>(240 - y);
  for (int i = 0; i < 30; ++i) page.rgb[15150 + i] = 50;
  Image other = page;
  for (int i = 0; i < 30; ++i) other.rgb[15150 + i] = 51;
  CHECK(compare(page, other).mean == 1.0);
  CHECK(compare(page, other).share == 0.0);
  CHECK_FALSE(compare(page, other).passes());
}

TEST_CASE("the difference for eyes is black where images agree and 16 times as bright where not") {
  const Image a{2, 1, {10, 10, 10, 50, 50, 50}}, b{2, 1, {10, 10, 10, 53, 50, 20}};
  CHECK(differenceImage(a, b).rgb == std::vector<std::uint8_t>{0, 0, 0, 48, 0, 255});
}
