// Pinocchio on robots: pinocchio_robot PROBLEM N SECONDS, for the robot of N freedoms that robots.py made
#include "common.hpp"
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <fstream>
#include <sstream>

static pin::JointModel joint_of(const std::string & kind, const Eigen::Vector3d & axis) {
  if (kind == "RX") return pin::JointModelRX();
  if (kind == "RY") return pin::JointModelRY();
  if (kind == "RZ") return pin::JointModelRZ();
  if (kind == "PX") return pin::JointModelPX();
  if (kind == "PY") return pin::JointModelPY();
  if (kind == "PZ") return pin::JointModelPZ();
  if (kind == "FreeFlyer") return pin::JointModelFreeFlyer();
  if (kind == "RevoluteUnaligned") return pin::JointModelRevoluteUnaligned(axis);
  if (kind == "PrismaticUnaligned") return pin::JointModelPrismaticUnaligned(axis);
  std::fprintf(stderr, "no joint %s here\n", kind.c_str());
  std::exit(1);
}

static pin::Model read(const std::string & path) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  pin::Model model;
  model.gravity.linear(Eigen::Vector3d(0, 0, -GRAVITY));
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::string kind, name;
    int parent;
    double x[28];
    in >> kind >> parent >> name;
    for (double & number : x) in >> number;
    const pin::SE3 place(Rows(Eigen::Map<Rows>(x)), Eigen::Vector3d(x[9], x[10], x[11]));
    const pin::Inertia body(x[12], Eigen::Vector3d(x[13], x[14], x[15]), Rows(Eigen::Map<Rows>(x + 16)));
    const auto id = model.addJoint(parent, joint_of(kind, Eigen::Vector3d(x[25], x[26], x[27])), place, name);
    model.appendBodyToJoint(id, body, pin::SE3::Identity());
  }
  return model;
}

int main(int argc, char ** argv) {
  if (argc == 2 && std::string(argv[1]) == "version") return std::printf("%s\n", PINOCCHIO_VERSION), 0;
  if (argc != 4) return std::fprintf(stderr, "pinocchio_robot PROBLEM N SECONDS\n"), 1;
  const std::string problem = argv[1], folder = std::getenv("PEERS_DIR");
  const pin::Model model = read(folder + "/robots/" + argv[2] + ".txt");
  const double seconds = std::atof(argv[3]);
  pin::Data data(model);
  const int n = model.nv, base = model.joints[1].nv() == 6 ? 6 : 0, joints = n - base;
  std::vector<Vector> q;
  for (int k = 0; k < STATES; ++k) {
    Vector step = Vector::Constant(n, 0.2 + 0.1 * k);
    step.head(base).setZero();
    q.push_back(pin::integrate(model, pin::neutral(model), step));
  }
  Vector v = Vector::Constant(n, 0.5);
  v.head(base).setZero();
  const Vector a = v, none = Vector::Zero(n);
  const pin::JointIndex last = model.njoints - 1;
  pin::Data::Matrix6x J(6, n);
  // values are sums over the joints, so that their order is of no account
  const auto timed = [&](const char * name, auto call, auto value) {
    const double time = time_of(seconds, call);
    call(0);
    print_line(name, time, value());
  };
  if (problem == "robot-mass") {
    const auto value = [&] { return data.M.diagonal().tail(joints).sum(); };
    timed("crba local", [&](int k) { return pin::crba(model, data, q[k], pin::Convention::LOCAL)(0, 0); }, value);
    timed("crba world", [&](int k) { return pin::crba(model, data, q[k], pin::Convention::WORLD)(0, 0); }, value);
  }
  if (problem == "robot-forward") {
    const auto value = [&] { return data.ddq.tail(joints).sum(); };
    timed("aba local", [&](int k) { return pin::aba(model, data, q[k], v, none, pin::Convention::LOCAL)[0]; }, value);
    timed("aba world", [&](int k) { return pin::aba(model, data, q[k], v, none, pin::Convention::WORLD)[0]; }, value);
  }
  if (problem == "robot-inverse") {
    const auto value = [&] { return data.tau.tail(joints).sum(); };
    timed("rnea", [&](int k) { return pin::rnea(model, data, q[k], v, a)[0]; }, value);
  }
  if (problem == "robot-jacobian") {
    const auto value = [&] { return J.rightCols(joints).squaredNorm(); };
    const auto own = [&](int k) {
      J.setZero();
      pin::computeJointJacobian(model, data, q[k], last, J);
      return J(0, 0);
    };
    timed("of one joint", own, value);
    const auto all = [&](int k) {
      pin::computeJointJacobians(model, data, q[k]);
      J.setZero();
      pin::getJointJacobian(model, data, last, pin::LOCAL_WORLD_ALIGNED, J);
      return J(0, 0);
    };
    timed("of all joints", all, value);
  }
  if (problem == "robot-derivatives") {
    const auto value = [&] { return data.ddq_dq.bottomRightCorner(joints, joints).sum(); };
    const auto call = [&](int k) {
      pin::computeABADerivatives(model, data, q[k], v, none);
      return data.ddq_dq(0, 0);
    };
    timed("computeABADerivatives", call, value);
  }
}
