#include "app/command/nearest.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tumble {

int editDistance(std::string_view a, std::string_view b) {
  // One row of the table of distances between prefixes at a time.
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string didYouMean(std::string_view word, std::span<const std::string> names) {
  int best = std::max<int>(2, static_cast<int>(word.size()) / 3) + 1;
  std::string_view nearest;
  for (const std::string& name : names) {
    const int distance = editDistance(word, name);
    if (distance < best) {
      best = distance;
      nearest = name;
    }
  }
  return nearest.empty() ? "" : ", did you mean '" + std::string(nearest) + "'?";
}

}  // namespace tumble
