// What both programs share: Frankel's chain in inches, poses along it, and the counting loop.
#pragma once
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

constexpr double A1 = 8.5, A2 = 48.0, A3 = 38.5, A4 = 18.5, SWING = 0.3;
constexpr int POSES = 64;
using Joints = std::array<double, 4>;

inline Joints joints(int i) {
  const auto part = [i](int stride) { return 0.02 + 0.96 * ((i * stride) % POSES) / POSES; };
  // Between the joint limits of the machine.
  return {SWING, 0.8 - 2.3 * part(1), -0.3 - 1.8 * part(5), 0.4 - 3.1 * part(11)};
}

// The plane formula, to check that a library was given this chain.
inline std::array<double, 3> expected(const Joints &q) {
  const double b = q[1], a = b + q[2], k = a + q[3];
  const double reach = A1 + A2 * std::cos(b) + A3 * std::cos(a) + A4 * std::cos(k);
  return {reach * std::cos(q[0]), reach * std::sin(q[0]), A2 * std::sin(b) + A3 * std::sin(a) + A4 * std::sin(k)};
}

inline void check(const char *what, double off, double within) {
  if (!(off < within)) {
    std::fprintf(stderr, "%s is off by %g\n", what, off);
    std::exit(1);
  }
}

// `PROGRAM nothing|forward|inverse COUNT`
template <class Forward, class Inverse>
int run(int argc, char **argv, Forward forward, Inverse inverse) {
  if (argc != 3) return 2;
  const int count = std::atoi(argv[2]);
  volatile double sink = 0;
  for (int i = 0; i < count; i++) {
    if (!std::strcmp(argv[1], "forward")) sink = forward(i % POSES);
    else if (!std::strcmp(argv[1], "inverse")) sink = inverse(i % POSES);
    else sink = joints(i % POSES)[1];
  }
  return std::isnan(sink);
}
