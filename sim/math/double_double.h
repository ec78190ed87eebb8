// Chapter 0, math: sums and products without rounding error, where a difference would lose digits.
#pragma once

namespace tumble {

/// An unevaluated sum hi + lo with |lo| at most half a unit in the last place of hi: twice the
/// digits of a double (Dekker, A Floating-Point Technique for Extending the Available Precision,
/// 1971). Relative error of each operation below 1e-31.
struct DoubleDouble {
  double hi = 0.0, lo = 0.0;
};

/// a + b without error (Knuth).
inline DoubleDouble twoSum(double a, double b) {
  const double sum = a + b, share = sum - a;
  return {sum, (a - (sum - share)) + (b - share)};
}

/// a b without error, by halves of 26 bits (Dekker, Veltkamp). For |a|, |b| < 1e150.
inline DoubleDouble twoProduct(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2²⁷ + 1
  const double ca = kSplit * a, cb = kSplit * b;
  const double ah = ca - (ca - a), bh = cb - (cb - b);
  const double al = a - ah, bl = b - bh;
  const double product = a * b;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = twoSum(a.hi, b.hi), low = twoSum(a.lo, b.lo);
  const DoubleDouble sum = twoSum(high.hi, high.lo + low.hi);
  return twoSum(sum.hi, sum.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.hi, -a.lo};
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = twoProduct(a.hi, b.hi);
  return twoSum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator*(double a, const DoubleDouble& b) {
  const DoubleDouble p = twoProduct(a, b.hi);
  return twoSum(p.hi, p.lo + a * b.lo);
}

/// a / b by three digits of a double each: the quotient of the highs, and of what is left twice.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double q1 = a.hi / b.hi;
  const DoubleDouble left = a - q1 * b;
  const double q2 = left.hi / b.hi, q3 = (left - q2 * b).hi / b.hi;
  return twoSum(q1, q2) + DoubleDouble{q3, 0.0};
}

inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

}  // namespace tumble
