// Several processes of this program on one machine.
#pragma once

#include <functional>

namespace tumble {

/// Runs work(i, tell) for i in [0, count), each in a process of its own, and returns the largest
/// exit code. `tell` is to be called after each piece of work, `told` then is in the parent with
/// the pieces so far. No thread and no OpenGL context may be there before.
/// @throws std::system_error if a process cannot be begun.
int runJobs(int count, const std::function<int(int, const std::function<void()>&)>& work,
            const std::function<void(long)>& told);

}  // namespace tumble
