// Simbody on chains, a tree and four-bars: simbody (chain | tree | four-bars) N SECONDS
#include <SimTKsimbody.h>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

using namespace SimTK;
constexpr int STATES = 8, BATCHES = 7;

struct Mechanism {
  MultibodySystem system;
  SimbodyMatterSubsystem matter{system};
  GeneralForceSubsystem forces{system};
  Body::Rigid rod{MassProperties(1, Vec3(0.5, 0, 0), Inertia(1e-3, 1.0 / 12 + 0.25, 1.0 / 12 + 0.25))};
  std::vector<MobilizedBody> bodies;
  State state;
  // for each state the angles and the rates, in the order of `bodies`
  std::vector<Vector> q, u;

  Mechanism() { Force::Gravity(forces, matter, Vec3(0, -9.81, 0)); }

  int add(int parent, double x) {
    MobilizedBody & on = parent < 0 ? static_cast<MobilizedBody &>(matter.Ground()) : bodies[parent];
    bodies.push_back(MobilizedBody::Pin(on, Transform(Vec3(x, 0, 0)), rod, Transform()));
    return int(bodies.size()) - 1;
  }

  void grow(int i, int n, int parent) {
    const int body = add(parent, i ? 1 : 0);
    for (int child : {2 * i + 1, 2 * i + 2})
      if (child < n) grow(child, n, body);
  }

  // Two planes hold each coupler's end on the next crank: the third equation of a ball would repeat others.
  void four_bars(int n) {
    for (int j = 0; j <= n; ++j) {
      const int crank = add(-1, j);
      if (j < n) add(crank, 1);
    }
    for (int i = 0; i < n; ++i) {
      MobilizedBody & coupler = bodies[2 * i + 1], & crank = bodies[2 * i + 2];
      Constraint::PointInPlane(crank, UnitVec3(1, 0, 0), 1.0, coupler, Vec3(1, 0, 0));
      Constraint::PointInPlane(crank, UnitVec3(0, 1, 0), 0.0, coupler, Vec3(1, 0, 0));
    }
  }

  void make_states(bool is_four_bars) {
    state = system.realizeTopology();
    system.realizeModel(state);
    uint32_t seed = 1;
    auto next = [&] {
      seed = seed * 1664525u + 1013904223u;
      return (seed >> 8) / 16777216.0 * 2.0 - 1.0;
    };
    const int n = int(bodies.size());
    for (int k = 0; k < STATES; ++k) {
      for (int i = 0; i < n; ++i) bodies[i].setOneQ(state, 0, is_four_bars ? (i % 2 ? -1.2 : 1.2) : 3 * next());
      for (int i = 0; i < n; ++i) bodies[i].setOneU(state, 0, is_four_bars ? (i % 2 ? 1 : -1) : next());
      q.push_back(state.getQ());
      u.push_back(state.getU());
    }
  }

  double accelerate(int k) {
    state.updQ() = q[k];
    state.updU() = u[k];
    system.realize(state, Stage::Acceleration);
    return bodies[0].getOneUDot(state, 0);
  }
};

static double now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

static double time_of(Mechanism & m, double seconds) {
  auto batch = [&](long n) {
    const double start = now();
    for (long i = 0; i < n; ++i) m.accelerate(int(i % STATES));
    return now() - start;
  };
  long n = 1;
  while (batch(n) < seconds / (2 * BATCHES)) n *= 2;
  std::vector<double> times;
  for (int i = 0; i < BATCHES; ++i) times.push_back(batch(n) / n);
  std::sort(times.begin(), times.end());
  return times[BATCHES / 2];
}

int main(int argc, char ** argv) {
  if (argc == 2) {
    int major, minor, build;
    SimTK_version_simbody(&major, &minor, &build);
    return std::printf("%d.%d\n", major, minor), 0;
  }
  if (argc != 4) return std::fprintf(stderr, "simbody (chain | tree | four-bars) N SECONDS\n"), 1;
  const std::string problem = argv[1];
  const int n = std::atoi(argv[2]);
  Mechanism m;
  if (problem == "chain")
    for (int i = 0; i < n; ++i) m.add(i - 1, i ? 1 : 0);
  if (problem == "tree") m.grow(0, n, -1);
  if (problem == "four-bars") m.four_bars(n);
  m.make_states(problem == "four-bars");
  const double value = m.accelerate(0);
  std::printf("realize(Acceleration),%.6e,%.17g,exact\n", time_of(m, std::atof(argv[3])), value);
}
