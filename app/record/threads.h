// Threads that the application lends to its worlds.
#pragma once

#include "sim/method/workers.h"

namespace tumble {

/// So many workers: the thread that calls them, and others that live as long as the workers do.
Workers makeWorkers(int count);

/// How many threads every world that is made from now on may use; 1 before.
void useThreads(int count);
int threadsInUse();

}  // namespace tumble
