// Quadruple precision: 113 bits, the same by every compiler.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace tumble::test {

using Quad = boost::multiprecision::cpp_bin_float_quad;
using QVec = std::array<Quad, 3>;

inline Quad dot(const QVec& a, const QVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace tumble::test
