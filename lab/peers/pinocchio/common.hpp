// What the Pinocchio programs share: the rod, the states that every program starts from, and the clock.
#pragma once
#include <pinocchio/multibody.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace pin = pinocchio;
using Vector = Eigen::VectorXd;

constexpr double GRAVITY = 9.81;
constexpr int STATES = 8;

// 1 m, 1 kg, its centre in the middle; slender but for 0.001 kg m2 about its own axis.
inline pin::Inertia rod() {
  const Eigen::Matrix3d inertia = Eigen::Vector3d(1e-3, 1.0 / 12, 1.0 / 12).asDiagonal();
  return pin::Inertia(1.0, Eigen::Vector3d(0.5, 0, 0), inertia);
}

inline pin::SE3 at(double x) { return pin::SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, 0, 0)); }

inline pin::Model empty() {
  pin::Model model;
  model.gravity.linear(Eigen::Vector3d(0, -GRAVITY, 0));
  return model;
}

inline pin::JointIndex add_rod(pin::Model & model, pin::JointIndex parent, double x) {
  const auto joint = model.addJoint(parent, pin::JointModelRZ(), at(x), "j" + std::to_string(model.njoints));
  model.appendBodyToJoint(joint, rod(), pin::SE3::Identity());
  return joint;
}

// The same numbers in every program: a linear congruential generator, first all angles of a state, then all rates.
struct States {
  std::vector<Vector> q, v, a;
  explicit States(int n) {
    uint32_t seed = 1;
    auto next = [&] {
      seed = seed * 1664525u + 1013904223u;
      return (seed >> 8) / 16777216.0 * 2.0 - 1.0;
    };
    for (int k = 0; k < STATES; ++k) {
      Vector angles(n), rates(n);
      for (int i = 0; i < n; ++i) angles[i] = 3.0 * next();
      for (int i = 0; i < n; ++i) rates[i] = next();
      q.push_back(angles);
      v.push_back(rates);
      a.push_back(rates); // inverse dynamics is asked at accelerations that equal the rates
    }
  }
};

// CPU time of this process [s].
inline double now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

// CPU seconds for one call: the median of batches that fill `seconds` together.
template <class F> double time_of(double seconds, F call) {
  constexpr int BATCHES = 7;
  volatile double sink = 0;
  auto batch = [&](long n) {
    const double start = now();
    for (long i = 0; i < n; ++i) sink = sink + call(int(i % STATES));
    return now() - start;
  };
  long n = 1;
  while (batch(n) < seconds / (2 * BATCHES)) n *= 2;
  std::vector<double> times;
  for (int i = 0; i < BATCHES; ++i) times.push_back(batch(n) / n);
  std::sort(times.begin(), times.end());
  return times[BATCHES / 2];
}

// One line: algorithm, seconds for one call, the value at the first state, what that is compared with.
inline void print_line(const char * algorithm, double seconds, double value, const char * reference = "exact") {
  std::printf("%s,%.6e,%.17g,%s\n", algorithm, seconds, value, reference);
  std::fflush(stdout);
}
