// A run that is recorded while others look at it.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// Records a scene in a thread of its own. Ends with its owner, between two samples.
class Recorder {
 public:
  explicit Recorder(const Scene& scene);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Hands over what is new, at the end with report and certificate. True if anything was.
  bool take(Recording& into);
  /// Waits until there is something to take, at most so long [s].
  void waitFor(double seconds);

  bool running() const { return running_; }
  double share() const { return share_; }  ///< done, in [0, 1]
  /// Why the scene cannot run, or "". To be asked when it runs no more.
  const std::string& complaint() const { return complaint_; }

 private:
  void run(const Scene& scene);

  std::atomic<bool> running_ = true, unwanted_ = false;
  std::atomic<double> share_ = 0.0;
  std::string complaint_;
  std::mutex lock_;              // of what follows
  std::vector<Sample> samples_;  // not yet taken
  Recording end_;                // without samples
  bool ended_ = false;           // end_ is there to be taken
  std::thread thread_;           // last: it begins when all else is there
};

}  // namespace tumble
