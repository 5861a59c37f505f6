// Pinocchio on open mechanisms: pinocchio_open (chain | tree | inverse) N SECONDS
#include "common.hpp"
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/cholesky.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>

static pin::Model chain(int n) {
  pin::Model model = empty();
  pin::JointIndex last = 0;
  for (int i = 0; i < n; ++i) last = add_rod(model, last, i ? 1.0 : 0.0);
  return model;
}

// Depth first: crba and the factorisation need the joints of a subtree side by side.
static void grow(pin::Model & model, int i, int n, pin::JointIndex parent) {
  const auto joint = add_rod(model, parent, i ? 1.0 : 0.0);
  for (int child : {2 * i + 1, 2 * i + 2})
    if (child < n) grow(model, child, n, joint);
}

static pin::Model tree(int n) {
  pin::Model model = empty();
  grow(model, 0, n, 0);
  return model;
}

static void forward(const pin::Model & model, double seconds) {
  pin::Data data(model);
  const States s(model.nv);
  const Vector none = Vector::Zero(model.nv);
  auto local = [&](int k) { return pin::aba(model, data, s.q[k], s.v[k], none, pin::Convention::LOCAL)[0]; };
  auto world = [&](int k) { return pin::aba(model, data, s.q[k], s.v[k], none, pin::Convention::WORLD)[0]; };
  Vector rhs(model.nv);
  auto factored = [&](int k) {
    pin::crba(model, data, s.q[k]);
    rhs = -pin::nonLinearEffects(model, data, s.q[k], s.v[k]);
    pin::cholesky::decompose(model, data);
    pin::cholesky::solve(model, data, rhs);
    return rhs[0];
  };
  print_line("aba local", time_of(seconds, local), local(0));
  print_line("aba world", time_of(seconds, world), world(0));
  print_line("crba + Cholesky", time_of(seconds, factored), factored(0));
}

static void inverse(const pin::Model & model, double seconds) {
  pin::Data data(model);
  const States s(model.nv);
  auto rnea = [&](int k) { return pin::rnea(model, data, s.q[k], s.v[k], s.a[k])[0]; };
  print_line("rnea", time_of(seconds, rnea), rnea(0));
}

int main(int argc, char ** argv) {
  if (argc == 2 && std::string(argv[1]) == "version") return std::printf("%s\n", PINOCCHIO_VERSION), 0;
  if (argc != 4) return std::fprintf(stderr, "pinocchio_open (chain | tree | inverse) N SECONDS\n"), 1;
  const std::string problem = argv[1];
  const int n = std::atoi(argv[2]);
  const double seconds = std::atof(argv[3]);
  if (problem == "chain") forward(chain(n), seconds);
  if (problem == "tree") forward(tree(n), seconds);
  if (problem == "inverse") inverse(chain(n), seconds);
}
