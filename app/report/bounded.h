// Work that may take only so long: in a process of its own, since a run does not look at the clock.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace tumble {

/// What came of bounded work.
struct Bounded {
  std::string sent;        ///< all that it sent before its end
  bool whole = false;      ///< whether it came to its end
  bool outOfTime = false;  ///< whether its time was over before
};

using Send = std::function<void(std::string_view)>;

/// Runs `work` in a copy of this process that ends after so many seconds of CPU time of its own,
/// rounded up to whole ones. Nothing but what it sends comes back.
/// @throws FileError if the system has no process or pipe left
Bounded runBounded(double seconds, const std::function<void(const Send&)>& work);

}  // namespace tumble
