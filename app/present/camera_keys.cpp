#include "app/present/camera_keys.h"

#include <algorithm>

namespace tumble {

namespace {

// Eye, target and field of a key as one vector.
using Station = Eigen::Matrix<double, 7, 1>;

Station stationOf(const CameraKey& key) {
  Station place;
  place << key.eye, key.target, key.fov;
  return place;
}

Station rateAt(const std::vector<CameraKey>& keys, std::size_t k) {
  if (k == 0 || k + 1 == keys.size()) return Station::Zero();
  return (stationOf(keys[k + 1]) - stationOf(keys[k - 1])) / (keys[k + 1].at - keys[k - 1].at);
}

Station between(const std::vector<CameraKey>& keys, std::size_t k, double t) {
  const double h = keys[k + 1].at - keys[k].at, u = (t - keys[k].at) / h, w = 1.0 - u;
  return w * w * (1.0 + 2.0 * u) * stationOf(keys[k]) +
         u * u * (3.0 - 2.0 * u) * stationOf(keys[k + 1]) +
         h * u * w * (w * rateAt(keys, k) - u * rateAt(keys, k + 1));
}

}  // namespace

Camera cameraAt(const std::vector<CameraKey>& keys, double t) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), t,
                                      [](double at, const CameraKey& key) { return at < key.at; });
  const std::size_t next = static_cast<std::size_t>(after - keys.begin());
  const Station place = next == 0             ? stationOf(keys.front())
                        : next == keys.size() ? stationOf(keys.back())
                                              : between(keys, next - 1, t);
  Camera camera;
  camera.eye = place.head<3>();
  camera.target = place.segment<3>(3);
  camera.fov = std::clamp(place[6], 1.0, 170.0);
  return camera;
}

}  // namespace tumble
