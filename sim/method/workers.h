// Chapter 9, method: work side by side. The library starts no thread: who runs a world may lend it
// some, and whatever they do, no bit of the motion changes.
#pragma once

#include <functional>

namespace tumble {

/// Calls that may be made at once.
struct Workers {
  int count = 1;
  /// Calls act(item, worker) once for each item from 0 to items − 1, in any order and on any
  /// threads, but never two at once with the same worker from 0 to count − 1. Returns when all are
  /// done; what one of them throws is thrown then. Empty where count is 1.
  std::function<void(int items, const std::function<void(int item, int worker)>& act)> forEach;
};

}  // namespace tumble
