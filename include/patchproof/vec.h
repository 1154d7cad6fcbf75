// SPDX-License-Identifier: Apache-2.0
// Fixed-size vectors over any Ring: points, control points, homogeneous points.
#pragma once

#include <array>
#include <cstddef>

namespace patchproof {

// N numbers with componentwise + and −, and scalar ×. Value-initialised to zero by Vec<T, N>{}... for the number types
// of scalar/ (all of them default-construct to 0).
template <class T, std::size_t N>
struct Vec {
  std::array<T, N> c{};

  T& operator[](std::size_t i) { return c[i]; }
  const T& operator[](std::size_t i) const { return c[i]; }
  static constexpr std::size_t size() { return N; }

  Vec& operator+=(const Vec& o) {
    for (std::size_t i = 0; i < N; ++i) c[i] += o.c[i];
    return *this;
  }
  friend Vec operator+(Vec a, const Vec& b) {
    a += b;
    return a;
  }
  friend Vec operator-(const Vec& a, const Vec& b) {
    Vec r;
    for (std::size_t i = 0; i < N; ++i) r.c[i] = a.c[i] - b.c[i];
    return r;
  }
  friend Vec operator-(const Vec& a) {
    Vec r;
    for (std::size_t i = 0; i < N; ++i) r.c[i] = -a.c[i];
    return r;
  }
  friend Vec operator*(const T& s, const Vec& v) {
    Vec r;
    for (std::size_t i = 0; i < N; ++i) r.c[i] = s * v.c[i];
    return r;
  }
  // Only for scalars whose == is exact (Rational, Integer, Quadratic) or is meant bit for bit (double).
  friend bool operator==(const Vec& a, const Vec& b) { return a.c == b.c; }
};

template <class T>
T dot(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

}  // namespace patchproof
