// A whole run, hashed.
#pragma once

#include "app/record/hashes.h"
#include "app/record/recording.h"

namespace tumble::test {

/// All samples at the rate [1/s], and the events.
inline RunHashes hashesOf(const Scene& scene, double rate = 10.0) {
  RunHashes hashes = hashesFor(scene, rate);
  const Recording recording =
      run(scene, rate, [&](Sample&& sample) { hashes.samples.push_back(hashOf(sample)); });
  addEvents(hashes, recording.report);
  return hashes;
}

}  // namespace tumble::test
