// Quadruple precision: 113 bits, the same by every compiler.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace tumble::test {

using Quad = boost::multiprecision::cpp_bin_float_quad;

}  // namespace tumble::test
