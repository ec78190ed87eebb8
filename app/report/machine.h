// What machine and build a measurement was made with.
#pragma once

#include <string>

namespace tumble {

/// "AMD EPYC 7B13, 2 processors; gcc 12.2.0, Release -O2, assertions on; tumble 0.1.0"
std::string machineLine();

}  // namespace tumble
