// Pinocchio on N planar four-bars in a row: pinocchio_loop four-bars N SECONDS
#include "common.hpp"
#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/algorithm/loop-constrained-aba.hpp>
#include <cmath>

using Constraints = PINOCCHIO_ALIGNED_STD_VECTOR(pin::RigidConstraintModel);
using ConstraintData = PINOCCHIO_ALIGNED_STD_VECTOR(pin::RigidConstraintData);

// N + 1 cranks on pivots 1 m apart, N couplers on the first N of them, N closures at the couplers' ends.
struct FourBars {
  pin::Model model = empty();
  Constraints constraints;
  Vector q, v, none;

  FourBars(int n, double angle, double rate) {
    std::vector<pin::JointIndex> cranks, couplers;
    for (int j = 0; j <= n; ++j) {
      cranks.push_back(add_rod(model, 0, j));
      if (j < n) couplers.push_back(add_rod(model, cranks[j], 1.0));
    }
    for (int i = 0; i < n; ++i)
      constraints.emplace_back(pin::CONTACT_3D, model, couplers[i], at(1), cranks[i + 1], at(1), pin::LOCAL);
    q.resize(model.nq);
    v.resize(model.nv);
    none = Vector::Zero(model.nv);
    auto set = [&](pin::JointIndex joint, double sign) {
      q[model.joints[joint].idx_q()] = sign * angle;
      v[model.joints[joint].idx_v()] = sign * rate;
    };
    for (auto joint : cranks) set(joint, 1);
    for (auto joint : couplers) set(joint, -1);
  }

  ConstraintData data() const {
    ConstraintData all;
    for (const auto & constraint : constraints) all.emplace_back(constraint.createData());
    return all;
  }
};

static void constraint_dynamics(FourBars & f, double seconds) {
  pin::Data data(f.model);
  auto closures = f.data();
  pin::initConstraintDynamics(f.model, data, f.constraints, closures);
  pin::ProximalSettings settings(1e-10, 1e-8, 5);
  auto call = [&](int) {
    return pin::constraintDynamics(f.model, data, f.q, f.v, f.none, f.constraints, closures, settings)[0];
  };
  const double value = (call(0), data.ddq[0]);
  print_line("constraintDynamics", time_of(seconds, call), value);
}

static void loop_aba(FourBars & f, double seconds) {
  pin::Data data(f.model);
  auto closures = f.data();
  pin::computeJointMinimalOrdering(f.model, data, f.constraints);
  pin::ProximalSettings settings(1e-10, 1e-6, 10);
  auto call = [&](int) {
    return pin::lcaba(f.model, data, f.q, f.v, f.none, f.constraints, closures, settings)[0];
  };
  const double value = (call(0), data.ddq[0]);
  print_line("lcaba", time_of(seconds, call), value);
}

int main(int argc, char ** argv) {
  if (argc != 4) return std::fprintf(stderr, "pinocchio_loop four-bars N SECONDS\n"), 1;
  FourBars f(std::atoi(argv[2]), 1.2, -1.0);
  const double seconds = std::atof(argv[3]);
  constraint_dynamics(f, seconds);
  FourBars anew(std::atoi(argv[2]), 1.2, -1.0);
  loop_aba(anew, seconds);
}
