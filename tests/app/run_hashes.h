// A whole run, hashed.
#pragma once

#include "app/record/hashes.h"
#include "app/record/recording.h"
#include "app/record/threads.h"

namespace tumble::test {

/// Worlds that are made while it lives simulate by so many threads.
struct ThreadsInUse {
  explicit ThreadsInUse(int count) { useThreads(count); }
  ~ThreadsInUse() { useThreads(1); }
  ThreadsInUse(const ThreadsInUse&) = delete;
  ThreadsInUse& operator=(const ThreadsInUse&) = delete;
};

/// All samples at the rate [1/s], and the events.
inline RunHashes hashesOf(const Scene& scene, double rate = 10.0) {
  RunHashes hashes = hashesFor(scene, rate);
  const Recording recording =
      run(scene, rate, [&](Sample&& sample) { hashes.samples.push_back(hashOf(sample)); });
  addEvents(hashes, recording.report);
  return hashes;
}

}  // namespace tumble::test
