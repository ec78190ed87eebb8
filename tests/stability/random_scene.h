// Random scenes as text: one to six bodies of all shapes, thrown at each other over a floor, in
// joints, on springs, under drag and point forces.
#pragma once

#include <cstdint>
#include <string>

namespace tumble::test {

/// The same seed, the same text. One second of motion.
/// @param most  bodies that move, at most
std::string randomScene(std::uint64_t seed, int most = 6);

}  // namespace tumble::test
